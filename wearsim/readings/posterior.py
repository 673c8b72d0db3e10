"""What readings of a chain say about one factor on its wear coefficient: its distribution on a grid."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq
from scipy.special import log_ndtr
from scipy.stats import chi2

from wearsim.case.model import log_deviation
from wearsim.geometry.profile_points import Vector
from wearsim.readings.chain_readings import ChainReading

LEVELS = (0.05, 0.25, 0.5, 0.75, 0.95)
"""Probabilities of the quantiles that are told: ends of 90 and 50 %, and the middle."""

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
        return max(log_deviation(self.low, self.high), _NO_BAND)


@dataclass(frozen=True)
class FactorPosterior:
    """A factor after the readings."""

    quantiles: tuple[float, ...]  # at `LEVELS`
    # what the errors were multiplied by: 1, or more where the readings lie too far from one line for chance
    scale: float
    nearest: float  # that of the readings alone, by least squares; of gauges that all agree, the median


def factor_posterior(
    readings: Sequence[ChainReading], expected: Sequence[float], prior: FactorPrior
) -> FactorPosterior:
    """Return the distribution of a factor from readings that should be it times what is expected.

    The prior times the likelihood: of a measured value the normal density of its error, of a gauge
    that fell in or not the probability of that side of its mark. Readings that are too far from one
    line for chance have larger errors than they state. These are taken so much larger, a gauge on the wrong
    side of its mark as a value at the mark, and the factor that they give as log-normal about that of least
    squares: a normal density would reach below 0, and leave the answer to the prior.

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
    nearest = _nearest(pairs)
    fixing = [(one, at) for one, at in pairs if one.measured or _miss(one, nearest * at) != 0.0]
    scale = _scale(fixing, nearest)
    # Of readings whose errors are too small, what they say together; else each of them.
    together = _log_normal(fixing, nearest, scale) if scale > 1.0 else None
    alone = [pair for pair in pairs if together is None or pair not in fixing]

    def density(logs: Vector) -> Vector:
        found = -0.5 * ((logs - prior.middle) / prior.sigma) ** 2
        if together is not None:
            found -= 0.5 * ((logs - together[0]) / together[1]) ** 2
        for one, at in alone:
            found += _log_likelihood(one, at * np.exp(logs))
        return found

    reach = _FAR * prior.sigma
    near = [math.log(one.mark / at) for one, at in pairs if one.mark > 0.0]
    ends = min([prior.middle, *near]) - reach, max([prior.middle, *near]) + reach
    coarse = np.linspace(*ends, _COARSE)
    logs = _where_it_matters(coarse, density(coarse))
    fine = density(logs)
    weight = np.exp(fine - fine.max())
    below = np.concatenate([[0.0], np.cumsum(0.5 * (weight[1:] + weight[:-1]))])
    found = tuple(float(value) for value in np.exp(np.interp(LEVELS, below / below[-1], logs)))
    return FactorPosterior(found, scale, nearest if fixing else found[len(LEVELS) // 2])


def _where_it_matters(logs: Vector, density: Vector) -> Vector:
    """Return a finer grid where the density is more than nothing."""
    kept = np.flatnonzero(density > density.max() - _NOTHING)
    first, last = max(kept[0] - 1, 0), min(kept[-1] + 1, logs.size - 1)
    return np.linspace(logs[first], logs[last], _FINE)


def _log_likelihood(one: ChainReading, predicted: Vector) -> Vector:
    if one.measured:
        return -0.5 * ((predicted - one.low) / one.error) ** 2
    return log_probability(one, predicted)


def log_probability(one: ChainReading, predicted: Vector) -> Vector:
    """Return the logarithm of the probability that a gauge sees the elongation on its side of the mark."""
    side = 1.0 if math.isinf(one.low) else -1.0
    return np.asarray(log_ndtr(side * (one.mark - predicted) / one.error))


def _miss(one: ChainReading, predicted: float) -> float:
    """Return by how many errors a prediction lies beyond what was read; of a gauge on its side 0."""
    return (max(predicted - one.high, 0.0) - max(one.low - predicted, 0.0)) / one.error


def _nearest(pairs: Sequence[tuple[ChainReading, float]]) -> float:
    """Return the factor of least squares, to which a gauge on the wrong side of its mark adds that mark.

    The slope of the sum of squares rises with the factor, and changes its sign between the least and the
    greatest factor that a reading asks for.
    """

    def slope(factor: float) -> float:
        return math.fsum(_miss(one, factor * at) * at / one.error for one, at in pairs)

    asked = [one.mark / at for one, at in pairs]
    low, high = min(asked), max(asked)
    if slope(low) >= 0.0:
        return low
    return float(brentq(slope, low, high)) if slope(high) > 0.0 else high


def _log_normal(
    fixing: Sequence[tuple[ChainReading, float]], nearest: float, scale: float
) -> tuple[float, float]:
    """Return the mean and the standard deviation of the logarithm of a factor by least squares."""
    error = scale / math.hypot(*(at / one.error for one, at in fixing))
    return math.log(nearest), error / nearest


def _scale(fixing: Sequence[tuple[ChainReading, float]], nearest: float) -> float:
    """Return what the errors must be multiplied by for the readings that fix a factor to lie on one line."""
    freedom = len(fixing) - 1
    if freedom < 1 or nearest <= 0.0:
        return 1.0
    square = math.fsum(_miss(one, nearest * at) ** 2 for one, at in fixing)
    return math.sqrt(square / freedom) if chi2.sf(square, freedom) < _UNLIKELY else 1.0
