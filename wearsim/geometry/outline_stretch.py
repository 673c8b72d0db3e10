"""Stretches of an outline: rows of lines and arcs from end to end, with a name."""

import math
from dataclasses import dataclass, replace

import numpy as np

from wearsim.geometry.gap import Gap
from wearsim.geometry.outline import rotated
from wearsim.geometry.profile_points import Vector
from wearsim.geometry.segments import ArcSegment, Segment

APART = 1e-9
"""Distance [mm] below which two ends are one point."""


@dataclass(frozen=True, eq=False)
class OutlineStretch:
    """A part of an outline from end to end."""

    # `flank` (the side that wears), `back_flank`, `root`, `tip`, `gap` (both sides and the seat in one), or
    # `step` between a worn part and one that is not
    part: str
    vertices: Vector  # coordinates [mm], both ends included, shape (n, 2)
    # of the ways between them, shape (n - 1,): tan of a quarter of the arc's angle, positive
    # counterclockwise, 0 for a line
    bulges: Vector
    # whether the vertices are points of a smooth curve; else the arcs and lines are the form
    is_curve: bool = False

    def rotated(self, angle: float) -> "OutlineStretch":
        """Return the stretch turned counterclockwise about the origin."""
        return replace(self, vertices=rotated(self.vertices, angle))

    def mirrored(self, part: str) -> "OutlineStretch":
        """Return the mirror image on +y, run from the other end."""
        return OutlineStretch(part, self.vertices[::-1] * (-1.0, 1.0), self.bulges[::-1], self.is_curve)


def line(part: str, start: Vector, end: Vector) -> tuple[OutlineStretch, ...]:
    """Return the line between two points, none where they are one."""
    if math.dist(start, end) < APART:
        return ()
    return (OutlineStretch(part, np.array([start, end]), np.zeros(1)),)


def arc_through(part: str, start: Vector, middle: Vector, end: Vector) -> OutlineStretch:
    """Return the arc whose ends and middle are given.

    Examples
    --------
    A half circle, run counterclockwise:

    >>> points = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]])
    >>> arc_through("root", *points).bulges.tolist()
    [1.0]
    """
    (x, y), chord = middle - 0.5 * (start + end), end - start
    bulge = 2.0 * (x * chord[1] - y * chord[0]) / (chord @ chord)
    return OutlineStretch(part, np.array([start, end]), np.array([bulge]))


def along_points(part: str, points: Vector) -> OutlineStretch:
    """Return a stretch through points of a curve, with arcs between them where it bends evenly.

    Of two neighbours the lesser of the curvatures is taken, and none where they differ in sign,
    so that corners stay corners.

    Examples
    --------
    Five points of a half circle of radius 1: four arcs of 45 degrees each.

    >>> angle = np.linspace(0.0, np.pi, 5)
    >>> half = along_points("root", np.column_stack([np.cos(angle), np.sin(angle)]))
    >>> np.degrees(4.0 * np.arctan(half.bulges)).round(9).tolist()
    [45.0, 45.0, 45.0, 45.0]
    """
    way = np.diff(points, axis=0)
    chord = np.hypot(*way.T)
    cross = way[:-1, 0] * way[1:, 1] - way[:-1, 1] * way[1:, 0]
    across = np.hypot(*(points[2:] - points[:-2]).T)
    # The circle through three points has the radius a b c / (2 |a x b|).
    inner = 2.0 * cross / (chord[:-1] * chord[1:] * across)
    curvature = np.concatenate([inner[:1], inner, inner[-1:]])
    before, after = curvature[:-1], curvature[1:]
    lesser = np.where(np.abs(before) < np.abs(after), before, after)
    bent = np.where(before * after > 0.0, lesser, 0.0)
    half_sweep = np.arcsin(np.clip(0.5 * bent * chord, -0.5, 0.5))
    return OutlineStretch(part, points, np.tan(0.5 * half_sweep), is_curve=True)


def up_to(flank: OutlineStretch, point: Vector) -> OutlineStretch:
    """Return the first part of a flank that is run from root to tip."""
    below = np.hypot(*flank.vertices.T) < math.hypot(*point) - APART
    kept = int(below.argmin())
    start, end = flank.vertices[kept - 1 : kept + 1]
    part = math.dist(start, point) / math.dist(start, end)
    last = math.tan(part * math.atan(flank.bulges[kept - 1]))
    return OutlineStretch(
        flank.part,
        np.concatenate([flank.vertices[:kept], [point]]),
        np.concatenate([flank.bulges[: kept - 1], [last]]),
        flank.is_curve,
    )


def along_gap(gap: Gap) -> OutlineStretch:
    """Return the gap of a standard form by its own arcs and lines."""
    half = gap.segments
    points = np.array([part.start for part in half] + [half[-1].end])
    bulges = np.array([_bulge(part) for part in half])
    if abs(points[0, 0]) < APART:
        return _joined_halves(points, bulges)
    ends = np.concatenate([points[::-1], points * (-1.0, 1.0)])
    return OutlineStretch("gap", ends, -np.concatenate([bulges[::-1], [0.0], bulges]))


def _joined_halves(points: Vector, bulges: Vector) -> OutlineStretch:
    """Both halves of a gap whose bottom is one point."""
    vertices = np.concatenate([points[:0:-1], points * (-1.0, 1.0)])
    vertices[points.shape[0] - 1, 0] = 0.0
    return OutlineStretch("gap", vertices, -np.concatenate([bulges[::-1], bulges]))


def _bulge(part: Segment) -> float:
    return math.tan(0.25 * (part.last - part.first)) if isinstance(part, ArcSegment) else 0.0


def arc_about_axis(part: str, start: Vector, end: Vector) -> tuple[OutlineStretch, ...]:
    """Return the arc about the axis from one point to another at its radius."""
    if math.dist(start, end) < APART:
        return ()
    bulge = math.tan(0.25 * angle_between(start, end))
    return (OutlineStretch(part, np.array([start, end]), np.array([bulge])),)


def angle_between(start: Vector, end: Vector) -> float:
    """Return the angle from one point to another about the axis."""
    return math.atan2(start[0] * end[1] - start[1] * end[0], float(start @ end))
