"""One implicit stage of the wear of all gaps: rollers in every phase rest in what they leave worn."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import TABLE, VECTOR, float64, int64, void
from wearsim.kernels.wrap_equilibrium import (
    CONSTANTS,
    FRICTION,
    PITCH_ANGLE,
    SEATED,
    TIGHT_TENSION,
    engaged,
    same_roller,
)
from wearsim.kernels.wrap_wear import SPACING, UNWORN_CURVATURE, recede, worn_width
from wearsim.kernels.wrap_yielding_seats import (
    AFTER,
    BEFORE,
    DRIFT_X,
    DRIFT_Y,
    FIRST,
    HALF_WIDTH,
    LAST,
    NEAREST,
    OWN_YIELD,
    PLACE,
    SEAT_X,
    SEAT_Y,
    SLIP,
    SPEED,
    seat_rollers,
)

if TYPE_CHECKING:
    from wearsim.jit.signatures import Vector

# rows of the table of blocks, after the constants of `wrap_equilibrium`
COUNT, PITCH_TIME = CONSTANTS, CONSTANTS + 1
BLOCK_ROWS = CONSTANTS + 2

# numbers of a stage
(
    WRAP_ANGLE,
    FACE_WIDTH,
    ARTICULATION_SLIP,
    PATH_SLIP,
    ROLLER_RADIUS,
    MODULUS,
    REACH,
    TOLERANCE,
    RATE_FACTOR,
    EXPONENT,
    SPEED_POWER,
    HARD_DEPTH,
    SOFTNESS,
    BEHIND,
    AHEAD,
) = range(15)
STAGE_NUMBERS = 15

# rows of the table of outlines, each for every body: points, cell width, depth, area, how fast the area
# grows by pressure, area not yet worn by the pressures known
OUTLINE_X, OUTLINE_Y, OUTLINE_WIDTH, OUTLINE_DEPTH, OUTLINE_AREA, YIELD, REST = range(7)
OUTLINES = 7

PHASE, PHASE_SHARE = range(2)
"""Rows of the phases of a pitch: how much of one is gone, and the part of the pitch that it stands for."""

_WINKLER = 8.0 / (3.0 * math.pi)
"""Compliance of every cell times modulus over half-width with which a Hertz contact keeps load and width."""

_EDGE = 0.2
"""Compliance of the cells at the edges of a contact as a part of that in its middle, at least."""

_LEAST_SWEEP = 0.05
"""Cells that a roller sweeps at least to have its wear spread."""

_SETTLED = 1e-2
"""Part of the wear of a stage by which its last two passes may differ."""

_FREE_PASSES = 2
"""Passes that take the new pressures alone; later ones take the mean of old and new, or they would swing."""

# rows of the table of sums: those of `spread`, the work of every body before a pass, and the pressures of
# the rollers of a phase, and the parts of cells that press, before they are seated
_FIRST_SUM, _SECOND_SUM, _MASSES, _BORDERS, WORK_BEFORE = range(5)


@kernel(float64(float64, float64, float64, float64))
def area_of_work(work: float, curvature: float, hard_depth: float, softness: float) -> float:
    """Return the area worn per unworn length of what would be worn if all were as hard as the surface."""
    hard = hard_depth * (1.0 - 0.5 * curvature * hard_depth) if hard_depth < math.inf else math.inf
    return work if work <= hard else hard + softness * (work - hard)


@kernel(void(int64, int64, float64, float64, int64, int64, TABLE))
def add_shifted(low: int, high: int, shift: float, sign: float, begin: int, end: int, sums: Vector) -> None:
    """Add the integral of the masses' cumulative sum from the left to every border of cells plus a shift."""
    first, second, masses, borders = sums[_FIRST_SUM], sums[_SECOND_SUM], sums[_MASSES], sums[_BORDERS]
    whole = math.floor(shift)
    part, ahead = shift - whole, int(whole)
    inside, beyond = min(max(low - ahead, begin), end + 1), min(max(high - ahead, begin), end + 1)
    for j in range(inside, beyond):
        k = j + ahead
        borders[j] += sign * (second[k] + part * (first[k] + 0.5 * part * masses[k]))
    rest = second[high] + first[high] * (part + ahead - high)
    for j in range(beyond, end + 1):
        borders[j] += sign * (rest + first[high] * j)


@kernel(void(int64, int64, float64, float64, TABLE, VECTOR, TABLE))
def spread(
    low: int, high: int, before: float, after: float, unworn: Vector, density: Vector, sums: Vector
) -> None:
    """Add the masses of cells to the area per unworn length, spread evenly over the cells swept."""
    n, whole, masses = unworn.shape[1], before + after, sums[_MASSES]
    if high <= low:
        return
    if whole < _LEAST_SWEEP:
        for j in range(low, high):
            density[j] += masses[j] / unworn[SPACING, j]
        return
    first, second, borders = sums[_FIRST_SUM], sums[_SECOND_SUM], sums[_BORDERS]
    first[low], second[low] = 0.0, 0.0
    for j in range(low, high):
        first[j + 1] = first[j] + masses[j]
        second[j + 1] = second[j] + first[j] + 0.5 * masses[j]
    begin, end = max(0, int(low - before) - 1), min(n, int(high + after) + 2)
    for j in range(begin, end + 1):
        borders[j] = 0.0
    add_shifted(low, high, before, 1.0, begin, end, sums)
    add_shifted(low, high, -after, -1.0, begin, end, sums)
    for j in range(begin, end):
        density[j] += (borders[j + 1] - borders[j]) / (whole * unworn[SPACING, j])


@kernel(void(TABLE, VECTOR, TABLE, TABLE))
def shape_outlines(works: Vector, numbers: Vector, unworn: Vector, outlines: Vector) -> None:
    """Write points and widths of all outlines from the work done on them."""
    bodies, n = works.shape
    for body in range(bodies):
        area, depth = outlines[OUTLINE_AREA * bodies + body], outlines[OUTLINE_DEPTH * bodies + body]
        for j in range(n):
            curvature = unworn[UNWORN_CURVATURE, j]
            area[j] = area_of_work(works[body, j], curvature, numbers[HARD_DEPTH], numbers[SOFTNESS])
        x, y = outlines[OUTLINE_X * bodies + body], outlines[OUTLINE_Y * bodies + body]
        recede(area, depth, x, y, unworn, 0, n)
        worn_width(depth, unworn, 0, n, outlines[OUTLINE_WIDTH * bodies + body])


@kernel(float64(int64, int64, TABLE, TABLE, VECTOR))
def worn_by_unit_pressure(event: int, events: int, blocks: Vector, seats: Vector, numbers: Vector) -> float:
    """Return the depth that a roller wears off in the cycles of a stage under 1 MPa."""
    worn: float = numbers[RATE_FACTOR] * blocks[event // events, COUNT] * seats[SLIP, event]
    if numbers[SPEED_POWER] != 0.0:
        speed = seats[SPEED, event]
        worn *= speed ** numbers[SPEED_POWER] if speed > 0.0 else 0.0
    return worn


@kernel(void(int64, int64, float64, int64, int64, TABLE, TABLE, VECTOR, TABLE, TABLE, TABLE, TABLE, TABLE))
def add_work(
    begin: int,
    end: int,
    sign: float,
    kinds: int,
    most: int,
    blocks: Vector,
    seats: Vector,
    numbers: Vector,
    unworn: Vector,
    pressures: Vector,
    outlines: Vector,
    works: Vector,
    sums: Vector,
) -> None:
    """Add what the pressures of some rollers wear off, or take it back by a negative sign.

    What a cell that presses in part loses is shared with its neighbour, so that it is taken off about the
    middle of that part: contacts would widen to whole cells else.
    """
    bodies, exponent, masses = outlines.shape[0] // OUTLINES, numbers[EXPONENT], sums[_MASSES]
    events = seats.shape[1] // blocks.shape[0]
    for event in range(begin, end):
        body = (event % most + event // (events // kinds) % kinds) % bodies
        first, last = int(seats[FIRST, event]), int(seats[LAST, event])
        worn = worn_by_unit_pressure(event, events, blocks, seats, numbers)
        if not worn > 0.0:
            continue
        width, pressure = outlines[OUTLINE_WIDTH * bodies + body], pressures[event]
        part = pressures[seats.shape[1] + event]
        for j in range(first, last):
            masses[j] = 0.0
        for j in range(first, last):
            p = pressure[j]
            if not p > 0.0:
                continue
            mass = sign * worn * width[j] * (p if exponent == 1.0 else part[j] * (p / part[j]) ** exponent)
            # Of a cell that presses in part the middle of the part is on the side of the pressed neighbour.
            before = part[j - 1] if j > first else 0.0
            after = part[j + 1] if j + 1 < last else 0.0
            beside = after + before
            aside = 0.5 * (1.0 - part[j]) * (after - before) / beside if beside > 0.0 else 0.0
            masses[j] += mass * (1.0 - abs(aside))
            if aside > 0.0:
                masses[j + 1] += mass * aside
            elif aside < 0.0:
                masses[j - 1] -= mass * aside
        spread(first, last, seats[BEFORE, event], seats[AFTER, event], unworn, works[body], sums)


@kernel(void(int64, int64, int64, int64, TABLE, TABLE, VECTOR, TABLE, TABLE, TABLE, TABLE))
def add_yields(
    begin: int,
    end: int,
    kinds: int,
    most: int,
    blocks: Vector,
    seats: Vector,
    numbers: Vector,
    unworn: Vector,
    pressures: Vector,
    outlines: Vector,
    sums: Vector,
) -> None:
    """Add how fast the wear of some rollers grows by their pressures; write how fast that of each does."""
    bodies, exponent, masses = outlines.shape[0] // OUTLINES, numbers[EXPONENT], sums[_MASSES]
    events = seats.shape[1] // blocks.shape[0]
    for event in range(begin, end):
        body = (event % most + event // (events // kinds) % kinds) % bodies
        first, last = int(seats[FIRST, event]), int(seats[LAST, event])
        seats[OWN_YIELD, event] = 0.0
        worn = worn_by_unit_pressure(event, events, blocks, seats, numbers)
        if not worn > 0.0:
            continue
        pressure, part = pressures[event], pressures[seats.shape[1] + event]
        before, after = seats[BEFORE, event], seats[AFTER, event]
        least = 0.0
        if exponent != 1.0:
            for j in range(first, last):
                least = max(least, 0.05 * pressure[j] / part[j] if part[j] > 0.0 else 0.0)
        for j in range(first, last):
            p = pressure[j]
            local = p / part[j] if part[j] > 0.0 else 0.0
            grows = 1.0 if exponent == 1.0 else exponent * max(local, least) ** (exponent - 1.0)
            masses[j] = worn * grows * unworn[SPACING, j] if p > 0.0 else 0.0
            own = masses[j] / (unworn[SPACING, j] * (1.0 + before + after))
            seats[OWN_YIELD, event] = max(seats[OWN_YIELD, event], own)
        spread(first, last, before, after, unworn, outlines[YIELD * bodies + body], sums)


@kernel(void(int64, int64, int64, int64, TABLE, TABLE, VECTOR, TABLE, TABLE, TABLE, TABLE, TABLE))
def yield_of_phase(
    begin: int,
    end: int,
    kinds: int,
    most: int,
    blocks: Vector,
    seats: Vector,
    numbers: Vector,
    unworn: Vector,
    pressures: Vector,
    outlines: Vector,
    works: Vector,
    sums: Vector,
) -> None:
    """Write how fast the pressures of a phase wear the outlines, and the work that these do not show yet."""
    bodies, n = works.shape
    for row in range(YIELD * bodies, OUTLINES * bodies):
        for j in range(n):
            outlines[row, j] = 0.0
    add_yields(begin, end, kinds, most, blocks, seats, numbers, unworn, pressures, outlines, sums)
    for body in range(bodies):
        rest, fast = outlines[REST * bodies + body], outlines[YIELD * bodies + body]
        for j in range(n):
            curvature = unworn[UNWORN_CURVATURE, j]
            area = area_of_work(works[body, j], curvature, numbers[HARD_DEPTH], numbers[SOFTNESS])
            rest[j] = outlines[OUTLINE_AREA * bodies + body, j] - area
            soft = outlines[OUTLINE_DEPTH * bodies + body, j] > numbers[HARD_DEPTH]
            fast[j] *= numbers[SOFTNESS] if soft else 1.0


@kernel(void(int64, int64, TABLE, TABLE, TABLE))
def take_mean(event: int, rollers: int, before: Vector, seats: Vector, pressures: Vector) -> None:
    """Replace the pressures of a phase by the mean of theirs and those before."""
    n = pressures.shape[1]
    for i in range(rollers):
        pressure, part = pressures[event + i], pressures[seats.shape[1] + event + i]
        for j in range(n):
            pressure[j] = 0.5 * (pressure[j] + before[i, j])
            part[j] = 0.5 * (part[j] + before[rollers + i, j])
        first, last = 0, n
        while first < n and pressure[first] == 0.0:
            first += 1
        while last > first and pressure[last - 1] == 0.0:
            last -= 1
        seats[FIRST, event + i], seats[LAST, event + i] = first, last


@kernel(void(float64, float64, float64, float64, int64, int64, VECTOR))
def springs(
    half: float, width: float, place: float, modulus: float, low: int, high: int, compliance: Vector
) -> None:
    """Write the elastic compliance of cells [mm/MPa], by where they lie in the contact as it was last.

    On springs of sqrt(a^2 - x^2)/E* a roller on a flat has the pressure, the width and the load of a
    Hertz contact of half-width a; where ``place`` is not known yet all springs are alike.

    Equation physics.md (W15).
    """
    if place < 0.0:
        for j in range(low, high):
            compliance[j] = _WINKLER * half / modulus
        return
    edge = _EDGE * _EDGE * half * half
    for j in range(low, high):
        x = (j - place) * width
        compliance[j] = math.sqrt(max(half * half - x * x, edge)) / modulus


@kernel(void(int64, int64, VECTOR, TABLE, TABLE, float64, int64, float64, TABLE, TABLE))
def slips(
    start: int,
    kinds: int,
    numbers: Vector,
    phases: Vector,
    constants: Vector,
    pitch_time: float,
    most: int,
    spacing: float,
    outlines: Vector,
    seats: Vector,
) -> None:
    """Write slip, speed and the cells swept of every roller of a block.

    Slip of an articulation is shared out over the phases of the first and the last position, the way
    along the path is half of that from the phase before and to the phase after, and at an end of the wrap
    twice the half that is known. A roller sweeps the cells half way to its next places, and those
    that it drifts over in the step of the wear.

    Equation physics.md (W9).
    """
    count, angle = phases.shape[1], constants[0, PITCH_ANGLE]
    bodies, n = outlines.shape[0] // OUTLINES, outlines.shape[1]
    for kind in range(kinds):
        for step in range(count):
            rollers = engaged(numbers[WRAP_ANGLE], angle, phases[PHASE, step])
            for i in range(most):
                here = start + (kind * count + step) * most + i
                seats[SLIP, here], seats[BEFORE, here], seats[AFTER, here] = 0.0, 0.0, 0.0
                if i >= rollers or seats[PLACE, here] < 0.0:
                    continue
                ends = (1.0 if i == 0 else 0.0) + (1.0 if i == rollers - 1 else 0.0)
                way, sides, last_half = 0.0, 0, 0.0
                for side in range(2):
                    place = same_roller(kind, step, i, side, kinds, count, most)
                    if place < 0:
                        continue
                    there = start + place
                    rollers_there = engaged(numbers[WRAP_ANGLE], angle, phases[PHASE, place // most % count])
                    if place % most < rollers_there and seats[PLACE, there] >= 0.0:
                        dx = seats[SEAT_X, there] - seats[SEAT_X, here]
                        dy = seats[SEAT_Y, there] - seats[SEAT_Y, here]
                        moved = math.sqrt(dx * dx + dy * dy)
                        way, sides = way + 0.5 * moved, sides + 1
                        # In its own pocket a roller turns the force without sweeping anything.
                        cells = seats[PLACE, there] - seats[PLACE, here]
                        half = 0.5 * min(abs(cells), moved / spacing)
                        last_half = half if cells > 0.0 else -half
                        seats[AFTER if cells > 0.0 else BEFORE, here] += half
                if sides == 1:
                    # Where the wrap begins or ends, the half on the other side is as long.
                    way *= 2.0
                    seats[BEFORE, here] += max(last_half, 0.0)
                    seats[AFTER, here] += max(-last_half, 0.0)
                body, k = (i + kind) % bodies, int(seats[NEAREST, here])
                x, y = outlines[OUTLINE_X * bodies + body], outlines[OUTLINE_Y * bodies + body]
                before, after = max(k - 1, 0), min(k + 1, n - 1)
                tx, ty = x[after] - x[before], y[after] - y[before]
                along = tx * seats[DRIFT_X, here] + ty * seats[DRIFT_Y, here]
                drift = along / (math.sqrt(tx * tx + ty * ty) * spacing)
                ahead, behind = drift * numbers[AHEAD], drift * numbers[BEHIND]
                seats[AFTER, here] += max(ahead, 0.0) + max(-behind, 0.0)
                seats[BEFORE, here] += max(behind, 0.0) + max(-ahead, 0.0)
                slip = (
                    ends * numbers[ARTICULATION_SLIP] * phases[PHASE_SHARE, step] + numbers[PATH_SLIP] * way
                )
                seats[SLIP, here] = slip
                seats[SPEED, here] = slip / (pitch_time * phases[PHASE_SHARE, step])


@kernel(
    int64(
        int64,
        int64,
        int64,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        VECTOR,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
    )
)
def sweep_phases(
    block: int,
    number: int,
    kinds: int,
    works: Vector,
    blocks: Vector,
    phases: Vector,
    unworn: Vector,
    seats: Vector,
    numbers: Vector,
    pressures: Vector,
    outlines: Vector,
    compliance: Vector,
    raised: Vector,
    work: Vector,
    cells: Vector,
    sums: Vector,
) -> int:
    """Seat the rollers of a block phase by phase, each phase on what all others have left.

    ``works`` holds what all pressures wear off, and is kept up to date. A cell recedes by what its pressure
    wears off, as fast as the pressures of all rollers of the phase together do.
    """
    most, count, constants = compliance.shape[0], phases.shape[1], blocks[block]
    angle, tight = constants[PITCH_ANGLE], constants[TIGHT_TENSION]
    bodies = outlines.shape[0] // OUTLINES
    n = outlines.shape[1]
    x = outlines[OUTLINE_X * bodies : (OUTLINE_X + 1) * bodies]
    y = outlines[OUTLINE_Y * bodies : (OUTLINE_Y + 1) * bodies]
    width = outlines[OUTLINE_WIDTH * bodies : (OUTLINE_WIDTH + 1) * bodies]
    rest = outlines[REST * bodies : (REST + 1) * bodies]
    before = sums[WORK_BEFORE + bodies :]
    reach = int(numbers[REACH])
    for kind in range(kinds):
        for step in range(count):
            rollers = engaged(numbers[WRAP_ANGLE], angle, phases[PHASE, step])
            event = ((block * kinds + kind) * count + step) * most
            end = event + rollers
            tight_angle = angle * (phases[PHASE, step] - 0.5)
            slack_angle = numbers[WRAP_ANGLE] - tight_angle - (rollers - 1) * angle
            yield_of_phase(
                event, end, kinds, most, blocks, seats, numbers, unworn, pressures, outlines, works, sums
            )
            for i in range(rollers):
                body, near = (i + kind) % bodies, int(seats[NEAREST, event + i])
                # A little beyond what the roller can reach, as the nearest cell may move.
                low, high = max(0, near - 2 * reach), min(n, near + 2 * reach + 1)
                half = max(seats[HALF_WIDTH, event + i], 2.0 * width[body, near])
                springs(
                    half,
                    width[body, near],
                    seats[PLACE, event + i],
                    numbers[MODULUS],
                    low,
                    high,
                    compliance[i],
                )
                fast = outlines[YIELD * bodies + body]
                pressure, own = pressures[event + i], seats[OWN_YIELD, event + i]
                for j in range(low, high):
                    grows = max(fast[j], own)
                    compliance[i, j] += grows
                    raised[i, j] = grows * pressure[j]
                part = pressures[seats.shape[1] + event + i]
                for j in range(n if number >= _FREE_PASSES else 0):
                    before[i, j], before[rollers + i, j] = pressure[j], part[j]
            add_work(
                event,
                end,
                -1.0,
                kinds,
                most,
                blocks,
                seats,
                numbers,
                unworn,
                pressures,
                outlines,
                works,
                sums,
            )
            status = seat_rollers(
                event,
                rollers,
                kind,
                constants,
                tight_angle,
                slack_angle,
                constants[FRICTION],
                x,
                y,
                width,
                compliance,
                rest,
                raised,
                pressures,
                reach,
                numbers[ROLLER_RADIUS],
                numbers[FACE_WIDTH],
                numbers[TOLERANCE] * tight,
                seats,
                work,
                cells,
            )
            if status != SEATED:
                return status
            if number >= _FREE_PASSES:
                take_mean(event, rollers, before, seats, pressures)
            add_work(
                event, end, 1.0, kinds, most, blocks, seats, numbers, unworn, pressures, outlines, works, sums
            )
    return SEATED


@kernel(
    int64(
        TABLE,
        TABLE,
        int64,
        int64,
        TABLE,
        TABLE,
        TABLE,
        VECTOR,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
        TABLE,
    )
)
def implicit_stage(
    base: Vector,
    works: Vector,
    passes: int,
    kinds: int,
    blocks: Vector,
    phases: Vector,
    seats: Vector,
    numbers: Vector,
    unworn: Vector,
    pressures: Vector,
    outlines: Vector,
    compliance: Vector,
    raised: Vector,
    work: Vector,
    cells: Vector,
    sums: Vector,
) -> int:
    """Replace a guess of the work done on all outlines by ``base`` plus that of the pressures in the end.

    Each pass seats the rollers on the outlines as they were after the pass before, phase by phase with
    the wear of all other phases as it is by then, until two passes agree. In a stage of no cycles
    nothing wears: the rollers are seated on the outlines of ``base``.

    Equations physics.md (W12) and (W16).
    """
    bodies, n = works.shape
    count, most, spacing = phases.shape[1], compliance.shape[0], unworn[SPACING, n // 2]
    events = seats.shape[1]
    for number in range(passes):
        shape_outlines(works, numbers, unworn, outlines)
        if number == 0:
            for body in range(bodies):
                for j in range(n):
                    works[body, j] = base[body, j]
            add_work(
                0, events, 1.0, kinds, most, blocks, seats, numbers, unworn, pressures, outlines, works, sums
            )
        for body in range(bodies):
            for j in range(n):
                sums[WORK_BEFORE + body, j] = works[body, j]
        for block in range(blocks.shape[0]):
            if not blocks[block, TIGHT_TENSION] > 0.0:
                continue
            status = sweep_phases(
                block,
                number,
                kinds,
                works,
                blocks,
                phases,
                unworn,
                seats,
                numbers,
                pressures,
                outlines,
                compliance,
                raised,
                work,
                cells,
                sums,
            )
            if status != SEATED:
                return status
            slips(
                block * kinds * count * most,
                kinds,
                numbers,
                phases,
                blocks[block : block + 1],
                blocks[block, PITCH_TIME],
                most,
                spacing,
                outlines,
                seats,
            )
        moved, worn = 0.0, 0.0
        for body in range(bodies):
            for j in range(n):
                works[body, j] = base[body, j]
        add_work(
            0, events, 1.0, kinds, most, blocks, seats, numbers, unworn, pressures, outlines, works, sums
        )
        for body in range(bodies):
            for j in range(n):
                moved += abs(works[body, j] - sums[WORK_BEFORE + body, j])
                worn += works[body, j] - base[body, j]
        if number > 0 and moved <= _SETTLED * worn:
            break
    return SEATED
