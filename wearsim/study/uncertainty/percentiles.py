"""Percentiles of lives of which some are only known to be longer, and distributions fitted to them."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from wearsim.geometry.profile_points import Vector
from wearsim.quantities import percentile_name

CONFIDENCE = 0.95

B10 = 0.1
"""Share of the lives that end before the rating life, which is also called P10."""

Flags = NDArray[np.bool_]


@dataclass(frozen=True)
class Percentile:
    """The hours that a part of all lives does not exceed."""

    share: float  # the part; `B10` for the life that 90 % reach
    hours: float  # estimate [h]; a lower bound where it is not known
    low: float  # ends of the interval that holds it with 95 % confidence; inf where not known
    high: float  # ends of the interval that holds it with 95 % confidence; inf where not known
    known: bool  # whether the hours are the percentile, not a bound

    @property
    def name(self) -> str:
        """Such as P10."""
        return percentile_name(self.share)

    @property
    def column(self) -> str:
        """Its row in the table of names, such as p10_hours."""
        return f"{self.name.lower()}_hours"


def percentile(lives: Vector, reached: Flags, share: float) -> Percentile:
    """Return a percentile of lives with an interval that assumes no distribution.

    The interval lies between two of the ordered lives: of n independent ones the number below
    the percentile is binomial. For Sobol' points and Latin hypercubes, which scatter less, it
    is too wide.

    Examples
    --------
    >>> percentile(np.arange(1.0, 100.0), np.full(99, True), 0.5).hours
    50.0
    """
    floor = float(lives[~reached].min()) if not reached.all() else math.inf
    ordered = np.sort(np.minimum(np.where(reached, lives, np.inf), floor))
    n = ordered.size
    tail = 0.5 * (1.0 - CONFIDENCE)
    first, last = (int(stats.binom.ppf(p, n, share)) for p in (tail, 1.0 - tail))
    low = float(ordered[first - 1]) if first > 0 else 0.0
    high = float(ordered[last]) if last < n else math.inf
    hours = float(np.quantile(ordered, share, method="median_unbiased"))
    known = float(np.quantile(ordered, share, method="higher")) < floor
    return Percentile(share, hours if known else floor, low, high if high < floor else math.inf, known)


@dataclass(frozen=True)
class DistributionFit:
    """A distribution fitted to lives by maximum likelihood."""

    name: str  # `lognormal` or `weibull`
    shape: float  # sigma of ln L and the median [h]; Weibull's modulus and characteristic life [h]
    scale: float  # sigma of ln L and the median [h]; Weibull's modulus and characteristic life [h]
    log_likelihood: float  # of the lives, the larger the better; both have two parameters
    b10: float  # life that 90 % reach, by the fit [h]


def fit_distributions(lives: Vector, reached: Flags) -> list[DistributionFit]:
    """Return a log-normal and a Weibull distribution fitted to lives."""
    seen = lives[reached]
    if seen.size < 2 or np.ptp(seen) <= 1e-9 * seen.max() or seen.min() == 0.0:
        return []
    unit = float(np.median(seen))
    data = stats.CensoredData(uncensored=seen / unit, right=lives[~reached] / unit)
    found = []
    for name, law in (("lognormal", stats.lognorm), ("weibull", stats.weibull_min)):
        shape, _, scale = law.fit(data, floc=0.0)
        frozen = law(shape, scale=scale)
        likelihood = frozen.logpdf(seen / unit).sum() + frozen.logsf(lives[~reached] / unit).sum()
        likelihood -= seen.size * math.log(unit)
        b10 = unit * float(frozen.ppf(B10))
        found.append(DistributionFit(name, float(shape), unit * float(scale), float(likelihood), b10))
    return sorted(found, key=lambda fit: -fit.log_likelihood)
