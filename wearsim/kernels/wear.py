"""Hertz pressure, depth per cycle and the loop over loading cycles."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.kernels.compiled import kernel
from wearsim.kernels.flank import flank_frame
from wearsim.kernels.signatures import CONTACT_FUNCTION, TABLE, VECTOR, float64, int64, void

if TYPE_CHECKING:
    from collections.abc import Callable

    from wearsim.kernels.signatures import Vector

RUNNING, DEPTH_REACHED, UNSTABLE, CONFORMING, VANISHED = 0, 1, 2, 3, 4


@kernel(void(VECTOR, VECTOR, VECTOR, VECTOR, float64, VECTOR, VECTOR, VECTOR))
def wear_depth(
    load: Vector,
    slip: Vector,
    speed: Vector,
    relative: Vector,
    modulus: float,
    law: Vector,
    pressure: Vector,
    depth: Vector,
) -> None:
    """Write the Hertz pressure and the depth worn off in one cycle at every point.

    ``law``: factor, pressure exponent, load exponent (0 or 1), speed exponent:
    depth = factor pressure^a load^b slip speed^n, zero where the load is zero.
    """
    n, factor, exponent = load.size, law[0], law[1]
    for j in range(n):
        pressure[j] = math.sqrt(load[j] * relative[j] * (modulus / math.pi))
    if exponent == 0.0:
        for j in range(n):
            depth[j] = factor
    elif exponent == 0.5:
        for j in range(n):
            depth[j] = math.sqrt(pressure[j]) * factor
    elif exponent == 1.0:
        for j in range(n):
            depth[j] = pressure[j] * factor
    else:
        for j in range(n):
            depth[j] = pressure[j] ** exponent * factor
    if law[3] != 0.0:
        for j in range(n):
            depth[j] *= speed[j] ** law[3] if speed[j] > 0.0 else 0.0
    if law[2] != 0.0:
        for j in range(n):
            depth[j] = depth[j] * load[j] * slip[j] if load[j] > 0.0 else 0.0
    else:
        for j in range(n):
            depth[j] = depth[j] * slip[j] if load[j] > 0.0 else 0.0


@kernel(void(VECTOR, VECTOR, VECTOR))
def soften(depth: Vector, law: Vector, step: Vector) -> None:
    """Multiply the steps of points below the hardened layer, ``law[4]`` deep, by ``law[5]``."""
    if law[5] != 1.0:
        for j in range(depth.size):
            step[j] *= law[5] if depth[j] > law[4] else 1.0


@kernel(int64(VECTOR, VECTOR, VECTOR, VECTOR, float64))
def update_status(
    load: Vector, relative: Vector, step: Vector, spacing_squared: Vector, diffusion: float
) -> int:
    """Tell whether an update may be made: RUNNING, or what forbids it.

    CONFORMING where Hertz fails at a loaded point (or its curvature is not a number) or
    the load is not a pressing one,
    VANISHED where nothing is worn off, UNSTABLE where a point recedes by more than
    spacing^2 relative / (2 diffusion) at once.
    """
    conforming, worn, unstable = 0, 0, 0
    for j in range(load.size):
        conforming += 1 if not load[j] >= 0.0 or (load[j] > 0.0 and not relative[j] > 0.0) else 0
        worn += 1 if step[j] > 0.0 else 0
        limit = spacing_squared[j] * relative[j]
        unstable += 1 if diffusion > 0.0 and 2.0 * diffusion * step[j] > limit else 0
    if conforming > 0:
        return CONFORMING
    if worn == 0:
        return VANISHED
    return UNSTABLE if unstable > 0 else RUNNING


@kernel(
    int64(
        CONTACT_FUNCTION, VECTOR, VECTOR, VECTOR, VECTOR, TABLE, TABLE,
        float64, VECTOR, float64, float64, float64, int64, VECTOR,
    )
)  # fmt: skip
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
    """Wear the flank update by update, equations (10) to (12), in place.

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
        contact(x, y, normal_x, normal_y, curvature, depth, constants, columns,
                load, slip, speed, relative)  # fmt: skip
        wear_depth(load, slip, speed, relative, modulus, law, pressure, step)
        soften(depth, law, step)
        if cycles_per_update != 1.0:
            for j in range(n):
                step[j] *= cycles_per_update
        status = update_status(load, relative, step, spacing_squared, diffusion)
        if status != RUNNING:
            return status
        for j in range(n):
            x[j] -= step[j] * normal_x[j]
            y[j] -= step[j] * normal_y[j]
        reached = 0
        for j in range(n):
            depth[j] += step[j]
            reached += 1 if depth[j] >= critical_depth else 0
        done[0] = update + 1
        if reached > 0:
            return DEPTH_REACHED
    return RUNNING
