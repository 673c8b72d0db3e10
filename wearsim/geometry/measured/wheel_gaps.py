"""The gaps of a drawn wheel, and how far they differ from each other."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray

from wearsim.geometry.measured.dxf_edges import without_repeats
from wearsim.geometry.profile_points import Vector

_TIP_CUT = 1e-3
_FLAT_TOP = 1e-2
"""Distance below the greatest radius [mm] within which a top counts as a tip."""

_SHALLOWEST = 0.01
_COMPARED = 201
"""Places along a gap at which all of them are compared."""

_BELOW_TIPS = 0.9
"""Part of the depth of the gaps that is compared: what a roller touches, without the ends of tip lands."""


@dataclass(frozen=True)
class Gap:
    """A gap between the two tips beside it, turned onto +y, with the angle it had."""

    points: Vector
    angle: float


def is_deep(radius: Vector) -> bool:
    """Tell whether radii differ as those of a toothed outline do."""
    return bool(radius.max() - radius.min() > _SHALLOWEST * radius.max())


def dips(ring: Vector) -> NDArray[np.intp]:
    """Indices where a closed outline dips below the middle of its radii."""
    radius = np.hypot(*ring.T)
    low = radius < 0.5 * (radius.min() + radius.max())
    return np.flatnonzero(low & ~np.roll(low, 1)) if is_deep(radius) else np.empty(0, dtype=np.intp)


def gaps_around(ring: Vector) -> list[Gap]:
    """All gaps of a wheel around the origin that is run through counterclockwise."""
    ring = np.roll(ring, -int(np.hypot(*ring.T).argmax()), axis=0)
    ring = np.concatenate([ring, ring[:1]])
    radius = np.hypot(*ring.T)
    starts = dips(ring[:-1])
    bounds = np.append(starts, radius.size)
    bottoms = [a + int(radius[a:b].argmin()) for a, b in pairwise(bounds)]
    tips = [a + int(radius[a:b].argmax()) for a, b in pairwise(bottoms)]
    tips = [0, *tips, radius.size - 1]
    # A tip land may fall to either of its gaps here: the cut takes it off.
    return [
        between_tips(ring[first : last + 1], bottom - first)
        for first, bottom, last in zip(tips, bottoms, tips[1:], strict=False)
    ]


def between_tips(points: Vector, bottom: int) -> Gap:
    """A gap from just below its right tip to just below its left one, turned onto +y."""
    left = _up_to_tip(points[bottom:])
    right = _up_to_tip(points[: bottom + 1][::-1])
    top = min(math.hypot(*left[-1]), math.hypot(*right[-1]))
    low = math.hypot(*points[bottom])
    radii = np.linspace(low + 0.2 * (top - low), top, 50)
    upwards = math.atan2(points[bottom, 1], points[bottom, 0])
    angles = []
    for side in (left, right):
        angle = np.arctan2(side[:, 1], side[:, 0]) - upwards
        angle = np.angle(np.exp(1j * angle))
        angles.append(np.interp(radii, np.maximum.accumulate(np.hypot(*side.T)), angle))
    middle = upwards + 0.5 * float(np.mean(angles[0] + angles[1]))
    turn = 0.5 * math.pi - middle
    cosine, sine = math.cos(turn), math.sin(turn)
    outline = np.concatenate([right[::-1], left[1:]])
    rotated = outline @ np.array([[cosine, sine], [-sine, cosine]])
    return Gap(rotated, math.remainder(-turn, 2.0 * math.pi))


def _up_to_tip(side: Vector) -> Vector:
    """A side of a gap from its bottom to where it comes within the cut of its tip.

    Its tip is the first top near its greatest radius: the other end of a tip land that is
    drawn as a straight line may lie a little higher.
    """
    radius = np.hypot(*side.T)
    near = int(np.flatnonzero(radius >= radius.max() - _FLAT_TOP)[0])
    falls = np.flatnonzero(np.diff(radius[near:]) < 0.0)
    level = radius[near + falls[0] if falls.size else -1] - _TIP_CUT
    last = int(np.flatnonzero(radius >= level)[0])
    share = (level - radius[last - 1]) / (radius[last] - radius[last - 1])
    end = side[last - 1] + share * (side[last] - side[last - 1])
    return without_repeats(np.concatenate([side[:last], end[None]]))


@dataclass(frozen=True, eq=False)
class Agreement:
    """How far the gaps of a wheel differ from their mean, turned onto each other by their flanks."""

    shape: Vector  # greatest distance of each gap from the mean one [mm], shape (z,)
    spacing: Vector  # of each gap from even spacing, along the tip circle [mm], shape (z,)
    mean: float  # distance from the mean gap, over all places of all gaps [mm]


def agreement(gaps: list[Gap], taken: Gap) -> Agreement:
    """Return how far gaps differ, compared along one of them up to 0.9 of the least depth.

    Examples
    --------
    Four gaps that are V-shaped, the first one 0.1 mm deeper, its flanks then 0.1 * 5 / hypot(5, 10.1) mm
    away at the bottom, of which the mean has a quarter:

    >>> def gap(depth, angle):
    ...     return Gap(np.array([[5.0, 30.0], [0.0, 30.0 - depth], [-5.0, 30.0]]), angle)
    >>> gaps = [gap(10.1, -math.pi / 2)] + [gap(10.0, i * math.pi / 2) for i in range(3)]
    >>> found = agreement(gaps, gaps[1])
    >>> found.shape.round(4).tolist()
    [0.0333, 0.0111, 0.0111, 0.0111]
    >>> found.spacing.round(9).tolist()
    [0.0, 0.0, 0.0, 0.0]
    """
    top = min(float(np.hypot(*gap.points[[0, -1]].T).min()) for gap in gaps)
    line = shapely.LineString(taken.points)
    along = shapely.line_interpolate_point(line, np.linspace(0.0, 1.0, _COMPARED), normalized=True)
    radius = np.hypot(shapely.get_x(along), shapely.get_y(along))
    along = along[radius <= radius.min() + _BELOW_TIPS * (top - radius.min())]
    apart = np.array([_distances(gap, along) for gap in gaps])
    apart -= apart.mean(axis=0)
    angles = np.array([gap.angle for gap in gaps])
    order = np.argsort(angles)
    uneven = np.empty(len(gaps))
    uneven[order] = angles[order] - 2.0 * math.pi / len(gaps) * np.arange(len(gaps))
    return Agreement(np.abs(apart).max(axis=1), top * (uneven - uneven.mean()), float(np.abs(apart).mean()))


def _distances(gap: Gap, places: NDArray[np.object_]) -> Vector:
    """Distances of places from the outline of a gap [mm], above 0 inside the gap."""
    right, left = gap.points[0, 0], gap.points[-1, 0]
    high = 2.0 * float(gap.points[:, 1].max())
    inside = shapely.Polygon([*gap.points, (left, high), (right, high)])
    shapely.prepare(inside)
    apart = shapely.distance(places, shapely.LineString(gap.points))
    return np.array(np.where(shapely.contains(inside, places), apart, -apart))
