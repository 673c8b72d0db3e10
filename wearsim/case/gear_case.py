"""From the tables of a gear pair as given to a complete case."""

from pathlib import Path

import numpy as np

from wearsim.case.flank_endurance import resolve_fatigue
from wearsim.case.gear_forms import resolve_teeth
from wearsim.case.model import Case, GearDrive
from wearsim.case.shared import FLANK_NODES, TOLERANCE, modulus_of, run_input, take_defaults, wear_input
from wearsim.contact.hertz import contact_modulus
from wearsim.geometry.gear.mesh import Mesh
from wearsim.input.case_record import Record
from wearsim.input.messages import Faults
from wearsim.input.schema.gear import GearTable, GearTables

PAIR_STIFFNESS = 14.0
"""Of a pair of teeth [N/(mm um)], the single stiffness c' of ISO 6336-1 for usual steel gears."""

_STEEL = contact_modulus((206_000.0, 206_000.0), (0.3, 0.3))


def resolve_gear(tables: GearTables, name: str, folder: Path, faults: Faults) -> Case:
    """Complete the case of a gear pair."""
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
    teeth = resolve_teeth(case, tables.gear, nodes, torque, modulus)
    if "wheel_wear_ratio" not in tables.wear.model_fields_set:
        case.assumptions.append("wear.wheel_wear_ratio = 1 (default)")
    stiffness = _stiffness(case, tables, modulus)
    run = run_input(case, tables.run, TOLERANCE)
    faults.check()
    assert teeth is not None
    pair, mesh = teeth
    line_load = torque / tables.gear.face_width_mm
    case.warnings += _third_pair(mesh, line_load, stiffness)
    limit = tables.stop.wheel_critical_depth_mm
    if limit is None:
        limit = tables.stop.critical_depth_mm
        case.take("stop.wheel_critical_depth_mm", limit, "as of the pinion")
    fatigue = resolve_fatigue(case, tables.fatigue)
    return Case(
        name=name,
        title=tables.title or _title(tables.gear),
        inputs=case.inputs,
        files=(),
        input_files={},
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


def _title(gear: GearTable) -> str:
    """What a case is about that has no title of its own."""
    form = gear.profile.replace("_", "-").capitalize()
    return f"{form} gears {gear.pinion_teeth}/{gear.wheel_teeth}, module {gear.module_mm:g} mm"


def _stiffness(case: Record, tables: GearTables, modulus: float) -> float:
    """Stiffness of a pair of teeth per face width [N/mm2]; 0 for rigid teeth."""
    table = tables.mechanism
    if "load_sharing" not in table.model_fields_set:
        case.assumptions.append("mechanism.load_sharing = elastic (default)")
    if table.load_sharing == "rigid":
        return 0.0
    given = table.pair_stiffness_N_per_mm_um
    if given is None:
        given = PAIR_STIFFNESS * modulus / _STEEL
        why = "ISO 6336-1: 14 for usual gears of steel with 206 000 MPa, times their moduli over it"
        case.take("mechanism.pair_stiffness_N_per_mm_um", given, why)
    return 1000.0 * given


def _third_pair(mesh: Mesh, torque: float, stiffness: float) -> list[str]:
    """Warn where a pair of teeth beyond two would come to bear; the torque is over the face width."""
    place = mesh.place[0] + mesh.pitch
    gap = float(np.interp(place, mesh.place, mesh.gaps[0]))
    if stiffness == 0.0 or gap * stiffness * float(mesh.lever.min()) >= torque:
        return []
    return [
        f"with a contact ratio of {mesh.contact_ratio:.3f} a third pair of teeth comes to bear under this "
        "load, which is left out: loads and wear are less than stated"
    ]
