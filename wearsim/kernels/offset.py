"""The loop over loading cycles of a flank in offset form: one depth per point is all that changes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import TABLE, VECTOR, float64, int64, void
from wearsim.kernels.hertz_wear import (
    DEPTH_REACHED,
    RELATIVE,
    RUNNING,
    SPACING_SQUARED,
    WORN,
    soften_edges,
    update_status,
)
from wearsim.kernels.hertz_wear import NORMAL_X as WORK_NORMAL_X
from wearsim.kernels.hertz_wear import NORMAL_Y as WORK_NORMAL_Y
from wearsim.kernels.severity import (
    COEFFICIENT,
    KIND,
    LOAD_EXPONENT,
    NONE,
    PRESSURE_EXPONENT,
    SPEED_EXPONENT,
    make_severe,
)

if TYPE_CHECKING:
    from wearsim.jit.signatures import Vector

ARC, LOAD, SLIP, SPEED, CURVATURE, NORMAL_X, NORMAL_Y = range(7)
"""Rows of the columns of a flank in offset form."""

MATE_CURVATURE = 0
"""Place of the only constant of such a flank: one over the radius of the mate."""

OFFSET_ROWS = 16
"""Of the table to work in; those of ``run_cycles`` and the weights of the second difference and
what does not change of a step."""

BEFORE, AFTER, BASE, STRESS, AMOUNT, ALLOWED, START = range(9, 16)


@kernel(void(VECTOR, VECTOR, TABLE, float64, VECTOR, float64, float64, TABLE))
def prepare_offset(
    depth: Vector,
    constants: Vector,
    columns: Vector,
    modulus: float,
    law: Vector,
    diffusion: float,
    cycles_per_update: float,
    work: Vector,
) -> None:
    """Write what no update changes: normals, spacing and the rows named here."""
    arc, n = columns[ARC], columns.shape[1]
    for j in range(n):
        work[START, j] = depth[j]
        work[WORK_NORMAL_X, j], work[WORK_NORMAL_Y, j] = columns[NORMAL_X, j], columns[NORMAL_Y, j]
        work[BASE, j] = constants[MATE_CURVATURE] + columns[CURVATURE, j]
        work[STRESS, j] = columns[LOAD, j] * (modulus / math.pi)
        before = arc[max(j, 1)] - arc[max(j, 1) - 1]
        after = arc[min(j, n - 2) + 1] - arc[min(j, n - 2)]
        inner = 2.0 / (before + after) if 0 < j < n - 1 else 0.0
        work[BEFORE, j], work[AFTER, j] = inner / before, inner / after
        work[SPACING_SQUARED, j] = min(before, after) ** 2
        limit = work[SPACING_SQUARED, j] / (2.0 * diffusion) if diffusion > 0.0 else math.inf
        work[ALLOWED, j] = limit if columns[LOAD, j] > 0.0 else 0.0
        amount = law[COEFFICIENT] * cycles_per_update * columns[SLIP, j]
        if law[SPEED_EXPONENT] != 0.0:
            amount *= columns[SPEED, j] ** law[SPEED_EXPONENT] if columns[SPEED, j] > 0.0 else 0.0
        if law[LOAD_EXPONENT] != 0.0:
            amount *= columns[LOAD, j]
        work[AMOUNT, j] = amount if columns[LOAD, j] > 0.0 else 0.0


@kernel(void(VECTOR, float64, TABLE))
def offset_step(depth: Vector, exponent: float, work: Vector) -> None:
    """Write relative curvature and depth of an update."""
    before, after, base = work[BEFORE], work[AFTER], work[BASE]
    stress, amount, relative, step = work[STRESS], work[AMOUNT], work[RELATIVE], work[WORN]
    n = depth.size
    relative[0], relative[n - 1] = base[0], base[n - 1]
    for j in range(1, n - 1):
        rise, fall = depth[j + 1] - depth[j], depth[j] - depth[j - 1]
        relative[j] = base[j] + (after[j] * rise - before[j] * fall)
    if exponent == 0.0:
        for j in range(n):
            step[j] = amount[j]
    elif exponent == 1.0:
        for j in range(n):
            step[j] = math.sqrt(stress[j] * relative[j]) * amount[j]
    else:
        for j in range(n):
            step[j] = (stress[j] * relative[j]) ** (0.5 * exponent) * amount[j]


@kernel(int64(TABLE))
def offset_failures(work: Vector) -> int:
    """Count the points at which an update may not be made, or is none at all."""
    relative, step, allowed = work[RELATIVE], work[WORN], work[ALLOWED]
    failures = 0
    for j in range(work.shape[1]):
        failures += 0 if step[j] <= allowed[j] * relative[j] else 1
    return failures


@kernel(
    int64(
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
def run_offset_cycles(
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

    As ``run_cycles`` under ``prescribed_contact``, but that neither frame nor points are
    formed in between, and that the spacing of the stability limit is that of the arc.
    ``work``: `OFFSET_ROWS` rows.
    """
    prepare_offset(depth, constants, columns, modulus, law, diffusion, cycles_per_update, work)
    step, n, made = work[WORN], depth.size, 0
    severe = law[KIND] != NONE
    offset_step(depth, law[PRESSURE_EXPONENT], work)
    if severe:
        make_severe(columns[LOAD], columns[SLIP], columns[SPEED], work[RELATIVE], modulus, law, step)
    soften_edges(depth, law, step)
    status = update_status(columns[LOAD], work[RELATIVE], step, work[SPACING_SQUARED], diffusion)
    while status == RUNNING and made < updates:
        made += 1
        reached = 0
        for j in range(n):
            depth[j] += step[j]  # (11)
            reached += 1 if depth[j] >= critical_depth else 0  # (12)
        if reached > 0:
            status = DEPTH_REACHED
        elif made < updates:
            offset_step(depth, law[PRESSURE_EXPONENT], work)
            if severe:
                make_severe(columns[LOAD], columns[SLIP], columns[SPEED], work[RELATIVE], modulus, law, step)
            soften_edges(depth, law, step)
            if offset_failures(work) > 0:
                status = update_status(columns[LOAD], work[RELATIVE], step, work[SPACING_SQUARED], diffusion)
    for j in range(n):  # (10), summed: the normal is that of the new flank
        x[j] -= (depth[j] - work[START, j]) * work[WORK_NORMAL_X, j]
        y[j] -= (depth[j] - work[START, j]) * work[WORK_NORMAL_Y, j]
    done[0] = made
    return status
