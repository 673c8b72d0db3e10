"""Flanks of a run from new to worn, as pictures show them: their points at any time."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from wearsim.case.model import Case
from wearsim.errors import CaseError, Fault
from wearsim.geometry.profile_points import Profile, Vector
from wearsim.geometry.scene import Circle, Stroke
from wearsim.geometry.wheel_outline import WheelShape
from wearsim.report.flank_view import case_of, flanks, snapshot
from wearsim.result import WearResult

_LARGEST_SHOWN = 0.12
"""Depth in the picture of a flank, as a fraction of the flank's extent."""

_ROUND = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)


@dataclass(frozen=True, eq=False)
class WornFlank:
    """A flank that wears; ``S`` snapshots of ``N`` points."""

    name: str  # `tooth`, or of gears `pinion` and `wheel`
    cycles: Vector  # loading cycles of the snapshots, from 0, shape (S,)
    x: Vector  # points and the depth worn off there [mm], shape (S, N)
    y: Vector  # points and the depth worn off there [mm], shape (S, N)
    depth: Vector  # points and the depth worn off there [mm], shape (S, N)

    @cached_property
    def new(self) -> Profile:
        """The flank before it wears."""
        return Profile(self.x[0], self.y[0])

    @property
    def extent(self) -> float:
        """Larger side of the box around the new flank [mm]."""
        return float(max(np.ptp(self.x[0]), np.ptp(self.y[0])))

    @property
    def deepest(self) -> int:
        """Point that is worn most at the last snapshot."""
        return int(self.depth[-1].argmax())

    @property
    def factor(self) -> int:
        """Round factor that a picture enlarges the depth by."""
        return enlargement(float(self.depth[-1].max()), self.extent)

    def at(self, cycles: Vector) -> tuple[Vector, Vector, Vector]:
        """Return the flank at some times, linear in them between two snapshots."""
        after = np.clip(np.searchsorted(self.cycles, cycles), 1, self.cycles.size - 1)
        first, last = self.cycles[after - 1], self.cycles[after]
        part = ((cycles - first) / (last - first))[:, None]
        x, y, depth = (
            (1.0 - part) * values[after - 1] + part * values[after] for values in (self.x, self.y, self.depth)
        )
        return x, y, depth

    def until(self, cycles: float) -> "WornFlank":
        """Return the flank as it wears up to a time."""
        end = np.array([min(cycles, self.cycles[-1])])
        before, last = self.cycles < end[0], self.at(end)
        x, y, depth = (
            np.vstack([values[before], ends])
            for values, ends in zip((self.x, self.y, self.depth), last, strict=True)
        )
        return WornFlank(self.name, np.append(self.cycles[before], end), x, y, depth)

    def strokes(
        self, x: Vector, y: Vector, depth: Vector, factor: int
    ) -> tuple[Stroke, Stroke, Stroke, Stroke]:
        """Return what is worn off at a time, the new flank, the worn one and its deepest point, enlarged."""
        new = np.column_stack([self.x[0], self.y[0]])
        worn = new + factor * (np.column_stack([x, y]) - new)
        deepest = worn[[depth.argmax()]] if depth.any() else worn[:0]
        return (
            Stroke("between", np.concatenate([new, worn[::-1]]), closed=True),
            Stroke("new", new),
            Stroke("worn", worn),
            Stroke("deepest", deepest),
        )


def flanks_of_life(result: WearResult) -> list[WornFlank]:
    """Return the flank up to the end of the life, of gears those of both wheels."""
    return [flank.until(result.life.cycles_run) for flank in worn_flanks(result)]


def worn_flanks(result: WearResult) -> list[WornFlank]:
    """Return the flank of a run, of gears those of both wheels."""
    columns = result.flank_columns
    size = snapshot(result, 0)["depth_mm"].size
    rows: slice | Vector = slice(None)
    if "gap_kind" in columns:
        rows = columns["gap_kind"] == columns["gap_kind"][int(columns["depth_mm"].argmax())]
    cycles = columns["cycles"][rows].reshape(-1, size)[:, 0]

    def _flank(name: str, start: str) -> WornFlank:
        x, y, depth = (columns[start + part][rows].reshape(-1, size) for part in ("x_mm", "y_mm", "depth_mm"))
        return WornFlank(name, cycles, x, y, depth)

    if "wheel_x_mm" in columns:
        return [_flank("pinion", ""), _flank("wheel", "wheel_")]
    return [_flank("tooth", "")]


def enlargement(depth: float, extent: float) -> int:
    """Return a round factor that makes a depth visible beside a flank.

    Examples
    --------
    >>> enlargement(0.1, 20.0)  # 20 * 0.1 = 2.0 <= 0.12 * 20 = 2.4
    20
    """
    return max(n for n in _ROUND if n == 1 or n * depth <= _LARGEST_SHOWN * extent)


def wheel_shapes(case: Case, result: WearResult | None) -> tuple[WheelShape, ...]:
    """Return the wheels of a case, worn as at the end of a run where there is one."""
    shapes = case.drive.wheels(case.engaged_every, None if result is None else flanks(result, -1))
    if not shapes:
        message = (
            "the case must have a sprocket or gears to draw, but is a table of loads, which does not place "
            "the flank on a wheel: give the case of the wheel"
        )
        raise CaseError([Fault(message, "mechanism.kind", case.name)])
    return shapes


def around_flank(result: WearResult, flank: WornFlank) -> tuple[Stroke | Circle, ...]:
    """Return the steel around a new flank, as far as it is known, and the circle that touches it.

    The circle touches it where it wears most.
    """
    drive, new, deepest = case_of(result).drive, flank.new, flank.deepest
    body, mate = drive.body(), drive.mate(snapshot(result, -1), deepest)
    if mate is None:
        return body
    radius, name = mate
    x = float(new.x[deepest] + radius * new.normal_x[deepest])
    y = float(new.y[deepest] + radius * new.normal_y[deepest])
    return *body, Circle("mate", (x, y), abs(radius), name)
