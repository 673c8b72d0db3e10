"""Which mechanism a case is about, and which keys belong to it."""

from wearsim.input.case_record import Resolution
from wearsim.input.schema import CaseTables

WRAP_PROFILES = ("iso606", "ansi_b29", "gost591", "dxf")
"""Tooth forms for a chain that wraps the sprocket."""

_BELONGS_TO = {
    "mechanism.table_file": "prescribed",
    "mechanism.phases": "wrap",
    "mechanism.friction_roller_tooth": "wrap",
    "mechanism.friction_roller_bush": "wrap",
    "drive": "wrap",
    "joint": "wrap",
    "sprocket.role": "wrap",
    "stop.elongation_percent": "wrap",
    "stop.over_pins_change_mm": "wrap",
    "stop.min_slack_tension_N": "wrap",
    "wear.roller_wear_ratio": "wrap",
    "chain.pin_diameter_mm": "wrap",
    "chain.bush_diameter_mm": "wrap",
    "chain.bearing_area_mm2": "wrap",
    "chain.mass_kg_per_m": "wrap",
}


def mechanism_kind(case: Resolution) -> str:
    """Return the kind of mechanism, and name the keys that belong to another one."""
    tables = case.tables
    profile = tables.sprocket.profile if tables.sprocket else ""
    kind = tables.mechanism.kind
    if kind is None:
        kind = "wrap" if profile in WRAP_PROFILES else "strand"
        case.take("mechanism.kind", kind, "default for this profile")
    if kind == "strand" and profile in WRAP_PROFILES:
        case.faults.add(
            "sprocket.profile",
            f"{profile!r} is made for a chain that wraps the sprocket: set mechanism.kind = 'wrap', or "
            "use profile = 'evolute' or 'points' on a strand",
        )
    for place, owner in _BELONGS_TO.items():
        for key in _given(tables, place) if owner != kind else ():
            case.faults.add(key, f"belongs to kind = {owner!r}: remove it")
    return kind


def _given(tables: CaseTables, place: str) -> list[str]:
    """Return the keys that were given of a table, or the one key that is named."""
    table, _, name = place.partition(".")
    model = getattr(tables, table)
    if model is None:
        return []
    names = sorted(model.model_fields_set) if not name else [name]
    return [f"{table}.{key}" for key in names if getattr(model, key) is not None]
