"""Lives of many flanks in one call: each in ever smaller steps until two lives agree."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import CONTACT_FUNCTION, CUBE, STEP_FUNCTION, TABLE, VECTOR, float64, int64, void
from wearsim.kernels.controlled_steps import (
    END,
    FINEST,
    LOOSEST,
    PART_OF_TOLERANCE,
    TIGHTEST,
    WRITTEN,
    between,
    wear_in_steps,
)
from wearsim.kernels.hertz_wear import DEPTH_REACHED, HORIZON, LOAD, RELATIVE, RUNNING, flank_rate

if TYPE_CHECKING:
    from collections.abc import Callable

    from wearsim.jit.signatures import Vector

LIMIT, HORIZON_TIME, LIFE_TOLERANCE, MODULUS, DIFFUSION = range(5)
"""Of the numbers of a flank: depth allowed, time of the horizon, tolerance of the life, E*, e."""

STATUS, TIME_RUN, CHANGE, WIDEST = range(4)
"""Of what is found: what ended the last run, its time, relative difference of the last two lives or
of the depths at the horizon, greatest q rho_H of the new and of the last flank (half-width squared
times pi E*/4)."""


@kernel(float64(TABLE))
def widest(work: Vector) -> float:
    """Return the greatest load over relative curvature after ``flank_rate``."""
    greatest = 0.0
    for j in range(work.shape[1]):
        greatest = max(greatest, work[LOAD, j] / work[RELATIVE, j] if work[LOAD, j] > 0.0 else 0.0)
    return greatest


@kernel(float64(VECTOR, VECTOR))
def depth_change(depth: Vector, before: Vector) -> float:
    """Return the greatest difference over the greatest depth."""
    change, deepest = 0.0, 0.0
    for j in range(depth.size):
        change = max(change, abs(depth[j] - before[j]))
        deepest = max(deepest, depth[j])
    return change / deepest


@kernel(
    int64(
        STEP_FUNCTION,
        CONTACT_FUNCTION,
        TABLE,
        VECTOR,
        TABLE,
        VECTOR,
        VECTOR,
        int64,
        float64,
        int64,
        TABLE,
        TABLE,
        TABLE,
        VECTOR,
        VECTOR,
        CUBE,
    )
)
def run_once(
    make_step: Callable[..., float],
    contact: Callable[..., None],
    start: Vector,
    constants: Vector,
    columns: Vector,
    numbers: Vector,
    law: Vector,
    ends: int,
    tolerance: float,
    most_states: int,
    state: Vector,
    work: Vector,
    increments: Vector,
    clock: Vector,
    times: Vector,
    path: Vector,
) -> int:
    """Wear a flank with one tolerance; leave ``state`` where it ends."""
    # In loops: assigned as a whole, numba would compile all of its messages on shapes too.
    for i in range(clock.size):
        clock[i] = 0.0
    for row in range(state.shape[0]):
        for j in range(state.shape[1]):
            state[row, j] = start[row, j]
    status = wear_in_steps(
        make_step,
        contact,
        state,
        constants,
        columns,
        numbers[MODULUS],
        law,
        numbers[DIFFUSION],
        ends,
        numbers[LIMIT],
        tolerance,
        numbers[HORIZON_TIME],
        most_states,
        work,
        increments,
        clock,
        times,
        path,
    )
    if status in (DEPTH_REACHED, HORIZON):
        last = (int(clock[WRITTEN]) - 1) % times.size
        before = (last - 1) % times.size
        step = times[last] - times[before]
        part = (clock[END] - times[before]) / step
        for row in range(3):
            for j in range(state.shape[1]):
                state[row, j] = between(path[before], path[last], step, row, part, j)
    return status


@kernel(
    void(
        STEP_FUNCTION,
        CONTACT_FUNCTION,
        CUBE,
        TABLE,
        CUBE,
        TABLE,
        TABLE,
        int64,
        int64,
        TABLE,
        TABLE,
        VECTOR,
        VECTOR,
        CUBE,
        CUBE,
        TABLE,
    )
)
def wear_flanks(
    make_step: Callable[..., float],
    contact: Callable[..., None],
    starts: Vector,
    constants: Vector,
    columns: Vector,
    numbers: Vector,
    laws: Vector,
    ends: int,
    most_states: int,
    work: Vector,
    increments: Vector,
    clock: Vector,
    times: Vector,
    path: Vector,
    worn: Vector,
    found: Vector,
) -> None:
    """Find the life of every flank: first index of all arrays but those to work in.

    ``worn``: x, y and depth in the end, and a row to work in.

    A life stands where two runs, one with a tenth of the other's tolerance, differ by at
    most a tenth of the tolerance of the life; where none do, the status is RUNNING.
    """
    for i in range(starts.shape[0]):
        flank_rate(
            contact, starts[i], starts[i, 2], constants[i], columns[i], numbers[i, MODULUS], laws[i], work
        )
        wide = widest(work)
        tolerance = PART_OF_TOLERANCE * numbers[i, LIFE_TOLERANCE]
        tolerance = min(LOOSEST, max(FINEST, tolerance))
        ended, before, change = RUNNING, 0.0, math.inf
        found[i, STATUS] = RUNNING
        while tolerance >= TIGHTEST and found[i, STATUS] == RUNNING:
            status = run_once(
                make_step,
                contact,
                starts[i],
                constants[i],
                columns[i],
                numbers[i],
                laws[i],
                ends,
                tolerance,
                most_states,
                worn[i, :3],
                work,
                increments,
                clock,
                times,
                path,
            )
            if status == ended and status in (DEPTH_REACHED, HORIZON):
                if status == HORIZON:
                    change = depth_change(worn[i, 2], worn[i, 3])
                else:
                    change = abs(clock[END] / before - 1.0)
                if change <= 0.1 * numbers[i, LIFE_TOLERANCE]:
                    found[i, STATUS] = status
            ended, before = status, clock[END]
            for j in range(worn.shape[2]):
                worn[i, 3, j] = worn[i, 2, j]
            # Where the steps do not suffice a tighter run takes even more.
            tolerance = 0.0 if status == RUNNING else 0.1 * tolerance
        status = flank_rate(
            contact, worn[i, :3], worn[i, 2], constants[i], columns[i], numbers[i, MODULUS], laws[i], work
        )
        if status != RUNNING:
            found[i, STATUS] = RUNNING
        found[i, TIME_RUN], found[i, CHANGE] = clock[END], change
        found[i, WIDEST] = max(wide, widest(work))
