"""The curvature that a depth adds to a flank given along its arc."""

from __future__ import annotations

from typing import TYPE_CHECKING

from wearsim.kernels.compiled import kernel
from wearsim.kernels.signatures import VECTOR, void

if TYPE_CHECKING:
    from wearsim.kernels.signatures import Vector


@kernel(void(VECTOR, VECTOR, VECTOR))
def add_second_difference(arc: Vector, depth: Vector, curvature: Vector) -> None:
    """Add that of the depth over the arc at every inner point; both end points keep their curvature.

    Equation physics.md (A1), its last term.
    """
    for j in range(1, depth.size - 1):
        before, after = arc[j] - arc[j - 1], arc[j + 1] - arc[j]
        rise, fall = (depth[j + 1] - depth[j]) / after, (depth[j] - depth[j - 1]) / before
        curvature[j] += 2.0 * (rise - fall) / (before + after)
