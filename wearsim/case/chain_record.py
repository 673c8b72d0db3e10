"""The record of a drive with a chain, and which keys belong to its mechanism."""

from pathlib import Path

from wearsim.case.keys import CaseTables
from wearsim.contact.stop_limits import CHAIN_LIMITS
from wearsim.input.faults import CaseRecord, Faults
from wearsim.input.mechanism_registry import STRAND_FORMS, WRAP_FORMS


class ChainRecord(CaseRecord):
    """The record of a drive with a chain."""

    def __init__(self, tables: CaseTables, folder: Path, faults: Faults) -> None:
        super().__init__(tables, folder, faults)
        self.tables = tables
        if tables.sprocket is not None and "back_flank" not in tables.sprocket.model_fields_set:
            # Taken where the tooth form has one.
            del self.inputs["sprocket"]["back_flank"]


_BELONGS_TO = {
    "mechanism.table_file": "prescribed",
    "mechanism.phases": "wrap",
    "mechanism.friction_roller_tooth": "wrap",
    "mechanism.friction_roller_bush": "wrap",
    "drive": "wrap",
    "joint": "wrap",
    "sprocket.role": "wrap",
    **{f"stop.{row.key}": row.kind for row in CHAIN_LIMITS if row.kind},
    "wear.roller_wear_ratio": "wrap",
    "chain.pin_diameter_mm": "wrap",
    "chain.bush_diameter_mm": "wrap",
    "chain.bearing_area_mm2": "wrap",
    "chain.mass_kg_per_m": "wrap",
}


def mechanism_kind(case: ChainRecord) -> str:
    """Return the kind of mechanism, and name the keys that belong to another one."""
    tables = case.tables
    profile = tables.sprocket.profile if tables.sprocket else ""
    kind = tables.mechanism.kind
    if kind is None:
        kind = "wrap" if profile in WRAP_FORMS else "strand"
        case.take("mechanism.kind", kind, "default for this profile")
    if kind == "strand" and profile in WRAP_FORMS:
        case.faults.add(
            "sprocket.profile",
            f"{profile!r} is made for a chain that wraps the sprocket: set mechanism.kind = 'wrap', or "
            f"use profile = {' or '.join(map(repr, STRAND_FORMS))} on a strand",
        )
    for place, owner in _BELONGS_TO.items():
        for key in _given(tables, place) if owner != kind else ():
            case.faults.add(key, f"belongs to kind = {owner!r}: remove it, or set mechanism.kind = {owner!r}")
    return kind


def _given(tables: CaseTables, place: str) -> list[str]:
    """Return the keys that were given of a table, or the one key that is named."""
    table, _, name = place.partition(".")
    model = getattr(tables, table)
    if model is None:
        return []
    names = sorted(model.model_fields_set) if not name else [name]
    return [f"{table}.{key}" for key in names if getattr(model, key) is not None]
