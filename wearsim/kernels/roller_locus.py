"""Where the centre of a roller can be in a worn gap."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import TABLE, VECTOR, float64, int64, void

if TYPE_CHECKING:
    from wearsim.jit.signatures import Vector

LOCUS_X, LOCUS_Y, LOCUS_NORMAL_X, LOCUS_NORMAL_Y = range(4)
"""Rows of a locus, and of a ray: a place, and the unit normal out of the outline there."""

_INSIDE = 1.0 - 1e-12
"""Part of its radius squared within which a point is inside a roller, not on it."""


@kernel(float64(VECTOR, VECTOR, int64, VECTOR, float64))
def distance_to(x: Vector, y: Vector, point: int, ray: Vector, radius: float) -> float:
    """Return the way along a ray to the circle around a point; infinite if it lies behind or beside.

    ``ray``: x, y and the unit direction that it goes against.
    """
    ax, ay = ray[LOCUS_X] - x[point], ray[LOCUS_Y] - y[point]
    across = ax * ray[LOCUS_NORMAL_Y] - ay * ray[LOCUS_NORMAL_X]
    rest = radius * radius - across * across
    along, half = ax * ray[LOCUS_NORMAL_X] + ay * ray[LOCUS_NORMAL_Y], math.sqrt(max(rest, 0.0))
    return along - half if rest > 0.0 and along + half > 1e-9 * radius else math.inf


@kernel(int64(VECTOR, VECTOR, VECTOR, float64, VECTOR))
def first_met(x: Vector, y: Vector, ray: Vector, radius: float, reach: Vector) -> int:
    """Return the point whose circle a ray meets first, by trying all; ``reach`` takes the ways."""
    points = x.size
    bx, by, nx, ny = ray[LOCUS_X], ray[LOCUS_Y], ray[LOCUS_NORMAL_X], ray[LOCUS_NORMAL_Y]
    for j in range(points):
        ax, ay = bx - x[j], by - y[j]
        across = ax * ny - ay * nx
        rest = radius * radius - across * across
        along, half = ax * nx + ay * ny, math.sqrt(max(rest, 0.0))
        met = rest > 0.0 and along + half > 1e-9 * radius
        reach[j] = along - half if met else math.inf
    best = 0
    for j in range(1, points):
        best = j if reach[j] < reach[best] else best
    return best


@kernel(int64(VECTOR, VECTOR, int64, VECTOR, float64))
def met_near(x: Vector, y: Vector, point: int, ray: Vector, radius: float) -> int:
    """Return the point that a ray meets first if that is found downhill from another, else -1.

    It is the first of all where no other is nearer than the radius to the way of the roller.
    """
    points, best = x.size, point
    least = distance_to(x, y, best, ray, radius)
    for direction in (-1, 1):
        while 0 <= best + direction < points:
            way = distance_to(x, y, best + direction, ray, radius)
            if not way < least:
                break
            best, least = best + direction, way
    if not 0.0 <= least < math.inf:
        return -1
    within, inside = _INSIDE * radius * radius, 0
    bx, by, nx, ny = ray[LOCUS_X], ray[LOCUS_Y], ray[LOCUS_NORMAL_X], ray[LOCUS_NORMAL_Y]
    for j in range(points):
        ax, ay = bx - x[j], by - y[j]
        across, along = ax * ny - ay * nx, ax * nx + ay * ny
        beyond = max(max(along - least, -along), 0.0)
        inside += 1 if across * across + beyond * beyond < within else 0
    return -1 if inside > 0 else best


@kernel(void(VECTOR, VECTOR, TABLE, float64, VECTOR, TABLE, VECTOR))
def roller_locus(
    x: Vector, y: Vector, base: Vector, radius: float, work: Vector, locus: Vector, touched: Vector
) -> None:
    """Move every node of a base line towards the outline until the roller touches it.

    ``base``: rows x, y and the unit direction out of the outline that the node moves
    against. The way to a point is that of the ray to the circle of the roller's radius
    around it; the outline between the points is met by the parabola through the three
    smallest ways. Circles that lie behind the node, those of the opposite side, do not
    count. ``locus`` takes x, y and the unit normal from the touched place to the
    centre, ``touched`` the number of that place in points; ``work`` is of the
    outline's size and 4 more. A ray that meets nothing leaves its node where it is.
    """
    points, nodes = x.size, base.shape[1]
    reach, ray, best = work[:points], work[points : points + 4], -1
    for k in range(nodes):
        for row in range(4):
            ray[row] = base[row, k]
        best = met_near(x, y, best, ray, radius) if best >= 0 else -1
        if best < 0:
            best = first_met(x, y, ray, radius, reach)
        least = distance_to(x, y, best, ray, radius)
        if least == math.inf:
            for row in range(4):
                locus[row, k] = ray[row]
            touched[k], best = -1.0, -1
            continue
        place = 0.0
        middle = min(max(best, 1), points - 2)
        before = distance_to(x, y, middle - 1, ray, radius)
        here = distance_to(x, y, middle, ray, radius)
        after = distance_to(x, y, middle + 1, ray, radius)
        bend = before - 2.0 * here + after
        if best == middle and 0.0 < bend < math.inf:
            place = 0.5 * (before - after) / bend
            least = here - 0.25 * (before - after) * place
        elif best != middle:
            place = float(best - middle)
        a, b, c = 0.5 * place * (place - 1.0), 1.0 - place * place, 0.5 * place * (place + 1.0)
        kx = a * x[middle - 1] + b * x[middle] + c * x[middle + 1]
        ky = a * y[middle - 1] + b * y[middle] + c * y[middle + 1]
        cx, cy = ray[LOCUS_X] - least * ray[LOCUS_NORMAL_X], ray[LOCUS_Y] - least * ray[LOCUS_NORMAL_Y]
        length = math.sqrt((cx - kx) * (cx - kx) + (cy - ky) * (cy - ky))
        locus[LOCUS_X, k], locus[LOCUS_Y, k] = cx, cy
        locus[LOCUS_NORMAL_X, k], locus[LOCUS_NORMAL_Y, k] = (cx - kx) / length, (cy - ky) / length
        touched[k] = middle + place
