"""What cases of all kinds complete alike: materials, wear law, fatigue and how the life is calculated."""

import math
from collections.abc import Mapping
from dataclasses import replace

from wearsim.case.chain_record import ChainRecord
from wearsim.case.duty_blocks import GivenLoad
from wearsim.case.keys import MaterialTable, RunTable, SprocketTable, Table, WearTable
from wearsim.case.keys.wear_tables import FatigueTable, FilmTable, FlankMaterialTable
from wearsim.case.model import Drive, FatigueInput, FilmInput, RunInput, WearInput
from wearsim.catalogue.catalogues import Chain, materials, wear_conditions, wear_laws
from wearsim.catalogue.own_wear_laws import OwnWearLaw, own_wear_laws
from wearsim.contact.hertz import contact_modulus
from wearsim.fatigue.contact_fatigue import FlankMaterial
from wearsim.input.faults import CaseRecord

DEFAULT_BAND = 3.0
"""Factor to either side of a coefficient without a band of its own: a life is only as good as k."""

FLANK_NODES = 201
"""Points of a flank by default."""

_PLAUSIBLE_WEAR_RATE = (1e-15, 1e-6)

_NAMED_DEFAULTS = {
    "wear": {"law": "default"},
    "run": {"method": "default", "horizon_hours": "default: until a limit is met"},
}
"""Defaults of the schema itself that matter for the life, and what is said of them."""


_SPROCKET = (
    "contact fatigue of the sprocket by formulas (21) to (26) of source 001, which are for gears; applying "
    "them to its teeth is this project's reconstruction",
    "the stress for contact fatigue is the highest contact pressure on the new flank, once per cycle; the "
    "loads of a duty add up by its sixth power (Miner), and the effect of wear on it is neglected",
)


def take_defaults(case: CaseRecord, tables: Table) -> None:
    """Record the defaults of the schema that matter for the life and were not given."""
    for table, keys in _NAMED_DEFAULTS.items():
        model = getattr(tables, table)
        for key, why in keys.items():
            if key not in model.model_fields_set:
                case.take(f"{table}.{key}", getattr(model, key), why)


def contact_modulus_of(case: CaseRecord, bodies: Mapping[str, MaterialTable]) -> float:
    """Return the contact modulus of two materials."""
    (e1, nu1), (e2, nu2) = (_material(case, body, table) for body, table in bodies.items())
    return contact_modulus((e1, e2), (nu1, nu2))


def _material(case: CaseRecord, body: str, table: MaterialTable) -> tuple[float, float]:
    if table.name is not None:
        known = materials()[table.name]
        return known.youngs_modulus, known.poissons_ratio
    steel, modulus, ratio = materials()["steel"], table.youngs_modulus_MPa, table.poissons_ratio
    if modulus is None:
        modulus = steel.youngs_modulus
        case.take(f"material.{body}.youngs_modulus_MPa", modulus, "steel, default")
    if ratio is None:
        ratio = steel.poissons_ratio
        case.take(f"material.{body}.poissons_ratio", ratio, "steel, default")
    return modulus, ratio


def run_input(case: CaseRecord, table: RunTable, tolerance: float = Drive.life_tolerance) -> RunInput:
    """Return how the life is calculated."""
    if table.method == "per_cycle" and table.cycles_per_update is None:
        case.take("run.cycles_per_update", 1, "every cycle")
    if table.life_tolerance is None:
        case.take("run.life_tolerance", tolerance, "default")
    return RunInput(
        table.method, table.cycles_per_update or 1, table.life_tolerance or tolerance, table.horizon_hours
    )


def film_input(table: FilmTable | None) -> FilmInput | None:
    """Return the oil between the flanks."""
    if table is None:
        return None
    return FilmInput(
        1e-9 * table.viscosity_mPa_s, 1e-3 * table.pressure_viscosity_per_GPa, 1e-3 * table.roughness_um
    )


def wear_input(case: CaseRecord, table: WearTable) -> WearInput:
    """Return the wear law with its band."""
    return _changing(table, _law(case, table))


def _law(case: CaseRecord, table: WearTable) -> WearInput:
    if table.law in own_wear_laws():
        return _own_law(case, table, own_wear_laws()[table.law])
    key, *constants = wear_laws()[table.law].keys
    coefficient: float | None = getattr(table, key)
    if table.condition is not None and coefficient is None:
        return _condition(case, table, table.condition)
    assert coefficient is not None
    if key == "specific_wear_rate_mm2_per_N":
        case.warnings += _doubtful_rate(case, table, coefficient)
    case.assumptions.append("the constants of the wear law are given by the user")
    factor = _band_factor(case, table)
    return WearInput(
        law=table.law,
        coefficient=coefficient,
        constants={key: getattr(table, key) for key in constants},
        low=1.0 / factor,
        high=factor,
        band=f"factor {factor:g} to either side",
        band_is_given=table.band_factor is not None,
    )


def _doubtful_rate(case: CaseRecord, table: WearTable, rate: float) -> list[str]:
    """Return a warning of a specific wear rate that looks like one in another unit."""
    low, high = _PLAUSIBLE_WEAR_RATE
    start = f"wear.specific_wear_rate_mm2_per_N = {rate:g} is"
    unit = f"{rate:g} mm^3/(N*m) is {1e-3 * rate:g} mm2/N"
    if not low <= rate <= high:
        return [f"{start} outside {low:g}..{high:g}: {unit}, so check for a factor of 1000"]
    most = max(row.high for row in wear_conditions().values() if row.lubricated and row.machine == "any")
    if rate <= 10.0 * most or _is_dry_or_dirty(case, table):
        return []
    return [f"{start} more than 10 times that of any lubricated wear condition: {unit}, so check the unit"]


def _is_dry_or_dirty(case: CaseRecord, table: WearTable) -> bool:
    """Tell whether a case says that no lubricant, or dirt, reaches the teeth."""
    lubrication = case.inputs.get("lubrication") or {}
    dirty = lubrication.get("environment") not in (None, "clean")
    told_dry = table.condition is not None and not wear_conditions()[table.condition].lubricated
    return told_dry or dirty or lubrication.get("lubricant") == "dry"


def _own_law(case: CaseRecord, table: WearTable, law: OwnWearLaw) -> WearInput:
    """Return a law of the program, with the constants that the case leaves out."""
    given = table.constants or {}
    for name, constant in law.constants.items():
        if name not in given:
            case.take(f"wear.constants.{name}", constant.value, f"wear law {law.name!r}")
    if table.coefficient is None:
        case.take("wear.coefficient", 1.0, f"factor on wear law {law.name!r}")
    case.assumptions.append(f"wear law {law.name!r} is a user-defined function: {law.source}")
    constants = {name: float(given.get(name, constant.value)) for name, constant in law.constants.items()}
    for name, value in constants.items():
        if not law.constants[name].low <= value <= law.constants[name].high:
            text = (
                f"{law.constants[name].low:g} to {law.constants[name].high:g}, the range in which the law "
                "holds"
            )
            case.faults.add(f"wear.constants.{name}", f"must lie in {text} (got {value:g})")
    factor = _band_factor(case, table)
    return WearInput(
        law=law.name,
        coefficient=table.coefficient or 1.0,
        constants=constants,
        low=1.0 / factor,
        high=factor,
        band=f"factor {factor:g} to either side",
        band_is_given=table.band_factor is not None,
    )


def _changing(table: WearTable, wear: WearInput) -> WearInput:
    """Add what changes the coefficient as the drive wears."""
    if table.case_depth_mm is not None and table.core_factor is not None:
        wear = replace(wear, case_depth=table.case_depth_mm, core_factor=table.core_factor)
    if table.running_in_factor is not None and table.running_in_distance_mm is not None:
        wear = replace(
            wear, running_in_factor=table.running_in_factor, running_in_distance=table.running_in_distance_mm
        )
    if table.cycles_exponent is not None and table.reference_hours is not None:
        wear = replace(wear, cycles_exponent=table.cycles_exponent, reference_hours=table.reference_hours)
    if table.pv_limit_MPa_mm_per_s is not None and table.severe_factor is not None:
        wear = replace(wear, pv_limit=table.pv_limit_MPa_mm_per_s, severe_factor=table.severe_factor)
    if table.roller_wear_ratio is not None:
        wear = replace(wear, roller_ratio=table.roller_wear_ratio)
    return wear


def _band_factor(case: CaseRecord, table: WearTable) -> float:
    if table.band_factor is not None:
        return table.band_factor
    case.take(
        "wear.band_factor",
        DEFAULT_BAND,
        "the coefficient is given by the user; the tooth life is no more certain than it, a factor of 3 to "
        "10",
    )
    return DEFAULT_BAND


def _condition(case: CaseRecord, table: WearTable, name: str) -> WearInput:
    condition = wear_conditions()[name]
    typical = condition.typical
    low, high = condition.low / typical, condition.high / typical
    band = f"{name!r}: {condition.source}"
    if table.band_factor is not None:
        low, high = 1.0 / table.band_factor, table.band_factor
        band = f"factor {table.band_factor:g} to either side"
    case.assumptions.append(
        f"specific wear rate {typical:g} mm2/N, {condition.low:g} to {condition.high:g} "
        f"(wear condition {name!r})"
    )
    return WearInput("archard", typical, {}, low, high, band, table.band_factor is not None)


def fatigue_input(case: CaseRecord, table: FatigueTable | None) -> FatigueInput | None:
    """Return what a case says about contact fatigue."""
    if table is None:
        return None
    if "load_factor" not in table.model_fields_set:
        case.assumptions.append("fatigue.load_factor = 1 (default)")
    sides = {name: side for name, side in dict(table).items() if isinstance(side, FlankMaterialTable)}
    if "sprocket" in sides:
        case.assumptions += _SPROCKET
    return FatigueInput(
        load_factor=table.load_factor,
        materials={
            name: FlankMaterial(
                treatment=side.treatment,
                hardness=side.hardness_HB or side.hardness_HRC or 0.0,
                scale="HB" if side.hardness_HB else "HRC",
                contact_limit=side.contact_limit_MPa,
                contact_safety=side.contact_safety,
            )
            for name, side in sides.items()
        },
    )


_SAFETY = 7.0
"""Breaking load over tension below which a chain is loaded beyond its endurance."""


def slip_fraction(case: ChainRecord, default: float = 1.0) -> float:
    """Return the part of the sliding of a roller that does not turn."""
    given = case.tables.mechanism.roller_slip_fraction
    if given is None:
        why = "default" if default == 1.0 else "a roller free to turn"
        case.take("mechanism.roller_slip_fraction", default, why)
        return default
    return given


def effective_pull(block: GivenLoad, speed: float, lever: float) -> float:
    """Return the force that the load of a block asks of the chain."""
    if block.kind == "tension_N":
        return block.value
    if block.kind == "power_kW":
        return 1e6 * block.value / speed
    return 1e3 * block.value / lever


def chain_speed(case: ChainRecord, chain: Chain, block: GivenLoad) -> float:
    """Return the speed of the chain in a block [mm/s]."""
    table = case.tables.sprocket
    assert table is not None
    return chain.pitch * table.teeth * block.speed_rpm / (60.0 * table.engaged_every)


def chain_pull(case: ChainRecord, chain: Chain, block: GivenLoad) -> float:
    """Return the force that the load of a block asks of a chain round the sprocket [N]."""
    speed = chain_speed(case, chain, block)
    return effective_pull(block, speed, 60.0 * speed / (2.0 * math.pi * block.speed_rpm))


def within_strength(case: ChainRecord, pull: float, chain: Chain, key: str) -> bool:
    """Compare a pull with the chain's tensile strength: a fault above it, a warning near it."""
    if not chain.tensile:
        case.assumptions.append("tensile strength of the chain not known: the pull is not checked")
        return True
    if pull >= chain.tensile:
        case.faults.add(
            key, f"the pull must stay below the chain's tensile strength {chain.tensile:g} N, is {pull:.4g} N"
        )
        return False
    if pull * _SAFETY > chain.tensile:
        case.warnings.append(
            f"the pull of {pull:.4g} N is more than 1/{_SAFETY:g} of the chain's tensile strength "
            f"{chain.tensile:g} N: the plates will not last"
        )
    return True


def face_width(case: ChainRecord, table: SprocketTable, chain: Chain) -> float:
    """Return the width of the tooth that carries load."""
    if table.face_width_mm is None:
        width = float(f"{chain.face_width:.4g}")
        case.take("sprocket.face_width_mm", width, "standard tooth width for the chain")
        return width
    if table.face_width_mm > chain.strands * chain.inner_width:
        case.faults.add(
            "sprocket.face_width_mm",
            "the tooth must fit between the inner plates, "
            f"{chain.strands * chain.inner_width:g} mm (got {table.face_width_mm:g})",
        )
    return table.face_width_mm
