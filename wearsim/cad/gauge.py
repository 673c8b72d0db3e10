"""A go/no-go gauge: it goes in between two teeth that are worn to their limit, and no sooner.

Its shoulders rest on both tips. On the loaded side, at the radii of the deepest wear, it reaches as
far as the gap at the limit; elsewhere it keeps off the new teeth: the wear there alone decides. On
the other side it lies against the new tooth. It comes in from above even where the gap is narrower
between the tips than below, along a line that slants towards the loaded side: what would not come
past the tips along that line is cut off.
"""

import math
from dataclasses import dataclass

import numpy as np
import shapely
from shapely.geometry.polygon import orient

from wearsim.geometry.outline import along_ways, rotated
from wearsim.geometry.outline_stretch import OutlineStretch, angle_between, arc_about_axis, line
from wearsim.geometry.profile_points import Vector
from wearsim.geometry.wheel_outline import OutlineChain, WheelShape

_HEAD = 0.5
_LEAST_HEAD = 20.0
"""Height of the gauge above the tips: part of the pitch, and its least [mm]."""

_CLEARANCE = 0.02
_LEAST_SHOULDER = 0.1
"""Clearance to the new teeth, and least length of a shoulder: parts of the pitch."""

_DEEP = 0.5
"""Part of the greatest depth from which on the gauge is as wide as the worn gap."""

_NOSE = 0.9
"""Part of the greatest depth from which on the gauge must come in past the tip."""

_EDGE = 0.05
"""Part of the pitch that must touch the tooth that is not loaded, else it is the edge of its tip alone."""

_TOLERANCE = 1e-4
"""Distance of chords from their arcs [mm]."""


@dataclass(frozen=True, eq=False)
class GaugeOutline:
    """A gauge in the frame of its space, whose centre line is +y."""

    name: str  # of the wheel
    # closed, of short lines: what goes between the teeth, shoulders along the tips, head
    outline: OutlineChain
    new: tuple[OutlineChain, ...]  # the new gap, for comparison
    clearance: float  # to the new teeth, where the gauge is not as wide as the worn gap [mm]
    pitch_radius: float  # of the wheel [mm]
    tip_radius: float  # of the wheel [mm]
    slant: float  # of the way in, from the centre line downwards to the loaded side [rad]
    on_edge: bool  # whether it touches the tooth that is not loaded at the edge of its tip alone

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Left, bottom, width and height [mm]."""
        points = self.outline.vertices
        low, high = points.min(axis=0) - 1.0, points.max(axis=0) + 1.0
        return float(low[0]), float(low[1]), *(high - low).tolist()


def gauge(shape: WheelShape) -> GaugeOutline:
    """Return the gauge of a wheel that is worn to its limit."""
    worn, new = shape.worn[shape.worn_most], shape.new[shape.worn_most]
    pitch = math.tau * shape.pitch_radius / len(shape.new)
    clearance, top = _CLEARANCE * pitch, shape.tip_radius + max(_LEAST_HEAD, _HEAD * pitch)
    points, fresh = _points(worn.right + worn.left), _points(new.right + new.left)
    steel, unloaded = shapely.LineString(fresh), shapely.box(0.0, 0.0, top, top)
    depth = shapely.distance(shapely.points(points), steel)
    deep = np.hypot(*points[depth >= _DEEP * depth.max()].T)
    low, high = _disc(deep.min() - 0.1 * clearance), _disc(deep.max() + 0.1 * clearance)
    room = shapely.union_all(
        [
            _gap(fresh, clearance) - steel.buffer(clearance),
            _gap(points, clearance) & (high - low),
            (_gap(fresh, clearance) & unloaded) - low,
        ]
    )
    walls = _walls(room, shape.tip_radius)
    slant = _slant(points[depth >= _NOSE * depth.max()], walls)
    whole = (room - _shadow(walls, slant, shape.tip_radius)) | _head(points, len(shape.new), top)
    body = orient(max(shapely.get_parts(whole), key=shapely.area))
    rows = (new.right + new.left,) if new.rooted else (new.right, new.left)
    return GaugeOutline(
        shape.name,
        _closed(shapely.get_coordinates(body.exterior)),
        tuple(OutlineChain(row, (1,) * len(row), False) for row in rows),
        clearance,
        shape.pitch_radius,
        shape.tip_radius,
        slant,
        (body.exterior & steel.buffer(10.0 * _TOLERANCE) & unloaded).length < _EDGE * pitch,
    )


def _closed(vertices: Vector) -> OutlineChain:
    return OutlineChain((OutlineStretch("gauge", vertices, np.zeros(len(vertices) - 1)),), (1,), True)


def _walls(room: shapely.Polygon, tip_radius: float) -> Vector:
    """Sides of a room below the tips, as pairs of points, shape (n, 2, 2)."""
    lines = shapely.get_parts(room.exterior & _disc(tip_radius - _TOLERANCE))
    rows = [shapely.get_coordinates(line) for line in lines]
    return np.concatenate([np.stack([row[:-1], row[1:]], axis=1) for row in rows])


def _slant(nose: Vector, walls: Vector) -> float:
    """Return the least slant, in whole degrees, at which no wall of the loaded side lies above the nose."""
    wall = walls.reshape(-1, 2)
    wall = wall[wall[:, 0] < 0.0]
    (right, up), above = (wall - nose[:, None]).T, np.hypot(*wall.T)[:, None] > np.hypot(*nose.T)
    steepest = np.arctan2(right, up)[above & (up > _TOLERANCE)].max(initial=0.0)
    return math.radians(math.ceil(math.degrees(steepest)))


def _shadow(walls: Vector, slant: float, length: float) -> shapely.Geometry:
    """What lies below walls along the way in."""
    ahead = -length * np.array([math.sin(slant), math.cos(slant)])
    start, end = walls[:, 0], walls[:, 1]
    swept = shapely.polygons(np.stack([start, end, end + ahead, start + ahead], axis=1))
    return shapely.union_all(swept[shapely.area(swept) > 0.0])


def _points(stretches: tuple[OutlineStretch, ...]) -> Vector:
    """Points of stretches, arcs by chords, straight across where one does not start at the last."""
    rows = []
    for part in stretches:
        points, _ = along_ways(part.vertices[:-1], part.vertices[1:], part.bulges, _TOLERANCE)
        rows += [points, part.vertices[-1:]]
    return np.concatenate(rows)


def _gap(points: Vector, clearance: float) -> shapely.Polygon:
    """Room of a gap, closed by a point in the head above the tangents to both tips."""
    ends = points[[0, -1]]
    above = (np.square(ends).sum(axis=1) / ends[:, 1]).max() + clearance
    return shapely.Polygon([*points, (0.0, above)])


def _disc(radius: float) -> shapely.Polygon:
    return shapely.Point(0.0, 0.0).buffer(radius, quad_segs=2000)


def _head(points: Vector, teeth: int, top: float) -> shapely.Polygon:
    """Head over the tips, whose lower side rests on both of them."""
    right, left = points[0], points[-1]
    pitch = math.tau / teeth
    half = max(0.5 * (pitch - angle_between(right, left)), _LEAST_SHOULDER * pitch)
    left_end, right_end = rotated(left, half), rotated(right, -half)
    upper = top / math.hypot(*right)
    return shapely.Polygon(
        _points(
            (
                *arc_about_axis("shoulder", right_end, left_end),
                *line("head", left_end, left_end * upper),
                *line("head", left_end * upper, right_end * upper),
            )
        )
    )
