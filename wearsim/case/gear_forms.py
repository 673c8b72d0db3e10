"""The teeth of a gear pair, from their keys to a pair that can run."""

import math

import numpy as np

from wearsim.errors import GeometryError
from wearsim.geometry.gear.involute import InvolutePair
from wearsim.geometry.gear.mesh import Mesh, ToothPair, check_contact_ratio
from wearsim.geometry.gear.plane_gearing import PitchCircles
from wearsim.input.case_record import Record
from wearsim.input.schema.gear import GearTable


def resolve_teeth(
    case: Record, table: GearTable, nodes: int, torque: float, modulus: float
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


def _taken(case: Record, table: GearTable, key: str, default: float, why: str = "default") -> float:
    """Value of a key, or what is assumed instead."""
    given: float | None = getattr(table, key)
    if given is None:
        case.take(f"gear.{key}", default, why)
        return default
    return given


def _involute(case: Record, table: GearTable) -> ToothPair:
    teeth, module = (table.pinion_teeth, table.wheel_teeth), table.module_mm
    angle = _taken(case, table, "pressure_angle_deg", 20.0)
    shifts = _taken(case, table, "pinion_shift", 0.0), _taken(case, table, "wheel_shift", 0.0)
    tips = [
        _taken(
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


def _convex_concave(case: Record, table: GearTable, torque: float, modulus: float) -> ToothPair:
    from wearsim.geometry.gear.convex_concave import ConvexConcave  # takes 0.1 s, for scipy

    head = table.addendum_arc_radius_mm
    assert head is not None
    return ConvexConcave(
        table.module_mm,
        table.pinion_teeth,
        table.wheel_teeth,
        math.radians(_taken(case, table, "pitch_point_angle_deg", 20.0)),
        head,
        _taken(case, table, "dedendum_arc_radius_mm", head, "as of the head"),
        table.module_mm * _taken(case, table, "addendum_ratio", 1.0),
    )


def _prescribed_stress(case: Record, table: GearTable, torque: float, modulus: float) -> ToothPair:
    # They take 0.2 s, for scipy.
    from wearsim.contact.prescribed_stress import LineLoad, LoadedPair, StressLaw
    from wearsim.contact.synthesised_pair import SynthesisedPair

    teeth, stress = (table.pinion_teeth, table.wheel_teeth), table.contact_stress_MPa
    circles = PitchCircles(0.5 * table.module_mm * sum(teeth), teeth[1] / teeth[0])
    design = 1000.0 * _taken(case, table, "design_torque_N_m", 0.001 * torque, "as of the load")
    load = LineLoad(design / (table.face_width_mm * circles.pinion_radius), 1)
    places = table.stress_pitch_point_distance_mm or (0.0,)
    law = StressLaw(np.array(places), np.array(stress))
    # The shape does not depend on the speed.
    return SynthesisedPair(LoadedPair(circles, modulus, load, law, 0.0), teeth, table.reach)
