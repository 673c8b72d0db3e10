"""Values of a key by their probability."""

from collections.abc import Callable

import numpy as np
from scipy import stats

from wearsim.case.keys.study_tables import Distribution
from wearsim.geometry.profile_points import Vector

Quantile = Callable[[Vector], Vector]


def quantile(scatter: Distribution, value: float) -> Quantile:
    """Return the value of a key by its probability.

    Examples
    --------
    >>> scatter = Distribution(distribution="lognormal", sigma_ln=0.5)
    >>> float(quantile(scatter, 2.0)(np.array([0.5]))[0])
    2.0
    """
    if scatter.sigma_ln == 0.0:
        median = value if scatter.median is None else scatter.median
        return lambda share: np.full(share.shape, float(median))
    whole = _whole(scatter, value)
    if scatter.distribution in ("uniform", "triangular"):
        return lambda share: np.asarray(whole.ppf(share))
    low = 0.0 if scatter.low is None else float(whole.cdf(scatter.low))
    high = 1.0 if scatter.high is None else float(whole.cdf(scatter.high))
    if not low < high:
        raise ValueError("its low and high must leave a part of the distribution, but leave none")
    return lambda share: np.asarray(whole.ppf(low + (high - low) * share))


def _whole(scatter: Distribution, value: float) -> "stats.distributions.rv_frozen":
    low, high = float(scatter.low or 0.0), float(scatter.high or 0.0)
    match scatter.distribution:
        case "lognormal":
            median = value if scatter.median is None else scatter.median
            sigma = float(scatter.sigma_ln or 0.0)
            if not median > 0.0:
                raise ValueError(f"a log-normal key must be above 0, is {median:g}")
            return stats.lognorm(sigma, scale=median)
        case "normal":
            mean = value if scatter.mean is None else scatter.mean
            return stats.norm(mean, float(scatter.standard_deviation or 1.0))
        case "uniform":
            return stats.uniform(low, high - low)
        case "triangular":
            mode = float(value if scatter.mode is None else scatter.mode)
            if not low <= mode <= high:
                raise ValueError(f"its mode must lie from {low:g} to {high:g}, is {mode:g}")
            return stats.triang((mode - low) / (high - low), low, high - low)
        case _:
            assert scatter.shape is not None and scatter.scale is not None
            return stats.weibull_min(scatter.shape, scale=scatter.scale)


def described(scatter: Distribution, value: float) -> str:
    """Return a distribution in words.

    Examples
    --------
    >>> described(Distribution(distribution="lognormal", sigma_ln=0.5), 2e-10)
    'lognormal, median 2e-10, sigma_ln 0.5'
    """
    taken = {"lognormal": "median", "normal": "mean", "triangular": "mode"}
    given = scatter.model_dump(exclude_none=True, exclude={"distribution"})
    if (name := taken.get(scatter.distribution)) is not None:
        given = {name: given.pop(name, value), **given}
    shown = ", ".join(f"{name} {number:.6g}" for name, number in given.items())
    return f"{scatter.distribution}, {shown}"
