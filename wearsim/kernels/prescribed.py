"""Contact of a flank whose load and sliding are given along the arc."""

from __future__ import annotations

from typing import TYPE_CHECKING

from wearsim.kernels.compiled import kernel
from wearsim.kernels.flank_geometry import add_second_difference
from wearsim.kernels.signatures import CONTACT

if TYPE_CHECKING:
    from wearsim.kernels.signatures import Vector


@kernel(CONTACT)
def prescribed_contact(
    x: Vector,
    y: Vector,
    normal_x: Vector,
    normal_y: Vector,
    curvature: Vector,
    depth: Vector,
    constants: Vector,
    columns: Vector,
    load: Vector,
    slip: Vector,
    speed: Vector,
    relative: Vector,
) -> None:
    """Write the given load, slip and speed, and the relative curvature of the worn flank.

    Offset form: the relative curvature is the given one plus the second difference of
    the depth over the given arc length; the two end rows keep the given curvature. The
    direction a point recedes in is its initial normal.

    ``constants``: one over the roller radius. ``columns``: arc length, load, slip,
    speed, flank curvature, normal_x, normal_y.

    Equation physics.md (A1).
    """
    flank_curvature = columns[4]
    n = depth.size
    for j in range(n):
        load[j], slip[j], speed[j] = columns[1, j], columns[2, j], columns[3, j]
    for j in range(n):
        normal_x[j], normal_y[j] = columns[5, j], columns[6, j]
    for j in range(n):
        relative[j] = constants[0] + flank_curvature[j]
    add_second_difference(columns[0], depth, relative)
