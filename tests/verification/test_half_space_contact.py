"""Roller on a worn profile: Hertz (benchmark B1), the growing scar (B4), independent dense solves.

B1 for E = 2.1e5, nu = 0.3, q = 100 N/mm, roller 6.035: on a flat p0 780.1181 MPa, a 0.081606 mm;
in the seat 6.09535 p0 77.6247, a 0.820126, here at q = 1 where p0 and a are a tenth of that.
B4, closed form: 4 a^3 - 3 a a0^2 = 6 R k q s, w0 = (a^2 - a0^2 ln 2)/(2 R), for a above about 2 a0:
against the free half-space its depth is 1.2 % high at s = 40.5, 0.5 % at 81, 0.2 % at 162. The
boundary-element depth of 4.8600 um printed for s = 162 is that of a periodic line: a dense solve
with a period of 1.6 mm gives 4.8598 um and 204.75 MPa, without a period 4.8526 um and 204.5 MPa.
"""

import numpy as np
import pytest

from wearsim.kernels import half_space

MODULUS = 2.1e5 / (2.0 * (1.0 - 0.3**2))
R, q, k = 6.035, 100.0, 1e-7
HERTZ = np.sqrt(4.0 * q * R / (np.pi * MODULUS))
SLIDING = (40.5, 81.0, 162.0, 324.0, 1000.0)


def contact(x, y, width, centre, radius, load, wear=0.0, pressure=None, direction=(0.0, 1.0)):
    """Return pressure, result and status of one kernel call on a whole profile."""
    n = x.size
    coefficients = np.empty(2 * n - 1)
    half_space.influence_coefficients(MODULUS, coefficients)
    constants = np.array([*centre, radius, *direction, load, 1e-10, 500.0])
    pressure = np.zeros(n) if pressure is None else pressure.copy()
    result = np.empty(7)
    status = half_space.line_contact(
        x,
        y,
        width,
        np.full(n, wear),
        np.zeros(n),
        coefficients,
        constants,
        pressure,
        np.empty((half_space.WORK_ROWS, n)),
        result,
    )
    return pressure, result, status


def line(n, half):
    """Cells of equal width on the x axis."""
    h = 2.0 * half / n
    return (np.arange(n) + 0.5 - 0.5 * n) * h, np.full(n, h)


def seat(n, radius, half_angle):
    """Cells of a round seat about the origin, open upwards."""
    angle, step = line(n, half_angle)
    return angle, radius * np.sin(angle), -radius * np.cos(angle), radius * step


def dense(gap, matrix, cosine, width, load, active):
    """Solve the same conditions by a primal-dual active set and LU; return pressure, approach."""
    for _ in range(200):
        on = np.flatnonzero(active)
        system = np.zeros((on.size + 1, on.size + 1))
        system[:-1, :-1] = matrix[np.ix_(on, on)]
        system[:-1, -1] = -cosine[on]
        system[-1, :-1] = (cosine * width)[on]
        solution = np.linalg.solve(system, np.append(-gap[on], load))
        pressure = np.zeros(gap.size)
        pressure[on] = solution[:-1]
        left = gap + matrix @ pressure - solution[-1] * cosine
        changed = np.where(active, pressure > 0.0, left < 0.0)
        if (changed == active).all():
            return pressure, solution[-1]
        active = changed
    raise AssertionError("the active set cycles")


def influence(n, h, reference):
    """Displacement by unit pressure on one cell: -2/(pi E*) integral of ln(s/reference)."""
    s = h * np.subtract.outer(np.arange(n), np.arange(n))

    def primitive(s):
        return s * np.log(np.abs(s) / reference) - s

    return -2.0 / (np.pi * MODULUS) * (primitive(s + 0.5 * h) - primitive(s - 0.5 * h))


def half_width(pressure, x, width):
    """Of an elliptic pressure: its second moment is q a^2/4."""
    return 2.0 * np.sqrt(np.sum(pressure * x**2 * width) / np.sum(pressure * width))


@pytest.mark.parametrize(("n", "within"), [(51, 2e-3), (101, 5e-4), (201, 1e-4)])
def test_hertz_on_a_flat(validated, n, within):
    x, width = line(n, 0.1)
    pressure, _, status = contact(x, 0.0 * x, width, (0.0, R), R, q)
    assert status == half_space.CONVERGED
    quantity, source = "peak pressure on a flat, 201 points", "Hertz"
    validated(quantity, pressure.max(), 780.1181, within, source, "MPa", page=n == 201)
    assert half_width(pressure, x, width) == pytest.approx(0.081606, rel=within)


@pytest.mark.parametrize(("n", "within"), [(51, 2e-3), (101, 5e-4), (201, 1e-4)])
def test_hertz_in_the_seat(validated, n, within):
    angle, x, y, width = seat(n, 6.09535, 0.1 / 6.09535)
    pressure, _, status = contact(x, y, width, (0.0, -0.06035), R, 1.0)
    assert status == half_space.CONVERGED
    assert pressure.max() == pytest.approx(7.76247, rel=within)
    quantity, found = ("half-width in the seat, 201 points", half_width(pressure, angle * 6.09535, width))
    validated(quantity, found, 0.0820126, within, "Hertz", "mm", page=n == 201)


def far_roller(depth, x):
    """Return height of a parabola R worn by ``depth``, centre and radius of a nearly flat roller.

    All cosines are one to 1e-13, so the parabola of the closed forms is solved exactly.
    """
    return -(x**2) / (2.0 * R) - depth, (0.0, 1e6), 1e6


def test_order_of_convergence():
    """Whole cells on the half-width: the sum of the errors of pressure falls with order 1.5."""
    errors = []
    for n in (20, 40, 80, 160):
        x, width = line(n, 1.25 * HERTZ)
        y, centre, radius = far_roller(0.0, x)
        pressure, _, _ = contact(x, y, width, centre, radius, q)
        ellipse = 780.1181 * np.sqrt(np.maximum(1.0 - (x / HERTZ) ** 2, 0.0))
        errors.append(np.sum(np.abs(pressure - ellipse) * width) / q)
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert errors[-1] < 5e-4
    np.testing.assert_allclose(orders, 1.5, atol=0.05)


def scar(n, half, sliding, form=None):
    """Wear a profile under a roller that stays; return cell width, depth and pressure per step."""
    x, width = line(n, half)
    depth, history = np.zeros(n), []
    form = form or (lambda depth, x: (-depth, (0.0, R), R))
    y, centre, radius = form(depth, x)
    pressure, _, _ = contact(x, y, width, centre, radius, q)
    for step in np.diff(sliding, prepend=0.0):
        y, centre, radius = form(depth, x)
        pressure, _, status = contact(x, y, width, centre, radius, q, k * step, pressure)
        assert status == half_space.CONVERGED
        depth = depth + k * step * pressure
        history.append((depth, pressure))
    return width[0], history


def scar_closed_form(s):
    """Half-width and depth of B4."""
    roots = np.roots([4.0, 0.0, -3.0 * HERTZ**2, -6.0 * R * k * q * s])
    a = roots[np.abs(roots.imag) < 1e-9].real.max()
    return a, (a**2 - HERTZ**2 * np.log(2.0)) / (2.0 * R)


@pytest.fixture(scope="module")
def independent_scar():
    """Return depth, largest pressure, half-width and cell of B4 from the dense solver."""

    def wear(s):
        n = 100
        x, width = line(n, 1.15 * scar_closed_form(s)[0])
        matrix, depth, active = influence(n, width[0], 10.0), np.zeros(n), np.abs(x) < HERTZ
        for step in np.diff(np.geomspace(0.02 * s, s, 80), prepend=0.0):
            worn = matrix + k * step * np.eye(n)
            gap = x**2 / (2.0 * R) + depth
            pressure, _ = dense(gap, worn, np.ones(n), width, q, active)
            depth += k * step * pressure
            active = pressure > 0.0
        return depth.max(), pressure.max(), 0.5 * width[0] * np.sum(active), width[0]

    return {s: wear(s) for s in SLIDING}


@pytest.mark.parametrize("s", SLIDING)
def test_scar_of_b4(validated, s, independent_scar):
    a, w0 = scar_closed_form(s)
    h, history = scar(400, 1.15 * a, np.geomspace(0.03 * s, s, 60), far_roller)
    depth, pressure = history[-1]
    found = depth.max(), pressure.max(), 0.5 * h * np.sum(pressure > 0.0)
    expected = independent_scar[s]
    name, source, shown = f"after {s:g} mm of sliding", "dense solve by an active set", s < 100
    validated(f"depth of the scar {name}", found[0], expected[0], 1e-3, source, "mm", page=shown)
    shown = s == 40.5
    validated(f"pressure {name}", found[1], expected[1], 5e-3, source, "MPa", page=shown)
    assert found[2] == pytest.approx(expected[2], abs=expected[3])
    assert np.sum(depth) * h == pytest.approx(k * q * s, rel=1e-12)
    if s >= 162.0:
        assert found[0] == pytest.approx(w0, rel=5e-3)
    if s >= 81.0:
        assert found[2] == pytest.approx(a, rel=1e-2)


def test_printed_scar(validated):
    """Sliding 162 mm, printed: boundary elements 4.8600 um, 204.8 MPa, 0.2507 mm."""
    h, history = scar(240, 0.3, np.geomspace(5.0, 162.0, 60))
    depth, pressure = history[-1]
    source = "two boundary-element codes, periodic line"
    validated("depth after 162 mm", depth.max(), 4.8600e-3, 5e-3, source, "mm")
    validated("pressure after 162 mm", pressure.max(), 204.8, 1e-2, source, "MPa")
    assert 0.5 * h * np.sum(pressure > 0.0) == pytest.approx(0.2507, rel=1e-2)


@pytest.mark.parametrize("steps", [1, 2, 20, 1000])
def test_any_number_of_steps_is_stable(steps):
    """Explicit steps above 4 h/(pi k E*) = 0.66 mm break the contact into every other cell."""
    n = 101
    _, history = scar(n, 0.3, np.linspace(162.0 / steps, 162.0, steps))
    alternating = (-1.0) ** np.arange(n)
    for _, pressure in history:
        assert (np.diff(np.flatnonzero(pressure > 0.0)) == 1).all()
        assert abs(np.sum(alternating * pressure)) < 0.03 * np.sum(pressure)
    assert history[-1][0].max() == pytest.approx(4.853e-3, rel=0.03)


def test_error_falls_with_the_number_of_steps():
    """Implicit Euler, order 1; 4.8526 um is the dense solver's at 1000 equal steps, 200 cells."""
    errors = []
    for steps in (10, 20, 40):
        _, history = scar(200, 0.3145, np.geomspace(4.0, 162.0, steps), far_roller)
        errors.append(1.0 - history[-1][0].max() / 4.8526e-3)
    assert errors[0] < 0.01
    assert errors[2] < 0.002
    assert 0.4 < errors[1] / errors[0] < 0.65
    assert 0.4 < errors[2] / errors[1] < 0.65


@pytest.mark.parametrize("wear", [1e-9, 1e-5, 1e-3])
def test_worn_area_is_rate_times_load_times_sliding(wear):
    x, width = line(100, 0.4)
    y, centre, radius = far_roller(0.0, x)
    pressure, _, _ = contact(x, y, width, centre, radius, q, wear)
    assert np.sum(wear * pressure * width) == pytest.approx(wear * q, rel=1e-12)


CONFORMAL = [(3.96, 4.018, 100.0), (3.96, 4.018, 1000.0), (3.96, 3.96396, 1000.0), (3.96, 3.96, 50.0)]


@pytest.mark.wide
@pytest.mark.parametrize(("radius", "seat_radius", "load"), CONFORMAL)
@pytest.mark.parametrize("wear", [0.0, 1e-6, 1e-3])
@pytest.mark.parametrize("turn", [0.0, 0.15])
def test_conformal_seat_against_a_dense_solve(validated, radius, seat_radius, load, wear, turn):
    n = 120
    _, x, y, width = seat(n, seat_radius, 1.2)
    direction = np.array([np.sin(turn), np.cos(turn)])
    centre = -(seat_radius - radius) * direction
    pressure, result, status = contact(x, y, width, centre, radius, load, wear, direction=tuple(direction))
    assert status == half_space.CONVERGED
    to_centre = centre[:, None] - np.array([x, y])
    distance = np.hypot(*to_centre)
    cosine = direction @ to_centre / distance
    radial = to_centre / distance
    matrix = influence(n, width[0], n * width[0]) * (radial.T @ radial) + wear * np.eye(n)
    start = pressure > 0.5 * pressure.max()
    expected, approach = dense(distance - radius, matrix, cosine, width, load, start)
    validated(
        "pressures in the seat 4.018 mm under 1000 N/mm",
        *(pressure, expected, 1e-8 * expected.max(), "dense solve by an active set", "MPa"),
        absolute=True,
        page=(seat_radius, load, wear, turn) == (4.018, 1000.0, 0.0, 0.0),
    )
    assert result[0] == pytest.approx(approach, rel=1e-8)
    assert np.sum(pressure * cosine * width) == pytest.approx(load, rel=1e-12)
    gap = distance - radius + matrix @ pressure - result[0] * cosine
    assert gap.min() > -1e-9 * abs(result[0])
    assert (pressure >= 0.0).all()
    assert np.abs(pressure * gap).max() < 1e-9 * abs(result[0]) * pressure.max()


@pytest.mark.parametrize("cold", [True, False])
@pytest.mark.parametrize("load", [100.0, 1000.0])
@pytest.mark.parametrize(("exponent", "factor"), [(1.0, 1e-6), (1.5, 1e-7), (2.0, 1e-8), (3.0, 1e-9)])
def test_power_law_fulfils_all_conditions(exponent, factor, load, cold):
    n = 120
    _, x, y, width = seat(n, 4.018, 1.2)
    coefficients, result = np.empty(2 * n - 1), np.empty(7)
    half_space.influence_coefficients(MODULUS, coefficients)
    pressure = np.zeros(n) if cold else contact(x, y, width, (0.0, -0.058), 3.96, load)[0]
    status = half_space.power_contact(
        x,
        y,
        width,
        np.full(n, factor),
        exponent,
        coefficients,
        np.array([0.0, -0.058, 3.96, 0.0, 1.0, load, 1e-10, 500.0]),
        pressure,
        np.empty((half_space.WORK_ROWS, n)),
        result,
    )
    assert status == half_space.CONVERGED
    to_centre = np.array([[0.0], [-0.058]]) - np.array([x, y])
    distance = np.hypot(*to_centre)
    cosine, radial = to_centre[1] / distance, to_centre / distance
    matrix = influence(n, width[0], n * width[0]) * (radial.T @ radial)
    worn = factor * pressure**exponent
    gap = distance - 3.96 + matrix @ pressure + worn - result[0] * cosine
    on = pressure > 0.0
    assert np.abs(gap[on]).max() < 1e-8 * result[0]
    assert gap.min() > -1e-8 * result[0]
    assert (pressure >= 0.0).all()
    assert worn.max() > 0.01 * result[0]
    assert np.sum(pressure * cosine * width) == pytest.approx(load, rel=1e-12)


def power_scar(exponent, factor, n, half, sliding):
    """Wear a parabola by a power of the pressure; return depth, pressure, most iterations."""
    x, width = line(n, half)
    depth, pressure, iterations = np.zeros(n), np.zeros(n), 0.0
    coefficients, result = np.empty(2 * n - 1), np.empty(7)
    half_space.influence_coefficients(MODULUS, coefficients)
    for step in np.diff(sliding, prepend=0.0):
        y, centre, radius = far_roller(depth, x)
        status = half_space.power_contact(
            x,
            y,
            width,
            np.full(n, factor * step),
            exponent,
            coefficients,
            np.array([*centre, radius, 0.0, 1.0, q, 1e-9, 500.0]),
            pressure,
            np.empty((half_space.WORK_ROWS, n)),
            result,
        )
        assert status == half_space.CONVERGED
        iterations = max(iterations, result[6])
        depth += factor * step * pressure**exponent
    return depth, pressure, iterations


def test_power_law_scar_against_small_explicit_steps(validated):
    """Dense solver, explicit steps of a third of the stable 4 h/(pi E* m K p^(m-1))."""
    n, half, factor, s = 60, 0.25, 3e-10, 40.0
    x, width = line(n, half)
    matrix, depth, active = influence(n, width[0], 10.0), np.zeros(n), np.abs(x) < HERTZ
    for _ in range(600):
        gap = x**2 / (2.0 * R) + depth
        pressure, _ = dense(gap, matrix, np.ones(n), width, q, active)
        depth += factor * s / 600.0 * pressure**2
        active = pressure > 0.0
    worn, _, _ = power_scar(2.0, factor, n, half, np.geomspace(0.4, s, 80))
    quantity, source = "depth of a scar, m = 2", "600 explicit steps of a dense solver"
    validated(quantity, worn.max(), depth.max(), 1e-2, source, "mm")
    assert np.sum(worn) == pytest.approx(np.sum(depth), rel=1e-2)


@pytest.mark.parametrize("exponent", [1.5, 2.0, 3.0, 5.0])
def test_power_law_takes_a_large_step_onto_new_cells(exponent):
    """From 20 to 1000 mm at once: the new cells have no pressure, so no slope, to start from."""
    factor = 1e-7 / 300.0 ** (exponent - 1.0)
    depth, _, iterations = power_scar(exponent, factor, 200, 0.5, np.array([20.0, 1000.0]))
    fine, _, _ = power_scar(exponent, factor, 200, 0.5, np.geomspace(20.0, 1000.0, 80))
    assert iterations < 160
    assert depth.max() == pytest.approx(fine.max(), rel=0.2)


def test_reference_length_does_not_matter_in_a_symmetric_seat():
    """A longer profile has another constant in its coefficients; the approach absorbs it."""
    found = []
    for n in (100, 140):
        _, x, y, width = seat(n, 4.018, 0.01 * n)
        pressure, _, _ = contact(x, y, width, (0.0, -0.058), 3.96, 1000.0)
        found.append(pressure[pressure > 0.0])
    np.testing.assert_allclose(*found, rtol=1e-7)


def test_half_angle_in_a_close_seat():
    """Half-angle by Hertz 25 degrees at q = 1000 in the seat 4.018 (out of its range): near, below."""
    angle, x, y, width = seat(200, 4.018, 1.4)
    pressure, _, _ = contact(x, y, width, (0.0, -0.058), 3.96, 1000.0)
    rho = 1.0 / (1.0 / 3.96 - 1.0 / 4.018)
    hertz = np.sqrt(4.0 * 1000.0 * rho / (np.pi * MODULUS)) / 4.018
    found = angle[pressure > 0.0].max()
    assert 0.85 * hertz < found < hertz


@pytest.mark.parametrize("wear", [0.0, 1e-5])
def test_mirror_and_scale(wear):
    """Lengths 1024 times as long, at 1024 times the load per width: the same pressure."""
    n = 90
    rough = 2e-4 * np.random.default_rng(3).standard_normal(n)
    angle, _, _, width = seat(n, 4.018, 1.0)
    x, y = (4.018 + rough) * np.sin(angle), -(4.018 + rough) * np.cos(angle)
    seen, result, _ = contact(x, y, width, (0.01, -0.05), 3.96, 300.0, wear)
    mirror, other, _ = contact(-x[::-1].copy(), y[::-1].copy(), width, (-0.01, -0.05), 3.96, 300.0, wear)
    np.testing.assert_allclose(mirror[::-1], seen, rtol=0.0, atol=1e-9 * seen.max())
    assert other[0] == pytest.approx(result[0], rel=1e-9)
    large, other, _ = contact(
        1024 * x, 1024 * y, 1024 * width, (10.24, -51.2), 1024 * 3.96, 1024 * 300.0, 1024 * wear
    )
    np.testing.assert_allclose(large, seen, rtol=0.0, atol=1e-9 * seen.max())
    assert other[0] == pytest.approx(1024 * result[0], rel=1e-9)


def test_symmetric_profile_has_symmetric_pressure():
    _, x, y, width = seat(101, 4.018, 1.2)
    pressure, _, _ = contact(x, y, width, (0.0, -0.058), 3.96, 500.0, 1e-6)
    np.testing.assert_allclose(pressure[::-1], pressure, rtol=0.0, atol=1e-9 * pressure.max())
