"""Methods that the package's long steps were chosen against, compiled and under one step control.

Each step has the signature of ``rosenbrock_step`` and tells in the last row of ``work`` how many
rates it has evaluated. The matrix is the package's, along the normals at the start of the step.
"""

import math

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import (
    CONTACT_FUNCTION,
    CUBE,
    STEP,
    STEP_FUNCTION,
    TABLE,
    VECTOR,
    float64,
    int64,
    void,
)
from wearsim.kernels.controlled_steps import (
    END,
    FIRST_STEP,
    LEAST,
    LEAST_STEP,
    MAX,
    RATES,
    SAFETY,
    TIME,
    copy_removed,
    part_to_depth,
    write_state,
)
from wearsim.kernels.controlled_steps import STEP as NEXT_STEP
from wearsim.kernels.hertz_wear import (
    BROKEN,
    CONFORMING,
    DEPTH_REACHED,
    HORIZON,
    RUNNING,
    SAWTOOTH,
    flank_rate,
    sawtooth,
)
from wearsim.kernels.rosenbrock import slope_rate, wear_rows
from wearsim.kernels.tridiagonal import factorise, solve

WORK_ROWS, REPORT = 19, 18
"""Of ``work``; the last row holds the evaluations of a step."""

POWER, ERROR_POWER, BEFORE_POWER, PREVIOUS, CONTROL = 0, 1, 2, 3, 4
"""Of the step control. A failed step shrinks by error^-POWER, one that holds grows by
error^-ERROR_POWER (error of the one before)^BEFORE_POWER; POWER is 1 over the order of the error."""

ROS2_GAMMA = 1.0 - 1.0 / math.sqrt(2.0)


@kernel(void(TABLE, VECTOR))
def write_rate(work, rate):
    """Write what x, y and depth lose and gain in a cycle, after ``flank_rate``."""
    n = rate.size // 3
    for j in range(n):
        rate[j] = -work[8, j] * work[0, j]
        rate[n + j] = -work[8, j] * work[1, j]
        rate[2 * n + j] = work[8, j]


@kernel(void(TABLE, VECTOR))
def write_start_rate(start, rate):
    """The same at a state of the path."""
    n = rate.size // 3
    for j in range(n):
        rate[j] = -start[3, j] * start[4, j]
        rate[n + j] = -start[3, j] * start[5, j]
        rate[2 * n + j] = start[3, j]


@kernel(void(TABLE, TABLE, VECTOR, VECTOR))
def solve_along(start, factors, part, right):
    """Solve (I - scale A) u = right in place, A acting on the way along the normals."""
    n = part.size
    x, y, depth = right[:n], right[n : 2 * n], right[2 * n :]
    for j in range(n):
        part[j] = -(x[j] * start[4, j] + y[j] * start[5, j])
        depth[j] -= part[j]
        x[j] += part[j] * start[4, j]
        y[j] += part[j] * start[5, j]
    solve(factors, part)
    for j in range(n):
        depth[j] += part[j]
        x[j] -= part[j] * start[4, j]
        y[j] -= part[j] * start[5, j]


@kernel(STEP)
def ros2_step(
    contact, start, constants, columns, modulus, law, diffusion, ends, step, work, trial, increments
):
    """Verwer's two-stage W-method of order 2; error against linearly implicit Euler."""
    rows, factors, begin, to = work[10:14], work[14:18], start[:3].ravel(), trial.ravel()
    first, second = increments[0], increments[1]
    slope_rate(contact, start, constants, columns, modulus, law, work)
    wear_rows(start, work[9], diffusion, ends, rows)
    factorise(rows, ROS2_GAMMA * step, factors)
    write_start_rate(start, first)
    solve_along(start, factors, work[9], first)
    for j in range(to.size):
        to[j] = begin[j] + step * first[j]
    work[REPORT, 0] = 2.0
    if flank_rate(contact, trial, trial[2], constants, columns, modulus, law, work) in (CONFORMING, BROKEN):
        return math.nan
    write_rate(work, second)
    for j in range(to.size):
        second[j] -= 2.0 * first[j]
    solve_along(start, factors, work[9], second)
    greatest, total = 0.0, 0.0
    for j in range(to.size):
        to[j] = begin[j] + step * (1.5 * first[j] + 0.5 * second[j])
    for j in range(2 * start.shape[1], to.size):
        error = 0.5 * step * abs(first[j] + second[j])
        greatest, total = max(greatest, error), total + error
    return greatest if total < math.inf else math.nan


@kernel(STEP)
def euler_step(
    contact, start, constants, columns, modulus, law, diffusion, ends, step, work, trial, increments
):
    """Linearly implicit Euler, one step against two halves, extrapolated to order 2."""
    rows, factors, begin, to = work[10:14], work[14:18], start[:3].ravel(), trial.ravel()
    whole, half, other = increments[0], increments[1], increments[2]
    slope_rate(contact, start, constants, columns, modulus, law, work)
    wear_rows(start, work[9], diffusion, ends, rows)
    factorise(rows, step, factors)
    write_start_rate(start, whole)
    for j in range(to.size):
        whole[j] *= step
        half[j] = 0.5 * whole[j]
    solve_along(start, factors, work[9], whole)
    factorise(rows, 0.5 * step, factors)
    solve_along(start, factors, work[9], half)
    for j in range(to.size):
        to[j] = begin[j] + half[j]
    work[REPORT, 0] = 2.0
    if flank_rate(contact, trial, trial[2], constants, columns, modulus, law, work) in (CONFORMING, BROKEN):
        return math.nan
    write_rate(work, other)
    for j in range(to.size):
        other[j] *= 0.5 * step
    solve_along(start, factors, work[9], other)
    greatest, total = 0.0, 0.0
    for j in range(to.size):
        to[j] = begin[j] + 2.0 * (half[j] + other[j]) - whole[j]
    for j in range(2 * start.shape[1], to.size):
        error = abs(half[j] + other[j] - whole[j])
        greatest, total = max(greatest, error), total + error
    return greatest if total < math.inf else math.nan


@kernel(float64(TABLE, TABLE))
def spectral_radius(start, rows):
    """Bound of the matrix by Gershgorin, 4 e rate rho_H/ds^2, after ``wear_rows``."""
    greatest = 0.0
    for j in range(start.shape[1]):
        greatest = max(greatest, 2.0 * abs(rows[1, j]))
    return greatest


@kernel(STEP)
def chebyshev_step(
    contact, start, constants, columns, modulus, law, diffusion, ends, step, work, trial, increments
):
    """RKC2 of Sommeijer, Shampine and Verwer, J. Comput. Appl. Math. 88 (1998) 315: explicit,
    of as many stages as the spectral radius needs."""
    begin, to = start[:3].ravel(), trial.ravel()
    older, old, first, rate = increments[0], increments[1], increments[2], increments[3]
    slope_rate(contact, start, constants, columns, modulus, law, work)
    wear_rows(start, work[9], diffusion, ends, work[10:14])
    stages = max(2, 1 + int(math.sqrt(1.0 + 1.54 * step * spectral_radius(start, work[10:14]))))
    w = 1.0 + 2.0 / 13.0 / (stages * stages)
    root, angle = math.sqrt(w * w - 1.0), stages * math.acosh(w)
    shift = math.sinh(angle) * (w * w - 1.0) / (math.cosh(angle) * stages * root - w * math.sinh(angle))
    write_start_rate(start, first)
    b_older = b_old = 1.0 / (4.0 * w * w)
    t_older, t_old, d_older, d_old, s_older, s_old = 1.0, w, 0.0, 1.0, 0.0, 0.0
    for j in range(to.size):
        older[j], old[j] = begin[j], begin[j] + b_old * shift * step * first[j]
        to[j] = old[j]
    work[REPORT, 0] = 0.0
    for _ in range(2, stages + 1):
        work[REPORT, 0] += 1.0
        if flank_rate(contact, trial, trial[2], constants, columns, modulus, law, work) in (
            CONFORMING,
            BROKEN,
        ):
            return math.nan
        write_rate(work, rate)
        t, d = 2.0 * w * t_old - t_older, 2.0 * (w * d_old + t_old) - d_older
        s = 2.0 * (w * s_old + 2.0 * d_old) - s_older
        b = s / (d * d)
        mu, nu, by = 2.0 * b * w / b_old, -b / b_older, 2.0 * b * shift / b_old * step
        back = -(1.0 - b_old * t_old) * by
        for j in range(to.size):
            to[j] = (1.0 - mu - nu) * begin[j] + mu * old[j] + nu * older[j] + by * rate[j]
            to[j] += back * first[j]
        for j in range(to.size):
            older[j], old[j] = old[j], to[j]
        t_older, t_old, d_older, d_old, s_older, s_old = t_old, t, d_old, d, s_old, s
        b_older, b_old = b_old, b
    work[REPORT, 0] += 1.0
    if flank_rate(contact, trial, trial[2], constants, columns, modulus, law, work) in (CONFORMING, BROKEN):
        return math.nan
    write_rate(work, rate)
    greatest, total = 0.0, 0.0
    for j in range(2 * start.shape[1], to.size):
        error = abs(0.8 * (begin[j] - to[j]) + 0.4 * step * (first[j] + rate[j]))
        greatest, total = max(greatest, error), total + error
    return greatest if total < math.inf else math.nan


@kernel(
    int64(
        STEP_FUNCTION,
        CONTACT_FUNCTION,
        TABLE,
        VECTOR,
        TABLE,
        float64,
        VECTOR,
        float64,
        int64,
        float64,
        float64,
        float64,
        VECTOR,
        TABLE,
        TABLE,
        VECTOR,
        VECTOR,
        CUBE,
    )
)
def wear_under_control(
    make_step,
    contact,
    state,
    constants,
    columns,
    modulus,
    law,
    diffusion,
    ends,
    depth_limit,
    tolerance,
    end,
    control,
    work,
    increments,
    clock,
    times,
    path,
):
    """Wear as ``wear_in_steps`` does, with the powers of the step control handed in."""
    status = flank_rate(contact, state, state[2], constants, columns, modulus, law, work)
    clock[RATES] += 1.0
    fastest, power = 0.0, control[POWER]
    for j in range(state.shape[1]):
        fastest = max(fastest, work[8, j])
    clock[NEXT_STEP] = FIRST_STEP * tolerance**power * depth_limit / fastest
    control[PREVIOUS] = 1.0
    while True:
        place = write_state(state, work, clock, times, path)
        here, deepest = path[place], 0.0
        for j in range(state.shape[1]):
            deepest = max(deepest, state[2, j])
        if deepest >= depth_limit:
            before = (place - 1) % times.size
            step = times[place] - times[before]
            reached = times[before] + step * part_to_depth(path[before], here, step, depth_limit)
            clock[END] = min(reached, end)
            return DEPTH_REACHED if reached <= end else HORIZON
        if clock[TIME] >= end:
            return HORIZON
        if status != RUNNING:
            return status
        if sawtooth(state[2], depth_limit) >= 0:
            return SAWTOOTH
        grown = MAX
        while True:
            step = clock[NEXT_STEP]
            error = make_step(
                contact,
                here,
                constants,
                columns,
                modulus,
                law,
                diffusion,
                ends,
                step,
                work,
                state,
                increments,
            ) / (tolerance * depth_limit)
            clock[RATES] += work[REPORT, 0]
            if error <= 1.0:
                error = math.nan if copy_removed(here, state, step) > 0 else error
                status = flank_rate(contact, state, state[2], constants, columns, modulus, law, work)
                clock[RATES] += 1.0
            if error <= 1.0 and status not in (CONFORMING, BROKEN):
                break
            if step < LEAST_STEP * clock[TIME]:
                return BROKEN
            grown = 1.0
            shorter = SAFETY / error**power if error > 1.0 else LEAST
            clock[NEXT_STEP] = step * max(LEAST, shorter)
        clock[TIME] += step
        error = max(error, 1e-9)
        longer = control[PREVIOUS] ** control[BEFORE_POWER] / error ** control[ERROR_POWER]
        clock[NEXT_STEP] = step * min(grown, max(LEAST, SAFETY * longer))
        control[PREVIOUS] = error
