"""From the tables as given to a complete case: defaults, checks across tables, geometry."""

import math
from dataclasses import replace
from pathlib import Path

from wearsim.case.drive import resolve_prescribed, resolve_strand
from wearsim.case.duty import resolve_duty
from wearsim.case.kind import mechanism_kind
from wearsim.case.messages import Faults
from wearsim.case.model import (
    Case,
    Drive,
    PrescribedDrive,
    RunInput,
    StrandDrive,
    WearInput,
    WrapDrive,
)
from wearsim.case.resolution import Resolution
from wearsim.case.schema import CaseTables, ChainTable, MaterialTable, WearTable
from wearsim.case.wrap import resolve_wrap
from wearsim.catalogue.tables import KG_PER_M, Chain, chain_name, chains, materials, wear_conditions
from wearsim.contact.hertz import contact_modulus

DEFAULT_BAND = 3.0
"""Factor to either side of a coefficient without a band of its own: a life is only as good as k."""

_DEEP = 0.3
"""Critical depth over tooth thickness above which the tooth itself is in doubt."""

TOLERANCE, WRAP_TOLERANCE = 1e-3, 1e-2
"""Relative tolerances of a life by default; that of a wrap costs more."""

_PLAUSIBLE_WEAR_RATE = (1e-15, 1e-6)


def resolve(tables: CaseTables, name: str, folder: Path, faults: Faults) -> Case:
    """Complete a case.

    Parameters
    ----------
    tables : CaseTables
        The validated input.
    name : str
        Of the case.
    folder : pathlib.Path
        Place that paths are relative to.
    faults : Faults
        Takes what is wrong.

    Returns
    -------
    Case
        Complete.

    Raises
    ------
    CaseError
        With everything that is wrong.
    """
    case = Resolution(tables, folder, faults)
    for table, key, value in _taken_defaults(tables):
        case.assumptions.append(f"{table}.{key} = {value} (default)")
    chain = _chain(case, tables.chain)
    modulus = _modulus(case)
    wear = _changing(tables.wear, _wear(case, tables.wear))
    kind = mechanism_kind(case)
    duty = resolve_duty(case, kind, chain)
    drive: Drive | None
    if kind == "prescribed":
        drive = resolve_prescribed(case, wear)
    elif kind == "wrap":
        drive = resolve_wrap(case, chain, duty)
    else:
        drive = resolve_strand(case, chain, duty)
    critical_depth = _critical_depth(case, drive)
    if tables.stop.min_tip_land_mm is not None:
        _check_tip_land(case, drive, tables.stop.min_tip_land_mm)
    more_limits = _more_limits(case, drive)
    run = _run(case, kind)
    faults.check()
    assert drive is not None and duty is not None
    return Case(
        name=name,
        title=tables.title or name,
        inputs=case.inputs,
        files=tuple(case.files),
        chain=chain,
        drive=drive,
        modulus=modulus,
        speed_rpm=duty.speed_rpm,
        engaged_every=tables.sprocket.engaged_every if tables.sprocket else 1,
        turns_per_cycle=_turns_per_cycle(case),
        wear=wear,
        critical_depth=critical_depth,
        min_tip_land=tables.stop.min_tip_land_mm or 0.0,
        more_limits=more_limits,
        run=run,
        assumptions=tuple(case.assumptions),
        warnings=tuple(case.warnings),
    )


def _turns_per_cycle(case: Resolution) -> int:
    """Turns between two loadings of a gap; some gaps carry no roller where it is not engaged_every."""
    table = case.tables.sprocket
    if table is None:
        return 1
    common = math.gcd(table.teeth, table.engaged_every)
    if common > 1:
        case.warnings.append(
            f"with {table.teeth} gaps and engaged_every = {table.engaged_every} the rollers meet the "
            f"same {table.teeth // common} gaps: those wear {common} times as fast as if all took part"
        )
    return table.engaged_every // common


def _taken_defaults(tables: CaseTables) -> list[tuple[str, str, object]]:
    """Defaults of the schema itself that matter for the life and were not given."""
    taken: list[tuple[str, str, object]] = []
    wanted = {
        "wear": ("law",),
        "run": ("method", "horizon_hours"),
    }
    for table, keys in wanted.items():
        model = getattr(tables, table)
        if model is not None:
            taken += [
                (table, key, getattr(model, key))
                for key in keys
                if key not in model.model_fields_set
            ]
    return taken


def _chain(case: Resolution, table: ChainTable) -> Chain:
    if table.designation is None:
        assert table.pitch_mm and table.roller_diameter_mm and table.inner_width_mm
        return replace(
            Chain("", table.pitch_mm, table.roller_diameter_mm, table.inner_width_mm),
            pin_diameter=table.pin_diameter_mm or 0.0,
            bearing_area=table.bearing_area_mm2 or 0.0,
            mass_per_length=KG_PER_M * (table.mass_kg_per_m or 0.0),
        )
    name = chain_name(table.designation)
    assert name is not None
    if name != table.designation:
        case.inputs["chain"]["designation"] = name
        case.assumptions.append(f"chain {table.designation!r} is read as {name} of the catalogue")
    chain = chains()[name]
    chain = replace(
        chain,
        pin_diameter=chain.pin_diameter or table.pin_diameter_mm or 0.0,
        bearing_area=chain.bearing_area or table.bearing_area_mm2 or 0.0,
        mass_per_length=chain.mass_per_length or KG_PER_M * (table.mass_kg_per_m or 0.0),
    )
    if chain.flag:
        case.assumptions.append(f"note of the catalogue on chain {chain.designation}: {chain.flag}")
    return chain


def _modulus(case: Resolution) -> float:
    (e1, nu1), (e2, nu2) = (_material(case, body) for body in ("sprocket", "roller"))
    return contact_modulus((e1, e2), (nu1, nu2))


def _material(case: Resolution, body: str) -> tuple[float, float]:
    table: MaterialTable = getattr(case.tables.material, body)
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


def _wear(case: Resolution, table: WearTable) -> WearInput:
    if table.condition is not None:
        return _condition(case, table, table.condition)
    coefficient = table.specific_wear_rate_mm2_per_N or table.coefficient
    assert coefficient is not None
    low, high = _PLAUSIBLE_WEAR_RATE
    if table.law == "archard" and not low <= coefficient <= high:
        case.warnings.append(
            f"wear.specific_wear_rate_mm2_per_N = {coefficient:g} is outside {low:g}..{high:g}: "
            "1 mm3/(N m) is 1e-3 mm2/N, so check for a factor of 1000"
        )
    case.assumptions.append("the constants of the wear law are the user's")
    factor = _band_factor(case, table)
    return WearInput(
        law=table.law,
        coefficient=coefficient,
        pressure_exponent=table.pressure_exponent or 1.0,
        hardness=table.hardness_MPa or 1.0,
        reference_speed=table.reference_speed_mm_per_s or 1.0,
        speed_exponent=table.speed_exponent or 0.0,
        low=1.0 / factor,
        high=factor,
        band=f"factor {factor:g} to either side",
    )


def _changing(table: WearTable, wear: WearInput) -> WearInput:
    """Add what changes the coefficient as the drive wears."""
    if table.case_depth_mm is not None and table.core_factor is not None:
        wear = replace(wear, case_depth=table.case_depth_mm, core_factor=table.core_factor)
    if table.running_in_factor is not None and table.running_in_distance_mm is not None:
        wear = replace(
            wear,
            running_in_factor=table.running_in_factor,
            running_in_distance=table.running_in_distance_mm,
        )
    if table.roller_wear_ratio is not None:
        wear = replace(wear, roller_ratio=table.roller_wear_ratio)
    return wear


def _band_factor(case: Resolution, table: WearTable) -> float:
    if table.band_factor is not None:
        return table.band_factor
    case.take(
        "wear.band_factor",
        DEFAULT_BAND,
        "the coefficient is the user's; a tooth life is only as good as it, factor 3 to 10",
    )
    return DEFAULT_BAND


def _condition(case: Resolution, table: WearTable, name: str) -> WearInput:
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
    return WearInput("archard", typical, 1.0, 1.0, 1.0, 0.0, low, high, band)


def _critical_depth(case: Resolution, drive: Drive | None) -> float:
    given = case.tables.stop.critical_depth_mm
    if given is not None:
        _check_depth(case, drive, given)
        return given
    if isinstance(drive, StrandDrive | WrapDrive):
        depth = float(f"{0.1 * drive.pitch_line_thickness:.4g}")
        if depth > 0.0:
            case.take(
                "stop.critical_depth_mm", depth, "10 % of the tooth thickness at the pitch line"
            )
            return depth
        case.faults.add(
            "stop.critical_depth_mm",
            "required: the tooth has no thickness at the pitch line to derive it from: give it, or "
            "check the points of the flank",
        )
    if isinstance(drive, PrescribedDrive):
        case.faults.add(
            "stop.critical_depth_mm", "required: a table of loads has no tooth to derive it from"
        )
    return math.nan


def _check_depth(case: Resolution, drive: Drive | None, depth: float) -> None:
    """Compare a given critical depth with the tooth that has to bear it."""
    if not isinstance(drive, StrandDrive | WrapDrive):
        return
    thinnest, thickness = drive.thinnest, drive.pitch_line_thickness
    if depth >= thinnest > 0.0:
        case.faults.add(
            "stop.critical_depth_mm",
            f"must be below the thickness of the tooth at its neck, {thinnest:.4g} mm "
            f"(got {depth:g})",
        )
    elif depth > _DEEP * thickness > 0.0:
        case.warnings.append(
            f"critical depth {depth:g} mm is more than {_DEEP:g} of the tooth thickness "
            f"{thickness:.3g} mm at the pitch line: the tooth may break first"
        )


def _check_tip_land(case: Resolution, drive: Drive | None, min_tip_land: float) -> None:
    key = "stop.min_tip_land_mm"
    if isinstance(drive, PrescribedDrive):
        case.faults.add(key, "a table of loads has no tooth and no tip: remove this key")
    elif drive is not None and drive.tip_land <= min_tip_land:
        case.faults.add(
            key,
            f"must be below the tip land of the new tooth, {drive.tip_land:.4g} mm "
            f"(got {min_tip_land:g})",
        )


def _more_limits(case: Resolution, drive: Drive | None) -> dict[str, float]:
    """Limits of the worn tooth beyond depth and tip land, by their keys."""
    stop = case.tables.stop
    keys = (
        "case_depth_mm",
        "min_tooth_thickness_mm",
        "over_pins_change_mm",
        "min_slack_tension_N",
    )
    given = {key: value for key in keys if (value := getattr(stop, key)) is not None}
    tension = given.get("min_slack_tension_N")
    if tension is not None and isinstance(drive, WrapDrive) and tension > drive.slack:
        case.faults.add(
            "stop.min_slack_tension_N",
            "must not be above the slack tension that the drive has, "
            f"{drive.slack:.4g} N (got {tension:g})",
        )
    least = given.get("min_tooth_thickness_mm")
    if least is not None and drive is not None:
        key = "stop.min_tooth_thickness_mm"
        if isinstance(drive, PrescribedDrive):
            case.faults.add(key, "a table of loads has no tooth: remove this key")
        elif drive.pitch_line_thickness <= least:
            case.faults.add(
                key,
                "must be below the thickness of the new tooth at the pitch line, "
                f"{drive.pitch_line_thickness:.4g} mm (got {least:g})",
            )
    return given


def _run(case: Resolution, kind: str) -> RunInput:
    table = case.tables.run
    if table.method == "per_cycle" and table.cycles_per_update is None:
        case.take("run.cycles_per_update", 1, "every cycle")
    tolerance = table.life_tolerance
    if tolerance is None:
        tolerance = WRAP_TOLERANCE if kind == "wrap" else TOLERANCE
        case.take("run.life_tolerance", tolerance, "default")
    return RunInput(table.method, table.cycles_per_update or 1, tolerance, table.horizon_hours)
