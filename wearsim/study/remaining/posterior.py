"""What readings of a chain say about one factor on its wear coefficient: its distribution on a grid."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import log_ndtr
from scipy.stats import chi2

from wearsim.geometry.profile_points import Vector
from wearsim.study.remaining.chain_readings import ChainReading

LEVELS = (0.05, 0.25, 0.5, 0.75, 0.95)
"""Probabilities of the quantiles that are told: ends of 90 and 50 %, and the middle."""

_NORMAL_95 = 1.6448536269514722
_NO_BAND = 1e-6
_FAR = 8.0
"""Standard deviations of the prior, and of a measured factor's logarithm, that the grid reaches out."""

_COARSE, _FINE = 4001, 8001
_NOTHING = 40.0
"""How far below its greatest value a logarithm of the density is left out."""

_UNLIKELY = 0.01
"""Probability of the sum of squares below which the stated errors are taken to be too small."""


@dataclass(frozen=True)
class FactorPrior:
    """A log-normal factor before anything is read."""

    low: float  # with 5 % below
    high: float  # with 5 % above

    @property
    def middle(self) -> float:
        """Mean of its logarithm."""
        return 0.5 * math.log(self.low * self.high)

    @property
    def sigma(self) -> float:
        """Standard deviation of its logarithm; not 0, where the case has no band."""
        return max(0.5 * math.log(self.high / self.low) / _NORMAL_95, _NO_BAND)


@dataclass(frozen=True)
class FactorPosterior:
    """A factor after the readings."""

    quantiles: tuple[float, ...]  # at `LEVELS`
    # what the errors were multiplied by: 1, or more where the values lie too far from one line for chance
    scale: float


def factor_posterior(
    readings: Sequence[ChainReading], expected: Sequence[float], prior: FactorPrior
) -> FactorPosterior:
    """Return the distribution of a factor from readings that should be it times what is expected.

    The prior times the likelihood: of a measured value the normal density of its error, of a gauge
    that fell in or not the probability of that side of its mark.

    Parameters
    ----------
    readings : sequence of ChainReading
        Elongations or sides of marks, with their errors [%].
    expected : sequence of float
        Elongation at each of them with the factor 1 [%].
    prior : FactorPrior
        What is known without them.

    Examples
    --------
    A sharp reading of 1.2 where 1 was expected outweighs a wide prior:

    >>> one = ChainReading(2, 100.0, "elongation_percent", 1.2, 1.2, 0.001)
    >>> factor_posterior([one], [1.0], FactorPrior(0.1, 10.0)).quantiles[2].__round__(3)
    1.2
    """
    pairs = list(zip(readings, expected, strict=True))
    scale = _scale([(one, at) for one, at in pairs if one.measured])

    def density(logs: Vector) -> Vector:
        found = -0.5 * ((logs - prior.middle) / prior.sigma) ** 2
        for one, at in pairs:
            found += _log_likelihood(one, at * np.exp(logs), scale)
        return found

    reach = _FAR * prior.sigma
    near = [math.log(one.mark / at) for one, at in pairs if one.mark > 0.0]
    ends = min([prior.middle, *near]) - reach, max([prior.middle, *near]) + reach
    coarse = np.linspace(*ends, _COARSE)
    logs = _where_it_matters(coarse, density(coarse))
    fine = density(logs)
    weight = np.exp(fine - fine.max())
    below = np.concatenate([[0.0], np.cumsum(0.5 * (weight[1:] + weight[:-1]))])
    found = np.exp(np.interp(LEVELS, below / below[-1], logs))
    return FactorPosterior(tuple(float(value) for value in found), scale)


def _where_it_matters(logs: Vector, density: Vector) -> Vector:
    """Return a finer grid where the density is more than nothing."""
    kept = np.flatnonzero(density > density.max() - _NOTHING)
    first, last = max(kept[0] - 1, 0), min(kept[-1] + 1, logs.size - 1)
    return np.linspace(logs[first], logs[last], _FINE)


def _log_likelihood(one: ChainReading, predicted: Vector, scale: float) -> Vector:
    if one.measured:
        return -0.5 * ((predicted - one.low) / (scale * one.error)) ** 2
    return log_probability(one, predicted)


def log_probability(one: ChainReading, predicted: Vector) -> Vector:
    """Return the logarithm of the probability that a gauge sees the elongation on its side of the mark."""
    side = 1.0 if math.isinf(one.low) else -1.0
    return np.asarray(log_ndtr(side * (one.mark - predicted) / one.error))


def _scale(measured: Sequence[tuple[ChainReading, float]]) -> float:
    """Return what the errors must be multiplied by for the values to lie on one line.

    Least squares of the values over their errors, in closed form as there is one factor.
    """
    freedom = len(measured) - 1
    if freedom < 1:
        return 1.0
    values = np.array([one.low / one.error for one, _ in measured])
    slopes = np.array([at / one.error for one, at in measured])
    factor = float(slopes @ values) / float(slopes @ slopes)
    square = float(((values - factor * slopes) ** 2).sum())
    return math.sqrt(square / freedom) if chi2.sf(square, freedom) < _UNLIKELY else 1.0
