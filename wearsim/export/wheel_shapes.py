"""The wheels of a case, new and worn, as outlines for CAD."""

import math

import numpy as np

from wearsim.case.model import Case
from wearsim.errors import CaseError, Fault
from wearsim.export.gear_shapes import gear_shapes
from wearsim.export.wheel_states import WheelShape
from wearsim.geometry.blank import gap_space, tooth_space
from wearsim.geometry.profile import Vector
from wearsim.geometry.wheel import Space, worn_gap, worn_space
from wearsim.mechanisms.gear_pair.drive import GearDrive
from wearsim.mechanisms.prescribed.drive import PrescribedDrive
from wearsim.mechanisms.strand.drive import StrandDrive
from wearsim.mechanisms.wrap.drive import WrapDrive
from wearsim.report.flank_view import flanks
from wearsim.result import WearResult


def wheel_shapes(case: Case, result: WearResult | None) -> tuple[WheelShape, ...]:
    """Return the wheels of a case."""
    drive = case.drive
    if isinstance(drive, PrescribedDrive):
        message = (
            "the case must have a sprocket or gears to draw, but is a table of loads along a flank "
            "whose place on a wheel it does not tell: give the wheel's own case"
        )
        raise CaseError([Fault(message, "mechanism.kind", case.name)])
    if isinstance(drive, GearDrive):
        return gear_shapes(drive, result)
    if isinstance(drive, StrandDrive):
        return (_strand_shape(case, drive, result),)
    assert isinstance(drive, WrapDrive)
    return (_wrap_shape(case, drive, result),)


def _strand_shape(case: Case, drive: StrandDrive, result: WearResult | None) -> WheelShape:
    tooth = drive.tooth
    new = tooth_space(tooth)
    every = math.gcd(tooth.teeth, case.engaged_every)
    worn: tuple[Space, ...] = ()
    if result is not None:
        last = flanks(result, -1)
        gone = worn_space(new, np.column_stack([last["x_mm"], last["y_mm"]]))
        worn = tuple(new if number % every else gone for number in range(tooth.teeth))
    notes = ("seat and tip are arcs, the tip about the axis; back flank and seat do not wear", *_alike(every))
    return WheelShape(
        "sprocket", (new,) * tooth.teeth, worn, tooth.strand.centrode_radius, drive.face_width, notes
    )


def _alike(every: int) -> tuple[str, ...]:
    if every > 1:
        return (f"worn alike: every {every}. gap, the only ones that ever carry a roller",)
    return ("all teeth worn alike",)


def _wrap_shape(case: Case, drive: WrapDrive, result: WearResult | None) -> WheelShape:
    new = gap_space(drive.outline, drive.gap)
    if drive.gap is not None:
        notes = [f"{drive.gap.form}: arcs and lines of the standard, exactly"]
    else:
        notes = ["the gap as the case gives it, by points; tips are arcs about the axis"]
    worn: tuple[Space, ...] = ()
    most_worn = 0
    if result is not None:
        last = flanks(result, -1)
        kinds = _worn_kinds(new, last)
        places = _kind_of_gaps(drive.gaps, case.engaged_every, len(kinds))
        worn = tuple(new if kind is None else kinds[kind] for kind in places)
        most_worn = places.index(int(last["gap_kind"][int(last["depth_mm"].argmax())]) - 1)
        if len(kinds) > 1:
            notes.append("gaps that meet inner links and gaps that meet outer ones in turn")
        notes += _alike(math.gcd(drive.gaps, case.engaged_every)) if len(kinds) == 1 else ()
    radius = 0.5 * drive.layout.pitch / math.sin(0.5 * drive.pitch_angle)
    return WheelShape(
        "sprocket", (new,) * drive.gaps, worn, radius, drive.face_width, tuple(notes), most_worn=most_worn
    )


def _worn_kinds(new: Space, last: dict[str, Vector]) -> list[Space]:
    points = np.column_stack([last["x_mm"], last["y_mm"]])
    kinds = last["gap_kind"]
    return [worn_gap(new, points[kinds == kind]) for kind in np.unique(kinds)]


def _kind_of_gaps(gaps: int, every: int, kinds: int) -> list[int | None]:
    """Kind of every gap, None where no roller ever comes."""
    found: list[int | None] = [None] * gaps
    for turn in range(gaps // math.gcd(gaps, every)):
        found[every * turn % gaps] = turn % kinds
    return found
