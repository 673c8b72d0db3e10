"""Contact of a flank whose load and sliding are given along the arc."""

from wearsim.kernels.compiled import kernel
from wearsim.kernels.signatures import CONTACT


@kernel(CONTACT)
def prescribed_contact(  # type: ignore[no-untyped-def]
    x, y, normal_x, normal_y, curvature, depth, constants, columns, load, slip, speed, relative
):
    """Write the given load, slip and speed, and the relative curvature of the worn flank.

    Offset form: the relative curvature is the given one plus the second difference of
    the depth over the given arc length; the two end rows keep the given curvature. The
    direction a point recedes in is its initial normal.

    ``constants``: one over the roller radius. ``columns``: arc length, load, slip,
    speed, flank curvature, normal_x, normal_y.
    """
    arc, flank_curvature = columns[0], columns[4]
    n = depth.size
    for j in range(n):
        load[j], slip[j], speed[j] = columns[1, j], columns[2, j], columns[3, j]
    for j in range(n):
        normal_x[j], normal_y[j] = columns[5, j], columns[6, j]
    for j in range(n):
        relative[j] = constants[0] + flank_curvature[j]
    for j in range(1, n - 1):
        before, after = arc[j] - arc[j - 1], arc[j + 1] - arc[j]
        rise, fall = (depth[j + 1] - depth[j]) / after, (depth[j] - depth[j - 1]) / before
        relative[j] += 2.0 * (rise - fall) / (before + after)
