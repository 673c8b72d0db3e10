"""Wear in long steps of controlled error, and what lies between two of them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import CONTACT_FUNCTION, CUBE, STEP_FUNCTION, TABLE, VECTOR, float64, int64, void
from wearsim.kernels.hertz_wear import (
    BROKEN,
    CONFORMING,
    CURVATURE,
    DEPTH,
    DEPTH_REACHED,
    HORIZON,
    LOAD,
    NORMAL_X,
    NORMAL_Y,
    PATH_CURVATURE,
    PATH_NORMAL_X,
    PATH_NORMAL_Y,
    PATH_RELATIVE,
    RATE,
    RELATIVE,
    RUNNING,
    SAWTOOTH,
    WORN,
    X,
    Y,
    flank_rate,
    sawtooth,
)
from wearsim.kernels.severity import CASE_DEPTH, CORE_FACTOR

if TYPE_CHECKING:
    from collections.abc import Callable

    from wearsim.jit.signatures import Vector

STATE_ROWS = 8
"""Of a state on the path: x, y, depth, rate, the direction a point recedes in (2), 1/rho_H."""

TIME, STEP, WRITTEN, RATES, END, STATUS, WIDEST = range(7)
"""Of the clock: time, next step, states on the path, rates evaluated, time at which the run has
ended within its last step, how it stands, greatest load over 1/rho_H [N] before its last step: that of the
widest contact. A clock of zeros starts a run."""
CLOCK = 7

MODULUS, DIFFUSION, LIMIT, TOLERANCE, END_TIME = range(5)
"""Of the numbers of a flank: E*, e, depth allowed, tolerance of a step, time at which it ends in any case."""

FIRST_STEP = 0.1
"""Depth of the first step tried, in parts of the depth allowed and of the cube root of the
tolerance: runs of other tolerances shall not make the same steps."""

SAFETY, LEAST, MAX = 0.9, 0.2, 4.0
"""A step grows or shrinks by SAFETY error^(-1/3) within these."""

LEAST_STEP = 1e-11
"""A step of at most this part of the time so far is none, nor is one of 0 at its start."""


@kernel(float64(TABLE, TABLE, float64, int64, float64, int64))
def between(start: Vector, end: Vector, step: float, row: int, part: float, point: int) -> float:
    """Return x, y or depth (row 0, 1, 2) of a point at a part of a step.

    It is the cubic through both ends; that of the depth rises all the way, its slopes are
    at most three times the mean (Fritsch and Carlson, SIAM J. Numer. Anal. 17 (1980) 238).
    """
    if row == 2:
        greatest = 3.0 * (end[DEPTH, point] - start[DEPTH, point]) / step
        slope, slope_end = min(start[RATE, point], greatest), min(end[RATE, point], greatest)
    else:
        slope = -start[RATE, point] * start[PATH_NORMAL_X + row, point]
        slope_end = -end[RATE, point] * end[PATH_NORMAL_X + row, point]
    rest = 1.0 - part
    value: float = rest * rest * (
        (1.0 + 2.0 * part) * start[row, point] + part * step * slope
    ) + part * part * ((1.0 + 2.0 * rest) * end[row, point] - rest * step * slope_end)
    return value


@kernel(void(VECTOR, CUBE, VECTOR, CUBE))
def states_between(times: Vector, path: Vector, wanted: Vector, states: Vector) -> None:
    """Write x, y and depth at the wanted increasing times within those of the path."""
    place = 0
    for k in range(wanted.size):
        while place < times.size - 2 and wanted[k] > times[place + 1]:
            place += 1
        step = times[place + 1] - times[place]
        part = (wanted[k] - times[place]) / step
        for row in range(3):
            for j in range(path.shape[2]):
                states[k, row, j] = between(path[place], path[place + 1], step, row, part, j)


@kernel(float64(TABLE, TABLE, float64, float64))
def part_to_depth(start: Vector, end: Vector, step: float, limit: float) -> float:
    """Return the part of a step at which the first point reaches a depth, by bisection.

    The deepest point comes first, so that few others need to be searched.
    """
    first, deepest, points = 1.0, 0, start.shape[1]
    for j in range(points):
        deepest = j if end[DEPTH, j] > end[DEPTH, deepest] else deepest
    for i in range(points):
        j = (deepest + i) % points
        if end[DEPTH, j] < limit or between(start, end, step, DEPTH, first, j) < limit:
            continue
        low, high = 0.0, first
        middle = 0.5 * (low + high)
        while low < middle < high:
            if between(start, end, step, DEPTH, middle, j) < limit:
                low = middle
            else:
                high = middle
            middle = 0.5 * (low + high)
        first = high
    return first


@kernel(float64(VECTOR, VECTOR, float64))
def widest(load: Vector, relative: Vector, before: float) -> float:
    """Return the greatest load over 1/rho_H where the mate touches, or that of before."""
    greatest = before
    for j in range(load.size):
        if load[j] > greatest * relative[j] and relative[j] > 0.0:
            greatest = load[j] / relative[j]
    return greatest


@kernel(int64(TABLE, TABLE, VECTOR, VECTOR, CUBE))
def write_state(state: Vector, work: Vector, clock: Vector, times: Vector, path: Vector) -> int:
    """Write a state with its rate as the next of the path, round and round; return its place."""
    place = int(clock[WRITTEN]) % times.size
    here = path[place]
    for j in range(state.shape[1]):
        here[X, j], here[Y, j], here[DEPTH, j] = state[X, j], state[Y, j], state[DEPTH, j]
        here[RATE, j] = work[WORN, j]
        here[PATH_NORMAL_X, j], here[PATH_NORMAL_Y, j] = work[NORMAL_X, j], work[NORMAL_Y, j]
        here[PATH_RELATIVE, j], here[PATH_CURVATURE, j] = work[RELATIVE, j], work[CURVATURE, j]
    times[place] = clock[TIME]
    clock[WRITTEN] += 1.0
    return place


@kernel(int64(TABLE, TABLE, float64))
def copy_removed(start: Vector, state: Vector, step: float) -> int:
    """Leave a point where it was at the start of a step if it came out with more material.

    Return how many did by more than rounding and the error of the step can do: by a tenth of
    what they should have lost.
    """
    gained = 0
    for j in range(state.shape[1]):
        if state[DEPTH, j] < start[DEPTH, j]:
            gained += 1 if start[DEPTH, j] - state[DEPTH, j] > 0.1 * step * start[RATE, j] else 0
            state[X, j], state[Y, j], state[DEPTH, j] = start[X, j], start[Y, j], start[DEPTH, j]
    return gained


@kernel(float64(TABLE, TABLE, VECTOR, float64))
def part_to_layer(start: Vector, state: Vector, law: Vector, allowed: float) -> float:
    """Return the part of a step after which it should end, 1 where that is its end.

    It ends where the first point passes through the hardened layer, so that what it wears
    below as if it were hard is at most half of what is allowed there.
    """
    part = 1.0
    if law[CORE_FACTOR] != 1.0:
        below = allowed / abs(law[CORE_FACTOR] - 1.0)
        for j in range(state.shape[1]):
            if start[DEPTH, j] <= law[CASE_DEPTH] and state[DEPTH, j] > law[CASE_DEPTH] + below:
                way = law[CASE_DEPTH] + 0.5 * below - start[DEPTH, j]
                part = min(part, way / (state[DEPTH, j] - start[DEPTH, j]))
    return part


@kernel(void(TABLE, TABLE, VECTOR))
def pass_layer(start: Vector, state: Vector, law: Vector) -> None:
    """Let what a point has gone below the hardened layer in a step wear as the core does.

    The step has taken it for hard to its end; the way below the layer is ``law[CORE_FACTOR]`` times as long.
    """
    if law[CORE_FACTOR] != 1.0:
        for j in range(state.shape[1]):
            if start[DEPTH, j] <= law[CASE_DEPTH] < state[DEPTH, j]:
                more = (law[CORE_FACTOR] - 1.0) * (state[DEPTH, j] - law[CASE_DEPTH])
                state[X, j] -= more * start[PATH_NORMAL_X, j]
                state[Y, j] -= more * start[PATH_NORMAL_Y, j]
                state[DEPTH, j] += more


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
        int64,
        TABLE,
        TABLE,
        VECTOR,
        VECTOR,
        CUBE,
    )
)
def wear_in_steps(
    make_step: Callable[..., float],
    contact: Callable[..., None],
    state: Vector,
    constants: Vector,
    columns: Vector,
    modulus: float,
    law: Vector,
    diffusion: float,
    ends: int,
    depth_limit: float,
    tolerance: float,
    end: float,
    most_states: int,
    work: Vector,
    increments: Vector,
    clock: Vector,
    times: Vector,
    path: Vector,
) -> int:
    """Wear the flank, physics.md (10) to (12), step by step in place until something ends it.

    A step is repeated shorter until its error at every point is at most the tolerance, a part
    of the depth allowed; one in which the flank would conform or gain material is too long. Every
    state is written to the path until ``most_states`` of them are. The time is in cycles times the
    coefficient that ``law`` leaves out. Ends with DEPTH_REACHED or HORIZON within the last
    step, RUNNING where the path is full, VANISHED, CONFORMING at once, SAWTOOTH where the
    depth alternates from point to point, or BROKEN where no step is short enough: ``state``
    and ``work`` are then those that failed. The step is handed in like the contact: linked
    in, it would be compiled twice.
    """
    status = flank_rate(contact, state, state[DEPTH], constants, columns, modulus, law, work)
    clock[RATES] += 1.0
    if clock[TIME] == 0.0:
        fastest = 0.0
        for j in range(state.shape[1]):
            fastest = max(fastest, work[WORN, j])
        clock[STEP] = FIRST_STEP * tolerance ** (1.0 / 3.0) * depth_limit / fastest
    while True:
        place = write_state(state, work, clock, times, path)
        here, deepest = path[place], 0.0
        for j in range(state.shape[1]):
            deepest = max(deepest, state[DEPTH, j])
        if deepest >= depth_limit:
            before = (place - 1) % times.size
            step = times[place] - times[before]
            reached = times[before] + step * part_to_depth(path[before], here, step, depth_limit)
            clock[END] = min(reached, end)
            return DEPTH_REACHED if reached <= end else HORIZON
        if clock[TIME] >= end:
            clock[END] = end
            return HORIZON
        clock[END] = clock[TIME]
        clock[WIDEST] = widest(work[LOAD], work[RELATIVE], clock[WIDEST])
        if status != RUNNING:
            return status
        if sawtooth(state[DEPTH], depth_limit) >= 0:
            return SAWTOOTH
        if clock[WRITTEN] >= most_states:
            return RUNNING
        grown = MAX
        while True:
            step = clock[STEP]
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
            part = 1.0
            if error <= 1.0:
                error = math.nan if copy_removed(here, state, step) > 0 else error
                part = part_to_layer(here, state, law, tolerance * depth_limit)
            if error <= 1.0 and part == 1.0:
                pass_layer(here, state, law)
                status = flank_rate(contact, state, state[DEPTH], constants, columns, modulus, law, work)
            clock[RATES] += 5.0
            if error <= 1.0 and part == 1.0 and status not in (CONFORMING, BROKEN):
                break
            if step <= LEAST_STEP * clock[TIME]:
                return BROKEN
            grown = 1.0
            if part < 1.0:
                clock[STEP] = step * part
                continue
            shorter = SAFETY / error ** (1.0 / 3.0) if error > 1.0 else LEAST
            clock[STEP] = step * max(LEAST, shorter)
        clock[TIME] += step
        clock[STEP] = step * min(grown, SAFETY / max(error, 1e-9) ** (1.0 / 3.0))


@kernel(void(VECTOR, VECTOR, CUBE, TABLE))
def go_to_end(clock: Vector, times: Vector, path: Vector, state: Vector) -> None:
    """Leave ``state`` where the last step on the path has ended."""
    last = (int(clock[WRITTEN]) - 1) % times.size
    before = (last - 1) % times.size
    step = times[last] - times[before]
    part = (clock[END] - times[before]) / step
    for row in range(3):
        for j in range(state.shape[1]):
            state[row, j] = between(path[before], path[last], step, row, part, j)


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
        TABLE,
        TABLE,
        CUBE,
    )
)
def wear_flanks(
    make_step: Callable[..., float],
    contact: Callable[..., None],
    states: Vector,
    constants: Vector,
    columns: Vector,
    numbers: Vector,
    laws: Vector,
    ends: int,
    most_states: int,
    work: Vector,
    increments: Vector,
    clocks: Vector,
    times: Vector,
    path: Vector,
) -> None:
    """Wear flanks in steps, one after the other: first index of all arrays but those to work in.

    ``path``: the states of the first flank at its ``times``, then those of the next. A state that
    has come to its limit or horizon is left there.
    """
    for i in range(states.shape[0]):
        own = path[i * times.shape[1] : (i + 1) * times.shape[1]]
        status = wear_in_steps(
            make_step,
            contact,
            states[i],
            constants[i],
            columns[i],
            numbers[i, MODULUS],
            laws[i],
            numbers[i, DIFFUSION],
            ends,
            numbers[i, LIMIT],
            numbers[i, TOLERANCE],
            numbers[i, END_TIME],
            most_states,
            work,
            increments,
            clocks[i],
            times[i],
            own,
        )
        clocks[i, STATUS] = status
        if status in (DEPTH_REACHED, HORIZON):
            go_to_end(clocks[i], times[i], own, states[i])
