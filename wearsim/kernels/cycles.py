"""The loop over loading cycles: physics.md (10) to (12) as the source prints them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from wearsim.kernels.compiled import kernel
from wearsim.kernels.flank_geometry import flank_frame
from wearsim.kernels.hertz_wear import DEPTH_REACHED, RUNNING, soften, update_status, wear_depth
from wearsim.kernels.signatures import CONTACT_FUNCTION, TABLE, VECTOR, float64, int64

if TYPE_CHECKING:
    from collections.abc import Callable

    from wearsim.kernels.signatures import Vector


CYCLES_ROWS = 10
"""Of the table to work in."""


@kernel(
    int64(
        CONTACT_FUNCTION,
        VECTOR,
        VECTOR,
        VECTOR,
        VECTOR,
        TABLE,
        TABLE,
        float64,
        VECTOR,
        float64,
        float64,
        float64,
        int64,
        VECTOR,
    )
)
def run_cycles(
    contact: Callable[..., None],
    x: Vector,
    y: Vector,
    depth: Vector,
    constants: Vector,
    columns: Vector,
    work: Vector,
    modulus: float,
    law: Vector,
    diffusion: float,
    cycles_per_update: float,
    critical_depth: float,
    updates: int,
    done: Vector,
) -> int:
    """Wear the flank update by update, physics.md (10) to (12), in place.

    Every update recomputes normals, curvature, load, sliding and Hertz pressure on the
    worn points and moves each along its normal. It stops before an update that the
    stability limit forbids or that Hertz cannot describe, and after the update that
    reaches the critical depth. ``done[0]`` counts the updates made; ``work`` holds
    normals, curvature, squared spacing, load, slip, speed, relative curvature,
    pressure and the depth of the last update.
    """
    normal_x, normal_y, curvature, spacing_squared = work[0], work[1], work[2], work[3]
    load, slip, speed, relative = work[4], work[5], work[6], work[7]
    pressure, step = work[8], work[9]
    n = x.size
    done[0] = 0.0
    for update in range(updates):
        flank_frame(x, y, normal_x, normal_y, curvature, spacing_squared)
        contact(x, y, normal_x, normal_y, curvature, depth, constants, columns, load, slip, speed, relative)
        wear_depth(load, slip, speed, relative, modulus, law, pressure, step)
        soften(depth, law, step)
        if cycles_per_update != 1.0:
            for j in range(n):
                step[j] *= cycles_per_update
        status = update_status(load, relative, step, spacing_squared, diffusion)
        if status != RUNNING:
            return status
        for j in range(n):  # (10): alpha - psi is the direction of the normal
            x[j] -= step[j] * normal_x[j]
            y[j] -= step[j] * normal_y[j]
        reached = 0
        for j in range(n):
            depth[j] += step[j]  # (11)
            reached += 1 if depth[j] >= critical_depth else 0  # (12)
        done[0] = update + 1
        if reached > 0:
            return DEPTH_REACHED
    return RUNNING
