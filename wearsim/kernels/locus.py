"""Where the centre of a roller can be in a worn gap."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.kernels.compiled import kernel
from wearsim.kernels.signatures import TABLE, VECTOR, float64, void

if TYPE_CHECKING:
    from wearsim.kernels.signatures import Vector


@kernel(void(VECTOR, VECTOR, TABLE, float64, VECTOR, TABLE, VECTOR))
def roller_locus(
    x: Vector,
    y: Vector,
    base: Vector,
    radius: float,
    reach: Vector,
    locus: Vector,
    touched: Vector,
) -> None:
    """Move every node of a base line towards the outline until the roller touches it.

    ``base``: rows x, y and the unit direction out of the outline that the node moves
    against. The way to point j is that of the ray to the circle of the roller's radius
    around it; the outline between the points is met by the parabola through the three
    smallest ways. Circles that lie behind the node, those of the opposite side, do not
    count. ``locus`` takes x, y and the unit normal from the touched place to the
    centre, ``touched`` the number of that place in points; ``reach`` is work of the
    outline's size. A ray that meets nothing leaves its node where it is.
    """
    points, nodes = x.size, base.shape[1]
    for k in range(nodes):
        bx, by, nx, ny = base[0, k], base[1, k], base[2, k], base[3, k]
        for j in range(points):
            ax, ay = bx - x[j], by - y[j]
            across = ax * ny - ay * nx
            rest = radius * radius - across * across
            along, half = ax * nx + ay * ny, math.sqrt(max(rest, 0.0))
            met = rest > 0.0 and along + half > 1e-9 * radius
            reach[j] = along - half if met else math.inf
        # Four at a time: a minimum waits for the one before it.
        least, least_1, least_2, least_3 = math.inf, math.inf, math.inf, math.inf
        for j in range(0, points - 3, 4):
            least, least_1 = min(least, reach[j]), min(least_1, reach[j + 1])
            least_2, least_3 = min(least_2, reach[j + 2]), min(least_3, reach[j + 3])
        for j in range(points - points % 4, points):
            least = min(least, reach[j])
        least = min(min(least, least_1), min(least_2, least_3))
        best = 0
        while reach[best] != least:
            best += 1
        if least == math.inf:
            locus[0, k], locus[1, k], locus[2, k], locus[3, k] = bx, by, nx, ny
            touched[k] = -1.0
            continue
        place = 0.0
        middle = min(max(best, 1), points - 2)
        before, here, after = reach[middle - 1], reach[middle], reach[middle + 1]
        bend = before - 2.0 * here + after
        if best == middle and 0.0 < bend < math.inf:
            place = 0.5 * (before - after) / bend
            least = here - 0.25 * (before - after) * place
        elif best != middle:
            place = float(best - middle)
        a, b, c = 0.5 * place * (place - 1.0), 1.0 - place * place, 0.5 * place * (place + 1.0)
        kx = a * x[middle - 1] + b * x[middle] + c * x[middle + 1]
        ky = a * y[middle - 1] + b * y[middle] + c * y[middle + 1]
        cx, cy = bx - least * nx, by - least * ny
        length = math.sqrt((cx - kx) * (cx - kx) + (cy - ky) * (cy - ky))
        locus[0, k], locus[1, k] = cx, cy
        locus[2, k], locus[3, k] = (cx - kx) / length, (cy - ky) / length
        touched[k] = middle + place
