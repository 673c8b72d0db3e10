"""The wear of a flank in long steps: a linearly implicit method with step control.

ROS34PW2 of Rang and Angermann, BIT 45 (2005) 761: four stages, order 3, embedded order 2,
stiffly accurate, and of full order with any matrix in place of the Jacobian (a W-method).
That matrix is here what makes the problem stiff, tridiagonal: the diffusion of depth by the
curvature, d(rate)/d(1/rho_H) = e rate rho_H times the second difference of the depth, and what the
rate follows of the slope, as the load does where it is shared or leans, times the first.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import CONTACT_FUNCTION, STEP, TABLE, VECTOR, float64, int64, void
from wearsim.kernels.hertz_wear import (
    BROKEN,
    CONFORMING,
    CURVATURE,
    DEPTH,
    LOAD,
    NORMAL_X,
    NORMAL_Y,
    PATH_CURVATURE,
    PATH_NORMAL_X,
    PATH_NORMAL_Y,
    PATH_RELATIVE,
    RATE,
    RELATIVE,
    SLIP,
    SPEED,
    WORN,
    X,
    Y,
    flank_rate,
    soften_edges,
    wear_depth,
)
from wearsim.kernels.tridiagonal import factorise, solve

if TYPE_CHECKING:
    from collections.abc import Callable

    from wearsim.jit.signatures import Vector

SLOPE, WORK_ROWS = 9, 18
"""Row of d(rate)/d(slope) in the table to work in, after those of ``flank_rate``, and the number of rows."""

GAMMA = 4.3586652150845900e-01
"""Diagonal of the method, the root of x^3 - 3 x^2 + 3 x/2 - 1/6 that makes it L-stable."""

TURN = 1e-6
"""Angle by which the normals are turned for d(rate)/d(slope) [rad]."""

MAX_RATIO = 1e3
"""Of the third entry of an end row to that of the row beside it, which eliminates it."""

STAGES = 4

STATE = (
    0.0,
    0.0,
    0.0,
    2.0,
    0.0,
    0.0,
    1.4192173174557645,
    -0.2592322116729697,
    0.0,
    4.18476048231916,
    -0.28519201735549593,
    2.294280360279042,
)
RIGHT = (
    0.0,
    0.0,
    0.0,
    -4.588560720558084,
    0.0,
    0.0,
    -4.18476048231916,
    0.28519201735549593,
    0.0,
    -6.368179200128357,
    -6.795620944466836,
    2.870098604331056,
)
ERROR = (0.27774994764796823, -1.403239895175999, 1.772630127667551, 0.5)

"""Rows of the stages in the increments u = Gamma k, which spares products with the matrix.

A stage stands at y + STATE u and solves (I - gamma h A) u = gamma (h f + RIGHT u); the result is
the last stage plus its increment, the error of it ERROR u."""


@kernel(void(CONTACT_FUNCTION, TABLE, VECTOR, TABLE, float64, VECTOR, TABLE))
def slope_rate(
    contact: Callable[..., None],
    start: Vector,
    constants: Vector,
    columns: Vector,
    modulus: float,
    law: Vector,
    work: Vector,
) -> None:
    """Write d(rate)/d(slope of the depth) of every point to ``work[SLOPE]``: the normals turn by the slope.

    The contact is asked with all normals of a state of the path turned towards the tip.
    """
    n = start.shape[1]
    for j in range(n):
        work[NORMAL_X, j] = start[PATH_NORMAL_X, j] - TURN * start[PATH_NORMAL_Y, j]
        work[NORMAL_Y, j] = start[PATH_NORMAL_Y, j] + TURN * start[PATH_NORMAL_X, j]
        work[CURVATURE, j] = start[PATH_CURVATURE, j]
    contact(
        start[X],
        start[Y],
        work[NORMAL_X],
        work[NORMAL_Y],
        work[CURVATURE],
        start[DEPTH],
        constants,
        columns,
        work[LOAD],
        work[SLIP],
        work[SPEED],
        work[RELATIVE],
    )
    wear_depth(work[LOAD], work[SLIP], work[SPEED], work[RELATIVE], modulus, law, work[WORN])
    soften_edges(start[DEPTH], law, work[WORN])
    for j in range(n):
        moved = (work[WORN, j] - start[RATE, j]) / TURN
        work[SLOPE, j] = moved if start[RATE, j] > 0.0 and abs(moved) < math.inf else 0.0


@kernel(void(TABLE, VECTOR, float64, int64, TABLE))
def wear_rows(start: Vector, slope: Vector, diffusion: float, ends: int, rows: Vector) -> None:
    """Write d(depth per cycle)/d(depth).

    It is ``diffusion`` rate rho_H times the second difference and ``slope`` times the first,
    both of the parabola through three points. ``ends`` tells whether curvature and slope of
    the end points follow from the worn points; an end row whose third entry the row beside it
    cannot eliminate is left to the explicit part of the method. ``rows``: as ``factorise``
    takes them, and the spacing.

    Equation physics.md (A4).
    """
    x, y, rate, relative = start[X], start[Y], start[RATE], start[PATH_RELATIVE]
    before, centre, after, spacing = rows[0], rows[1], rows[2], rows[3]
    n = x.size
    for j in range(n - 1):
        ax, ay = x[j + 1] - x[j], y[j + 1] - y[j]
        spacing[j] = math.sqrt(ax * ax + ay * ay)
    for j in range(n):
        centre[j] = 2.0 * diffusion * rate[j] / relative[j] if rate[j] > 0.0 else 0.0
    first = centre[0] - slope[0] * spacing[0] if ends == 1 else 0.0
    last = centre[n - 1] + slope[n - 1] * spacing[n - 2] if ends == 1 else 0.0
    for j in range(1, n - 1):
        both = spacing[j - 1] + spacing[j]
        before[j] = (centre[j] - slope[j] * spacing[j]) / (both * spacing[j - 1])
        after[j] = (centre[j] + slope[j] * spacing[j - 1]) / (both * spacing[j])
    for j in range(1, n - 1):
        centre[j] = -(before[j] + after[j])
    near, far = spacing[0], spacing[1]
    first /= near + far
    centre[0], after[0], before[0] = first / near, -first / near - first / far, first / far
    near, far = spacing[n - 2], spacing[n - 3]
    last /= near + far
    centre[n - 1], before[n - 1], after[n - 1] = last / near, -last / near - last / far, last / far
    if ends == 1:
        step = slope[0] / spacing[0]
        centre[0], after[0] = centre[0] - step, after[0] + step
        step = slope[n - 1] / spacing[n - 2]
        centre[n - 1], before[n - 1] = centre[n - 1] + step, before[n - 1] - step
    if abs(before[0]) > MAX_RATIO * abs(after[1]):
        centre[0], after[0], before[0] = 0.0, 0.0, 0.0
    if abs(after[n - 1]) > MAX_RATIO * abs(before[n - 2]):
        centre[n - 1], before[n - 1], after[n - 1] = 0.0, 0.0, 0.0


@kernel(void(TABLE, TABLE, int64, TABLE))
def stage_state(start: Vector, increments: Vector, stage: int, trial: Vector) -> None:
    """Write where a stage stands."""
    rows, n = trial.shape
    for i in range(rows):
        for j in range(n):
            trial[i, j] = start[i, j]
    for s in range(stage):
        weight, increment = STATE[3 * stage + s], increments[s]
        for i in range(rows):
            for j in range(n):
                trial[i, j] += weight * increment[i * n + j]


@kernel(void(TABLE, int64, float64, TABLE, TABLE, TABLE))
def stage_increment(
    start: Vector, stage: int, step: float, work: Vector, factors: Vector, increments: Vector
) -> None:
    """Write the increment of a stage from the rate there.

    The matrix acts along the normals at the start of the step (``start``: a state of the
    path), on the depth along them; ``work[SLOPE]`` takes that part of the increment.
    """
    normal_x, normal_y, part = start[PATH_NORMAL_X], start[PATH_NORMAL_Y], work[SLOPE]
    n, own = normal_x.size, increments[stage]
    x, y, depth = own[:n], own[n : 2 * n], own[2 * n :]
    for j in range(n):
        depth[j] = GAMMA * step * work[WORN, j]
        x[j] = -depth[j] * work[NORMAL_X, j]
        y[j] = -depth[j] * work[NORMAL_Y, j]
    for s in range(stage):
        weight, other = GAMMA * RIGHT[3 * stage + s], increments[s]
        for j in range(own.size):
            own[j] += weight * other[j]
    for j in range(n):
        part[j] = -(x[j] * normal_x[j] + y[j] * normal_y[j])
        depth[j] -= part[j]
        x[j] += part[j] * normal_x[j]
        y[j] += part[j] * normal_y[j]
    solve(factors, part)
    for j in range(n):
        depth[j] += part[j]
        x[j] -= part[j] * normal_x[j]
        y[j] -= part[j] * normal_y[j]


@kernel(float64(TABLE))
def greatest_error(increments: Vector) -> float:
    """Return the greatest error of the depth; not a number where a depth is not."""
    greatest, broken, size = 0.0, 0, increments.shape[1]
    for j in range(2 * size // 3, size):
        error = 0.0
        for s in range(STAGES):
            error += ERROR[s] * increments[s, j]
        greatest = max(greatest, abs(error))
        broken += 0 if abs(error) < math.inf else 1
    return math.nan if broken > 0 else greatest


@kernel(STEP)
def rosenbrock_step(
    contact: Callable[..., None],
    start: Vector,
    constants: Vector,
    columns: Vector,
    modulus: float,
    law: Vector,
    diffusion: float,
    ends: int,
    step: float,
    work: Vector,
    trial: Vector,
    increments: Vector,
) -> float:
    """Make one step from a state of the path, to ``trial``; return its error, nan where it fails.

    Points are hard or soft all the step long, as they are at its start.
    """
    rows, factors = work[10:14], work[14:18]
    slope_rate(contact, start, constants, columns, modulus, law, work)
    wear_rows(start, work[SLOPE], diffusion, ends, rows)
    factorise(rows, GAMMA * step, factors)
    for j in range(start.shape[1]):
        work[WORN, j] = start[RATE, j]
        work[NORMAL_X, j], work[NORMAL_Y, j] = start[PATH_NORMAL_X, j], start[PATH_NORMAL_Y, j]
    for stage in range(STAGES):
        if stage > 0:
            stage_state(start, increments, stage, trial)
            status = flank_rate(contact, trial, start[DEPTH], constants, columns, modulus, law, work)
            if status in (CONFORMING, BROKEN):
                return math.nan
        stage_increment(start, stage, step, work, factors, increments)
    stage, n = STAGES - 1, start.shape[1]
    for i in range(trial.shape[0]):
        for j in range(n):
            trial[i, j] += increments[stage, i * n + j]
    return greatest_error(increments)
