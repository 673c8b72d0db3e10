"""Where the rollers of a wrap rest when gaps yield like an elastic foundation and wear meanwhile."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import TABLE, VECTOR, float64, int64, void
from wearsim.kernels.wrap_equilibrium import (
    DIGITS,
    PITCH_ANGLE,
    PITCH_EVEN,
    PITCH_ODD,
    SEATED,
    SLACK_TENSION,
    STALLED,
    STIFFNESS,
    TIGHT_TENSION,
)

if TYPE_CHECKING:
    from wearsim.jit.signatures import Vector

# rows of the table of seats, a column for every roller in every phase: centre in its gap, nearest cell,
# half of the width that presses, cells that may press, friction, force on the tooth, where it presses,
# slip, over how many cells it sweeps on either side until it is half way to the next phase, and how fast
# it alone wears a cell by its pressure
SEAT_X, SEAT_Y, NEAREST, HALF_WIDTH, FIRST, LAST, DRAG_X, DRAG_Y = range(8)
LOAD_X, LOAD_Y, PLACE, SLIP, SPEED, BEFORE, AFTER, OWN_YIELD, DRIFT_X, DRIFT_Y = range(8, 18)
SEAT_ROWS = 18

# rows of the table of work, a column for every roller
_RIGHT_X, _RIGHT_Y, _XX, _XY, _YY, _LXX, _LXY, _LYX, _LYY = range(9)
_IXX, _IXY, _IYY, _DOWN_X, _DOWN_Y, _STEP_X, _STEP_Y = range(9, 16)
_TRIAL_X, _TRIAL_Y, _FROM_X, _FROM_Y, _SEEN_X, _SEEN_Y, _LOW, _HIGH, _PRESSED = range(16, 25)
_LOAD_X, _LOAD_Y = 25, 26
SEAT_WORK_ROWS = 27

# rows of the table of cells: force of each, and its direction
_FORCE, _ACROSS, _UP = 0, 1, 2
CELL_ROWS = 3

# what a foundation answers: force per width, stiffness, energy, width that presses
_PUSH_X, _PUSH_Y, _STIFF_XX, _STIFF_XY, _STIFF_YY, _STORED, _PRESSING = range(7)

# cells that a roller may press: the first, the one after the last, the nearest
_FIRST_SEEN, _PAST_SEEN, _NEAREST_SEEN = range(3)

_MARGIN = 0.002
"""Distance within which cells are looked at, in radii of the roller; the first longest step too."""

_MAX_ITERATIONS = 4000
_MAX_DRAGS = 60
_STIFFEST = 1e14
_ROUNDING = 1e-11


@kernel(void(VECTOR, VECTOR, VECTOR, int64, float64, float64, float64, float64, VECTOR, VECTOR))
def near_cells(
    x: Vector,
    y: Vector,
    recess: Vector,
    reach: int,
    radius: float,
    cx: float,
    cy: float,
    nearest: float,
    beyond: Vector,
    found: Vector,
) -> None:
    """Write the first cell and the one after the last that a roller may press, and the nearest one."""
    k = int(nearest)
    low, high = max(0, k - reach), min(x.size, k + reach + 1)
    wide = (1.0 + _MARGIN) * radius
    for j in range(low, high):
        dx, dy, within = cx - x[j], cy - y[j], wide + recess[j]
        beyond[j] = dx * dx + dy * dy - within * within
    first, last = low, high
    while first < high and beyond[first] >= 0.0:
        first += 1
    while last > first and beyond[last - 1] >= 0.0:
        last -= 1
    begin, end = (first, last) if last > first else (low, high)
    best = math.inf
    for j in range(begin, end):
        dx, dy = cx - x[j], cy - y[j]
        distance = dx * dx + dy * dy
        if distance < best:
            best, k = distance, j
    found[_FIRST_SEEN], found[_PAST_SEEN] = first, last if last > first else low
    found[_NEAREST_SEEN] = k


@kernel(
    void(
        VECTOR,
        VECTOR,
        VECTOR,
        VECTOR,
        VECTOR,
        int64,
        int64,
        float64,
        float64,
        float64,
        VECTOR,
        int64,
        TABLE,
        VECTOR,
    )
)
def foundation_force(
    x: Vector,
    y: Vector,
    width: Vector,
    compliance: Vector,
    recess: Vector,
    first: int,
    last: int,
    radius: float,
    cx: float,
    cy: float,
    held: Vector,
    holds: int,
    cells: Vector,
    out: Vector,
) -> None:
    """Write force per width on a roller, its stiffness, energy and the width that presses.

    A cell presses along the line to the roller's centre with (overlap + recess)/compliance.
    ``holds`` 1: the cells that have a pressure in ``held`` press or pull, no others; 0: what presses is
    written there.

    Equation physics.md (W15).
    """
    if holds == 1:
        for j in range(first, last):
            dx, dy = cx - x[j], cy - y[j]
            distance = math.sqrt(dx * dx + dy * dy)
            over = radius - distance + recess[j]
            cells[_FORCE, j] = over / compliance[j] * width[j] if held[j] > 0.0 else 0.0
            cells[_ACROSS, j], cells[_UP, j] = dx / distance, dy / distance
    else:
        for j in range(first, last):
            dx, dy = cx - x[j], cy - y[j]
            distance = math.sqrt(dx * dx + dy * dy)
            cells[_FORCE, j] = max(radius - distance + recess[j], 0.0) / compliance[j] * width[j]
            cells[_ACROSS, j], cells[_UP, j] = dx / distance, dy / distance
        for j in range(first, last):
            held[j] = cells[_FORCE, j]
    fx, fy, xx, xy, yy, stored, pressed = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(first, last):
        force = cells[_FORCE, j]
        if force != 0.0:
            stiffness, turning = width[j] / compliance[j], force / radius
            nx, ny = cells[_ACROSS, j], cells[_UP, j]
            fx += force * nx
            fy += force * ny
            xx += stiffness * nx * nx - turning * ny * ny
            xy += (stiffness + turning) * nx * ny
            yy += stiffness * ny * ny - turning * nx * nx
            stored += 0.5 * force * force / stiffness
            pressed += width[j]
    out[_PUSH_X], out[_PUSH_Y] = fx, fy
    out[_STIFF_XX], out[_STIFF_XY], out[_STIFF_YY] = xx, xy, yy
    out[_STORED], out[_PRESSING] = stored, pressed


@kernel(
    float64(
        int64,
        int64,
        int64,
        VECTOR,
        float64,
        float64,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        int64,
        float64,
        float64,
        TABLE,
        TABLE,
        TABLE,
    )
)
def wrap_balance(
    event: int,
    rollers: int,
    kind: int,
    constants: Vector,
    tight_angle: float,
    slack_angle: float,
    x: Vector,
    y: Vector,
    width: Vector,
    compliance: Vector,
    recess: Vector,
    held: Vector,
    holds: int,
    radius: float,
    face_width: float,
    seats: Vector,
    work: Vector,
    cells: Vector,
) -> float:
    """Write what pulls on every roller and the stiffness against it; return the potential energy.

    The trial places of ``work`` are each in the frame of its own gap, which is that of the one before
    turned clockwise by a pitch angle. The energy counts from the places where the solve began.

    Equation physics.md (W3).
    """
    bodies, spring = x.shape[0], constants[STIFFNESS]
    out = cells[CELL_ROWS]
    energy: float = 0.0
    for i in range(rollers):
        body = (i + kind) % bodies
        foundation_force(
            x[body],
            y[body],
            width[body],
            compliance[i],
            recess[i],
            int(work[_LOW, i]),
            int(work[_HIGH, i]),
            radius,
            work[_TRIAL_X, i],
            work[_TRIAL_Y, i],
            held[i],
            holds,
            cells,
            out,
        )
        work[_LOAD_X, i], work[_LOAD_Y, i] = out[_PUSH_X], out[_PUSH_Y]
        drag_x, drag_y = seats[DRAG_X, event + i], seats[DRAG_Y, event + i]
        work[_RIGHT_X, i] = face_width * out[_PUSH_X] + drag_x
        work[_RIGHT_Y, i] = face_width * out[_PUSH_Y] + drag_y
        work[_XX, i], work[_XY, i], work[_YY, i] = (
            face_width * out[_STIFF_XX],
            face_width * out[_STIFF_XY],
            face_width * out[_STIFF_YY],
        )
        work[_PRESSED, i] = out[_PRESSING]
        energy += face_width * out[_STORED]
        energy -= drag_x * (work[_TRIAL_X, i] - work[_FROM_X, i]) + drag_y * (
            work[_TRIAL_Y, i] - work[_FROM_Y, i]
        )
    last, turn = rollers - 1, constants[PITCH_ANGLE]
    pull_x, pull_y = -math.cos(tight_angle), -math.sin(tight_angle)
    pull_x, pull_y = constants[TIGHT_TENSION] * pull_x, constants[TIGHT_TENSION] * pull_y
    work[_RIGHT_X, 0] += pull_x
    work[_RIGHT_Y, 0] += pull_y
    energy -= pull_x * (work[_TRIAL_X, 0] - work[_FROM_X, 0]) + pull_y * (
        work[_TRIAL_Y, 0] - work[_FROM_Y, 0]
    )
    # The slack strand goes off at slack_angle below the tangent of the last gap's own frame.
    pull_x = constants[SLACK_TENSION] * math.cos(slack_angle)
    pull_y = -constants[SLACK_TENSION] * math.sin(slack_angle)
    work[_RIGHT_X, last] += pull_x
    work[_RIGHT_Y, last] += pull_y
    energy -= pull_x * (work[_TRIAL_X, last] - work[_FROM_X, last])
    energy -= pull_y * (work[_TRIAL_Y, last] - work[_FROM_Y, last])
    c, s = math.cos(turn), math.sin(turn)
    for i in range(rollers - 1):
        natural = constants[PITCH_EVEN] if (i + kind) % 2 == 0 else constants[PITCH_ODD]
        ex = c * work[_TRIAL_X, i + 1] + s * work[_TRIAL_Y, i + 1] - work[_TRIAL_X, i]
        ey = c * work[_TRIAL_Y, i + 1] - s * work[_TRIAL_X, i + 1] - work[_TRIAL_Y, i]
        length = math.sqrt(ex * ex + ey * ey)
        pull = spring * (length - natural)
        if not pull > 0.0:
            work[_LXX, i], work[_LXY, i], work[_LYX, i], work[_LYY, i] = 0.0, 0.0, 0.0, 0.0
            continue
        energy += 0.5 * pull * (length - natural)
        ex, ey = ex / length, ey / length
        across = pull / length
        work[_RIGHT_X, i] += pull * ex
        work[_RIGHT_Y, i] += pull * ey
        work[_RIGHT_X, i + 1] -= pull * (c * ex - s * ey)
        work[_RIGHT_Y, i + 1] -= pull * (s * ex + c * ey)
        xx, xy = spring * ex * ex + across * ey * ey, (spring - across) * ex * ey
        yy = spring * ey * ey + across * ex * ex
        work[_XX, i] += xx
        work[_XY, i] += xy
        work[_YY, i] += yy
        ax, ay, bx, by = c * xx - s * xy, c * xy - s * yy, s * xx + c * xy, s * xy + c * yy
        work[_XX, i + 1] += ax * c - ay * s
        work[_XY, i + 1] += ax * s + ay * c
        work[_YY, i + 1] += bx * s + by * c
        work[_LXX, i], work[_LXY, i] = xy * s - xx * c, -(xx * s + xy * c)
        work[_LYX, i], work[_LYY, i] = yy * s - xy * c, -(xy * s + yy * c)
    return energy


@kernel(int64(int64, float64, TABLE))
def wrap_step(rollers: int, shift: float, work: Vector) -> int:
    """Write the step that the forces ask for, each roller held by a spring ``shift``; 1 if not stable."""
    for i in range(rollers):
        xx, xy, yy = work[_XX, i] + shift, work[_XY, i], work[_YY, i] + shift
        right_x, right_y = work[_RIGHT_X, i], work[_RIGHT_Y, i]
        if i > 0:
            lxx, lxy, lyx, lyy = work[_LXX, i - 1], work[_LXY, i - 1], work[_LYX, i - 1], work[_LYY, i - 1]
            ixx, ixy, iyy = work[_IXX, i - 1], work[_IXY, i - 1], work[_IYY, i - 1]
            ax, bx = ixx * lxx + ixy * lyx, ixx * lxy + ixy * lyy
            ay, by = ixy * lxx + iyy * lyx, ixy * lxy + iyy * lyy
            xx -= lxx * ax + lyx * ay
            xy -= lxx * bx + lyx * by
            yy -= lxy * bx + lyy * by
            right_x -= ax * work[_DOWN_X, i - 1] + ay * work[_DOWN_Y, i - 1]
            right_y -= bx * work[_DOWN_X, i - 1] + by * work[_DOWN_Y, i - 1]
        pivot = xx * yy - xy * xy
        if not (xx > 0.0 and yy > 0.0 and pivot > 1e-14 * xx * yy):
            return 1
        work[_IXX, i], work[_IXY, i], work[_IYY, i] = yy / pivot, -xy / pivot, xx / pivot
        work[_DOWN_X, i], work[_DOWN_Y, i] = right_x, right_y
    for i in range(rollers - 1, -1, -1):
        right_x, right_y = work[_DOWN_X, i], work[_DOWN_Y, i]
        if i < rollers - 1:
            right_x -= work[_LXX, i] * work[_STEP_X, i + 1] + work[_LXY, i] * work[_STEP_Y, i + 1]
            right_y -= work[_LYX, i] * work[_STEP_X, i + 1] + work[_LYY, i] * work[_STEP_Y, i + 1]
        work[_STEP_X, i] = work[_IXX, i] * right_x + work[_IXY, i] * right_y
        work[_STEP_Y, i] = work[_IXY, i] * right_x + work[_IYY, i] * right_y
    return 0


@kernel(float64(int64, int64, TABLE))
def largest_of(rollers: int, row: int, work: Vector) -> float:
    """Return the largest entry by amount of two rows of the table of work."""
    found = 0.0
    for i in range(rollers):
        found = max(found, abs(work[row, i]), abs(work[row + 1, i]))
    return found


@kernel(void(int64, int64, int64, TABLE, TABLE, TABLE, int64, float64, TABLE, TABLE, TABLE))
def look_around(
    event: int,
    i: int,
    body: int,
    x: Vector,
    y: Vector,
    recess: Vector,
    reach: int,
    radius: float,
    seats: Vector,
    work: Vector,
    cells: Vector,
) -> None:
    """Find the cells that a roller may press from its trial place."""
    found = cells[CELL_ROWS + 1]
    near_cells(
        x[body],
        y[body],
        recess[i],
        reach,
        radius,
        work[_TRIAL_X, i],
        work[_TRIAL_Y, i],
        seats[NEAREST, event + i],
        cells[_FORCE],
        found,
    )
    seats[NEAREST, event + i] = found[_NEAREST_SEEN]
    work[_SEEN_X, i], work[_SEEN_Y, i] = work[_TRIAL_X, i], work[_TRIAL_Y, i]


@kernel(
    int64(
        int64,
        int64,
        int64,
        VECTOR,
        float64,
        float64,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        int64,
        int64,
        float64,
        float64,
        float64,
        TABLE,
        TABLE,
        TABLE,
    )
)
def balance_rollers(
    event: int,
    rollers: int,
    kind: int,
    constants: Vector,
    tight_angle: float,
    slack_angle: float,
    x: Vector,
    y: Vector,
    width: Vector,
    compliance: Vector,
    recess: Vector,
    pressures: Vector,
    holds: int,
    reach: int,
    radius: float,
    face_width: float,
    tolerance: float,
    seats: Vector,
    work: Vector,
    cells: Vector,
) -> int:
    """Bring the rollers of one phase into balance, by Newton steps of limited length; the energy falls.

    The seats from column ``event`` on hold where to start and take the answer. ``holds`` 1: the cells
    that pressed last are held in the first step, so that a roller which the tooth has receded
    from comes back to it at once.
    """
    found, tried = cells[CELL_ROWS + 1], cells[CELL_ROWS + 2 :]
    bodies, longest, came_upon = x.shape[0], _MARGIN * radius, 0
    for i in range(rollers):
        work[_TRIAL_X, i], work[_TRIAL_Y, i] = seats[SEAT_X, event + i], seats[SEAT_Y, event + i]
        work[_FROM_X, i], work[_FROM_Y, i] = work[_TRIAL_X, i], work[_TRIAL_Y, i]
        look_around(event, i, (i + kind) % bodies, x, y, recess, reach, radius, seats, work, cells)
        work[_LOW, i], work[_HIGH, i] = found[_FIRST_SEEN], found[_PAST_SEEN]
        if holds == 1 and seats[LAST, event + i] > seats[FIRST, event + i]:
            work[_LOW, i] = min(found[_FIRST_SEEN], seats[FIRST, event + i])
            work[_HIGH, i] = max(found[_PAST_SEEN], seats[LAST, event + i])
    if holds == 1:
        wrap_balance(
            event,
            rollers,
            kind,
            constants,
            tight_angle,
            slack_angle,
            x,
            y,
            width,
            compliance,
            recess,
            pressures[event : event + rollers],
            1,
            radius,
            face_width,
            seats,
            work,
            cells,
        )
        if wrap_step(rollers, 0.0, work) == 0 and largest_of(rollers, _STEP_X, work) < 10.0 * longest:
            for i in range(rollers):
                work[_TRIAL_X, i] += work[_STEP_X, i]
                work[_TRIAL_Y, i] += work[_STEP_Y, i]
                look_around(event, i, (i + kind) % bodies, x, y, recess, reach, radius, seats, work, cells)
                work[_LOW, i], work[_HIGH, i] = found[_FIRST_SEEN], found[_PAST_SEEN]
    for i in range(rollers):
        seats[SEAT_X, event + i], seats[SEAT_Y, event + i] = work[_TRIAL_X, i], work[_TRIAL_Y, i]
    energy = wrap_balance(
        event,
        rollers,
        kind,
        constants,
        tight_angle,
        slack_angle,
        x,
        y,
        width,
        compliance,
        recess,
        tried,
        0,
        radius,
        face_width,
        seats,
        work,
        cells,
    )
    error = largest_of(rollers, _RIGHT_X, work)
    # Of a wrap that is nearly straight and lightly pulled the energy may be near 0, and its rounding is not.
    rounding = DIGITS * constants[TIGHT_TENSION] * (abs(work[_TRIAL_X, 0]) + abs(work[_TRIAL_Y, 0]))
    for _ in range(_MAX_ITERATIONS):
        if error <= tolerance:
            return SEATED
        shift = 0.0
        while wrap_step(rollers, shift, work) != 0:
            shift = max(16.0 * shift, 1e-4 * constants[STIFFNESS])
            if shift > _STIFFEST:
                return STALLED
        whole = largest_of(rollers, _STEP_X, work)
        step = min(whole, longest)
        if step < whole:
            for i in range(rollers):
                work[_STEP_X, i] *= step / whole
                work[_STEP_Y, i] *= step / whole
        slope = 0.0
        for i in range(rollers):
            body = (i + kind) % bodies
            slope -= work[_STEP_X, i] * work[_RIGHT_X, i] + work[_STEP_Y, i] * work[_RIGHT_Y, i]
            work[_TRIAL_X, i] = seats[SEAT_X, event + i] + work[_STEP_X, i]
            work[_TRIAL_Y, i] = seats[SEAT_Y, event + i] + work[_STEP_Y, i]
            away_x, away_y = work[_TRIAL_X, i] - work[_SEEN_X, i], work[_TRIAL_Y, i] - work[_SEEN_Y, i]
            if away_x * away_x + away_y * away_y > _MARGIN * _MARGIN * radius * radius:
                low, high = work[_LOW, i], work[_HIGH, i]
                look_around(event, i, body, x, y, recess, reach, radius, seats, work, cells)
                if found[_PAST_SEEN] > found[_FIRST_SEEN]:
                    work[_LOW, i] = min(low, found[_FIRST_SEEN]) if high > low else found[_FIRST_SEEN]
                    work[_HIGH, i] = max(high, found[_PAST_SEEN]) if high > low else found[_PAST_SEEN]
        after = wrap_balance(
            event,
            rollers,
            kind,
            constants,
            tight_angle,
            slack_angle,
            x,
            y,
            width,
            compliance,
            recess,
            tried,
            0,
            radius,
            face_width,
            seats,
            work,
            cells,
        )
        left = largest_of(rollers, _RIGHT_X, work)
        level = abs(after - energy) <= _ROUNDING * abs(energy) + rounding
        falls = after < energy if came_upon == 1 else after <= energy + 1e-4 * slope
        if falls or (level and left < error):
            gain = 1.0 if level or came_upon == 1 else (after - energy) / slope
            came_upon = 0
            longest *= 3.0 if gain > 0.75 else (0.5 if gain < 0.25 else 1.0)
            for i in range(rollers):
                seats[SEAT_X, event + i], seats[SEAT_Y, event + i] = work[_TRIAL_X, i], work[_TRIAL_Y, i]
            energy, error = after, left
        else:
            # The cells that the step came upon press or pull in the next one.
            longest, came_upon = 0.25 * step, 1
            if longest < 1e-13 * radius:
                return STALLED
            for i in range(rollers):
                work[_TRIAL_X, i], work[_TRIAL_Y, i] = seats[SEAT_X, event + i], seats[SEAT_Y, event + i]
            wrap_balance(
                event,
                rollers,
                kind,
                constants,
                tight_angle,
                slack_angle,
                x,
                y,
                width,
                compliance,
                recess,
                tried,
                1,
                radius,
                face_width,
                seats,
                work,
                cells,
            )
    return STALLED


@kernel(
    int64(
        int64,
        int64,
        int64,
        VECTOR,
        float64,
        float64,
        float64,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        int64,
        int64,
        float64,
        float64,
        float64,
        TABLE,
        TABLE,
        TABLE,
    )
)
def seat_rollers(
    event: int,
    rollers: int,
    kind: int,
    constants: Vector,
    tight_angle: float,
    slack_angle: float,
    friction: float,
    x: Vector,
    y: Vector,
    width: Vector,
    compliance: Vector,
    recess: Vector,
    pressures: Vector,
    holds: int,
    reach: int,
    radius: float,
    face_width: float,
    tolerance: float,
    seats: Vector,
    work: Vector,
    cells: Vector,
) -> int:
    """Find where the rollers of one phase rest, friction included, and write how they press.

    Friction is a fraction of the force across it and acts towards the last cell where it is positive;
    it is renewed until it agrees with the force. ``pressures`` has a row for every column of ``seats``.
    """
    status, bodies = STALLED, x.shape[0]
    for _ in range(_MAX_DRAGS):
        status = balance_rollers(
            event,
            rollers,
            kind,
            constants,
            tight_angle,
            slack_angle,
            x,
            y,
            width,
            compliance,
            recess,
            pressures,
            holds,
            reach,
            radius,
            face_width,
            tolerance,
            seats,
            work,
            cells,
        )
        change, holds = 0.0, 0
        for i in range(rollers):
            load_x, load_y = work[_LOAD_X, i], work[_LOAD_Y, i]
            seats[LOAD_X, event + i], seats[LOAD_Y, event + i] = load_x, load_y
            drag_x, drag_y = -friction * face_width * load_y, friction * face_width * load_x
            change = max(
                change, abs(drag_x - seats[DRAG_X, event + i]), abs(drag_y - seats[DRAG_Y, event + i])
            )
            seats[DRAG_X, event + i], seats[DRAG_Y, event + i] = drag_x, drag_y
        if status != SEATED or friction == 0.0 or change <= 10.0 * tolerance:
            break
    for i in range(rollers):
        body = (i + kind) % bodies
        for j in range(int(seats[FIRST, event + i]), int(seats[LAST, event + i])):
            pressures[event + i, j] = 0.0
        first, last = int(work[_LOW, i]), int(work[_HIGH, i])
        moment, whole = 0.0, 0.0
        for j in range(first, last):
            dx, dy = seats[SEAT_X, event + i] - x[body, j], seats[SEAT_Y, event + i] - y[body, j]
            over = max(radius - math.sqrt(dx * dx + dy * dy) + recess[i, j], 0.0)
            pressures[event + i, j] = over / compliance[i, j]
            whole += pressures[event + i, j]
            moment += pressures[event + i, j] * j
        seats[FIRST, event + i], seats[LAST, event + i] = first, max(first, last)
        seats[HALF_WIDTH, event + i] = 0.5 * work[_PRESSED, i]
        seats[PLACE, event + i] = moment / whole if whole > 0.0 else -1.0
    return status
