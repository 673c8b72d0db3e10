"""The wheels of a case, new and worn, as outlines for CAD."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from wearsim.case.model import Case
from wearsim.errors import CaseError, Fault
from wearsim.geometry.blank import gap_space, tooth_space
from wearsim.geometry.profile import Vector
from wearsim.geometry.wheel import Chain, Space, ring, worn_gap, worn_space
from wearsim.mechanisms.gear_pair.drive import GearDrive
from wearsim.mechanisms.prescribed.drive import PrescribedDrive
from wearsim.mechanisms.strand.drive import StrandDrive
from wearsim.mechanisms.wrap.drive import WrapDrive
from wearsim.report.flank_view import flanks
from wearsim.result import WearResult

State = Literal["new", "worn"]


@dataclass(frozen=True, eq=False)
class WheelShape:
    """A wheel, new and worn."""

    name: str  # `sprocket`, `pinion` or `wheel`
    # new, worn: spaces between the teeth, counterclockwise; no worn ones without a run
    new: tuple[Space, ...]
    worn: tuple[Space, ...]
    # radius of the circle that rolls, or through the centres of the rollers [mm]
    pitch_radius: float
    width: float  # of the face [mm]
    notes: tuple[str, ...]  # what the outline takes for granted
    turn: float = 0.0  # angle by which the first space is turned from +y counterclockwise [rad]
    centre: tuple[float, float] = (0.0, 0.0)  # where the axis lies [mm]
    most_worn: int = 0  # index of a space that is worn most

    def chains(self, state: State) -> tuple[Chain, ...]:
        """Return the outline in one state, where it lies in the drawing."""
        spaces = self.new if state == "new" else self.worn
        return tuple(chain.moved(self.centre) for chain in ring(spaces, self.turn))

    @property
    def tip_radius(self) -> float:
        """Radius of the tips of the new teeth [mm]."""
        space = self.new[0]
        return math.hypot(*(space.left or space.right)[-1].vertices[-1])

    @property
    def root_radius(self) -> float:
        """Least radius of the new outline [mm], of the flanks where there is no root."""
        stretches = self.new[0].right + self.new[0].left
        return min(float(np.hypot(*part.vertices.T).min()) for part in stretches)


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
        from wearsim.export.gear_shapes import gear_shapes

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
