"""From the tables of a gear pair as given to a complete case."""

from pathlib import Path

from wearsim.case.fatigue import resolve_fatigue
from wearsim.case.gear_forms import resolve_teeth
from wearsim.case.messages import Faults
from wearsim.case.model import Case, GearDrive
from wearsim.case.resolution import Record
from wearsim.case.schema.gear import GearTables
from wearsim.case.shared import (
    FLANK_NODES,
    TOLERANCE,
    modulus_of,
    run_input,
    take_defaults,
    wear_input,
)

PAIR_STIFFNESS = 14.0
"""Of a pair of teeth [N/(mm um)], the single stiffness c' of ISO 6336-1 for usual steel gears."""


def resolve_gear(tables: GearTables, name: str, folder: Path, faults: Faults) -> Case:
    """Complete the case of a gear pair.

    Parameters
    ----------
    tables : GearTables
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
        Complete; the pinion's turns are its cycles.

    Raises
    ------
    CaseError
        With everything that is wrong.
    """
    case = Record(tables, folder, faults)
    take_defaults(case, tables)
    materials = tables.material
    modulus = modulus_of(case, {"pinion": materials.pinion, "wheel": materials.wheel})
    wear = wear_input(case, tables.wear)
    if wear.pressure_exponent < 1.0:
        faults.add(
            "wear.pressure_exponent",
            "must be at least 1 on gears: below 1 a pit deepens itself and the problem is ill-posed "
            f"(got {wear.pressure_exponent:g})",
        )
    nodes = tables.gear.nodes or FLANK_NODES
    if tables.gear.nodes is None:
        case.take("gear.nodes", nodes, "default")
    torque = 1000.0 * tables.load.torque_N_m
    pair = resolve_teeth(case, tables.gear, nodes, torque, modulus)
    if "wheel_wear_ratio" not in tables.wear.model_fields_set:
        case.assumptions.append("wear.wheel_wear_ratio = 1 (default)")
    stiffness = _stiffness(case, tables)
    run = run_input(case, tables.run, TOLERANCE)
    faults.check()
    assert pair is not None
    limit = tables.stop.wheel_critical_depth_mm
    if limit is None:
        limit = tables.stop.critical_depth_mm
        case.take("stop.wheel_critical_depth_mm", limit, "as of the pinion")
    fatigue = resolve_fatigue(case, tables.fatigue)
    return Case(
        name=name,
        title=tables.title or name,
        inputs=case.inputs,
        files=(),
        drive=GearDrive(
            pair=pair,
            face_width=tables.gear.face_width_mm,
            torque=torque,
            stiffness=stiffness,
            wheel_wear_ratio=tables.wear.wheel_wear_ratio,
            points=nodes,
        ),
        modulus=modulus,
        speed_rpm=tables.load.speed_rpm,
        engaged_every=1,
        turns_per_cycle=1,
        wear=wear,
        critical_depth=tables.stop.critical_depth_mm,
        min_tip_land=0.0,
        more_limits={"wheel_critical_depth_mm": limit},
        run=run,
        fatigue=fatigue,
        assumptions=tuple(case.assumptions),
        warnings=tuple(case.warnings),
    )


def _stiffness(case: Record, tables: GearTables) -> float:
    """Stiffness of a pair of teeth per face width [N/mm2]; 0 for rigid teeth."""
    table = tables.mechanism
    if "load_sharing" not in table.model_fields_set:
        case.assumptions.append("mechanism.load_sharing = elastic (default)")
    if table.load_sharing == "rigid":
        return 0.0
    given = table.pair_stiffness_N_per_mm_um
    if given is None:
        given = PAIR_STIFFNESS
        why = "single stiffness of usual steel gears, ISO 6336-1"
        case.take("mechanism.pair_stiffness_N_per_mm_um", given, why)
    return 1000.0 * given
