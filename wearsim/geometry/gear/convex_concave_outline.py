"""Whole outlines of convex-concave gears: flanks, tips and simple roots.

The frame is that of the flanks: axis at the origin, a tooth's working flank on +y, its tooth
on the side of +x.
"""

import math
from typing import Literal

import numpy as np
import shapely

from wearsim.errors import GeometryError
from wearsim.geometry.gear.convex_concave import ConvexConcave
from wearsim.geometry.gear.convex_concave_flank import ConvexConcaveFlank
from wearsim.geometry.gear.convex_concave_gear import ConvexConcaveGear
from wearsim.geometry.outline import Outline, rotated
from wearsim.geometry.profile_points import Vector

RootForm = Literal["radial", "fillet"]

_FLANK_POINTS = 33
"""Of head and of foot; with arcs between them the outline follows the flank to about 2e-7 module."""


def root_radius(gear: ConvexConcaveGear, clearance: float | None, root: RootForm) -> float:
    """Return the radius of the root circle."""
    depth = gear.addendum + (0.25 * gear.module if clearance is None else clearance)
    radius = gear.pitch_radius - depth
    if root == "fillet" and clearance is None:
        radius = _joining_root(gear)
    if not radius > 0.0:
        raise GeometryError(
            f"root of z = {gear.teeth}: its radius must be above 0 mm, is {radius:.4g} mm: take more "
            "teeth, or lower addendum_ratio or root_clearance_ratio"
        )
    return radius


def gear_outline(gear: ConvexConcaveGear, clearance: float | None, root: RootForm) -> Outline:
    """Return the outline of a gear."""
    half, half_bulges, _ = half_tooth(gear, clearance, root)
    tip = 2.0 * math.atan2(-half[0, 0], half[0, 1])
    tooth = np.concatenate([half[:0:-1] * (-1.0, 1.0), half[:1] * (-1.0, 1.0), half[:-1]])
    tooth_bulges = np.concatenate([half_bulges[::-1], [math.tan(0.25 * tip)], half_bulges])
    pitch, first = 2.0 * math.pi / gear.teeth, -0.5 * math.pi / gear.teeth
    teeth = [rotated(tooth, first + k * pitch) for k in range(gear.teeth)]
    return Outline(np.concatenate(teeth), np.tile(tooth_bulges, gear.teeth))


def half_tooth(
    gear: ConvexConcaveGear, clearance: float | None, root: RootForm
) -> tuple[Vector, Vector, int]:
    """Return the left half of a tooth whose centre line is +y."""
    vertices, bulges = _flank(gear)
    radius = root_radius(gear, clearance, root)
    below, below_bulges = (_radial if root == "radial" else _fillet)(gear, radius)
    half = rotated(np.concatenate([vertices, below]), gear.half_tooth)
    return half, np.concatenate([bulges, below_bulges]), len(bulges)


def _flank(gear: ConvexConcaveGear) -> tuple[Vector, Vector]:
    """Flank from tip to foot, and the bulges between its points from the turn of its normal."""

    def part(flank: ConvexConcaveFlank, first: float, last: float) -> tuple[Vector, Vector]:
        alpha = np.linspace(first, last, _FLANK_POINTS)
        return flank.points(alpha), alpha + flank.roll_angle(alpha)

    head, head_turn = part(gear.head, gear.tip_angle, gear.pitch_point_angle)
    foot, foot_turn = part(gear.foot, gear.pitch_point_angle, gear.foot_angle)
    turns = np.concatenate([np.diff(head_turn), np.diff(foot_turn)])
    return np.concatenate([head, foot[1:]]), np.tan(-0.25 * turns)


def _at(radius: float, angle: float) -> list[float]:
    """Point at an angle from +y, counterclockwise."""
    return [-radius * math.sin(angle), radius * math.cos(angle)]


def _radial(gear: ConvexConcaveGear, root: float) -> tuple[Vector, Vector]:
    """Radial line, largest arc that rounds it, root circle to the middle of the gap."""
    x, y = gear.foot.points(gear.foot_angle)
    end, line = math.hypot(x, y), math.atan2(-x, y)
    across, deepest = math.sin(gear.half_gap - line), 0.5 * (end**2 / root - root)
    fillet = root * across / (1.0 - across)
    if fillet < deepest:
        points = [_at(math.sqrt(root**2 + 2.0 * root * fillet), line), _at(root, gear.half_gap)]
        angles = [0.0, gear.half_gap - line - 0.5 * math.pi]
    else:
        spread = math.asin(deepest / (root + deepest))
        points = [_at(root, line + spread), _at(root, gear.half_gap)]
        angles = [spread - 0.5 * math.pi, gear.half_gap - line - spread]
    return np.array(points), np.tan(0.25 * np.array(angles))


def _joining_root(gear: ConvexConcaveGear) -> float:
    """Root radius at which one arc goes from foot to foot: that of a roller that rests on both ends."""
    arc = 0.5 * gear.seated_diameter(gear.foot, gear.foot_angle)
    centre = gear.foot.points(gear.foot_angle) + arc * gear.foot.normals(gear.foot_angle)
    return math.hypot(*centre) - arc


def _fillet(gear: ConvexConcaveGear, root: float) -> tuple[Vector, Vector]:
    """Arc from the end of the flank, in its direction, that touches the root circle."""
    least = _joining_root(gear)
    if root < least:
        greatest = math.floor(1e4 * (gear.pitch_radius - gear.addendum - least) / gear.module) / 1e4
        raise GeometryError(
            f"root_clearance_ratio: must be at most {greatest:g} for a fillet to fit into the gap of "
            f'z = {gear.teeth}, is more: lower it, leave it out or take root_form = "radial"'
        )
    point = gear.foot.points(gear.foot_angle)
    normal = gear.foot.normals(gear.foot_angle)
    fillet = 0.5 * (point @ point - root**2) / (root - point @ normal)
    x, y = point + fillet * normal
    touch = gear.half_gap if root == least else math.atan2(-x, y)
    sweep, rest = touch - math.atan2(-normal[0], normal[1]), gear.half_gap - touch
    points = [_at(root, touch), _at(root, gear.half_gap)][: 2 if rest else 1]
    return np.array(points), np.tan(0.25 * np.array([sweep, rest][: len(points)]))


def tip_overlap(pair: ConvexConcave, pinion: Vector, wheel: Vector) -> tuple[float, float]:
    """Return how deep the tips of each gear enter the other.

    The corner of the tip goes round the other gear while the flanks stay in contact.
    """
    return (_entered(pair.wheel, pair.pinion, pinion), _entered(pair.pinion, pair.wheel, wheel))


def _entered(gear: ConvexConcaveGear, mate: ConvexConcaveGear, polygon: Vector) -> float:
    """Depth of the tip corner of a gear in the polygon of its mate."""
    centre = gear.pitch_radius + mate.pitch_radius
    corner = gear.head.points(gear.tip_angle)
    reach = math.acos(
        (centre**2 + gear.tip_radius**2 - mate.tip_radius**2) / (2.0 * centre * gear.tip_radius)
    )
    turn = math.atan2(corner[0], corner[1]) + np.linspace(-reach, reach, 1001)
    # Turned by its angle, into the frame of the mate half round, and back by the mate's angle.
    there = np.stack([rotated(corner, angle) for angle in turn]) * -1.0 + (0.0, centre)
    back = turn * gear.pitch_radius / mate.pitch_radius
    path = np.stack([rotated(at, angle) for at, angle in zip(there, back, strict=True)])
    solid = shapely.Polygon(rotated(polygon, mate.turn))
    inside = shapely.points(path[shapely.contains_xy(solid, path)])
    return max((float(d) for d in shapely.distance(inside, solid.exterior)), default=0.0)
