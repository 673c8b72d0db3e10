"""What drives and worn flanks look like: the one place where a picture asks what kind a drive is."""

import numpy as np

from wearsim.case.model import Case, GearDrive, PrescribedDrive, StrandDrive, WrapDrive
from wearsim.errors import CaseError, Fault
from wearsim.geometry.scene import Circle, Scene, Stroke
from wearsim.geometry.wheel import WheelShape
from wearsim.mechanisms.gear_pair.scene import gear_scene, gear_wheels
from wearsim.mechanisms.strand.scene import strand_scene, strand_wheel
from wearsim.mechanisms.wrap.scene import beside_gap, wrap_scene, wrap_wheel
from wearsim.report.flank_view import case_of, flanks, snapshot
from wearsim.report.worn_flank import WornFlank
from wearsim.result import WearResult

_FINE = 2e-4
"""Deviation of the wheel's outline around a flank, as a part of the pitch."""


def drive_scene(case: Case) -> Scene | None:
    """Return the drive to scale, where more than a flank is known of it."""
    drive = case.drive
    if isinstance(drive, WrapDrive):
        return wrap_scene(drive)
    if isinstance(drive, GearDrive):
        return gear_scene(drive)
    return strand_scene(drive, case.engaged_every) if isinstance(drive, StrandDrive) else None


def wheel_shapes(case: Case, result: WearResult | None) -> tuple[WheelShape, ...]:
    """Return the wheels of a case, worn as at the end of a run where there is one."""
    drive, last = case.drive, None if result is None else flanks(result, -1)
    if isinstance(drive, PrescribedDrive):
        message = (
            "the case must have a sprocket or gears to draw, but is a table of loads along a flank "
            "whose place on a wheel it does not tell: give the wheel's own case"
        )
        raise CaseError([Fault(message, "mechanism.kind", case.name)])
    if isinstance(drive, GearDrive):
        return gear_wheels(drive, last)
    if isinstance(drive, StrandDrive):
        return (strand_wheel(drive, case.engaged_every, last),)
    return (wrap_wheel(drive, case.engaged_every, last),)


def teeth_and_chain(case: Case) -> str:
    """Return what one orders the wheels of a case by."""
    drive = case.drive
    if isinstance(drive, GearDrive):
        return "{} and {} teeth".format(*drive.pair.teeth)
    chain = drive.chain.designation or f"of {drive.chain.pitch:g} mm pitch"
    return f"{case.inputs['sprocket']['teeth']} teeth, chain {chain}"


def around_flank(result: WearResult, flank: WornFlank) -> tuple[Stroke | Circle, ...]:
    """Return the steel around a new flank, as far as it is known, and the circle that touches it.

    The circle touches it where it wears most.
    """
    drive, new, deepest = case_of(result).drive, flank.new, flank.deepest
    body: tuple[Stroke, ...] = ()
    if isinstance(drive, WrapDrive):
        body = (beside_gap(drive),)
    elif isinstance(drive, StrandDrive) and result.inputs["sprocket"]["profile"] == "evolute":
        body = (strand_wheel(drive, 1).sketched("body", _FINE),)
    if isinstance(drive, GearDrive):
        mesh, place = drive.pair.mesh(drive.points), snapshot(result, -1)["path_mm"][deepest]
        radius, name = 1.0 / float(np.interp(place, mesh.pole_distance, mesh.curvature[1])), "wheel"
    else:
        radius, name = 0.5 * drive.chain.roller_diameter, "roller"
    x = float(new.x[deepest] + radius * new.normal_x[deepest])
    y = float(new.y[deepest] + radius * new.normal_y[deepest])
    return *body, Circle("mate", (x, y), abs(radius), name)
