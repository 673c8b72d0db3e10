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

# rows of the table of work, a column for every roller: what pulls on it, the stiffness against that and
# that of the link to the next one; the same where the last step began; then its factors, step, places and
# cells
_RIGHT_X, _RIGHT_Y, _XX, _XY, _YY, _LXX, _LXY, _LYX, _LYY = range(9)
_BALANCE = 9
_IXX, _IXY, _IYY, _DOWN_X, _DOWN_Y, _STEP_X, _STEP_Y = range(2 * _BALANCE, 2 * _BALANCE + 7)
_TRIAL_X, _TRIAL_Y, _FROM_X, _FROM_Y, _SEEN_X, _SEEN_Y, _LOW, _HIGH, _PRESSED, _LOAD_X, _LOAD_Y = range(
    25, 36
)
SEAT_WORK_ROWS = 36

# rows of the table of cells: what a foundation answers, cells that a roller may press, directions, how far
# cells are beyond its reach, three rows of overlaps; then, at its trial place, the pressures of every
# roller, and behind them the parts of the cells that press
_ANSWER, _SEEN, _PULLS, _BEYOND, _NEAR = 0, 1, 2, 3, 4
CELL_ROWS = 7

# what a foundation answers: force per width, stiffness, energy, width that presses
_PUSH_X, _PUSH_Y, _STIFF_XX, _STIFF_XY, _STIFF_YY, _STORED, _PRESSING = range(7)

# cells that a roller may press: the first, the one after the last, the nearest
_FIRST_SEEN, _PAST_SEEN, _NEAREST_SEEN = range(3)

# directions: cosine and sine of the pitch angle, pulls of both strands
_COSINE, _SINE, _TIGHT_X, _TIGHT_Y, _SLACK_X, _SLACK_Y = range(6)

_MARGIN = 0.002
"""Distance within which cells are looked at, in radii of the roller; the first longest step too."""

_MAX_ITERATIONS = 4000
_MAX_DRAGS = 60
_STIFFEST = 1e14
_ROUNDING = 1e-11


@kernel(void(VECTOR, VECTOR, VECTOR, VECTOR, int64, float64, float64, float64, float64, VECTOR, VECTOR))
def near_cells(
    x: Vector,
    y: Vector,
    rest: Vector,
    raised: Vector,
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
    other = k + 1 if k + 1 < x.size else k - 1
    spacing_x, spacing_y = x[other] - x[k], y[other] - y[k]
    # A roller that presses between two nodes is this far from both of them.
    between = 0.5 * (spacing_x * spacing_x + spacing_y * spacing_y) / radius
    wide = (1.0 + _MARGIN) * radius + between
    for j in range(low, high):
        dx, dy, within = cx - x[j], cy - y[j], wide + rest[j] + raised[j]
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
    if last > first:
        # A cell may press with a part of its width where its middle does not.
        first, last = max(first - 1, 0), min(last + 1, x.size)
    found[_FIRST_SEEN], found[_PAST_SEEN] = first, last if last > first else low
    found[_NEAREST_SEEN] = k


@kernel(void(VECTOR, VECTOR, VECTOR, int64, int64, float64, float64, float64, VECTOR, VECTOR, VECTOR))
def overlaps(
    x: Vector,
    y: Vector,
    rest: Vector,
    first: int,
    last: int,
    radius: float,
    cx: float,
    cy: float,
    over: Vector,
    along_x: Vector,
    along_y: Vector,
) -> None:
    """Write how far a roller reaches into cells and one beside them, and the directions to its centre.

    Column j + 1 is that of cell j; the outline goes on straight beyond its end cells.
    """
    for j in range(max(first - 1, 0), min(last + 1, x.size)):
        dx, dy = cx - x[j], cy - y[j]
        distance = math.sqrt(dx * dx + dy * dy)
        over[j + 1], along_x[j + 1], along_y[j + 1] = (
            radius - distance + rest[j],
            dx / distance,
            dy / distance,
        )
    for k, m in ((0, 1), (x.size - 1, x.size - 2)):
        j = 2 * k - m
        if first - 1 <= j <= last:
            dx, dy = cx - (2.0 * x[k] - x[m]), cy - (2.0 * y[k] - y[m])
            distance = math.sqrt(dx * dx + dy * dy)
            over[j + 1] = radius - distance + 2.0 * rest[k] - rest[m]
            along_x[j + 1], along_y[j + 1] = dx / distance, dy / distance


@kernel(
    void(
        VECTOR,
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
        TABLE,
        VECTOR,
        VECTOR,
        VECTOR,
    )
)
def foundation_force(
    x: Vector,
    y: Vector,
    width: Vector,
    compliance: Vector,
    rest: Vector,
    raised: Vector,
    first: int,
    last: int,
    radius: float,
    cx: float,
    cy: float,
    near: Vector,
    pressure: Vector,
    part: Vector,
    answer: Vector,
) -> None:
    """Write force per width on a roller, its stiffness, energy and the width that presses; and pressures.

    A cell presses along the line to the roller's centre with (overlap + rest + raised)/compliance. Within
    a cell, overlap and rest are the parabola through those of its own middle and of its neighbours',
    ``raised`` is of the cell as a whole, and their sum counts only where it is positive: so force and
    stiffness are smooth in the place of the roller, however few cells it presses. ``near`` takes what
    `overlaps` writes, ``pressure`` the mean over each cell, ``part`` how much of it presses.

    Equation physics.md (W15).
    """
    over, along_x, along_y = near[0], near[1], near[2]
    if last > first:
        overlaps(x, y, rest, first, last, radius, cx, cy, over, along_x, along_y)
    fx, fy, xx, xy, yy, stored, pressed = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(first, last):
        pressure[j], part[j] = 0.0, 0.0
    for j in range(first, last):
        over_before, top, over_after = over[j], over[j + 1] + raised[j], over[j + 2]
        # top + rise t + bend t^2/2 for t from -1/2 to 1/2, about the middle of the cell
        rise, bend = 0.5 * (over_after - over_before), over_after - 2.0 * over[j + 1] + over_before
        left, right = top - 0.5 * rise + 0.125 * bend, top + 0.5 * rise + 0.125 * bend
        discriminant = rise * rise - 2.0 * bend * top
        turns = abs(rise) < 0.5 * abs(bend) and discriminant > 0.0
        if left <= 0.0 and right <= 0.0 and not (turns and bend < 0.0):
            continue
        # integrals of 1, t, t^2, t^3, t^4 over what presses
        p0, p1, p2, p3, p4 = 1.0, 0.0, 1.0 / 12.0, 0.0, 1.0 / 80.0
        if left <= 0.0 or right <= 0.0 or (turns and bend > 0.0):
            bend = bend if bend != 0.0 else 1e-30
            root = math.sqrt(max(discriminant, 0.0))
            far = -rise - root if rise > 0.0 else root - rise
            one, two = far / bend, 2.0 * top / far
            least, most = min(one, two), max(one, two)
            # A valley leaves two parts of the cell, a hill one.
            low, high = (max(-0.5, least), min(0.5, most)) if bend < 0.0 else (-0.5, min(0.5, least))
            p0, p1, p2, p3, p4 = 0.0, 0.0, 0.0, 0.0, 0.0
            for _ in range(2):
                if high > low:
                    low_2, high_2 = low * low, high * high
                    p0 += high - low
                    p1 += (high_2 - low_2) / 2.0
                    p2 += (high_2 * high - low_2 * low) / 3.0
                    p3 += (high_2 * high_2 - low_2 * low_2) / 4.0
                    p4 += (high_2 * high_2 * high - low_2 * low_2 * low) / 5.0
                low, high = (max(-0.5, most), 0.5) if bend > 0.0 else (0.0, 0.0)
        # integrals of the overlap, and of that times t and t^2
        i0 = top * p0 + rise * p1 + 0.5 * bend * p2
        i1 = top * p1 + rise * p2 + 0.5 * bend * p3
        i2 = top * p2 + rise * p3 + 0.5 * bend * p4
        softness = 1.0 / compliance[j]
        stiffness = width[j] * softness
        # The direction turns along the cell by m t + q t^2/2.
        nx, ny = along_x[j + 1], along_y[j + 1]
        mx, my = 0.5 * (along_x[j + 2] - along_x[j]), 0.5 * (along_y[j + 2] - along_y[j])
        qx, qy = along_x[j + 2] - 2.0 * nx + along_x[j], along_y[j + 2] - 2.0 * ny + along_y[j]
        turning = stiffness * i0 / radius
        fx += stiffness * (i0 * nx + i1 * mx + 0.5 * i2 * qx)
        fy += stiffness * (i0 * ny + i1 * my + 0.5 * i2 * qy)
        xx += stiffness * (p0 * nx * nx + 2.0 * p1 * nx * mx + p2 * mx * mx) - turning * ny * ny
        xy += stiffness * (p0 * nx * ny + p1 * (nx * my + ny * mx) + p2 * mx * my) + turning * nx * ny
        yy += stiffness * (p0 * ny * ny + 2.0 * p1 * ny * my + p2 * my * my) - turning * nx * nx
        stored += 0.5 * stiffness * (top * i0 + rise * i1 + 0.5 * bend * i2)
        pressed += p0 * width[j]
        pressure[j], part[j] = i0 * softness, p0
    answer[_PUSH_X], answer[_PUSH_Y] = fx, fy
    answer[_STIFF_XX], answer[_STIFF_XY], answer[_STIFF_YY] = xx, xy, yy
    answer[_STORED], answer[_PRESSING] = stored, pressed


@kernel(
    float64(
        int64,
        int64,
        int64,
        VECTOR,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
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
    x: Vector,
    y: Vector,
    width: Vector,
    compliance: Vector,
    rest: Vector,
    raised: Vector,
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
    answer, pulls = cells[_ANSWER], cells[_PULLS]
    energy: float = 0.0
    for i in range(rollers):
        body = (i + kind) % bodies
        foundation_force(
            x[body],
            y[body],
            width[body],
            compliance[i],
            rest[body],
            raised[i],
            int(work[_LOW, i]),
            int(work[_HIGH, i]),
            radius,
            work[_TRIAL_X, i],
            work[_TRIAL_Y, i],
            cells[_NEAR:CELL_ROWS],
            cells[CELL_ROWS + i],
            cells[CELL_ROWS + rollers + i],
            answer,
        )
        work[_LOAD_X, i], work[_LOAD_Y, i] = answer[_PUSH_X], answer[_PUSH_Y]
        drag_x, drag_y = seats[DRAG_X, event + i], seats[DRAG_Y, event + i]
        work[_RIGHT_X, i] = face_width * answer[_PUSH_X] + drag_x
        work[_RIGHT_Y, i] = face_width * answer[_PUSH_Y] + drag_y
        work[_XX, i], work[_XY, i], work[_YY, i] = (
            face_width * answer[_STIFF_XX],
            face_width * answer[_STIFF_XY],
            face_width * answer[_STIFF_YY],
        )
        work[_PRESSED, i] = answer[_PRESSING]
        energy += face_width * answer[_STORED]
        energy -= drag_x * (work[_TRIAL_X, i] - work[_FROM_X, i]) + drag_y * (
            work[_TRIAL_Y, i] - work[_FROM_Y, i]
        )
    last, c, s = rollers - 1, pulls[_COSINE], pulls[_SINE]
    work[_RIGHT_X, 0] += pulls[_TIGHT_X]
    work[_RIGHT_Y, 0] += pulls[_TIGHT_Y]
    energy -= pulls[_TIGHT_X] * (work[_TRIAL_X, 0] - work[_FROM_X, 0])
    energy -= pulls[_TIGHT_Y] * (work[_TRIAL_Y, 0] - work[_FROM_Y, 0])
    work[_RIGHT_X, last] += pulls[_SLACK_X]
    work[_RIGHT_Y, last] += pulls[_SLACK_Y]
    energy -= pulls[_SLACK_X] * (work[_TRIAL_X, last] - work[_FROM_X, last])
    energy -= pulls[_SLACK_Y] * (work[_TRIAL_Y, last] - work[_FROM_Y, last])
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


@kernel(void(int64, int64, int64, TABLE, TABLE, TABLE, TABLE, int64, float64, TABLE, TABLE, TABLE))
def look_around(
    event: int,
    i: int,
    body: int,
    x: Vector,
    y: Vector,
    rest: Vector,
    raised: Vector,
    reach: int,
    radius: float,
    seats: Vector,
    work: Vector,
    cells: Vector,
) -> None:
    """Find the cells that a roller may press from its trial place, and from any within the margin."""
    found = cells[_SEEN]
    near_cells(
        x[body],
        y[body],
        rest[body],
        raised[i],
        reach,
        radius,
        work[_TRIAL_X, i],
        work[_TRIAL_Y, i],
        seats[NEAREST, event + i],
        cells[_BEYOND],
        found,
    )
    seats[NEAREST, event + i] = found[_NEAREST_SEEN]
    work[_LOW, i], work[_HIGH, i] = found[_FIRST_SEEN], found[_PAST_SEEN]
    work[_SEEN_X, i], work[_SEEN_Y, i] = work[_TRIAL_X, i], work[_TRIAL_Y, i]


@kernel(void(VECTOR, float64, float64, VECTOR))
def point_pulls(constants: Vector, tight_angle: float, slack_angle: float, pulls: Vector) -> None:
    """Write the direction of the next gap's frame, and what both strands pull.

    The slack strand goes off at ``slack_angle`` below the tangent of the last gap's own frame.
    """
    pulls[_COSINE], pulls[_SINE] = math.cos(constants[PITCH_ANGLE]), math.sin(constants[PITCH_ANGLE])
    pulls[_TIGHT_X] = -constants[TIGHT_TENSION] * math.cos(tight_angle)
    pulls[_TIGHT_Y] = -constants[TIGHT_TENSION] * math.sin(tight_angle)
    pulls[_SLACK_X] = constants[SLACK_TENSION] * math.cos(slack_angle)
    pulls[_SLACK_Y] = -constants[SLACK_TENSION] * math.sin(slack_angle)


@kernel(
    int64(
        int64,
        int64,
        int64,
        VECTOR,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
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
    x: Vector,
    y: Vector,
    width: Vector,
    compliance: Vector,
    rest: Vector,
    raised: Vector,
    reach: int,
    radius: float,
    face_width: float,
    tolerance: float,
    seats: Vector,
    work: Vector,
    cells: Vector,
) -> int:
    """Bring the rollers of one phase into balance, by Newton steps of limited length; the energy falls.

    The seats from column ``event`` on hold where to start and take the answer.
    """
    bodies, longest = x.shape[0], _MARGIN * radius
    for i in range(rollers):
        work[_TRIAL_X, i], work[_TRIAL_Y, i] = seats[SEAT_X, event + i], seats[SEAT_Y, event + i]
        work[_FROM_X, i], work[_FROM_Y, i] = work[_TRIAL_X, i], work[_TRIAL_Y, i]
        look_around(event, i, (i + kind) % bodies, x, y, rest, raised, reach, radius, seats, work, cells)
    energy = wrap_balance(
        event,
        rollers,
        kind,
        constants,
        x,
        y,
        width,
        compliance,
        rest,
        raised,
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
        slope = 0.0
        for i in range(rollers):
            if step < whole:
                work[_STEP_X, i] *= step / whole
                work[_STEP_Y, i] *= step / whole
            slope -= work[_STEP_X, i] * work[_RIGHT_X, i] + work[_STEP_Y, i] * work[_RIGHT_Y, i]
            work[_TRIAL_X, i] = seats[SEAT_X, event + i] + work[_STEP_X, i]
            work[_TRIAL_Y, i] = seats[SEAT_Y, event + i] + work[_STEP_Y, i]
            away_x, away_y = work[_TRIAL_X, i] - work[_SEEN_X, i], work[_TRIAL_Y, i] - work[_SEEN_Y, i]
            if away_x * away_x + away_y * away_y > _MARGIN * _MARGIN * radius * radius:
                look_around(
                    event, i, (i + kind) % bodies, x, y, rest, raised, reach, radius, seats, work, cells
                )
            for row in range(_BALANCE):
                work[_BALANCE + row, i] = work[row, i]
        after = wrap_balance(
            event,
            rollers,
            kind,
            constants,
            x,
            y,
            width,
            compliance,
            rest,
            raised,
            radius,
            face_width,
            seats,
            work,
            cells,
        )
        left = largest_of(rollers, _RIGHT_X, work)
        level = abs(after - energy) <= _ROUNDING * abs(energy) + rounding
        if after <= energy + 1e-4 * slope or (level and left < error):
            gain = 1.0 if level else (after - energy) / slope
            longest *= 3.0 if gain > 0.75 else (0.5 if gain < 0.25 else 1.0)
            for i in range(rollers):
                seats[SEAT_X, event + i], seats[SEAT_Y, event + i] = work[_TRIAL_X, i], work[_TRIAL_Y, i]
            energy, error = after, left
        else:
            longest = 0.25 * step
            if longest < 1e-13 * radius:
                return STALLED
            for i in range(rollers):
                for row in range(_BALANCE):
                    work[row, i] = work[_BALANCE + row, i]
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
        TABLE,
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
    rest: Vector,
    raised: Vector,
    pressures: Vector,
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
    it is renewed until it agrees with the force. ``pressures`` has a row for every column of
    ``seats``, the mean over each cell, and behind them as many of the part of each cell that presses.
    """
    status = STALLED
    point_pulls(constants, tight_angle, slack_angle, cells[_PULLS])
    for _ in range(_MAX_DRAGS):
        status = balance_rollers(
            event,
            rollers,
            kind,
            constants,
            x,
            y,
            width,
            compliance,
            rest,
            raised,
            reach,
            radius,
            face_width,
            tolerance,
            seats,
            work,
            cells,
        )
        change = 0.0
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
        for j in range(int(seats[FIRST, event + i]), int(seats[LAST, event + i])):
            pressures[event + i, j], pressures[seats.shape[1] + event + i, j] = 0.0, 0.0
        first, last = int(work[_LOW, i]), int(work[_HIGH, i])
        moment, whole = 0.0, 0.0
        pressure, part = cells[CELL_ROWS + i], cells[CELL_ROWS + rollers + i]
        for j in range(first, last):
            pressures[event + i, j], pressures[seats.shape[1] + event + i, j] = pressure[j], part[j]
            whole += pressure[j]
            moment += pressure[j] * j
        while first < last and part[first] == 0.0:
            first += 1
        while last > first and part[last - 1] == 0.0:
            last -= 1
        seats[FIRST, event + i], seats[LAST, event + i] = first, max(first, last)
        seats[HALF_WIDTH, event + i] = 0.5 * work[_PRESSED, i]
        seats[PLACE, event + i] = moment / whole if whole > 0.0 else -1.0
    return status
