"""Hertz pressure, depth per cycle and what forbids an update."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import CONTACT_FUNCTION, TABLE, VECTOR, float64, int64, void
from wearsim.kernels.flank_geometry import flank_frame
from wearsim.kernels.severity import (
    CASE_DEPTH,
    COEFFICIENT,
    CORE_FACTOR,
    KIND,
    LOAD_EXPONENT,
    NONE,
    PRESSURE_EXPONENT,
    SPEED_EXPONENT,
    make_severe,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from wearsim.jit.signatures import Vector

X, Y, DEPTH, RATE, PATH_NORMAL_X, PATH_NORMAL_Y, PATH_RELATIVE, PATH_CURVATURE = range(8)
"""Rows of a state: points and depth, and on the path also what the contact made of them."""

NORMAL_X, NORMAL_Y, CURVATURE, SPACING_SQUARED, LOAD, SLIP, SPEED, RELATIVE, WORN = range(9)
"""Rows of the table to work in: frame of the flank, contact, and the depth worn off in a cycle."""

RUNNING, DEPTH_REACHED, UNSTABLE, CONFORMING, VANISHED, BROKEN, HORIZON, SAWTOOTH = range(8)


@kernel(void(VECTOR, VECTOR, VECTOR, VECTOR, float64, VECTOR, VECTOR))
def wear_depth(
    load: Vector, slip: Vector, speed: Vector, relative: Vector, modulus: float, law: Vector, depth: Vector
) -> None:
    """Write the depth worn off in one cycle at every point.

    depth = coefficient pressure^a load^b slip speed^n, b 0 or 1, zero where the load is zero; what makes wear
    severe follows. The Hertz pressure, a root, is found in the place of the depth, and only where the law
    asks for it.

    Equations physics.md (C2) and (L1) or (L3).
    """
    n, factor, exponent = load.size, law[COEFFICIENT], law[PRESSURE_EXPONENT]
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
    if law[SPEED_EXPONENT] != 0.0:
        for j in range(n):
            depth[j] *= speed[j] ** law[SPEED_EXPONENT] if speed[j] > 0.0 else 0.0
    if law[LOAD_EXPONENT] != 0.0:
        for j in range(n):
            depth[j] = depth[j] * load[j] * slip[j] if load[j] > 0.0 else 0.0
    else:
        for j in range(n):
            depth[j] = depth[j] * slip[j] if load[j] > 0.0 else 0.0
    if law[KIND] != NONE:
        make_severe(load, slip, speed, relative, modulus, law, depth)


@kernel(void(VECTOR, VECTOR, VECTOR))
def soften_edges(depth: Vector, law: Vector, step: Vector) -> None:
    """Multiply the steps of points below the hardened layer by the factor of the core."""
    if law[CORE_FACTOR] != 1.0:
        for j in range(depth.size):
            step[j] *= law[CORE_FACTOR] if depth[j] > law[CASE_DEPTH] else 1.0


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
    """
    flank_frame(state[X], state[Y], work[NORMAL_X], work[NORMAL_Y], work[CURVATURE], work[SPACING_SQUARED])
    contact(
        state[X],
        state[Y],
        work[NORMAL_X],
        work[NORMAL_Y],
        work[CURVATURE],
        state[DEPTH],
        constants,
        columns,
        work[LOAD],
        work[SLIP],
        work[SPEED],
        work[RELATIVE],
    )
    wear_depth(work[LOAD], work[SLIP], work[SPEED], work[RELATIVE], modulus, law, work[WORN])
    soften_edges(layer, law, work[WORN])
    return update_status(work[LOAD], work[RELATIVE], work[WORN], work[SPACING_SQUARED], 0.0)


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
