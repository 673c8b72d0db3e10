"""The half-space line contact kernel at its limits: status, starts, tiny loads, idle cells."""

import importlib.util
from itertools import pairwise

import numpy as np
import pytest
from numba.core import config

from wearsim.kernels import half_space

MODULUS = 1e5
FAR = 1e6  # roller radius at which all cosines are one


def arguments(n=60, radius=4.0, seat=4.05, half_angle=1.0, load=200.0, wear=1e-6):
    """Arguments of a roller resting at the bottom of a round seat."""
    step = 2.0 * half_angle / n
    angle = (np.arange(n) + 0.5 - 0.5 * n) * step
    coefficients = np.empty(2 * n - 1)
    half_space.influence_coefficients(MODULUS, coefficients)
    return {
        "x": seat * np.sin(angle),
        "y": -seat * np.cos(angle),
        "width": np.full(n, seat * step),
        "wear_compliance": np.full(n, wear),
        "recess": np.zeros(n),
        "coefficients": coefficients,
        "constants": np.array([0.0, radius - seat, radius, 0.0, 1.0, load, 1e-10, 500.0]),
        "pressure": np.zeros(n),
        "work": np.empty((half_space.WORK_ROWS, n)),
        "result": np.empty(7),
    }


def solve(given, kernels=half_space):
    """Return a copy of the pressure, the result and the status."""
    status = kernels.line_contact(*given.values())
    return given["pressure"].copy(), given["result"].copy(), status


def test_coefficients_are_those_of_constant_pressure_cells():
    """-2/(pi E*) integral of ln(s/n) over a cell by quadrature; the middle one in closed form."""
    n = 7
    coefficients = np.empty(2 * n - 1)
    half_space.influence_coefficients(MODULUS, coefficients)
    nodes, weights = np.polynomial.legendre.leggauss(20)
    scale = -2.0 / (np.pi * MODULUS)
    expected = [scale * 0.5 * np.sum(weights * np.log((lag + 0.5 * nodes) / n)) for lag in range(1, n)]
    np.testing.assert_allclose(coefficients[n:], expected, rtol=1e-12)
    np.testing.assert_array_equal(coefficients[: n - 1], coefficients[:-n:-1])
    assert coefficients[n - 1] == pytest.approx(scale * (np.log(0.5 / n) - 1.0), rel=1e-14)
    assert (coefficients > 0.0).all()


def test_work_of_a_longer_line_is_left_out():
    """Rows of work may be longer than the line and hold anything."""
    given, other = arguments(), arguments()
    other["work"] = np.full((half_space.WORK_ROWS, 90), -1e3)
    (pressure, _, status), (found, _, found_status) = solve(given), solve(other)
    assert (found_status, half_space.CONVERGED) == (status, status)
    np.testing.assert_array_equal(found, pressure)


def test_two_cells_by_hand():
    """One cell 2 um deeper: D (p1 - p2) = 2 um - (a0 - a1)(f1 - f2), p1 + p2 = q/w."""
    a0 = 2.0 / (np.pi * MODULUS) * (1.0 + np.log(4.0))
    a1 = -2.0 / (np.pi * MODULUS) * (1.5 * np.log(0.75) - 0.5 * np.log(0.25) - 1.0)
    coefficients = np.empty(3)
    half_space.influence_coefficients(MODULUS, coefficients)
    np.testing.assert_allclose(coefficients, [a1, a0, a1], rtol=1e-13)
    width, wear, load = 0.1, 1e-6, 400.0
    difference = 0.002 / (wear / width + a0 - a1)
    forces = 0.5 * (load + difference), 0.5 * (load - difference)
    given = arguments(n=2, load=load, wear=wear)
    given.update(x=np.array([-0.05, 0.05]), y=np.array([0.0, -0.002]), width=np.full(2, width))
    given.update(coefficients=coefficients)
    given["constants"][:3] = 0.0, FAR, FAR
    pressure, result, status = solve(given)
    assert status == half_space.CONVERGED
    np.testing.assert_allclose(pressure * width, forces, rtol=1e-6)
    approach = (wear / width + a0) * forces[0] + a1 * forces[1]
    assert result[0] == pytest.approx(approach, rel=1e-6)


def test_compiled_and_interpreted_agree(monkeypatch):
    monkeypatch.setattr(config, "DISABLE_JIT", 0 if config.DISABLE_JIT else 1)
    spec = importlib.util.spec_from_file_location("other_mode", half_space.__file__)
    other = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(other)
    for start in (np.zeros(15), np.linspace(1.0, 2.0, 15)):
        found = []
        for kernels in (half_space, other):
            given = arguments(n=15)
            given["y"] += 1e-4 * np.sin(5.0 * given["x"])
            given["pressure"][:] = start
            kernels.influence_coefficients(MODULUS, given["coefficients"])
            found.append(solve(given, kernels))
        (pressure, result, status), (other_pressure, other_result, other_status) = found
        assert status == other_status == half_space.CONVERGED
        np.testing.assert_allclose(pressure, other_pressure, rtol=1e-12)
        np.testing.assert_allclose(result[[0, 4, 5, 6]], other_result[[0, 4, 5, 6]], rtol=1e-12)


STARTS = {
    "uniform": lambda n: np.ones(n),
    "noise": lambda n: np.random.default_rng(1).uniform(-1.0, 1.0, n),
    "one far cell": lambda n: np.eye(n)[0],
    "not a number": lambda n: np.full(n, np.nan),
    "endless": lambda n: np.full(n, np.inf),
    "huge": lambda n: np.full(n, 1e90),
}


@pytest.mark.parametrize("wear", [0.0, 1e-6, 1e-2])
@pytest.mark.parametrize("start", STARTS)
def test_any_start_gives_the_same_pressure(start, wear):
    expected, reached, _ = solve(arguments(wear=wear))
    given = arguments(wear=wear)
    given["pressure"][:] = STARTS[start](60)
    pressure, result, status = solve(given)
    assert status == half_space.CONVERGED
    np.testing.assert_allclose(pressure, expected, rtol=0.0, atol=1e-8 * expected.max())
    assert result[0] == pytest.approx(reached[0], rel=1e-9)


@pytest.mark.parametrize("wear", [0.0, 1e-6])
@pytest.mark.parametrize("start", [None, *STARTS])
def test_window_is_near_the_contact_from_any_start(start, wear):
    """Hertz: 31 of 300 cells; a useless start is replaced by one from the overlap."""
    given = arguments(n=300, wear=wear, load=60.0, half_angle=1.2)
    if start:
        given["pressure"][:] = STARTS[start](300)
    pressure, result, _ = solve(given)
    assert 29 <= np.sum(pressure > 0.0) <= 35
    assert result[5] - result[4] <= 2.5 * np.sum(pressure > 0.0)
    assert result[6] <= 25


def test_own_solution_is_kept():
    given = arguments()
    solve(given)
    pressure, result, status = solve(given)
    assert (status, result[6]) == (half_space.CONVERGED, 0.0)
    assert np.sum(pressure > 0.0) < result[5] - result[4] <= 60


@pytest.mark.parametrize(("n", "carrying"), [(60, 2), (61, 1)])
@pytest.mark.parametrize("load", [1e-9, 1e-4])
def test_tiny_load_is_carried_by_one_or_two_cells(n, carrying, load):
    given = arguments(n=n, load=load)
    pressure, _, status = solve(given)
    assert status == half_space.CONVERGED
    assert np.sum(pressure > 0.0) == carrying
    cosine = np.cos(np.arctan2(given["x"], given["constants"][1] - given["y"]))
    assert np.sum(pressure * cosine * given["width"]) == pytest.approx(load, rel=1e-12)


def test_single_cell_carries_the_load():
    given = arguments(n=1, half_angle=0.01)
    pressure, _, status = solve(given)
    assert status == half_space.CONVERGED
    assert pressure[0] * given["width"][0] == pytest.approx(200.0, rel=1e-14)


def test_cells_without_reach_carry_nothing():
    """A seat of a whole circle round the roller: only cells within acos(0.2) of the load."""
    given = arguments(n=200, half_angle=np.pi, seat=4.0, wear=1e-2)
    pressure, _, status = solve(given)
    angle = np.abs(np.linspace(-np.pi, np.pi, 401)[1::2])
    assert status == half_space.CONVERGED
    np.testing.assert_array_equal(pressure > 0.0, angle < np.arccos(half_space.SMALLEST_COSINE))


@pytest.mark.parametrize("seat", [4.0, 3.999, 3.9])
def test_seat_as_large_as_the_roller_or_smaller(seat):
    pressure, result, status = solve(arguments(seat=seat, n=80, half_angle=1.3))
    assert status == half_space.CONVERGED
    assert np.isfinite(pressure).all() and np.isfinite(result).all()
    assert (pressure >= 0.0).all() and pressure.max() > 0.0


def test_wear_that_dominates_takes_few_iterations():
    _, result, status = solve(arguments(wear=1e-2))
    assert status == half_space.CONVERGED
    assert result[6] <= 4


def test_iteration_limit_is_reported_and_the_load_still_carried():
    given = arguments(n=61, wear=0.0)
    given["constants"][7] = 2.0
    pressure, result, status = solve(given)
    assert (status, result[6]) == (half_space.NOT_CONVERGED, 2.0)
    assert result[1] > 1e-10
    cosine = np.cos(np.arctan2(given["x"], given["constants"][1] - given["y"]))
    assert np.sum(pressure * cosine * given["width"]) == pytest.approx(200.0, rel=1e-12)


def test_out_of_reach():
    given = arguments()
    given["constants"][4] = -1.0
    pressure, _, status = solve(given)
    assert status == half_space.OUT_OF_REACH
    assert (pressure == 0.0).all()


def test_no_load_touches_without_pressure():
    given = arguments(load=0.0, n=61)
    given["y"] -= 0.25
    given["pressure"][:] = 1.0
    pressure, result, status = solve(given)
    assert status == half_space.CONVERGED
    assert (pressure == 0.0).all()
    assert result[0] == pytest.approx(0.25, rel=1e-12)


FAULTS = [
    *((name, 3, value) for name in ("x", "y") for value in (np.nan, np.inf)),
    *((name, 3, value) for name in ("width", "wear_compliance") for value in (np.nan, np.inf, -1)),
    *(("constants", index, value) for index in range(8) for value in (np.nan, np.inf)),
    ("constants", 5, -1.0),
    ("width", 3, 0.0),
]


@pytest.mark.parametrize(("name", "index", "fault"), FAULTS)
def test_invalid_input(name, index, fault):
    given = arguments()
    given["pressure"][:] = 1.0
    given[name][index] = fault
    pressure, result, status = solve(given)
    assert status == half_space.INVALID
    assert (pressure == 0.0).all() and (result == 0.0).all()


@pytest.mark.parametrize("exponent", [1.0, 1.5, 3.0])
@pytest.mark.parametrize("start", STARTS)
def test_power_law_from_any_start(start, exponent):
    found = []
    for first in (np.zeros(60), STARTS[start](60)):
        given = arguments()
        given["pressure"][:] = first
        status = power(given, exponent, np.full(60, 1e-4 / 100.0**exponent))
        assert status == half_space.CONVERGED
        found.append(given["pressure"])
    np.testing.assert_allclose(*found, rtol=0.0, atol=1e-8 * found[0].max())


def power(given, exponent, factor):
    """Status of the power law on these arguments."""
    values = {name: given[name] for name in ("x", "y", "width")}
    rest = (given[name] for name in ("coefficients", "constants", "pressure", "work", "result"))
    return half_space.power_contact(*values.values(), factor, exponent, *rest)


def test_power_law_of_exponent_one_is_the_linear_one():
    given, linear = arguments(), arguments()
    assert power(given, 1.0, linear["wear_compliance"]) == half_space.CONVERGED
    solve(linear)
    np.testing.assert_array_equal(given["pressure"], linear["pressure"])
    np.testing.assert_array_equal(given["result"], linear["result"])


@pytest.mark.parametrize(("exponent", "factor"), [(0.5, 1e-6), (np.nan, 1e-6), (2.0, -1.0)])
def test_power_law_with_invalid_numbers(exponent, factor):
    given = arguments()
    assert power(given, exponent, np.full(60, factor)) == half_space.INVALID
    assert (given["pressure"] == 0.0).all()


def test_power_law_without_load_or_reach():
    given = arguments(load=0.0)
    assert power(given, 2.0, np.full(60, 1e-8)) == half_space.CONVERGED
    given = arguments()
    given["constants"][4] = -1.0
    assert power(given, 2.0, np.full(60, 1e-8)) == half_space.OUT_OF_REACH


def test_energy_never_rises():
    """A rough seat on which cutting every force at zero raises the energy by 4 % once."""
    energies = []
    for limit in range(14):
        given = arguments(n=40, wear=0.0, half_angle=1.2, load=50.0)
        given["y"] += 0.001 * np.random.default_rng(8).standard_normal(40)
        given["pressure"][:] = 1.0
        given["constants"][7] = limit
        pressure, _, status = solve(given)
        gap, cosine, sine = given["work"][:3]
        lag = np.subtract.outer(np.arange(40), np.arange(40)) + 39
        matrix = given["coefficients"][lag] * (np.outer(cosine, cosine) + np.outer(sine, sine))
        force = pressure * given["width"]
        energies.append(force @ gap + 0.5 * force @ matrix @ force)
    assert status == half_space.CONVERGED
    assert all(after <= before + 1e-12 * abs(before) for before, after in pairwise(energies))
    assert energies[-1] < energies[0]
