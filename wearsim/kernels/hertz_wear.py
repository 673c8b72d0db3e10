"""Hertz pressure, depth per cycle and what forbids an update."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.kernels.compiled import kernel
from wearsim.kernels.flank_geometry import flank_frame
from wearsim.kernels.severity import KIND, NONE, make_severe
from wearsim.kernels.signatures import CONTACT_FUNCTION, TABLE, VECTOR, float64, int64, void

if TYPE_CHECKING:
    from collections.abc import Callable

    from wearsim.kernels.signatures import Vector

RUNNING, DEPTH_REACHED, UNSTABLE, CONFORMING, VANISHED, BROKEN, HORIZON, SAWTOOTH = range(8)


@kernel(void(VECTOR, VECTOR, VECTOR, VECTOR, float64, VECTOR, VECTOR))
def wear_depth(
    load: Vector, slip: Vector, speed: Vector, relative: Vector, modulus: float, law: Vector, depth: Vector
) -> None:
    """Write the depth worn off in one cycle at every point.

    ``law``: factor, pressure exponent, load exponent (0 or 1), speed exponent:
    depth = factor pressure^a load^b slip speed^n, zero where the load is zero. The Hertz pressure,
    a root, is found in the place of the depth, and only where the law asks for it. What makes wear severe
    follows: its kind, limit and factor.

    Equations physics.md (C2) and (L1) or (L3).
    """
    n, factor, exponent = load.size, law[0], law[1]
    if exponent == 0.0:
        for j in range(n):
            depth[j] = factor
    else:
        for j in range(n):
            depth[j] = math.sqrt(load[j] * relative[j] * (modulus / math.pi))
    if exponent == 0.5:
        for j in range(n):
            depth[j] = math.sqrt(depth[j]) * factor
    elif exponent == 1.0:
        for j in range(n):
            depth[j] *= factor
    elif exponent != 0.0:
        for j in range(n):
            depth[j] = depth[j] ** exponent * factor
    if law[3] != 0.0:
        for j in range(n):
            depth[j] *= speed[j] ** law[3] if speed[j] > 0.0 else 0.0
    if law[2] != 0.0:
        for j in range(n):
            depth[j] = depth[j] * load[j] * slip[j] if load[j] > 0.0 else 0.0
    else:
        for j in range(n):
            depth[j] = depth[j] * slip[j] if load[j] > 0.0 else 0.0
    if law[KIND] != NONE:
        make_severe(load, slip, speed, relative, modulus, law, depth)


@kernel(void(VECTOR, VECTOR, VECTOR))
def soften_edges(depth: Vector, law: Vector, step: Vector) -> None:
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
    the load is not a pressing one, BROKEN where a depth is not a number or infinite,
    VANISHED where nothing is worn off, UNSTABLE where a point recedes by more than
    spacing^2 relative / (2 diffusion) at once.

    Equation physics.md (A3).
    """
    conforming, broken, worn, unstable = 0, 0, 0, 0
    for j in range(load.size):
        conforming += 1 if not load[j] >= 0.0 or (load[j] > 0.0 and not relative[j] > 0.0) else 0
        broken += 0 if step[j] < math.inf else 1
        worn += 1 if step[j] > 0.0 else 0
        limit = spacing_squared[j] * relative[j]
        unstable += 1 if diffusion > 0.0 and 2.0 * diffusion * step[j] > limit else 0
    if conforming > 0:
        return CONFORMING
    if broken > 0:
        return BROKEN
    if worn == 0:
        return VANISHED
    return UNSTABLE if unstable > 0 else RUNNING


@kernel(int64(CONTACT_FUNCTION, TABLE, VECTOR, VECTOR, TABLE, float64, VECTOR, TABLE))
def flank_rate(
    contact: Callable[..., None],
    state: Vector,
    layer: Vector,
    constants: Vector,
    columns: Vector,
    modulus: float,
    law: Vector,
    work: Vector,
) -> int:
    """Write the depth that each point of a state (x, y, depth) loses in a cycle; tell its status.

    ``layer``: the depths that tell whether a point is below the hardened layer.
    ``work``, 9 rows: normals, curvature, squared spacing, load, slip, speed, relative
    curvature, depth per cycle.
    """
    flank_frame(state[0], state[1], work[0], work[1], work[2], work[3])
    contact(
        state[0],
        state[1],
        work[0],
        work[1],
        work[2],
        state[2],
        constants,
        columns,
        work[4],
        work[5],
        work[6],
        work[7],
    )
    wear_depth(work[4], work[5], work[6], work[7], modulus, law, work[8])
    soften_edges(layer, law, work[8])
    return update_status(work[4], work[7], work[8], work[3], 0.0)


@kernel(int64(VECTOR, float64))
def sawtooth(depth: Vector, depth_limit: float) -> int:
    """Return the point where the depth alternates from one to the next; -1 where nowhere.

    There the short second differences of five neighbours come to four times the long ones
    and 1e-3 of the depth that is allowed.
    """
    least, greatest = 1e-3 * depth_limit, 0.0
    for j in range(2, depth.size - 2):
        short = abs(depth[j - 1] - 2.0 * depth[j] + depth[j + 1])
        greatest = max(greatest, short - abs(depth[j - 2] - 2.0 * depth[j] + depth[j + 2]))
    if 5.0 * greatest <= least:
        return -1
    for j in range(4, depth.size - 4):
        excess = 0.0
        for k in range(j - 2, j + 3):
            excess += abs(depth[k - 1] - 2.0 * depth[k] + depth[k + 1])
            excess -= abs(depth[k - 2] - 2.0 * depth[k] + depth[k + 2])
        if excess > least:
            return j
    return -1
