"""Arcs and lines run from one end to the other, exact to rounding."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from wearsim.geometry.profile_points import Vector

Point = tuple[float, float]

_ON_END = 1e-12
"""Angle [rad], or part of a line's length, by which a crossing may lie beyond an end."""


@dataclass(frozen=True)
class ArcSegment:
    """A circular arc, run from its first direction to its last.

    Examples
    --------
    >>> ArcSegment((0.0, 0.0), 2.0, 0.0, 0.5 * math.pi).point_at(math.pi).round(12).tolist()
    [0.0, 2.0]
    """

    centre: Point  # coordinates [mm]
    radius: float  # radius [mm], above 0
    # first, last: directions from the centre to the end points [rad]; counterclockwise (a concave part of the
    # gap) where `last` is the larger
    first: float
    last: float

    @property
    def sense(self) -> float:
        """+1 where run counterclockwise, -1 where run clockwise."""
        return math.copysign(1.0, self.last - self.first)

    @property
    def length(self) -> float:
        """Length [mm]."""
        return self.radius * abs(self.last - self.first)

    @property
    def curvature(self) -> float:
        """Signed curvature [1/mm], positive where the flank is convex."""
        return -self.sense / self.radius

    @property
    def start(self) -> Point:
        """First point [mm]."""
        return self._at(self.first)

    @property
    def end(self) -> Point:
        """Last point [mm]."""
        return self._at(self.last)

    @property
    def start_tangent(self) -> float:
        """Direction of travel at the start [rad]."""
        return self.first + self.sense * 0.5 * math.pi

    @property
    def end_tangent(self) -> float:
        """Direction of travel at the end [rad]."""
        return self.last + self.sense * 0.5 * math.pi

    def point_at(self, arc_length: ArrayLike) -> Vector:
        """Return points of the arc."""
        direction = self.first + self.sense * np.asarray(arc_length, dtype=float) / self.radius
        unit = np.stack([np.cos(direction), np.sin(direction)], axis=-1)
        return np.asarray(self.centre) + self.radius * unit

    def shortened(self, arc_length: float) -> "ArcSegment":
        """Return the arc's first part."""
        turn = self.sense * arc_length / self.radius
        return ArcSegment(self.centre, self.radius, self.first, self.first + turn)

    def offset(self, distance: float) -> "ArcSegment":
        """Return the parallel arc on the left of the direction of travel (in the gap)."""
        return ArcSegment(self.centre, self.radius - self.sense * distance, self.first, self.last)

    def length_to_circle(self, radius: float) -> float:
        """Return the way to the first point at a distance from the origin."""
        far = math.hypot(*self.centre)
        beyond = (far + self.radius - radius) * (far + self.radius + radius)
        within = (radius - far + self.radius) * (radius + far - self.radius)
        if beyond < 0.0 or within < 0.0:
            return math.inf
        half = 2.0 * math.atan2(math.sqrt(beyond), math.sqrt(within))
        return self._way(math.atan2(self.centre[1], self.centre[0]), half)

    def length_to_ray(self, angle: float) -> float:
        """Return the way to the first point on a line through the origin."""
        cosine = -_beyond_ray(self.centre, angle) / self.radius
        return self._way(-angle, math.acos(cosine)) if abs(cosine) <= 1.0 else math.inf

    def _at(self, direction: float) -> Point:
        return (
            self.centre[0] + self.radius * math.cos(direction),
            self.centre[1] + self.radius * math.sin(direction),
        )

    def _way(self, middle: float, half: float) -> float:
        """Way to the nearer of two directions on both sides of a middle one."""
        span = abs(self.last - self.first)
        turns = (self.sense * (at - self.first) % math.tau for at in (middle - half, middle + half))
        wrapped = (0.0 if math.tau - turn < _ON_END else turn for turn in turns)
        found = [turn for turn in wrapped if turn <= span + _ON_END]
        return self.radius * min(found, default=math.inf)


@dataclass(frozen=True)
class LineSegment:
    """A straight part, given by its start, its direction and its length.

    Examples
    --------
    >>> LineSegment((1.0, 2.0), 0.0, 3.0).end
    (4.0, 2.0)
    """

    start: Point  # first point [mm]
    direction: float  # direction of travel [rad]
    length: float  # length [mm], above 0

    @property
    def curvature(self) -> float:
        """Signed curvature [1/mm]."""
        return 0.0

    @property
    def end(self) -> Point:
        """Last point [mm]."""
        return (
            self.start[0] + self.length * math.cos(self.direction),
            self.start[1] + self.length * math.sin(self.direction),
        )

    @property
    def start_tangent(self) -> float:
        """Direction of travel at the start [rad]."""
        return self.direction

    @property
    def end_tangent(self) -> float:
        """Direction of travel at the end [rad]."""
        return self.direction

    def point_at(self, arc_length: ArrayLike) -> Vector:
        """Return points of the line."""
        unit = np.array([math.cos(self.direction), math.sin(self.direction)])
        points: Vector = np.asarray(arc_length, dtype=float)[..., None] * unit + self.start
        return points

    def shortened(self, arc_length: float) -> "LineSegment":
        """Return the line's first part."""
        return LineSegment(self.start, self.direction, arc_length)

    def offset(self, distance: float) -> "LineSegment":
        """Return the parallel line on the left of the direction of travel (in the gap)."""
        start = (
            self.start[0] - distance * math.sin(self.direction),
            self.start[1] + distance * math.cos(self.direction),
        )
        return LineSegment(start, self.direction, self.length)

    def length_to_circle(self, radius: float) -> float:
        """Return the way to the first point at a distance from the origin."""
        along = self.start[0] * math.cos(self.direction) + self.start[1] * math.sin(self.direction)
        far = math.hypot(*self.start)
        root = along**2 + (radius - far) * (radius + far)
        if root < 0.0:
            return math.inf
        return self._way(*(sign * math.sqrt(root) - along for sign in (-1.0, 1.0)))

    def length_to_ray(self, angle: float) -> float:
        """Return the way to the point on a line through the origin."""
        rate = math.cos(angle + self.direction)
        return self._way(-_beyond_ray(self.start, angle) / rate) if rate != 0.0 else math.inf

    def _way(self, *ways: float) -> float:
        slack = _ON_END * self.length
        found = [way for way in ways if -slack <= way <= self.length + slack]
        return min(max(min(found), 0.0), self.length) if found else math.inf


Segment = ArcSegment | LineSegment


def points_along(segments: tuple[Segment, ...], arc_length: ArrayLike) -> Vector:
    """Return points of a row of segments, exactly on them.

    Examples
    --------
    >>> row = (LineSegment((0.0, 0.0), 0.0, 1.0), LineSegment((1.0, 0.0), 0.5 * math.pi, 1.0))
    >>> points_along(row, [0.5, 1.5]).round(12).tolist()
    [[0.5, 0.0], [1.0, 0.5]]
    """
    way = np.asarray(arc_length, dtype=float)
    starts = np.concatenate([[0.0], np.cumsum([segment.length for segment in segments])])
    which = np.clip(np.searchsorted(starts, way, side="right") - 1, 0, len(segments) - 1)
    points = np.empty((way.size, 2))
    for number, segment in enumerate(segments):
        here = which == number
        points[here] = segment.point_at(way[here] - starts[number])
    return points


def _beyond_ray(point: Point, angle: float) -> float:
    """Distance of a point beyond the line at an angle clockwise from +y."""
    return point[0] * math.cos(angle) - point[1] * math.sin(angle)
