"""A roller pressed on a worn profile: half-space line contact with the wear of the step inside."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import TABLE, VECTOR, float64, int64, void

if TYPE_CHECKING:
    from wearsim.jit.signatures import Vector

CONVERGED, NOT_CONVERGED, OUT_OF_REACH, INVALID = range(4)

_GAP, _COSINE, _SINE, _WEAR, _MOBILITY, _FORCE, _DEFORMED, _STEP, _RESPONSE, _PRESSED = range(10)
_TRIAL, _TRIAL_DEFORMED, _COMPLIANCE, _RECESS, WORK_ROWS = range(10, 15)
"""Rows of the table to work in, and their number."""

CENTRE_X, CENTRE_Y, RADIUS, ALONG_X, ALONG_Y, LOAD, TOLERANCE, MOST_ITERATIONS = range(8)
"""Places of what is constant: the roller, the direction in which it is pressed, and when to end."""

APPROACH, _ERROR, _BALANCE, _CHANGED, FIRST, LAST, _ITERATIONS = range(7)
"""Places of the result; the first four are the state of the solver."""

SMALLEST_COSINE = 0.2
_ENDLESS = 1e100
_ROUNDING = 1e-14
_LOCAL = 3.0 * math.log(3.0) / math.pi


@kernel(void(float64, VECTOR))
def influence_coefficients(modulus: float, coefficients: Vector) -> None:
    """Write the half-space displacement of cell i by a force of 1 N/mm on cell j, by i - j.

    The size is 2 n - 1 for n cells, i - j = 0 in the middle. Constant pressure on a cell of
    a uniform line (K. L. Johnson, Contact Mechanics, section 2.4), distances s in cells:
    a = -2/(pi E*) integral over the cell of ln(s/n) ds [mm2/N]. The reference length of n cells
    (a constant in the displacement, which the approach absorbs) makes every coefficient
    positive and the matrix of any part of the line positive definite.

    Equation physics.md (W11).
    """
    n = (coefficients.size + 1) // 2
    for k in range(coefficients.size):
        inner, outer = abs(k - n + 1) - 0.5, abs(k - n + 1) + 0.5
        integral = outer * math.log(outer / n) - inner * math.log(abs(inner) / n) - 1.0
        coefficients[k] = -2.0 / (math.pi * modulus) * integral


@kernel(float64(VECTOR))
def local_compliance(coefficients: Vector) -> float:
    """Return how far a cell recedes against its neighbour under 1 N/mm, 3 ln 3/(pi E*)."""
    n = (coefficients.size + 1) // 2
    own: float = coefficients[n - 1]
    return own * 1.5 * math.log(3.0) / (1.0 + math.log(2.0 * n))


@kernel(float64(VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, VECTOR))
def roller_gap(
    x: Vector, y: Vector, recess: Vector, constants: Vector, gap: Vector, cosine: Vector, sine: Vector
) -> float:
    """Write gap, ``recess`` added, and direction of every cell along the roller's radius.

    A cell steeper than ``SMALLEST_COSINE`` is out of reach: cosine zero, endless gap. Returns
    the approach gap/cosine at which the first cell touches, endless where none can.
    """
    radius, along_x, along_y = constants[RADIUS], constants[ALONG_X], constants[ALONG_Y]
    level = _ENDLESS
    for j in range(x.size):
        to_x, to_y = constants[CENTRE_X] - x[j], constants[CENTRE_Y] - y[j]
        distance = math.sqrt(to_x * to_x + to_y * to_y)
        gap[j], cosine[j], sine[j] = _ENDLESS, 0.0, 0.0
        if to_x * along_x + to_y * along_y > SMALLEST_COSINE * distance:
            gap[j] = distance - radius + recess[j]
            cosine[j] = (to_x * along_x + to_y * along_y) / distance
            sine[j] = (to_x * along_y - to_y * along_x) / distance
            level = min(level, gap[j] / cosine[j])
    return level


@kernel(void(VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, VECTOR))
def displacement(
    force: Vector, cosine: Vector, sine: Vector, wear: Vector, coefficients: Vector, displaced: Vector
) -> None:
    """Write how far the cells recede by forces on them, elastically and by wear.

    A force acts along the radius through its cell and a cell recedes along its own, so the
    coefficient of the straight line is multiplied by the cosine between the two.
    ``wear``: depth worn off by a force of 1 N/mm on the cell.

    Equation physics.md (W11).
    """
    n, middle = force.size, (coefficients.size - 1) // 2
    for i in range(n):
        displaced[i] = wear[i] * force[i]
    for j in range(1, n, 2):  # in pairs: 1.5 times as fast
        if force[j - 1] == 0.0 and force[j] == 0.0:
            continue
        along, across = force[j] * cosine[j], force[j] * sine[j]
        along_2, across_2 = force[j - 1] * cosine[j - 1], force[j - 1] * sine[j - 1]
        row = coefficients[middle - j : middle - j + n + 1]
        for i in range(n):
            displaced[i] += cosine[i] * (along * row[i] + along_2 * row[i + 1]) + sine[i] * (
                across * row[i] + across_2 * row[i + 1]
            )
    if n % 2 == 1:
        along, across = force[n - 1] * cosine[n - 1], force[n - 1] * sine[n - 1]
        row = coefficients[middle - n + 1 : middle + 1]
        for i in range(n):
            displaced[i] += (along * cosine[i] + across * sine[i]) * row[i]


@kernel(void(VECTOR, VECTOR, float64))
def scale_to_load(force: Vector, cosine: Vector, load: float) -> None:
    """Scale the forces so that they carry the load."""
    carried = 0.0
    for j in range(force.size):
        carried += force[j] * cosine[j]
    for j in range(force.size):
        force[j] *= load / carried


@kernel(void(VECTOR, VECTOR, VECTOR, VECTOR, float64, float64, VECTOR))
def overlap_force(
    gap: Vector, cosine: Vector, width: Vector, wear: Vector, local: float, load: float, force: Vector
) -> None:
    """Write a first guess: pressure in proportion to the overlap of roller and profile.

    The overlap is divided by the wear and by (half-width)/E*, which gives a Hertz contact its
    peak pressure and width; the half-width is that of the guess before, the approach follows
    from the load by Newton's method on a convex piecewise linear function, from above.
    """
    n, half_width = gap.size, width[0]
    for _ in range(8):
        elastic, approach = local / _LOCAL * half_width, _ENDLESS
        for j in range(n):
            if cosine[j] > 0.0:
                alone = load / cosine[j] * (wear[j] + elastic / width[j])
                approach = min(approach, (gap[j] + alone) / cosine[j])
        for _ in range(40):
            carried, slope = 0.0, 0.0
            for j in range(n):
                over = approach * cosine[j] - gap[j]
                if over > 0.0:
                    stiffness = cosine[j] / (wear[j] + elastic / width[j])
                    carried += stiffness * over
                    slope += stiffness * cosine[j]
            if not carried > 1.001 * load:
                break
            approach -= (carried - load) / slope
        half_width = 0.0
        for j in range(n):
            over = approach * cosine[j] - gap[j]
            force[j] = over / (wear[j] + elastic / width[j]) if over > 0.0 else 0.0
            half_width += 0.5 * width[j] if over > 0.0 else 0.0


@kernel(void(VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, VECTOR))
def imbalance(
    force: Vector, deformed: Vector, cosine: Vector, mobility: Vector, pressed: Vector, state: Vector
) -> None:
    """Find the approach, the cells that may move, and how far the forces are from balance.

    A cell may move (``pressed`` 1) that carries force or that the roller would penetrate. The
    approach makes the steps -mobility (deformed - approach cosine) of these cells sum to zero
    load: the root of an increasing convex function, by Newton's method from above. ``state``:
    approach, largest step over largest force, sum of mobility gap^2, cells that changed.
    """
    n = force.size
    approach = _ENDLESS
    for newton in range(n):
        moved, weight = 0.0, 0.0
        for j in range(n):
            if force[j] > 0.0 or (newton > 0 and deformed[j] < approach * cosine[j]):
                moved += mobility[j] * cosine[j] * deformed[j]
                weight += mobility[j] * cosine[j] * cosine[j]
        if not moved / weight < approach:
            break
        approach = moved / weight
    step, largest, balance, changed = 0.0, 0.0, 0.0, 0.0
    for j in range(n):
        left = deformed[j] - approach * cosine[j]
        now = 1.0 if force[j] > 0.0 or left < 0.0 else 0.0
        changed += abs(now - pressed[j])
        pressed[j] = now
        largest = max(largest, force[j])
        step = max(step, abs(left) * mobility[j] * now)
        balance += left * left * mobility[j] * now
    state[APPROACH], state[_ERROR], state[_BALANCE], state[_CHANGED] = (
        approach,
        step / largest,
        balance,
        changed,
    )


@kernel(float64(VECTOR, VECTOR, VECTOR))
def energy(force: Vector, gap: Vector, deformed: Vector) -> float:
    """Return what the solution makes smallest: sum of force (gap + displacement / 2)."""
    total = 0.0
    for j in range(force.size):
        if force[j] > 0.0:
            total += 0.5 * force[j] * (gap[j] + deformed[j])
    return total


@kernel(int64(VECTOR, VECTOR, VECTOR, float64, float64, TABLE, VECTOR))
def first_force(
    pressure: Vector,
    width: Vector,
    coefficients: Vector,
    level: float,
    load: float,
    work: Vector,
    window: Vector,
) -> int:
    """Write the forces to start from and the window of cells outside which none can press.

    The pressure given is taken while the gap that is left below it, weighted by its forces,
    stays under their own displacement (a quarter of it where wear outweighs elasticity), else
    a guess from the overlap is. The solution's energy is not above that of these forces, and
    load times (approach - level) is at most twice that. Returns 1 where the guess was made.
    """
    n, guessed = width.size, 0
    gap, cosine, sine, wear = work[_GAP][0:n], work[_COSINE][0:n], work[_SINE][0:n], work[_WEAR][0:n]
    force, displaced = work[_FORCE][0:n], work[_DEFORMED][0:n]
    for j in range(n):
        usable = cosine[j] > 0.0 and pressure[j] > 0.0 and pressure[j] < _ENDLESS
        force[j] = pressure[j] * width[j] if usable else 0.0
    while True:
        first, last, through, own = n, 0, 0.0, 0.0
        for j in range(n):
            first = j if force[j] > 0.0 and j < first else first
            last = j + 1 if force[j] > 0.0 else last
        if last > first:
            scale_to_load(force, cosine, load)
            displacement(
                force[first:last],
                cosine[first:last],
                sine[first:last],
                wear[first:last],
                coefficients,
                displaced[first:last],
            )
            for j in range(first, last):
                if force[j] > 0.0:
                    through += force[j] * (gap[j] - level * cosine[j])
                    own += force[j] * displaced[j]
        if guessed == 1 or through < own:
            break
        guessed = 1
        overlap_force(gap, cosine, width, wear, local_compliance(coefficients), load, force)
    bound = level + (own + 2.0 * through) / load
    for j in range(n):
        if gap[j] < bound * cosine[j]:
            first, last = min(first, j), max(last, j + 1)
    window[0], window[1] = first, last
    return guessed


@kernel(int64(VECTOR, VECTOR, TABLE, int64, int64, VECTOR))
def balance_forces(
    coefficients: Vector, constants: Vector, work: Vector, first: int, last: int, state: Vector
) -> int:
    """Bring the forces of the cells from ``first`` to before ``last`` into balance.

    Conjugate gradients on the cells that may move. A step that would make a force negative
    is cut at zero there and the rest scaled to the load; where that does not lower the energy
    the step ends at the first force to vanish, so the energy falls in every iteration and no
    set of cells comes back. Returns the iterations; ``state`` as `imbalance` leaves it.
    """
    gap, cosine, sine, wear = (
        work[_GAP][first:last],
        work[_COSINE][first:last],
        work[_SINE][first:last],
        work[_WEAR][first:last],
    )
    mobility, force, deformed = (
        work[_MOBILITY][first:last],
        work[_FORCE][first:last],
        work[_DEFORMED][first:last],
    )
    step, response, pressed = work[_STEP][first:last], work[_RESPONSE][first:last], work[_PRESSED][first:last]
    trial, trial_deformed = work[_TRIAL][first:last], work[_TRIAL_DEFORMED][first:last]
    load, tolerance, limit = constants[LOAD], constants[TOLERANCE], int(constants[MOST_ITERATIONS])
    n, before, restart = last - first, 0.0, True
    displacement(force, cosine, sine, wear, coefficients, deformed)
    for j in range(n):
        deformed[j] += gap[j]
        step[j] = 0.0
        pressed[j] = 0.0
    for iteration in range(limit):
        imbalance(force, deformed, cosine, mobility, pressed, state)
        if not state[_ERROR] > tolerance:
            return iteration
        keep = 0.0 if restart or state[_CHANGED] > 0.0 else state[_BALANCE] / before
        before = state[_BALANCE]
        for j in range(n):
            left = deformed[j] - state[APPROACH] * cosine[j]
            step[j] = (keep * step[j] - mobility[j] * left) * pressed[j]
        displacement(step, cosine, sine, wear, coefficients, response)
        downhill, stiffness, reach = 0.0, 0.0, _ENDLESS
        for j in range(n):
            downhill -= step[j] * (deformed[j] - state[APPROACH] * cosine[j])
            stiffness += step[j] * response[j]
            if step[j] < 0.0:
                reach = min(reach, -force[j] / step[j])
        length, restart = downhill / stiffness, False
        if length > reach:
            restart = True
            for j in range(n):
                trial[j] = max(force[j] + length * step[j], 0.0)
            scale_to_load(trial, cosine, load)
            displacement(trial, cosine, sine, wear, coefficients, trial_deformed)
            for j in range(n):
                trial_deformed[j] += gap[j]
            allowed = energy(force, gap, deformed)
            if energy(trial, gap, trial_deformed) <= allowed + _ROUNDING * abs(allowed):
                for j in range(n):
                    force[j] = trial[j]
                for j in range(n):
                    deformed[j] = trial_deformed[j]
                continue
            length = reach
        for j in range(n):  # the force that ends the step must vanish exactly, or it ends all others
            gone = step[j] < 0.0 and -force[j] / step[j] <= length
            force[j] = 0.0 if gone else max(force[j] + length * step[j], 0.0)
        for j in range(n):
            deformed[j] += length * response[j]
    imbalance(force, deformed, cosine, mobility, pressed, state)
    return limit


@kernel(int64(VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, TABLE, VECTOR))
def line_contact(
    x: Vector,
    y: Vector,
    width: Vector,
    wear_compliance: Vector,
    recess: Vector,
    coefficients: Vector,
    constants: Vector,
    pressure: Vector,
    work: Vector,
    result: Vector,
) -> int:
    """Write the pressure under a rigid roller pressed on the cells of an elastic profile.

    With g the distance of a cell from the roller, along the roller's radius, c the cosine
    between that radius and the direction of the load, u the elastic displacement, D
    ``wear_compliance`` [mm/MPa] and e ``recess`` [mm], the depth D p + e is worn off in this
    very step:

        gap = g - approach c + u + D p + e >= 0,   p >= 0,   p gap = 0,   sum p c width = load

    D = k s and e = 0 make the Archard step implicit, D = 0 is the elastic contact; of another
    law D p + e is the tangent (`power_contact`). The area worn off, sum D p width, is k s load
    to rounding where D is uniform and c = 1.

    ``coefficients``: `influence_coefficients` of a profile of at least as many cells, of about
    equal ``width``. ``constants``: roller centre x, y, roller radius, unit vector x, y from
    profile to centre, load per width, tolerance (error of a pressure over the largest one,
    not below 1e-11), most iterations. ``pressure`` [MPa]: the last one known (zeros where
    there is none); replaced. ``work``: `WORK_ROWS` rows. ``result``: approach, error reached,
    two numbers of the solver, first cell and the cell after the last that can press, iterations.
    Returns CONVERGED, NOT_CONVERGED (the pressure carries the load all the same),
    OUT_OF_REACH where the roller touches no cell or INVALID; pressure zero in both.

    Equation physics.md (W10), of m = 1.
    """
    n, load = x.size, constants[LOAD]
    gap, cosine, sine, wear = work[_GAP][0:n], work[_COSINE][0:n], work[_SINE][0:n], work[_WEAR][0:n]
    mobility, force = work[_MOBILITY][0:n], work[_FORCE][0:n]
    faults = 0 if load >= 0.0 else 1
    for i in range(constants.size):
        faults += 0 if abs(constants[i]) < _ENDLESS else 1
    for j in range(n):
        size = abs(x[j]) + abs(y[j]) + width[j] + wear_compliance[j] + abs(recess[j])
        sound = size < _ENDLESS and width[j] > 0.0 and wear_compliance[j] >= 0.0
        faults += 0 if sound else 1
    for j in range(n):
        work[_TRIAL][j] = pressure[j]
        pressure[j] = 0.0
    for i in range(result.size):
        result[i] = 0.0
    if faults > 0:
        return INVALID
    level = roller_gap(x, y, recess, constants, gap, cosine, sine)
    if level == _ENDLESS or load == 0.0:
        result[APPROACH] = level
        return OUT_OF_REACH if level == _ENDLESS else CONVERGED
    local = local_compliance(coefficients)
    for j in range(n):
        wear[j] = wear_compliance[j] / width[j]
        mobility[j] = 1.0 / (wear[j] + local)
    first_force(work[_TRIAL], width, coefficients, level, load, work, result[FIRST:_ITERATIONS])
    first, last = int(result[FIRST]), int(result[LAST])
    result[_ITERATIONS] = balance_forces(coefficients, constants, work, first, last, result[:FIRST])
    scale_to_load(force, cosine, load)
    for j in range(n):
        pressure[j] = force[j] / width[j]
    return CONVERGED if result[_ERROR] <= constants[TOLERANCE] else NOT_CONVERGED


@kernel(int64(VECTOR, VECTOR, VECTOR, VECTOR, float64, VECTOR, VECTOR, VECTOR, TABLE, VECTOR))
def power_contact(
    x: Vector,
    y: Vector,
    width: Vector,
    wear_factor: Vector,
    exponent: float,
    coefficients: Vector,
    constants: Vector,
    pressure: Vector,
    work: Vector,
    result: Vector,
) -> int:
    """Solve `line_contact` for the depth F p^m, F = ``wear_factor`` = K s [mm/MPa^m].

    Newton's method on the tangent of F p^m, m >= 1, taken at no less than a floor that starts
    at the mean pressure and falls tenfold in every turn: a cell that is new in contact has no
    pressure, so no slope, and with D = F p^(m-1) of the step before would not wear. A start that
    carries nothing like the load is replaced by the elastic pressure. ``result`` counts the
    iterations of all turns.

    Equation physics.md (W10).
    """
    n, load = x.size, constants[LOAD]
    compliance, recess = work[_COMPLIANCE][0:n], work[_RECESS][0:n]
    iterations, floor, status = 0.0, 0.0, INVALID
    for turn in range(40):
        carried, squared = 0.0, 0.0
        for j in range(n):
            carried += pressure[j] * width[j]
            squared += pressure[j] * pressure[j] * width[j]
        known = carried > 0.5 * load and carried < 2.0 / SMALLEST_COSINE * load
        if turn < 2:
            floor = squared / carried if known else 0.0
        for j in range(n):
            compliance[j], recess[j] = wear_factor[j] if exponent == 1.0 else 0.0, 0.0
            if not (exponent >= 1.0 and wear_factor[j] >= 0.0):
                compliance[j] = -1.0
            elif exponent > 1.0 and known:
                at = max(pressure[j], floor)
                compliance[j] = exponent * wear_factor[j] * at ** (exponent - 1.0)
                recess[j] = (1.0 - exponent) * wear_factor[j] * at**exponent
        status = line_contact(
            x, y, width, compliance, recess, coefficients, constants, pressure, work, result
        )
        iterations += result[_ITERATIONS]
        if status != CONVERGED and status != NOT_CONVERGED:
            break
        misfit, largest = 0.0, 0.0
        for j in range(n):
            if pressure[j] > 0.0:
                worn = wear_factor[j] * pressure[j] ** exponent
                tangent = recess[j] + compliance[j] * pressure[j]
                misfit = max(misfit, (worn - tangent) * work[_MOBILITY][j])
                largest = max(largest, pressure[j] * width[j])
        if status == CONVERGED and not misfit > constants[TOLERANCE] * largest:
            break
        status, floor = NOT_CONVERGED, 0.1 * floor
    result[_ITERATIONS] = iterations
    return status
