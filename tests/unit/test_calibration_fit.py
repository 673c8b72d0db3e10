"""Least squares and profile intervals against problems with closed solutions."""

import math

import numpy as np
import pytest
from scipy.stats import norm

from wearsim.errors import ContactError
from wearsim.study.calibrate.least_squares import (
    ConfidenceInterval,
    LeastSquaresProblem,
    fit_least_squares,
    profile_interval,
    stated_at,
)

Z = norm.ppf(0.95)
WIDE = np.full(2, -50.0), np.full(2, 50.0)


def linear(matrix, readings, bounds, freedom=None):
    matrix, readings = np.asarray(matrix, float), np.asarray(readings, float)
    free = matrix.shape[0] - matrix.shape[1] if freedom is None else freedom
    return LeastSquaresProblem(lambda u: matrix @ u - readings, *bounds, free)


def test_a_linear_problem_has_the_intervals_of_the_normal_equations():
    rng = np.random.default_rng(3)
    matrix = rng.normal(size=(12, 2)) @ np.array([[1.0, 0.9], [0.0, 0.4]])
    readings = matrix @ [1.5, -0.7] + rng.normal(size=12)
    problem = linear(matrix, readings, WIDE)
    found = fit_least_squares(problem, np.zeros(2))
    covariance = np.linalg.inv(matrix.T @ matrix)
    assert found.scale == 1.0
    assert found.point == pytest.approx(covariance @ matrix.T @ readings, abs=1e-5)
    assert found.covariance == pytest.approx(covariance, rel=1e-6)
    assert found.correlation[0, 1] == pytest.approx(
        covariance[0, 1] / math.sqrt(covariance[0, 0] * covariance[1, 1])
    )
    for index in range(2):
        interval = profile_interval(problem, found, index, 0.9)
        half = Z * math.sqrt(covariance[index, index])
        assert interval.low == pytest.approx(found.point[index] - half, abs=2e-3 * half)
        assert interval.high == pytest.approx(found.point[index] + half, abs=2e-3 * half)
        assert interval.known


def test_confidence_widens_the_interval():
    problem = linear([[1.0], [1.0]], [0.2, -0.2], (np.array([-9.0]), np.array([9.0])))
    found = fit_least_squares(problem, np.zeros(1))
    ends = [profile_interval(problem, found, 0, share).high for share in (0.9, 0.99)]
    assert ends == pytest.approx([Z / math.sqrt(2.0), norm.ppf(0.995) / math.sqrt(2.0)], rel=2e-3)


def test_a_curved_problem_has_an_interval_that_is_not_symmetric():
    """exp(u) = 1 +- 0.3 at 90 %: ln 0.7 and ln 1.3."""
    error = 0.3 / Z
    ends = np.array([-9.0]), np.array([9.0])
    problem = LeastSquaresProblem(lambda u: (np.exp(u) - 1.0) / error, *ends, freedom=1)
    interval = profile_interval(problem, fit_least_squares(problem, np.array([0.5])), 0, 0.9)
    assert interval.low == pytest.approx(math.log(0.7), abs=1e-3)
    assert interval.high == pytest.approx(math.log(1.3), abs=1e-3)


def test_what_the_data_do_not_know_is_open():
    """Only the sum of both is measured, and the second one is searched further out."""
    bounds = np.array([-50.0, -90.0]), np.array([50.0, 90.0])
    problem = linear([[1.0, 1.0]] * 3, [1.0, 1.1, 0.9], bounds)
    found = fit_least_squares(problem, np.zeros(2))
    assert found.correlation[0, 1] == pytest.approx(-1.0, abs=1e-6)
    interval = profile_interval(problem, found, 0, 0.9)
    assert interval == ConfidenceInterval(-50.0, 50.0, False, False)


def test_a_minimum_at_a_bound_is_open_there():
    problem = linear([[1.0]] * 2, [3.0, 3.2], (np.array([-1.0]), np.array([1.0])), 1)
    found = fit_least_squares(problem, np.zeros(1))
    assert found.point[0] == pytest.approx(1.0, abs=1e-3)
    interval = profile_interval(problem, found, 0, 0.9)
    assert interval.high == 1.0
    assert not interval.high_known
    assert interval.low_known


def test_where_the_case_cannot_run_the_end_is_not_known():
    def residuals(u):
        if u[0] > 0.5:
            raise ContactError("too far")
        return 0.1 * u

    problem = LeastSquaresProblem(residuals, np.array([-99.0]), np.array([99.0]), 1)
    found = stated_at(problem, np.zeros(1))
    interval = profile_interval(problem, found, 0, 0.9)
    assert not interval.high_known
    assert 0.3 < interval.high <= 0.5
    assert interval.low == pytest.approx(-10.0 * Z, rel=2e-3)


def test_readings_further_off_than_chance_widen_the_errors():
    readings = np.array([-6.0, 6.0, -6.0, 6.0, 0.0])
    problem = linear([[1.0]] * 5, readings, (np.array([-9.0]), np.array([9.0])))
    found = fit_least_squares(problem, np.zeros(1))
    assert found.chi_square == pytest.approx(144.0)
    assert found.scale == pytest.approx(6.0)
    interval = profile_interval(problem, found, 0, 0.9)
    assert interval.high == pytest.approx(6.0 * Z / math.sqrt(5.0), rel=2e-3)


def test_interval_of_what_follows():
    interval = ConfidenceInterval(-1.0, 2.0, True, False)
    scaled = interval.scaled(10.0)
    assert (scaled.low, scaled.high) == pytest.approx((10.0 / math.e, 10.0 * math.e**2))
    assert (scaled.low_known, scaled.high_known, scaled.known) == (True, False, False)
    assert ConfidenceInterval(2.0, 4.0, True, False).inverse(8.0) == ConfidenceInterval(2.0, 4.0, False, True)
