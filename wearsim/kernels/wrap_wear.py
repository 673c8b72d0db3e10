"""Wear by contacts that rest: each event presses its roller on the worn outline and wears it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import TABLE, VECTOR, int64, void
from wearsim.kernels import half_space
from wearsim.kernels.event_rows import (
    EVENT_BODY,
    EVENT_CENTRE_X,
    EVENT_CENTRE_Y,
    EVENT_COUNT,
    EVENT_LOAD,
    EVENT_NORMAL_X,
    EVENT_NORMAL_Y,
    EVENT_SLIP,
    EVENT_SPEED,
    EVENT_TOUCHED,
)
from wearsim.kernels.half_space import CONVERGED, NOT_CONVERGED, power_contact

if TYPE_CHECKING:
    from wearsim.jit.signatures import Vector

# rows of the table of the unworn outline
UNWORN_X, UNWORN_Y, UNWORN_NORMAL_X, UNWORN_NORMAL_Y, UNWORN_CURVATURE, SPACING = range(6)

# numbers of a step
(
    MATE_RADIUS,
    COEFFICIENT,
    PRESSURE_EXPONENT,
    SPEED_EXPONENT,
    CYCLES,
    REACH,
    TOLERANCE,
    CASE_DEPTH,
    CORE_FACTOR,
) = range(9)
NUMBERS = 9

# what a step found
AREA, HARD_AREA, PEAK_PRESSURE, UNBALANCED = range(4)
FINDINGS = 4

EVENT_NUMBERS = 15
"""Constants and results of a roller, which share a row of the work: it has so many columns at least."""

_MAX_ITERATIONS = 2000.0
_NEAR = 0.25
"""Part of the reach on which a roller is pressed first."""


@kernel(void(VECTOR, TABLE, int64, int64, VECTOR))
def worn_width(depth: Vector, unworn: Vector, first: int, last: int, width: Vector) -> None:
    """Write the length of every cell of the worn outline, of which depth leaves a slope."""
    n = depth.size
    for j in range(first, last):
        before, after = max(j - 1, 0), min(j + 1, n - 1)
        way = 0.5 * (unworn[SPACING, before] + unworn[SPACING, after])
        way = max((after - before) * way, unworn[SPACING, j])
        slope = (depth[after] - depth[before]) / way
        stretch = 1.0 - unworn[UNWORN_CURVATURE, j] * depth[j]
        width[j] = unworn[SPACING, j] * math.sqrt(stretch * stretch + slope * slope)


@kernel(void(VECTOR, VECTOR, VECTOR, VECTOR, TABLE, int64, int64))
def recede(area: Vector, depth: Vector, x: Vector, y: Vector, unworn: Vector, first: int, last: int) -> None:
    """Write depth and points from the area worn off per length of the unworn outline.

    Along the normals of an outline of curvature kappa the area is d - kappa d^2/2.

    Equation physics.md (W12).
    """
    for j in range(first, last):
        left = max(1.0 - 2.0 * unworn[UNWORN_CURVATURE, j] * area[j], 0.0)
        depth[j] = 2.0 * area[j] / (1.0 + math.sqrt(left))
        x[j] = unworn[UNWORN_X, j] - depth[j] * unworn[UNWORN_NORMAL_X, j]
        y[j] = unworn[UNWORN_Y, j] - depth[j] * unworn[UNWORN_NORMAL_Y, j]


@kernel(void(int64, TABLE, VECTOR, VECTOR))
def place_roller(event: int, events: Vector, numbers: Vector, constants: Vector) -> None:
    """Write what `power_contact` takes of the roller of an event."""
    constants[half_space.CENTRE_X], constants[half_space.CENTRE_Y] = (
        events[EVENT_CENTRE_X, event],
        events[EVENT_CENTRE_Y, event],
    )
    constants[half_space.RADIUS] = numbers[MATE_RADIUS]
    constants[half_space.ALONG_X], constants[half_space.ALONG_Y] = (
        events[EVENT_NORMAL_X, event],
        events[EVENT_NORMAL_Y, event],
    )
    constants[half_space.LOAD], constants[half_space.TOLERANCE] = (
        events[EVENT_LOAD, event],
        numbers[TOLERANCE],
    )
    constants[half_space.MOST_ITERATIONS] = _MAX_ITERATIONS


@kernel(int64(VECTOR, VECTOR, int64, int64, VECTOR, VECTOR))
def touches_beyond(x: Vector, y: Vector, first: int, last: int, constants: Vector, result: Vector) -> int:
    """Return 1 where a roller pressed on the cells from ``first`` to before ``last`` may touch others.

    The cells that may press must not reach an end of these, and all others must lie farther
    from the roller than it has come nearer: displacements are positive.
    """
    if int(result[half_space.FIRST]) == 0 or int(result[half_space.LAST]) == last - first:
        return 1
    away = constants[half_space.RADIUS] + max(result[half_space.APPROACH], 0.0)
    near = 0
    for j in range(x.size):
        to_x, to_y = constants[half_space.CENTRE_X] - x[j], constants[half_space.CENTRE_Y] - y[j]
        inside = to_x * to_x + to_y * to_y < away * away
        near += 1 if inside and (j < first or j >= last) else 0
    return 1 if near > 0 else 0


@kernel(void(int64, TABLE, TABLE, TABLE, TABLE, TABLE, TABLE, VECTOR, VECTOR, TABLE, TABLE, VECTOR))
def wear_event(
    event: int,
    events: Vector,
    x: Vector,
    y: Vector,
    area: Vector,
    depth: Vector,
    unworn: Vector,
    coefficients: Vector,
    numbers: Vector,
    pressures: Vector,
    work: Vector,
    findings: Vector,
) -> None:
    """Press one roller on its outline, wear it implicitly, and take the wear off.

    The roller is pressed on the cells near the place it touches and, where these might not be
    all, on all that it can reach.

    Equations physics.md (W10) and (W12).
    """
    body, n, touched = int(events[EVENT_BODY, event]), x.shape[1], int(events[EVENT_TOUCHED, event])
    width, factor, constants, result = work[0], work[1], work[2][0:8], work[2][8:15]
    place_roller(event, events, numbers, constants)
    exponent, speed = numbers[PRESSURE_EXPONENT], events[EVENT_SPEED, event]
    worn = numbers[COEFFICIENT] * numbers[CYCLES] * events[EVENT_COUNT, event]
    worn *= events[EVENT_SLIP, event]
    if numbers[SPEED_EXPONENT] != 0.0:
        worn *= speed ** numbers[SPEED_EXPONENT] if speed > 0.0 else 0.0
    far = int(numbers[REACH])
    low, high = max(0, touched - far), min(n, touched + far + 1)
    first, last, status = 0, n, NOT_CONVERGED
    for attempt in range(2):
        reach = far if attempt == 1 else int(numbers[REACH] * _NEAR)
        first, last = max(0, touched - reach), min(n, touched + reach + 1)
        worn_width(depth[body], unworn, first, last, width)
        for j in range(first, last):
            soft = depth[body, j] > numbers[CASE_DEPTH]
            factor[j] = worn * numbers[CORE_FACTOR] if soft else worn
        status = power_contact(
            x[body][first:last],
            y[body][first:last],
            width[first:last],
            factor[first:last],
            exponent,
            coefficients,
            constants,
            pressures[event][first:last],
            work[3:],
            result,
        )
        if attempt == 1:
            break
        if status != CONVERGED:
            for j in range(first, last):
                pressures[event, j] = 0.0
        elif (
            touches_beyond(x[body][low:high], y[body][low:high], first - low, last - low, constants, result)
            == 0
        ):
            break
    findings[UNBALANCED] += 0.0 if status == CONVERGED else 1.0
    if status != CONVERGED and status != NOT_CONVERGED:
        return
    pressure = pressures[event]
    for j in range(first, last):
        p = pressure[j]
        if p > 0.0:
            pressed = (p if exponent == 1.0 else p**exponent) * width[j]
            removed = factor[j] * pressed
            area[body, j] += removed / unworn[SPACING, j]
            findings[AREA] += removed
            findings[HARD_AREA] += worn * pressed
            findings[PEAK_PRESSURE] = max(findings[PEAK_PRESSURE], p)
    recede(area[body], depth[body], x[body], y[body], unworn, first, last)


@kernel(void(TABLE, int64, TABLE, TABLE, TABLE, TABLE, TABLE, VECTOR, VECTOR, TABLE, TABLE, VECTOR))
def wear_events(
    events: Vector,
    backwards: int,
    x: Vector,
    y: Vector,
    area: Vector,
    depth: Vector,
    unworn: Vector,
    coefficients: Vector,
    numbers: Vector,
    pressures: Vector,
    work: Vector,
    findings: Vector,
) -> None:
    """Let every event of a cycle wear its outline, ``numbers[CYCLES]`` times at once.

    ``events``: `EVENT_ROWS` rows; an event without load is passed over. ``x``, ``y``,
    ``area`` (per unworn length) and ``depth``: a row for every worn body. ``pressures``: a
    row of last pressures for every event. One event after the other meets what those
    before it left, so a step of any size is stable; ``backwards`` 1 turns the order round.
    """
    count = events.shape[1]
    for i in range(findings.size):
        findings[i] = 0.0
    for i in range(count):
        event = count - 1 - i if backwards == 1 else i
        if events[EVENT_LOAD, event] > 0.0:
            wear_event(
                event, events, x, y, area, depth, unworn, coefficients, numbers, pressures, work, findings
            )
