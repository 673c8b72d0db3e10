"""Elastic chain on the roller-centre loci of a wrapped sprocket: minimum of potential energy."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import TABLE, VECTOR, float64, int64, void
from wearsim.kernels.roller_locus import LOCUS_NORMAL_X, LOCUS_NORMAL_Y, LOCUS_X, LOCUS_Y

if TYPE_CHECKING:
    from wearsim.jit.signatures import Vector

SEATED, JUMPED, STALLED = 0, 1, 2
"""What a solve ends with: an equilibrium, a roller over a tip, or neither within the iterations."""

# rows of the table of work
CENTRE_X, CENTRE_Y, _DX, _DY, _DDX, _DDY = 0, 1, 2, 3, 4, 5
_GRADIENT, _DIAGONAL, _OFF, _STEP, _PIVOT, _DRAG_X, _DRAG_Y = 6, 7, 8, 9, 10, 11, 12
_FORCE_X, _FORCE_Y, NORMAL_X, NORMAL_Y, _ALOFT = 13, 14, 15, 16, 17
WORK_ROWS = 18

# constants of a solve
PITCH_ANGLE, STIFFNESS, PITCH_EVEN, PITCH_ODD = 0, 1, 2, 3
TIGHT_TENSION, SLACK_TENSION, FRICTION = 4, 5, 6
CONSTANTS = 7

_MAX_ITERATIONS = 5000
_MAX_ROUNDS = 200
_LONGEST_STEP = 12.0
_ROUNDING = 1e-11
DIGITS = 4e-15
"""Rounding of the energy over tension times radius: forces times differences of coordinates."""
_HANGING = 1e-4
"""How far a roller aloft may hang inside the tooth, in pitches."""


@kernel(int64(float64, float64, float64))
def engaged(wrap_angle: float, pitch_angle: float, phase: float) -> int:
    """Return the number of rollers between the straight strands."""
    return max(1, math.ceil(wrap_angle / pitch_angle + 1.0 - phase - 1e-9))


@kernel(int64(int64, int64, int64, int64, int64, int64, int64))
def same_roller(kind: int, phase: int, roller: int, side: int, kinds: int, phases: int, most: int) -> int:
    """Return where a roller stands in the phase before (side 0) or after (side 1), -1 where out of the wrap.

    Places count by kinds of links, phases and rollers. In the next pitch a roller counts one more from
    the tight end.
    """
    other, row, links = phase + 2 * side - 1, roller, kind
    if other < 0 or other >= phases:
        row = roller + (1 if side == 1 else -1)
        links = (kind + 1) % kinds
        other = 0 if side == 1 else phases - 1
    return (links * phases + other) * most + row if 0 <= row < most else -1


@kernel(void(TABLE, TABLE, int64, int64, VECTOR, float64, TABLE))
def place_rollers(
    locus: Vector, other: Vector, first: int, rollers: int, position: Vector, pitch_angle: float, work: Vector
) -> None:
    """Write place, first and second derivative and normal of every roller on its locus.

    ``locus`` and ``other``: rows x, y, normal x, normal y of the gaps that roller
    ``first`` = 0 and its neighbours sit in by turns; ``position`` counts their nodes.
    Between nodes the locus is the cubic with the nodes' tangents; gap i is turned
    clockwise by i pitch angles.
    """
    last = locus.shape[1] - 1
    for i in range(rollers):
        table = locus if (i + first) % 2 == 0 else other
        k = min(max(int(position[i]), 0), last - 1)
        t = position[i] - k
        x0, y0, x1, y1 = table[LOCUS_X, k], table[LOCUS_Y, k], table[LOCUS_X, k + 1], table[LOCUS_Y, k + 1]
        chord = math.sqrt((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0))
        ax, ay = -table[LOCUS_NORMAL_Y, k] * chord, table[LOCUS_NORMAL_X, k] * chord
        bx, by = -table[LOCUS_NORMAL_Y, k + 1] * chord, table[LOCUS_NORMAL_X, k + 1] * chord
        h1, h2, h3 = t * (t * (t - 2.0) + 1.0), t * t * (3.0 - 2.0 * t), t * t * (t - 1.0)
        d1, d2, d3 = t * (3.0 * t - 4.0) + 1.0, 6.0 * t * (1.0 - t), t * (3.0 * t - 2.0)
        c1, c2, c3 = 6.0 * t - 4.0, 6.0 - 12.0 * t, 6.0 * t - 2.0
        x, y = x0 + h1 * ax + h2 * (x1 - x0) + h3 * bx, y0 + h1 * ay + h2 * (y1 - y0) + h3 * by
        dx, dy = d1 * ax + d2 * (x1 - x0) + d3 * bx, d1 * ay + d2 * (y1 - y0) + d3 * by
        ex, ey = c1 * ax + c2 * (x1 - x0) + c3 * bx, c1 * ay + c2 * (y1 - y0) + c3 * by
        cosine, sine = math.cos(i * pitch_angle), math.sin(i * pitch_angle)
        work[CENTRE_X, i], work[CENTRE_Y, i] = cosine * x + sine * y, cosine * y - sine * x
        work[_DX, i], work[_DY, i] = cosine * dx + sine * dy, cosine * dy - sine * dx
        work[_DDX, i], work[_DDY, i] = cosine * ex + sine * ey, cosine * ey - sine * ex
        length = math.sqrt(dx * dx + dy * dy)
        work[NORMAL_X, i] = work[_DY, i] / length
        work[NORMAL_Y, i] = -work[_DX, i] / length


@kernel(float64(int64, int64, VECTOR, float64, float64, TABLE, VECTOR))
def balance(
    first: int,
    rollers: int,
    constants: Vector,
    tight_angle: float,
    slack_angle: float,
    work: Vector,
    tension: Vector,
) -> float:
    """Write forces, gradient and Hessian of the potential energy; return the energy.

    A link pulls only where it is longer than its pitch. Rollers aloft are left out: the
    links on both sides of them act as one. Friction acts as a dead force on each roller.

    Equation physics.md (W3).
    """
    stiffness = constants[STIFFNESS]
    angle = (rollers - 1) * constants[PITCH_ANGLE]
    tight_x, tight_y = -math.cos(tight_angle), -math.sin(tight_angle)
    slack_x = math.cos(angle + slack_angle)
    slack_y = -math.sin(angle + slack_angle)
    energy: float = 0.0
    before = -1
    for i in range(rollers):
        work[_FORCE_X, i], work[_FORCE_Y, i] = work[_DRAG_X, i], work[_DRAG_Y, i]
        work[_DIAGONAL, i], work[_OFF, i] = 0.0, 0.0
        tension[i + 1] = 0.0
        energy -= work[_DRAG_X, i] * work[CENTRE_X, i] + work[_DRAG_Y, i] * work[CENTRE_Y, i]
    natural, links = 0.0, 0
    pull_t, pull_s = constants[TIGHT_TENSION], constants[SLACK_TENSION]
    tension[0], tension[rollers] = pull_t, pull_s
    last = -1
    for i in range(rollers):
        if i > 0:
            natural += constants[PITCH_EVEN] if (i - 1 + first) % 2 == 0 else constants[PITCH_ODD]
            links += 1
        if work[_ALOFT, i] > 0.0:
            continue
        if before < 0:
            work[_FORCE_X, i] += pull_t * tight_x
            work[_FORCE_Y, i] += pull_t * tight_y
            energy -= pull_t * (tight_x * work[CENTRE_X, i] + tight_y * work[CENTRE_Y, i])
            for j in range(i):
                tension[j + 1] = pull_t
        else:
            ex, ey = (work[CENTRE_X, i] - work[CENTRE_X, before], work[CENTRE_Y, i] - work[CENTRE_Y, before])
            length = math.sqrt(ex * ex + ey * ey)
            spring = stiffness / links
            pull = spring * (length - natural)
            if pull > 0.0:
                energy += 0.5 * pull * (length - natural)
                ex, ey = ex / length, ey / length
                across = pull / length
                a1 = ex * work[_DX, before] + ey * work[_DY, before]
                a2 = ex * work[_DX, i] + ey * work[_DY, i]
                b1 = ex * work[_DY, before] - ey * work[_DX, before]
                b2 = ex * work[_DY, i] - ey * work[_DX, i]
                work[_DIAGONAL, before] += spring * a1 * a1 + across * b1 * b1
                work[_DIAGONAL, i] += spring * a2 * a2 + across * b2 * b2
                work[_OFF, before] = -(spring * a1 * a2 + across * b1 * b2)
                work[_FORCE_X, before] += pull * ex
                work[_FORCE_Y, before] += pull * ey
                work[_FORCE_X, i] -= pull * ex
                work[_FORCE_Y, i] -= pull * ey
                for j in range(before, i):
                    tension[j + 1] = pull
        before, natural, links = i, 0.0, 0
        last = i
    work[_FORCE_X, last] += pull_s * slack_x
    work[_FORCE_Y, last] += pull_s * slack_y
    energy -= pull_s * (slack_x * work[CENTRE_X, last] + slack_y * work[CENTRE_Y, last])
    for j in range(last, rollers):
        tension[j + 1] = pull_s
    for i in range(rollers):
        fx, fy = work[_FORCE_X, i], work[_FORCE_Y, i]
        work[_DIAGONAL, i] -= fx * work[_DDX, i] + fy * work[_DDY, i]
        work[_GRADIENT, i] = -(fx * work[_DX, i] + fy * work[_DY, i])
    return energy


@kernel(int64(int64, float64, float64, TABLE))
def newton_step(rollers: int, shift: float, stiffness: float, work: Vector) -> int:
    """Write the step of the shifted tridiagonal system; 1 where it is not positive definite."""
    before = -1
    for i in range(rollers):
        if work[_ALOFT, i] > 0.0:
            work[_STEP, i] = 0.0
            continue
        along = work[_DX, i] * work[_DX, i] + work[_DY, i] * work[_DY, i]
        pivot = work[_DIAGONAL, i] + shift * stiffness * along
        right = -work[_GRADIENT, i]
        if before >= 0:
            factor = work[_OFF, before] / work[_PIVOT, before]
            pivot -= factor * work[_OFF, before]
            right -= factor * work[_STEP, before]
        if not pivot > 1e-12 * stiffness * along:
            return 1
        work[_PIVOT, i], work[_STEP, i] = pivot, right
        before = i
    after = -1
    for i in range(rollers - 1, -1, -1):
        if work[_ALOFT, i] > 0.0:
            continue
        right = work[_STEP, i]
        if after >= 0:
            right -= work[_OFF, i] * work[_STEP, after]
        work[_STEP, i] = right / work[_PIVOT, i]
        after = i
    return 0


@kernel(float64(int64, TABLE))
def residual(rollers: int, work: Vector) -> float:
    """Return the largest force along a locus that nothing balances."""
    worst = 0.0
    for i in range(rollers):
        if work[_ALOFT, i] <= 0.0:
            along = math.sqrt(work[_DX, i] * work[_DX, i] + work[_DY, i] * work[_DY, i])
            worst = max(worst, abs(work[_GRADIENT, i]) / along)
    return worst


@kernel(int64(TABLE, TABLE, int64, int64, VECTOR, float64, float64, float64, VECTOR, TABLE, VECTOR, VECTOR))
def settle(
    locus: Vector,
    other: Vector,
    first: int,
    rollers: int,
    constants: Vector,
    tight_angle: float,
    slack_angle: float,
    tolerance: float,
    position: Vector,
    work: Vector,
    tension: Vector,
    trial: Vector,
) -> int:
    """Minimise the energy over the positions of the rollers that touch, by shifted Newton steps."""
    last = locus.shape[1] - 1
    shift = 0.0
    pitch_angle, stiffness = constants[PITCH_ANGLE], constants[STIFFNESS]
    place_rollers(locus, other, first, rollers, position, pitch_angle, work)
    energy = balance(first, rollers, constants, tight_angle, slack_angle, work, tension)
    error = residual(rollers, work)
    # Of a wrap that is nearly straight and lightly pulled the energy may be near 0, and its rounding is not.
    rounding = DIGITS * constants[TIGHT_TENSION] * (abs(work[CENTRE_X, 0]) + abs(work[CENTRE_Y, 0]))
    for _ in range(_MAX_ITERATIONS):
        if error <= tolerance:
            return SEATED
        while newton_step(rollers, shift, stiffness, work) != 0:
            shift = max(4.0 * shift, 1e-6)
            if shift > 1e12:
                return STALLED
        longest, slope = 0.0, 0.0
        for i in range(rollers):
            longest = max(longest, abs(work[_STEP, i]))
        scale = min(1.0, _LONGEST_STEP / longest) if longest > 0.0 else 1.0
        outside = 0
        for i in range(rollers):
            slope += scale * work[_STEP, i] * work[_GRADIENT, i]
            trial[i] = position[i] + scale * work[_STEP, i]
            outside += 1 if not 0.0 <= trial[i] <= last else 0
        if outside > 0 and scale * longest < 1e-3:
            return JUMPED
        for i in range(rollers):
            trial[i] = min(max(trial[i], 0.0), float(last))
        place_rollers(locus, other, first, rollers, trial, pitch_angle, work)
        after = balance(first, rollers, constants, tight_angle, slack_angle, work, tension)
        remaining = residual(rollers, work)
        level = abs(after - energy) <= _ROUNDING * abs(energy) + rounding and remaining < error
        if after <= energy + 1e-4 * slope or level:
            for i in range(rollers):
                position[i] = trial[i]
            energy, error = after, remaining
            shift = 0.2 * shift if shift > 1e-6 else 0.0
            if outside > 0 and longest > 0.0:
                for i in range(rollers):
                    if (position[i] == 0.0 and work[_GRADIENT, i] > 0.0) or (
                        position[i] == last and work[_GRADIENT, i] < 0.0
                    ):
                        return JUMPED
        else:
            shift = max(4.0 * shift, 1e-6)
            place_rollers(locus, other, first, rollers, position, pitch_angle, work)
            balance(first, rollers, constants, tight_angle, slack_angle, work, tension)
            if shift > 1e12:
                return STALLED
    return STALLED


@kernel(int64(int64, float64, TABLE))
def lift_off(rollers: int, tolerance: float, work: Vector) -> int:
    """Take the roller that its links pull off the tooth hardest out of contact; 0 if there is none."""
    worst, which = -tolerance, -1
    for i in range(rollers):
        if work[_ALOFT, i] == 0.0:
            pressing = -(work[_FORCE_X, i] * work[NORMAL_X, i] + work[_FORCE_Y, i] * work[NORMAL_Y, i])
            if pressing < worst:
                worst, which = pressing, i
    if which < 0:
        return 0
    work[_ALOFT, which] = 1.0
    work[_DRAG_X, which], work[_DRAG_Y, which] = 0.0, 0.0
    return 1


@kernel(float64(TABLE, float64, float64, float64))
def nearest_node(locus: Vector, x: float, y: float, allowed: float) -> float:
    """Return the node of a locus nearest to a roller behind it by more than allowed, else -1."""
    nearest, which = math.inf, 0
    for k in range(locus.shape[1]):
        dx, dy = x - locus[LOCUS_X, k], y - locus[LOCUS_Y, k]
        if dx * dx + dy * dy < nearest:
            nearest, which = dx * dx + dy * dy, k
    dx, dy = x - locus[LOCUS_X, which], y - locus[LOCUS_Y, which]
    behind = -(dx * locus[LOCUS_NORMAL_X, which] + dy * locus[LOCUS_NORMAL_Y, which])
    return float(which) if behind > allowed else -1.0


@kernel(void(int64, int64, VECTOR, float64, float64, TABLE))
def hang_rollers(
    first: int, rollers: int, constants: Vector, tight_angle: float, slack_angle: float, work: Vector
) -> None:
    """Write the places of the rollers aloft.

    A roller aloft hangs on the straight line between its neighbours in contact, or on the
    strand beyond the first or last of them; all links of that line stretch alike.
    """
    end = (rollers - 1) * constants[PITCH_ANGLE] + slack_angle
    before = -1
    for i in range(rollers):
        if work[_ALOFT, i] <= 0.0:
            before = i
            continue
        after = -1
        for j in range(rollers - 1, i, -1):
            after = j if work[_ALOFT, j] <= 0.0 else after
        way, whole, passed, links = 0.0, 0.0, 0, 0
        for j in range(max(before, 0), after if after >= 0 else rollers - 1):
            pitch = constants[PITCH_EVEN] if (j + first) % 2 == 0 else constants[PITCH_ODD]
            whole += pitch
            links += 1
            if (j < i and before >= 0) or (j >= i and before < 0):
                way += pitch
                passed += 1
        if before < 0:
            way += passed * constants[TIGHT_TENSION] / constants[STIFFNESS]
            x = work[CENTRE_X, after] - way * math.cos(tight_angle)
            y = work[CENTRE_Y, after] - way * math.sin(tight_angle)
        elif after < 0:
            way += passed * constants[SLACK_TENSION] / constants[STIFFNESS]
            x = work[CENTRE_X, before] + way * math.cos(end)
            y = work[CENTRE_Y, before] - way * math.sin(end)
        else:
            dx = work[CENTRE_X, after] - work[CENTRE_X, before]
            dy = work[CENTRE_Y, after] - work[CENTRE_Y, before]
            length = math.sqrt(dx * dx + dy * dy)
            part = (way + passed * (length - whole) / links) / length
            x = (1.0 - part) * work[CENTRE_X, before] + part * work[CENTRE_X, after]
            y = (1.0 - part) * work[CENTRE_Y, before] + part * work[CENTRE_Y, after]
        work[CENTRE_X, i], work[CENTRE_Y, i] = x, y


@kernel(int64(TABLE, TABLE, int64, int64, VECTOR, VECTOR, TABLE))
def seat_again(
    locus: Vector, other: Vector, first: int, rollers: int, constants: Vector, position: Vector, work: Vector
) -> int:
    """Put rollers back on the tooth that hang inside it, for good; return how many."""
    angle, back = constants[PITCH_ANGLE], 0
    for i in range(rollers):
        if work[_ALOFT, i] <= 0.0:
            continue
        x, y = work[CENTRE_X, i], work[CENTRE_Y, i]
        cosine, sine = math.cos(i * angle), math.sin(i * angle)
        table = locus if (i + first) % 2 == 0 else other
        node = nearest_node(
            table, cosine * x - sine * y, sine * x + cosine * y, _HANGING * constants[PITCH_EVEN]
        )
        if node >= 0.0:
            position[i], work[_ALOFT, i], back = node, -1.0, back + 1
    return back


@kernel(float64(int64, float64, TABLE))
def drag(rollers: int, friction: float, work: Vector) -> float:
    """Set the friction on every roller from its present force; return the largest change."""
    change = 0.0
    for i in range(rollers):
        if work[_ALOFT, i] <= 0.0:
            nx, ny = work[NORMAL_X, i], work[NORMAL_Y, i]
            pressing = -(work[_FORCE_X, i] * nx + work[_FORCE_Y, i] * ny)
            along = friction * max(0.0, pressing)
            fx, fy = -ny * along, nx * along
            change = max(change, abs(fx - work[_DRAG_X, i]), abs(fy - work[_DRAG_Y, i]))
            work[_DRAG_X, i], work[_DRAG_Y, i] = fx, fy
    return change


@kernel(int64(TABLE, TABLE, int64, int64, VECTOR, float64, float64, float64, VECTOR, TABLE, VECTOR, VECTOR))
def solve_wrap(
    locus: Vector,
    other: Vector,
    first: int,
    rollers: int,
    constants: Vector,
    tight_angle: float,
    slack_angle: float,
    tolerance: float,
    position: Vector,
    work: Vector,
    tension: Vector,
    force: Vector,
) -> int:
    """Find the equilibrium of the rollers in a wrap; ``position`` holds the start and the answer.

    ``first`` is 0 or 1: roller i sits in gap class (i + first) mod 2 and is followed by a
    link of the even or odd pitch likewise. ``tension`` (rollers + 1) runs from the tight
    strand to the slack one, ``force`` is what each tooth takes. A roller that its links
    pull off the tooth hangs between its neighbours; its force is zero. ``work`` takes the
    centres and, for rollers in contact, the normals. Friction, a fraction of the force,
    acts on each roller along the path, towards the last node where it is positive.

    Equation physics.md (W3).
    """
    friction = constants[FRICTION]
    for i in range(rollers):
        work[_ALOFT, i], work[_DRAG_X, i], work[_DRAG_Y, i] = 0.0, 0.0, 0.0
    status = STALLED
    for _ in range(_MAX_ROUNDS):
        status = settle(
            locus,
            other,
            first,
            rollers,
            constants,
            tight_angle,
            slack_angle,
            tolerance,
            position,
            work,
            tension,
            force,
        )
        if status == JUMPED:
            break
        lifted = lift_off(rollers, tolerance, work)
        settled = friction == 0.0 or drag(rollers, friction, work) <= tolerance
        if lifted == 0 and (settled or status == STALLED):
            hang_rollers(first, rollers, constants, tight_angle, slack_angle, work)
            if seat_again(locus, other, first, rollers, constants, position, work) == 0:
                break
        status = STALLED
    for i in range(rollers):
        pressing = -(work[_FORCE_X, i] * work[NORMAL_X, i] + work[_FORCE_Y, i] * work[NORMAL_Y, i])
        force[i] = pressing if work[_ALOFT, i] <= 0.0 else 0.0
    return status
