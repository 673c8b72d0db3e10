"""A whole wheel from its tooth spaces, each a row of named stretches of lines and arcs.

A space has its centre line on +y and is run from its right tip through the root to its left
tip, so that a wheel of them is run counterclockwise.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal

import numpy as np
import shapely

from wearsim.geometry.arc_fit import with_few_arcs
from wearsim.geometry.hub import NO_HUB, Hub, circle
from wearsim.geometry.outline import Outline, along_ways, rotated
from wearsim.geometry.outline_stretch import APART, OutlineStretch, along_points, arc_about_axis, line
from wearsim.geometry.profile_points import Vector
from wearsim.geometry.scene import Stroke

State = Literal["new", "worn"]

_ROOT_TOLERANCE = 1e-6
"""Distance of chords from their arcs [mm] where the root is looked for."""


@dataclass(frozen=True, eq=False)
class ToothSpace:
    """The space between two teeth."""

    right: tuple[OutlineStretch, ...]  # from the tip on the right on
    left: tuple[OutlineStretch, ...]  # to the tip on the left
    rooted: bool = True  # whether `left` starts where `right` ends; else the root is not known

    @property
    def root_radius(self) -> float:
        """Least distance from the axis [mm]."""
        axis, found = shapely.Point(0.0, 0.0), []
        for part in (*self.right, *self.left):
            points, _ = along_ways(part.vertices[:-1], part.vertices[1:], part.bulges, _ROOT_TOLERANCE)
            found.append(shapely.LineString([*points, part.vertices[-1]]).distance(axis))
        return float(min(found))

    def with_few_arcs(self, tolerance: float) -> "ToothSpace":
        """Return the space with its curves by few arcs, within a tolerance [mm]."""
        right, left = (
            tuple(with_few_arcs(part, tolerance) for part in side) for side in (self.right, self.left)
        )
        return replace(self, right=right, left=left)


@dataclass(frozen=True, eq=False)
class OutlineChain:
    """Stretches that follow one another."""

    stretches: tuple[OutlineStretch, ...]  # each starts where the one before ends
    teeth: tuple[int, ...]  # number of the tooth or space that each belongs to, from 1
    closed: bool  # whether the last one ends where the first starts

    @property
    def vertices(self) -> Vector:
        """All vertices [mm]; of a closed chain without the first one again."""
        rows = [stretch.vertices[:-1] for stretch in self.stretches]
        last = [] if self.closed else [self.stretches[-1].vertices[-1:]]
        return np.concatenate([*rows, *last])

    @property
    def bulges(self) -> Vector:
        """Bulges of all ways."""
        return np.concatenate([stretch.bulges for stretch in self.stretches])

    def stroke(self, role: str) -> Stroke:
        """Return the chain as it is drawn."""
        return Stroke(role, self.vertices, self.bulges.tolist(), self.closed)

    def moved(self, centre: tuple[float, float]) -> "OutlineChain":
        """Return the chain about another centre."""
        there = (replace(part, vertices=part.vertices + centre) for part in self.stretches)
        return OutlineChain(tuple(there), self.teeth, self.closed)

    @property
    def outline(self) -> Outline:
        """The closed outline."""
        return Outline(self.vertices, self.bulges)


def worn_space(new: ToothSpace, points: Vector) -> ToothSpace:
    """Return a space whose left side is worn: the new one without what lies between both flanks.

    Where wear reaches an end of the points a straight step joins it to what is not worn, unless
    the worn end lies above the tip, where there was nothing: there the tip cuts the flank off.
    """
    *below, flank = new.left
    first = line("step", flank.vertices[0], points[0]) if new.rooted else ()
    kept, last = _to_tip(points, flank.vertices[-1])
    worn = along_points("flank", kept)
    return ToothSpace(new.right, (*below, *first, worn, *last), new.rooted)


def worn_gap(new: ToothSpace, points: Vector) -> ToothSpace:
    """Return a space that is worn from tip to tip."""
    (gap,) = new.right
    kept, last = _to_tip(points, gap.vertices[-1])
    backwards, first = _to_tip(kept[::-1], gap.vertices[0])
    steps = tuple(OutlineStretch(part.part, part.vertices[::-1], part.bulges) for part in first)
    return ToothSpace((*steps, along_points("gap", backwards[::-1]), *last), ())


def to_circle(points: Vector, radius: float) -> Vector:
    """Return points of a flank that ends on a circle about the axis.

    Examples
    --------
    >>> flank = np.array([[0.0, 1.0], [0.0, 2.0], [0.0, 3.0]])
    >>> to_circle(flank, 2.5)[-1].tolist(), to_circle(flank, 4.0)[-1].tolist()
    ([0.0, 2.5], [0.0, 4.0])
    """
    inside = int(np.flatnonzero(np.hypot(*points.T) < radius)[-1])
    start = points[inside]
    along = start - points[inside - 1] if inside + 1 == len(points) else points[inside + 1] - start
    way = along / math.hypot(*along)
    forward = float(start @ way)
    length = math.sqrt(forward**2 + radius**2 - float(start @ start)) - forward
    return np.concatenate([points[: inside + 1], [start + length * way]])


def _to_tip(points: Vector, tip: Vector) -> tuple[Vector, tuple[OutlineStretch, ...]]:
    """Points of a worn flank as far as the tip circle, and the step from there to the new tip."""
    radius = math.hypot(*tip)
    if math.hypot(*points[-1]) <= radius + APART:
        return points, line("step", points[-1], tip)
    return to_circle(points, radius), ()


def ring(spaces: Sequence[ToothSpace], turn: float = 0.0) -> tuple[OutlineChain, ...]:
    """Return the outline of a wheel from its spaces, joined by arcs about the axis over the tips.

    Examples
    --------
    Four notches from corner to corner of a square of 2 mm take trapezia of 0.75 mm2 from it:

    >>> notch = np.array([[1.0, 1.0], [0.5, 0.5], [-0.5, 0.5], [-1.0, 1.0]])
    >>> space = ToothSpace((OutlineStretch("gap", notch, np.zeros(3)),), ())
    >>> (chain,) = ring([space] * 4)
    >>> chain.closed, round(chain.outline.area, 12)
    (True, 1.0)
    """
    pitch = math.tau / len(spaces)
    placed = [_placed(space, turn + number * pitch) for number, space in enumerate(spaces)]
    rows: list[tuple[OutlineStretch, ...]] = []
    for space, following in pairwise([*placed, placed[0]]):
        start = (space.left or space.right)[-1].vertices[-1]
        end = following.right[0].vertices[0]
        own = space.right + space.left if space.rooted else space.left
        rows.append((*own, *arc_about_axis("tip", start, end), *(() if space.rooted else following.right)))
    if spaces[0].rooted:
        numbers = tuple(n for n, row in enumerate(rows, 1) for _ in row)
        return (OutlineChain(tuple(part for row in rows for part in row), numbers, True),)
    return tuple(OutlineChain(row, (n,) * len(row), False) for n, row in enumerate(rows, 1))


def _placed(space: ToothSpace, angle: float) -> ToothSpace:
    return ToothSpace(
        tuple(part.rotated(angle) for part in space.right),
        tuple(part.rotated(angle) for part in space.left),
        space.rooted,
    )


@dataclass(frozen=True, eq=False)
class WheelShape:
    """A wheel, new and worn."""

    name: str  # `sprocket`, `pinion` or `wheel`
    # new, worn: spaces between the teeth, counterclockwise; no worn ones without a run
    new: tuple[ToothSpace, ...]
    worn: tuple[ToothSpace, ...]
    # radius of the circle that rolls, or through the centres of the rollers [mm]
    pitch_radius: float
    width: float  # of the face [mm]
    notes: tuple[str, ...]  # what the outline takes for granted
    turn: float = 0.0  # angle by which the first space is turned from +y counterclockwise [rad]
    centre: tuple[float, float] = (0.0, 0.0)  # where the axis lies [mm]
    worn_most: int = 0  # index of a space that is worn most
    hub: Hub = NO_HUB  # bore, keyway and hub

    def chains(self, state: State) -> tuple[OutlineChain, ...]:
        """Return the outline in one state, where it lies in the drawing."""
        spaces = self.new if state == "new" else self.worn
        return tuple(chain.moved(self.centre) for chain in ring(spaces, self.turn))

    @property
    def bore(self) -> Outline | None:
        """The bore with its keyway, where it lies in the drawing; None without one."""
        return self._placed(self.hub.bore_outline)

    @property
    def hub_outline(self) -> Outline | None:
        """The circle of the hub, where it lies in the drawing; None without one."""
        return self._placed(circle(self.hub.hub_diameter) if self.hub.hub_diameter else None)

    def with_few_arcs(self, tolerance: float) -> "WheelShape":
        """Return the wheel with the curves of its spaces by few arcs, within a tolerance [mm]."""
        few = {space: space.with_few_arcs(tolerance) for space in {*self.new, *self.worn}}
        new, worn = (tuple(few[space] for space in spaces) for spaces in (self.new, self.worn))
        return replace(self, new=new, worn=worn)

    def _placed(self, outline: Outline | None) -> Outline | None:
        if outline is None:
            return None
        return replace(outline, vertices=rotated(outline.vertices, self.turn) + self.centre)

    def sketched(self, role: str, fineness: float = 5e-3) -> Stroke:
        """Return the new outline by a few chords, which deviate by a part of the pitch."""
        (chain,) = self.chains("new")
        tolerance = fineness * math.tau * self.pitch_radius / len(self.new)
        ends = np.roll(chain.vertices, -1, axis=0)
        points, _ = along_ways(chain.vertices, ends, chain.bulges, 0.2 * tolerance)
        few = shapely.LinearRing(points).simplify(tolerance)
        return Stroke(role, shapely.get_coordinates(few)[:-1], closed=True)

    @property
    def tip_radius(self) -> float:
        """Radius of the tips of the new teeth [mm]."""
        space = self.new[0]
        return math.hypot(*(space.left or space.right)[-1].vertices[-1])


def worn_alike(every: int) -> str:
    """Return which spaces a run wears, in words."""
    if every > 1:
        return f"worn alike: every {every}. gap, the only ones that ever carry a roller"
    return "all teeth worn alike"
