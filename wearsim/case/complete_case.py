"""From the tables as given to a complete case: defaults, checks across tables, geometry."""

import math
from dataclasses import replace
from pathlib import Path

from wearsim.case.duty_blocks import resolve_duty
from wearsim.case.flank_endurance import resolve_fatigue
from wearsim.case.model import Case, ChainDrive, PrescribedDrive, StrandDrive, WrapDrive
from wearsim.case.shared import TOLERANCE, modulus_of, run_input, take_defaults, wear_input
from wearsim.case.strand_drive import resolve_prescribed, resolve_strand
from wearsim.case.wrap_drive import resolve_wrap
from wearsim.catalogue.catalogues import KG_PER_M, Chain, chain_name, chains
from wearsim.input.case_record import Resolution
from wearsim.input.kind import mechanism_kind
from wearsim.input.messages import Faults
from wearsim.input.schema import CaseTables, ChainTable

_DEEP = 0.3
"""Critical depth over tooth thickness above which the tooth itself is in doubt."""

WRAP_TOLERANCE = 5e-2
"""Relative tolerance of a life on a wrap by default, as it costs more."""


def resolve(tables: CaseTables, name: str, folder: Path, faults: Faults) -> Case:
    """Complete a case."""
    case = Resolution(tables, folder, faults)
    take_defaults(case, tables)
    chain = _chain(case, tables.chain)
    materials = tables.material
    modulus = modulus_of(case, {"sprocket": materials.sprocket, "roller": materials.roller})
    wear = wear_input(case, tables.wear)
    kind = mechanism_kind(case)
    duty = resolve_duty(case, kind, chain)
    drive: ChainDrive | None
    if kind == "prescribed":
        drive = resolve_prescribed(case, wear, chain)
    elif kind == "wrap":
        drive = resolve_wrap(case, chain, duty)
    else:
        drive = resolve_strand(case, chain, duty)
    critical_depth = _critical_depth(case, drive)
    if tables.stop.min_tip_land_mm is not None:
        _check_tip_land(case, drive, tables.stop.min_tip_land_mm)
    more_limits = _more_limits(case, drive)
    run = run_input(case, tables.run, WRAP_TOLERANCE if kind == "wrap" else TOLERANCE)
    fatigue = resolve_fatigue(case, tables.fatigue)
    faults.check()
    assert drive is not None and duty is not None
    return Case(
        name=name,
        title=tables.title or _title(case, kind),
        inputs=case.inputs,
        files=tuple(case.files),
        input_files=case.texts(),
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
        fatigue=fatigue,
        assumptions=tuple(case.assumptions),
        warnings=tuple(case.warnings),
    )


def _title(case: Resolution, kind: str) -> str:
    """What a case is about that has no title of its own."""
    given, sprocket = case.inputs["chain"], case.inputs.get("sprocket", {})
    name = given.get("designation")
    chain = f"{name} chain" if name else f"chain of {given['pitch_mm']:g} mm pitch"
    if kind == "prescribed":
        return f"Flank under the loads of {case.inputs['mechanism']['table_file']}"
    if kind == "wrap":
        return f"{chain[0].upper()}{chain[1:]} around a sprocket of {sprocket['teeth']} teeth"
    form = "Evolute sprocket" if sprocket["profile"] == "evolute" else "Sprocket from points"
    return f"{form}, {chain}, {sprocket['teeth']} teeth"


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
    if chain.note:
        case.assumptions.append(f"note of the catalogue on chain {chain.designation}: {chain.note}")
    return chain


def _critical_depth(case: Resolution, drive: ChainDrive | None) -> float:
    given = case.tables.stop.critical_depth_mm
    if given is not None:
        _check_depth(case, drive, given)
        return given
    if isinstance(drive, StrandDrive | WrapDrive):
        depth = float(f"{0.1 * drive.pitch_line_thickness:.4g}")
        if depth > 0.0:
            case.take("stop.critical_depth_mm", depth, "10 % of the tooth thickness at the pitch line")
            return depth
        case.faults.add(
            "stop.critical_depth_mm",
            "required: the tooth has no thickness at the pitch line to derive it from: give it, or "
            "check the points of the flank",
        )
    if isinstance(drive, PrescribedDrive):
        case.faults.add("stop.critical_depth_mm", "required: a table of loads has no tooth to derive it from")
    return math.nan


def _check_depth(case: Resolution, drive: ChainDrive | None, depth: float) -> None:
    """Compare a given critical depth with the tooth that has to bear it."""
    if not isinstance(drive, StrandDrive | WrapDrive):
        return
    thinnest, thickness = drive.thinnest, drive.pitch_line_thickness
    if depth >= thinnest > 0.0:
        case.faults.add(
            "stop.critical_depth_mm",
            f"must be below the thickness of the tooth at its neck, {thinnest:.4g} mm (got {depth:g})",
        )
    elif depth > _DEEP * thickness > 0.0:
        case.warnings.append(
            f"critical depth {depth:g} mm is more than {_DEEP:g} of the tooth thickness "
            f"{thickness:.3g} mm at the pitch line: the tooth may break first"
        )


def _check_tip_land(case: Resolution, drive: ChainDrive | None, min_tip_land: float) -> None:
    key = "stop.min_tip_land_mm"
    if isinstance(drive, PrescribedDrive):
        case.faults.add(key, "a table of loads has no tooth and no tip: remove this key")
    elif drive is not None and drive.tip_land <= min_tip_land:
        case.faults.add(
            key,
            f"must be below the tip land of the new tooth, {drive.tip_land:.4g} mm (got {min_tip_land:g})",
        )


def _more_limits(case: Resolution, drive: ChainDrive | None) -> dict[str, float]:
    """Limits of the worn tooth beyond depth and tip land, by their keys."""
    stop = case.tables.stop
    keys = ("case_depth_mm", "min_tooth_thickness_mm", "over_pins_change_mm", "min_slack_tension_N")
    given = {key: value for key in keys if (value := getattr(stop, key)) is not None}
    tension = given.get("min_slack_tension_N")
    if tension is not None and isinstance(drive, WrapDrive) and tension > drive.slack:
        case.faults.add(
            "stop.min_slack_tension_N",
            f"must not be above the slack tension that the drive has, {drive.slack:.4g} N (got {tension:g})",
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
