"""Percentiles, their intervals, fits and distributions against closed forms."""

import math

import numpy as np
import pytest
from scipy import stats

from wearsim.case.keys.study_tables import Distribution
from wearsim.runner.samples import METHODS, unit_samples
from wearsim.runner.scatter import quantile
from wearsim.study.uncertainty.percentiles import fit_distributions, percentile

ALL = np.full(1000, True)


def test_interval_covers_as_it_says():
    """Of 1000 sets of 60 lives, at least 93 % of the intervals hold the exact percentile."""
    rng = np.random.default_rng(1)
    for share, exact in ((0.1, -math.log(0.9)), (0.5, math.log(2.0))):
        found = [percentile(rng.exponential(size=60), ALL[:60], share) for _ in range(1000)]
        assert np.mean([one.low <= exact <= one.high for one in found]) > 0.93
        assert np.mean([one.high - one.low for one in found]) < 0.8


def test_percentile_beyond_the_horizon_is_a_bound():
    lives = np.minimum(np.arange(1.0, 101.0), 60.0)
    reached = lives < 60.0
    assert percentile(lives, reached, 0.5).hours == pytest.approx(50.5)
    above = percentile(lives, reached, 0.9)
    assert (above.hours, above.high, above.known) == (60.0, math.inf, False)


def test_lognormal_fit_is_mean_and_scatter_of_the_logarithms():
    lives = np.exp(np.random.default_rng(2).normal(7.0, 0.4, 1000))
    best = fit_distributions(lives, ALL)[0]
    assert best.name == "lognormal"
    assert best.shape == pytest.approx(np.log(lives).std(), rel=1e-4)
    assert best.scale == pytest.approx(math.exp(np.log(lives).mean()), rel=1e-4)
    assert best.b10 == pytest.approx(best.scale * math.exp(-1.281552 * best.shape), rel=1e-5)
    exact = stats.norm.logpdf(np.log(lives), np.log(lives).mean(), np.log(lives).std()).sum()
    assert best.log_likelihood == pytest.approx(exact - np.log(lives).sum(), rel=1e-7)


def test_weibull_fit_with_suspensions_solves_the_likelihood_equations():
    """Sum of t^b over all is n_f eta^b, and the derivative by the shape vanishes."""
    rng = np.random.default_rng(3)
    lives = np.minimum(5000.0 * rng.weibull(2.2, 400), 6000.0)
    reached = lives < 6000.0
    (fit,) = (fit for fit in fit_distributions(lives, reached) if fit.name == "weibull")
    powers, failures = lives**fit.shape, reached.sum()
    assert powers.sum() == pytest.approx(failures * fit.scale**fit.shape, rel=1e-3)
    slope = (powers * np.log(lives)).sum() / powers.sum() - np.log(lives[reached]).mean()
    assert 1.0 / slope == pytest.approx(fit.shape, rel=1e-3)


def test_no_fit_of_equal_lives():
    assert fit_distributions(np.full(1000, 5.0), ALL) == []


@pytest.mark.parametrize(
    ("table", "value", "exact"),
    [
        ({"distribution": "lognormal", "sigma_ln": 0.5}, 2.0, 2.0 * math.exp(0.5 * 1.2815516)),
        ({"distribution": "lognormal", "sigma_ln": 0.5, "median": 3}, 2.0, 3.0 * math.exp(0.6407758)),
        ({"distribution": "lognormal", "sigma_ln": 0.0}, 2.0, 2.0),
        ({"distribution": "normal", "standard_deviation": 0.1}, 5.0, 5.12815516),
        ({"distribution": "normal", "standard_deviation": 1, "mean": 1}, 5.0, 2.2815516),
        ({"distribution": "uniform", "low": 1, "high": 3}, 9.0, 2.8),
        ({"distribution": "triangular", "low": 0, "high": 2}, 1.0, 2.0 - math.sqrt(0.2)),
        ({"distribution": "triangular", "low": 0, "high": 2, "mode": 2}, 1.0, math.sqrt(3.6)),
        ({"distribution": "weibull", "shape": 2, "scale": 3}, 1.0, 3.0 * math.sqrt(math.log(10.0))),
        # The upper half of a normal distribution: 0.95 of the whole.
        ({"distribution": "normal", "standard_deviation": 1, "low": 0}, 0.0, 1.6448536),
    ],
    ids=lambda part: str(part)[:60],
)
def test_ninth_decile(table, value, exact):
    law = quantile(Distribution(**table), value)
    assert law(np.array([0.9]))[0] == pytest.approx(exact, rel=1e-6)


@pytest.mark.parametrize(
    ("table", "value"),
    [
        ({"distribution": "lognormal", "sigma_ln": 0.5}, -1.0),
        ({"distribution": "triangular", "low": 0, "high": 2}, 3.0),
        ({"distribution": "weibull", "shape": 2, "scale": 3, "high": -1}, 1.0),
    ],
)
def test_distribution_that_leaves_nothing(table, value):
    with pytest.raises(ValueError, match="must"):
        quantile(Distribution(**table), value)


@pytest.mark.parametrize("method", METHODS)
def test_samples_fill_the_cube_and_follow_the_seed(method):
    points = unit_samples(3, 256, 7, method)
    assert np.array_equal(points, unit_samples(3, 256, 7, method))
    assert not np.array_equal(points, unit_samples(3, 256, 8, method))
    assert points.min() > 0.0
    assert points.max() < 1.0
    assert np.abs(points.mean(axis=0) - 0.5).max() < (0.06 if method == "random" else 0.005)


def test_independent_samples_do_not_depend_on_their_number():
    assert np.array_equal(unit_samples(2, 8, 7, "random"), unit_samples(2, 16, 7, "random")[:8])
