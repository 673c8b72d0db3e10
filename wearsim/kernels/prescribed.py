"""Contact of a flank whose load and sliding are given along the arc."""

from __future__ import annotations

from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import CONTACT
from wearsim.kernels.flank_geometry import add_second_difference
from wearsim.kernels.offset import ARC, CURVATURE, LOAD, MATE_CURVATURE, NORMAL_X, NORMAL_Y, SLIP, SPEED

if TYPE_CHECKING:
    from wearsim.jit.signatures import Vector


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

    ``constants`` and ``columns``: as of the loop in offset form.

    Equation physics.md (A1).
    """
    flank_curvature = columns[CURVATURE]
    n = depth.size
    for j in range(n):
        load[j], slip[j], speed[j] = columns[LOAD, j], columns[SLIP, j], columns[SPEED, j]
    for j in range(n):
        normal_x[j], normal_y[j] = columns[NORMAL_X, j], columns[NORMAL_Y, j]
    for j in range(n):
        relative[j] = constants[MATE_CURVATURE] + flank_curvature[j]
    add_second_difference(columns[ARC], depth, relative)
