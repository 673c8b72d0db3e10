"""Bounded least squares, and intervals by the profile of the likelihood."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, least_squares
from scipy.stats import chi2

from wearsim.errors import WearsimError
from wearsim.geometry.profile_points import Vector

Residuals = Callable[[Vector], Vector]

_STEP = 0.01
"""Of the differences that a derivative is taken from: 1 % of a parameter, as they are logarithms."""

_MAX_STEPS = 40
"""Steps of the way out to the end of an interval."""

_UNLIKELY = 0.01
"""Probability of the sum of squares below which the stated errors are taken to be too small."""


@dataclass(frozen=True, eq=False)
class LeastSquaresProblem:
    """Residuals of normal errors of size 1 to be made small."""

    residuals: Residuals  # of the parameters, shape (n,)
    low: Vector  # bounds of the parameters, shape (p,)
    high: Vector  # bounds of the parameters, shape (p,)
    freedom: int  # degrees of freedom: readings that tell something less the parameters


@dataclass(frozen=True, eq=False)
class LeastSquaresFit:
    """The most likely parameters."""

    point: Vector  # the parameters, shape (p,)
    chi_square: float  # sum of squared residuals
    # what errors are multiplied by: 1, or more where the residuals are too large for chance
    scale: float
    # of the parameters by the linear theory, shape (p, p), inf where the data say nothing
    covariance: Vector
    correlation: Vector  # the same as correlations


@dataclass(frozen=True)
class ConfidenceInterval:
    """What a parameter can be."""

    low: float  # ends
    high: float  # ends
    low_known: bool  # false where the end is only the bound that the parameter was searched within
    high_known: bool  # false where the end is only the bound that the parameter was searched within

    @property
    def known(self) -> bool:
        """Whether the data give both ends."""
        return self.low_known and self.high_known

    def scaled(self, start: float) -> "ConfidenceInterval":
        """Return the interval of a value of which this one is that of the logarithm."""
        low, high = start * math.exp(self.low), start * math.exp(self.high)
        return ConfidenceInterval(low, high, self.low_known, self.high_known)

    def mapped(self, rising: Callable[[float], float]) -> "ConfidenceInterval":
        """Return the interval of a value that rises with this one."""
        return ConfidenceInterval(rising(self.low), rising(self.high), self.low_known, self.high_known)

    def inverse(self, whole: float) -> "ConfidenceInterval":
        """Return the interval of a value that is inverse to this one."""
        return ConfidenceInterval(whole / self.high, whole / self.low, self.high_known, self.low_known)


def fit_least_squares(problem: LeastSquaresProblem, start: Vector) -> LeastSquaresFit:
    """Return the parameters of least squares within their bounds.

    Examples
    --------
    The mean of two readings of error 1, 1.0 and 3.0, has the error 1/sqrt(2):

    >>> ends = np.array([-9.0]), np.array([9.0])
    >>> problem = LeastSquaresProblem(lambda u: u[0] - np.array([1.0, 3.0]), *ends, freedom=1)
    >>> found = fit_least_squares(problem, np.zeros(1))
    >>> round(float(found.point[0]), 6), round(float(found.covariance[0, 0]), 6)
    (2.0, 0.5)
    """
    return stated_at(problem, _minimum(problem.residuals, start, problem.low, problem.high))


def stated_at(problem: LeastSquaresProblem, point: Vector) -> LeastSquaresFit:
    """Return the most likely parameters, where they are known already."""
    residuals = problem.residuals(point)
    square = float(residuals @ residuals)
    scale = 1.0
    if problem.freedom > 0 and chi2.sf(square, problem.freedom) < _UNLIKELY:
        scale = math.sqrt(square / problem.freedom)
    covariance, correlation = _covariance(_jacobian(problem.residuals, point, problem.low, problem.high))
    return LeastSquaresFit(point, square, scale, scale**2 * covariance, correlation)


def profile_interval(
    problem: LeastSquaresProblem, found: LeastSquaresFit, index: int, confidence: float
) -> ConfidenceInterval:
    """Return the interval of one parameter by the profile of the likelihood.

    It holds all values for which the sum of squares, made as small as it can be by the other
    parameters, exceeds the smallest one by no more than the quantile of chi-square with one
    degree of freedom (Wilks' theorem).
    """
    allowed = found.chi_square + float(chi2.ppf(confidence, 1)) * found.scale**2
    walk = _Walk(problem, found, index, allowed)
    low, low_known = walk.end(-1.0)
    high, high_known = walk.end(1.0)
    return ConfidenceInterval(low, high, low_known, high_known)


class _Walk:
    """Along one parameter, the others following."""

    def __init__(
        self, problem: LeastSquaresProblem, found: LeastSquaresFit, index: int, allowed: float
    ) -> None:
        self.problem, self.index, self.allowed = problem, index, allowed
        self.start = found.point
        self.others = np.delete(found.point, index)
        error = math.sqrt(found.covariance[index, index])
        self.step = min(max(1.6 * error, 1e-6), 1.0)
        self.near = 1e-3 * self.step
        # A value is asked twice, and the way to it must not make a difference.
        self.known = {float(found.point[index]): found.chi_square - allowed}

    def excess(self, value: float) -> float:
        """Return the profile of the sum of squares above what is allowed."""
        if value not in self.known:
            self.known[value] = self._excess(value)
        return self.known[value]

    def _excess(self, value: float) -> float:
        free = np.delete(np.arange(self.start.size), self.index)

        def residuals(others: Vector) -> Vector:
            return self.problem.residuals(np.insert(others, self.index, value))

        if free.size:
            self.others = _minimum(residuals, self.others, self.problem.low[free], self.problem.high[free])
        left = residuals(self.others)
        return float(left @ left) - self.allowed

    def end(self, side: float) -> tuple[float, bool]:
        """Return the end of the interval on one side, and whether it is not only a bound."""
        self.others = np.delete(self.start, self.index)
        bounds = self.problem.low if side < 0.0 else self.problem.high
        bound, inside, step = float(bounds[self.index]), float(self.start[self.index]), self.step
        for _ in range(_MAX_STEPS):
            outside = side * min(side * (inside + side * step), side * bound)
            try:
                if self.excess(outside) > 0.0:
                    return float(brentq(self.excess, inside, outside, xtol=self.near)), True
            except WearsimError:
                # The case cannot be run so far out.
                step = 0.25 * step
                continue
            if outside == bound:
                break
            inside, step = outside, 2.0 * step
        return inside if outside != bound else bound, False


def _minimum(residuals: Residuals, start: Vector, low: Vector, high: Vector) -> Vector:
    def jacobian(at: Vector) -> Vector:
        return _jacobian(residuals, at, low, high)

    # From next to a bound the steps of the trust region would be tiny.
    margin = 1e-3 * (high - low)
    inside = np.clip(start, low + margin, high - margin)
    found = least_squares(
        residuals,
        inside,
        jac=jacobian,
        bounds=(low, high),
        x_scale=1.0,
        xtol=1e-7,
        ftol=1e-10,
        gtol=1e-8,
        max_nfev=100,
    )
    return np.asarray(found.x)


def _jacobian(residuals: Residuals, at: Vector, low: Vector, high: Vector) -> Vector:
    columns = []
    for index in range(at.size):
        ends = np.tile(at, (2, 1))
        ends[0, index] = max(at[index] - _STEP, low[index])
        ends[1, index] = min(at[index] + _STEP, high[index])
        width = ends[1, index] - ends[0, index]
        columns.append((residuals(ends[1]) - residuals(ends[0])) / width)
    return np.column_stack(columns)


def _covariance(jacobian: Vector) -> tuple[Vector, Vector]:
    """Invert the information, directions without any of it taken as nearly infinite."""
    _, size, directions = np.linalg.svd(jacobian, full_matrices=False)
    floored = np.maximum(size, 1e-6 * max(float(size.max(initial=0.0)), 1e-12))
    covariance = (directions.T / floored**2) @ directions
    error = np.sqrt(np.diag(covariance))
    return covariance, covariance / np.outer(error, error)
