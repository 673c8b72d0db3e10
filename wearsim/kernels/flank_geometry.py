"""Normals and curvature of a flank given by its points."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import VECTOR, int64, void

if TYPE_CHECKING:
    from wearsim.jit.signatures import Vector


@kernel(void(VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, int64, int64), quick=True)
def _end_frame(
    x: Vector,
    y: Vector,
    normal_x: Vector,
    normal_y: Vector,
    curvature: Vector,
    spacing_squared: Vector,
    end: int,
    inward: int,
) -> None:
    """Write the frame of an end point from the parabola through the three end points."""
    ax, ay = x[end + inward] - x[end], y[end + inward] - y[end]
    bx, by = x[end + 2 * inward] - x[end + inward], y[end + 2 * inward] - y[end + inward]
    a, b = math.sqrt(ax * ax + ay * ay), math.sqrt(bx * bx + by * by)
    second_x, second_y = 2.0 * (bx / b - ax / a) / (a + b), 2.0 * (by / b - ay / a) / (a + b)
    tangent_x, tangent_y = ax / a - 0.5 * a * second_x, ay / a - 0.5 * a * second_y
    length = math.sqrt(tangent_x * tangent_x + tangent_y * tangent_y)
    turn = (tangent_x * second_y - tangent_y * second_x) / (length * length * length)
    curvature[end] = inward * turn
    normal_x[end] = inward * tangent_y / length
    normal_y[end] = -inward * tangent_x / length
    spacing_squared[end] = a * a


@kernel(void(VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, VECTOR), quick=True)
def flank_frame(
    x: Vector, y: Vector, normal_x: Vector, normal_y: Vector, curvature: Vector, spacing_squared: Vector
) -> None:
    """Write normal, signed curvature and squared spacing at every point.

    An inner point takes them from the circle through it and its neighbours, an end
    point from the parabola through the three end points. With a and b the chords to
    and from the point, the tangent ``a b.b + b a.a`` has the length |a| |b| |a+b|, so
    one square root serves both. Points run from root to tip, the normal points to the
    right of that (into the gap), and a convex flank has positive curvature.
    """
    n = x.size
    for j in range(1, n - 1):
        ax, ay = x[j] - x[j - 1], y[j] - y[j - 1]
        bx, by = x[j + 1] - x[j], y[j + 1] - y[j]
        aa, bb = ax * ax + ay * ay, bx * bx + by * by
        cx, cy = ax + bx, ay + by
        spacing_squared[j] = min(aa, bb)
        curvature[j] = 1.0 / math.sqrt(aa * bb * (cx * cx + cy * cy))
    for j in range(1, n - 1):
        ax, ay = x[j] - x[j - 1], y[j] - y[j - 1]
        bx, by = x[j + 1] - x[j], y[j + 1] - y[j]
        aa, bb = ax * ax + ay * ay, bx * bx + by * by
        normal_x[j] = (ay * bb + by * aa) * curvature[j]
        normal_y[j] = -(ax * bb + bx * aa) * curvature[j]
    for j in range(1, n - 1):
        ax, ay = x[j] - x[j - 1], y[j] - y[j - 1]
        bx, by = x[j + 1] - x[j], y[j + 1] - y[j]
        curvature[j] = 2.0 * (ax * by - ay * bx) * curvature[j]
    _end_frame(x, y, normal_x, normal_y, curvature, spacing_squared, 0, 1)
    _end_frame(x, y, normal_x, normal_y, curvature, spacing_squared, n - 1, -1)


@kernel(void(VECTOR, VECTOR, VECTOR))
def add_second_difference(arc: Vector, depth: Vector, curvature: Vector) -> None:
    """Add that of the depth over the arc at every inner point; both end points keep their curvature.

    Equation physics.md (A1), its last term.
    """
    for j in range(1, depth.size - 1):
        before, after = arc[j] - arc[j - 1], arc[j + 1] - arc[j]
        rise, fall = (depth[j + 1] - depth[j]) / after, (depth[j] - depth[j - 1]) / before
        curvature[j] += 2.0 * (rise - fall) / (before + after)
