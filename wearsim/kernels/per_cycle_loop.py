"""The loop over loading cycles: equations (10) to (12) of the source, and the file to read first."""

from __future__ import annotations

from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import CONTACT_FUNCTION, TABLE, VECTOR, float64, int64
from wearsim.kernels.flank_geometry import flank_frame
from wearsim.kernels.hertz_wear import (
    CURVATURE,
    DEPTH_REACHED,
    LOAD,
    NORMAL_X,
    NORMAL_Y,
    RELATIVE,
    RUNNING,
    SLIP,
    SPACING_SQUARED,
    SPEED,
    WORN,
    soften_edges,
    update_status,
    wear_depth,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from wearsim.jit.signatures import Vector


CYCLES_ROWS = 9
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
    """Wear the flank update by update in place: physics.md (10) to (12), the source's, as they stand.

    Every update recomputes normals, curvature, load, sliding and, where the law asks for it, the
    Hertz pressure on the worn points and moves each along its normal. It stops before an update that the
    stability limit forbids or that Hertz cannot describe, and after the update that
    reaches the critical depth. ``done[0]`` counts the updates made; ``work`` holds
    normals, curvature, squared spacing, load, slip, speed, relative curvature
    and the depth of the last update.
    """
    normal_x, normal_y, curvature = work[NORMAL_X], work[NORMAL_Y], work[CURVATURE]
    spacing_squared = work[SPACING_SQUARED]
    load, slip, speed, relative = work[LOAD], work[SLIP], work[SPEED], work[RELATIVE]
    step, n = work[WORN], x.size
    done[0] = 0.0
    for update in range(updates):
        flank_frame(x, y, normal_x, normal_y, curvature, spacing_squared)
        contact(x, y, normal_x, normal_y, curvature, depth, constants, columns, load, slip, speed, relative)
        wear_depth(load, slip, speed, relative, modulus, law, step)
        soften_edges(depth, law, step)
        if cycles_per_update != 1.0:
            for j in range(n):
                step[j] *= cycles_per_update
        status = update_status(load, relative, step, spacing_squared, diffusion)
        if status != RUNNING:
            return status
        # Equation (10) of the source: every point goes down its normal by the depth of the cycle.
        for j in range(n):
            x[j] -= step[j] * normal_x[j]
            y[j] -= step[j] * normal_y[j]
        # Equations (11) and (12) of the source: the sum of all cycles, until a point has the critical depth.
        reached = 0
        for j in range(n):
            depth[j] += step[j]
            reached += 1 if depth[j] >= critical_depth else 0
        done[0] = update + 1
        if reached > 0:
            return DEPTH_REACHED
    return RUNNING
