"""One revolution of a wrapped sprocket: all phases and positions as contact events."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import CUBE, TABLE, VECTOR, float64, int64
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
from wearsim.kernels.wrap_equilibrium import (
    CENTRE_X,
    CENTRE_Y,
    NORMAL_X,
    NORMAL_Y,
    PITCH_ANGLE,
    SEATED,
    STALLED,
    TIGHT_TENSION,
    engaged,
    place_rollers,
    residual,
    same_roller,
    solve_wrap,
)

if TYPE_CHECKING:
    from wearsim.jit.signatures import Vector

_TOLERANCE = 1e-9
LOOSEST = 1e-2

# numbers of a cycle
WRAP_ANGLE, FACE_WIDTH, ARTICULATION_SLIP, PATH_SLIP, PHASE_TIME, START, LOOSE, LOWEST = range(8)
CYCLE_NUMBERS = 8


@kernel(
    int64(
        CUBE, TABLE, int64, int64, int64, float64, VECTOR, VECTOR, CUBE, TABLE, TABLE, VECTOR, VECTOR, TABLE
    )
)
def wrap_events(
    loci: Vector,
    touched: Vector,
    configurations: int,
    phases: int,
    most_rollers: int,
    count: float,
    constants: Vector,
    numbers: Vector,
    positions: Vector,
    work: Vector,
    gap_work: Vector,
    tension: Vector,
    force: Vector,
    events: Vector,
) -> int:
    """Solve phases of one pitch and write what a gap meets in one revolution.

    Phase k is (k + 1/2)/phases.

    ``loci`` and ``touched``: roller path and touched places of each worn body;
    ``configurations`` 2 where inner and outer links differ. ``positions`` (configuration,
    phase, roller) holds where to start from (below zero: nowhere) and the answers; where
    that fails ``numbers[START]`` and ``numbers[LOWEST]`` are tried. On a worn
    path an equilibrium may stay loose: up to `LOOSEST` of the tight tension without balance
    along the path is accepted, the most of all phases written to ``numbers[LOOSE]``. Event
    (configuration, phase, roller) stands in column (configuration phases + phase) most_rollers + roller,
    without load where the force is below the solver's tolerance. Slip of an articulation is
    shared out over the phases of the first and the last position, the way along the path is half
    of that from the phase before and to the phase after. Returns SEATED or how the first failing
    solve ended.
    """
    bodies, angle = loci.shape[0], constants[PITCH_ANGLE]
    for configuration in range(configurations):
        for step in range(phases):
            phase = (step + 0.5) / phases
            rollers = engaged(numbers[WRAP_ANGLE], angle, phase)
            tight = angle * (phase - 0.5)
            slack = numbers[WRAP_ANGLE] - tight - (rollers - 1) * angle
            position = positions[configuration, step]
            status = -1
            for attempt in range(3):
                if attempt > 0 or position[0] < 0.0:
                    for i in range(rollers):
                        position[i] = numbers[START] if attempt < 2 else numbers[LOWEST]
                status = solve_wrap(
                    loci[0],
                    loci[bodies - 1],
                    configuration,
                    rollers,
                    constants,
                    tight,
                    slack,
                    _TOLERANCE * constants[TIGHT_TENSION],
                    position,
                    work,
                    tension,
                    force,
                )
                if status == SEATED:
                    break
            if status == STALLED:
                left = residual(rollers, work) / constants[TIGHT_TENSION]
                numbers[LOOSE] = max(numbers[LOOSE], left)
                status = SEATED if left <= LOOSEST else STALLED
            if status != SEATED:
                return status
            base = (configuration * phases + step) * most_rollers
            for i in range(most_rollers):
                events[EVENT_LOAD, base + i] = 0.0
            place_rollers(loci[0], loci[bodies - 1], configuration, rollers, position, 0.0, gap_work)
            for i in range(rollers):
                event, body = base + i, (i + configuration) % bodies
                k = min(int(position[i]), touched.shape[1] - 2)
                part = position[i] - k
                events[EVENT_CENTRE_X, event] = gap_work[CENTRE_X, i]
                events[EVENT_CENTRE_Y, event] = gap_work[CENTRE_Y, i]
                events[EVENT_NORMAL_X, event] = gap_work[NORMAL_X, i]
                events[EVENT_NORMAL_Y, event] = gap_work[NORMAL_Y, i]
                events[EVENT_TOUCHED, event] = (1.0 - part) * touched[body, k] + part * touched[body, k + 1]
                pressed = force[i] > _TOLERANCE * constants[TIGHT_TENSION]
                events[EVENT_LOAD, event] = force[i] / numbers[FACE_WIDTH] if pressed else 0.0
                events[EVENT_COUNT, event] = count
                events[EVENT_BODY, event] = body
                ends = (1.0 if i == 0 else 0.0) + (1.0 if i == rollers - 1 else 0.0)
                events[EVENT_SLIP, event] = ends * numbers[ARTICULATION_SLIP] / phases
    for configuration in range(configurations):
        for step in range(phases):
            for i in range(most_rollers):
                here = (configuration * phases + step) * most_rollers + i
                if events[EVENT_LOAD, here] == 0.0:
                    continue
                way = 0.0
                for side in range(2):
                    there = same_roller(configuration, step, i, side, configurations, phases, most_rollers)
                    if there >= 0 and events[EVENT_LOAD, there] > 0.0:
                        dx = events[EVENT_CENTRE_X, there] - events[EVENT_CENTRE_X, here]
                        dy = events[EVENT_CENTRE_Y, there] - events[EVENT_CENTRE_Y, here]
                        way += 0.5 * math.sqrt(dx * dx + dy * dy)
                events[EVENT_SLIP, here] += numbers[PATH_SLIP] * way
                events[EVENT_SPEED, here] = events[EVENT_SLIP, here] / numbers[PHASE_TIME]
    return SEATED
