"""From the tables of a gear pair to its drive: teeth, mesh, stiffness."""

import math

import numpy as np

from wearsim.case.table_inputs import FLANK_NODES
from wearsim.contact.hertz import contact_modulus
from wearsim.errors import GeometryError
from wearsim.geometry.gear.involute import InvolutePair
from wearsim.geometry.gear.mesh import Mesh, ToothPair, check_contact_ratio
from wearsim.geometry.gear.plane_gearing import PitchCircles
from wearsim.input.faults import CaseRecord
from wearsim.mechanisms.gear_pair.drive import GearDrive
from wearsim.mechanisms.gear_pair.keys import GearTable, GearTables

PAIR_STIFFNESS = 14.0
"""Of a pair of teeth [N/(mm um)], the single stiffness c' of ISO 6336-1 for usual steel gears."""

_STEEL = contact_modulus((206_000.0, 206_000.0), (0.3, 0.3))


def gear_drive(case: CaseRecord, tables: GearTables, modulus: float) -> GearDrive | None:
    """Complete a pair of gears; None where their tables do not make one, which the faults tell."""
    nodes = tables.gear.nodes or FLANK_NODES
    if tables.gear.nodes is None:
        case.take("gear.nodes", nodes, "default")
    torque = 1000.0 * tables.load.torque_N_m
    teeth = complete_teeth(case, tables.gear, nodes, torque, modulus)
    if "wheel_wear_ratio" not in tables.wear.model_fields_set:
        case.assumptions.append("wear.wheel_wear_ratio = 1 (default)")
    stiffness = _stiffness(case, tables, modulus)
    if teeth is None:
        return None
    pair, mesh = teeth
    case.warnings += _third_pair(mesh, torque / tables.gear.face_width_mm, stiffness)
    return GearDrive(
        pair=pair,
        face_width=tables.gear.face_width_mm,
        torque=torque,
        stiffness=stiffness,
        wheel_wear_ratio=tables.wear.wheel_wear_ratio,
        points=nodes,
    )


def _stiffness(case: CaseRecord, tables: GearTables, modulus: float) -> float:
    """Stiffness of a pair of teeth per face width [N/mm2]; 0 for rigid teeth."""
    table = tables.mechanism
    if "load_sharing" not in table.model_fields_set:
        case.assumptions.append("mechanism.load_sharing = elastic (default)")
    if table.load_sharing == "rigid":
        return 0.0
    given = table.pair_stiffness_N_per_mm_um
    if given is None:
        given = PAIR_STIFFNESS * modulus / _STEEL
        why = "ISO 6336-1: 14 for usual steel gears (206 000 MPa), in proportion to their moduli"
        case.take("mechanism.pair_stiffness_N_per_mm_um", given, why)
    return 1000.0 * given


def _third_pair(mesh: Mesh, torque: float, stiffness: float) -> list[str]:
    """Warn where a pair of teeth beyond two would come to bear; the torque is over the face width."""
    place = mesh.place[0] + mesh.pitch
    gap = float(np.interp(place, mesh.place, mesh.gaps[0]))
    if stiffness == 0.0 or gap * stiffness * float(mesh.lever.min()) >= torque:
        return []
    return [
        f"with a contact ratio of {mesh.contact_ratio:.3f} a third pair of teeth carries load here, which "
        "is neglected: loads and wear are less than stated"
    ]


def complete_teeth(
    case: CaseRecord, table: GearTable, nodes: int, torque: float, modulus: float
) -> tuple[ToothPair, Mesh] | None:
    """Complete the teeth and check that they mesh."""
    try:
        if table.profile == "involute":
            involute = _involute(case, table)
            return involute, involute.mesh(nodes)
        form = _convex_concave if table.profile == "convex_concave" else _prescribed_stress
        pair = form(case, table, torque, modulus)
        mesh = pair.mesh(nodes)
        check_contact_ratio(mesh.contact_ratio)
    except GeometryError as error:
        case.faults.add("gear", str(error).removeprefix("gear pair: "))
        return None
    return pair, mesh


def _value_or_default(
    case: CaseRecord, table: GearTable, key: str, default: float, why: str = "default"
) -> float:
    """Value of a key, or what is assumed instead."""
    given: float | None = getattr(table, key)
    if given is None:
        case.take(f"gear.{key}", default, why)
        return default
    return given


def _involute(case: CaseRecord, table: GearTable) -> ToothPair:
    teeth, module = (table.pinion_teeth, table.wheel_teeth), table.module_mm
    angle = _value_or_default(case, table, "pressure_angle_deg", 20.0)
    shifts = (
        _value_or_default(case, table, "pinion_shift", 0.0),
        _value_or_default(case, table, "wheel_shift", 0.0),
    )
    tips = [
        _value_or_default(
            case,
            table,
            f"{gear}_tip_radius_mm",
            module * (0.5 * count + 1.0 + shift),
            "addendum of one module, plus shift",
        )
        for gear, count, shift in zip(("pinion", "wheel"), teeth, shifts, strict=True)
    ]
    pair = InvolutePair(teeth, module, math.radians(angle), shifts, (tips[0], tips[1]))
    pair.check()
    return pair


def _convex_concave(case: CaseRecord, table: GearTable, torque: float, modulus: float) -> ToothPair:
    from wearsim.geometry.gear.convex_concave import ConvexConcave  # takes 0.1 s, for scipy

    head = table.addendum_arc_radius_mm
    assert head is not None
    return ConvexConcave(
        table.module_mm,
        table.pinion_teeth,
        table.wheel_teeth,
        math.radians(_value_or_default(case, table, "pitch_point_angle_deg", 20.0)),
        head,
        _value_or_default(case, table, "dedendum_arc_radius_mm", head, "as of the head"),
        table.module_mm * _value_or_default(case, table, "addendum_ratio", 1.0),
    )


def _prescribed_stress(case: CaseRecord, table: GearTable, torque: float, modulus: float) -> ToothPair:
    # They take 0.2 s, for scipy.
    from wearsim.contact.prescribed_stress import LineLoad, LoadedPair, StressProfile
    from wearsim.contact.synthesised_pair import SynthesisedPair

    teeth, stress = (table.pinion_teeth, table.wheel_teeth), table.contact_stress_MPa
    circles = PitchCircles(0.5 * table.module_mm * sum(teeth), teeth[1] / teeth[0])
    design = 1000.0 * _value_or_default(case, table, "design_torque_N_m", 0.001 * torque, "as of the load")
    load = LineLoad(design / (table.face_width_mm * circles.pinion_radius), 1)
    places = table.stress_pitch_point_distance_mm or (0.0,)
    law = StressProfile(np.array(places), np.array(stress))
    # The shape does not depend on the speed.
    return SynthesisedPair(LoadedPair(circles, modulus, load, law, 0.0), teeth, table.reach)
