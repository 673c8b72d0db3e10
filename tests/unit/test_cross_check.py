"""Fits repeated by the library reliability: published answers, closed forms, an independent maximum."""

import math
from dataclasses import replace
from importlib.util import find_spec

import numpy as np
import pandas as pd
import pytest
from scipy import optimize, stats

if find_spec("reliability") is None:  # its import changes how pandas prints
    pytest.skip("reliability is not installed", allow_module_level=True)

from wearsim.study.uncertainty.cross_check import cross_check
from wearsim.study.uncertainty.percentiles import fit_distributions

# Distances to failure of vehicle shock absorbers [km], 11 of 38 failed: O'Connor (1985), as in Meeker and
# Escobar, Statistical Methods for Reliability Data (1998), table C.2. Their chapter 8 gives the maxima.
FAILED = [6700, 9120, 12200, 13150, 14300, 17520, 20100, 20900, 22700, 26510, 27490]
RUNNING = [
    6950,
    7820,
    8790,
    9660,
    9820,
    11310,
    11690,
    11850,
    11880,
    12140,
    12870,
    13330,
    13470,
    14040,
    17540,
    17890,
    18450,
    18960,
    18980,
    19410,
    20100,
    20150,
    20320,
    23490,
    27410,
    27890,
    28100,
]
ABSORBERS = np.array([*FAILED, *RUNNING], float)
BROKEN = np.arange(38) < 11


def by_name(lives, reached):
    crossed = cross_check(lives, reached, fit_distributions(lives, reached))
    assert crossed.differences_found == ()
    return {fit.name: fit for fit in crossed.fits}


def test_shock_absorbers_give_the_published_maxima():
    found = by_name(ABSORBERS, BROKEN)
    weibull, lognormal = found["weibull"], found["lognormal"]
    assert math.log(weibull.scale.value) == pytest.approx(10.23, abs=0.005)
    assert 1.0 / weibull.shape.value == pytest.approx(0.3164, abs=0.0005)
    assert math.log(lognormal.scale.value) == pytest.approx(10.14, abs=0.01)
    assert lognormal.shape.value == pytest.approx(0.530, abs=0.001)


@pytest.mark.wide
@pytest.mark.parametrize("name", ["weibull", "lognormal"])
def test_maximum_and_bounds_by_the_likelihood_written_out(name):
    """The smallest extreme value and the normal distribution of ln t, and their curvature."""
    logs = np.log(ABSORBERS)
    law = stats.gumbel_l if name == "weibull" else stats.norm

    def cost(at):
        mu, sigma = at[0], math.exp(at[1])
        seen = law.logpdf(logs[BROKEN], mu, sigma).sum()
        return -seen - law.logsf(logs[~BROKEN], mu, sigma).sum()

    options = {"xatol": 1e-9, "fatol": 1e-12}
    best = optimize.minimize(cost, (10.0, -1.0), method="Nelder-Mead", options=options).x
    a, b = 1e-3 * np.eye(2)
    curvature = [
        [
            (cost(best + p + q) - cost(best + p - q) - cost(best - p + q) + cost(best - p - q)) / 4e-6
            for p in (a, b)
        ]
        for q in (a, b)
    ]
    deviation = 1.959964 * np.sqrt(np.diag(np.linalg.inv(curvature)))
    found = by_name(ABSORBERS, BROKEN)[name]
    ends = [np.exp(best[0] + sign * deviation[0]) for sign in (0.0, -1.0, 1.0)]
    assert list(vars(found.scale).values()) == pytest.approx(ends, rel=1e-3)
    ends = [np.exp(best[1] + sign * deviation[1]) for sign in (0.0, -1.0, 1.0)]
    if name == "weibull":
        ends = [1.0 / ends[0], 1.0 / ends[2], 1.0 / ends[1]]
    assert list(vars(found.shape).values()) == pytest.approx(ends, rel=1e-3)


def test_bounds_of_complete_logarithms_are_closed_forms():
    """mu +- z sigma / sqrt(n), and sigma exp(+- z / sqrt(2 n))."""
    lives = np.exp(np.random.default_rng(5).normal(9.0, 0.3, 200))
    found = by_name(lives, lives > 0.0)["lognormal"]
    mu, sigma = np.log(lives).mean(), np.log(lives).std()
    wide, wider = 1.959964 * sigma / math.sqrt(200), 1.959964 / math.sqrt(400)
    assert found.scale.low == pytest.approx(math.exp(mu - wide), rel=1e-4)
    assert found.scale.high == pytest.approx(math.exp(mu + wide), rel=1e-4)
    assert found.shape.low == pytest.approx(sigma * math.exp(-wider), rel=1e-3)
    assert found.shape.high == pytest.approx(sigma * math.exp(wider), rel=1e-3)


@pytest.mark.wide
@pytest.mark.parametrize("part", ["shape", "scale"])
@pytest.mark.parametrize(("factor", "told"), [(1.009, 0), (1.012, 1)])
def test_parameters_that_differ_are_told(part, factor, told):
    ours = [
        replace(fit, **{part: factor * getattr(fit, part)}) for fit in fit_distributions(ABSORBERS, BROKEN)
    ]
    differences_found = cross_check(ABSORBERS, BROKEN, ours).differences_found
    assert len(differences_found) == 2 * told
    assert all(f"the {part} of the" in text and "within 1 %" in text for text in differences_found)


def test_no_fit_is_no_fault():
    lives = np.full(10, 5.0)
    assert cross_check(lives, lives > 0.0, fit_distributions(lives, lives > 0.0)).fits == ()


def test_what_the_library_prints_or_raises_is_a_doubt(monkeypatch):
    with pd.option_context("display.float_format", None):
        from reliability import Fitters

    original = Fitters.Fit_Weibull_2P.__init__

    def complaining(self, **given):
        print("\x1b[31mWARNING: the optimizer gave up\x1b[0m")
        original(self, **given)

    def failing(self, **given):
        raise ValueError("no maximum")

    monkeypatch.setattr(Fitters.Fit_Weibull_2P, "__init__", complaining)
    monkeypatch.setattr(Fitters.Fit_Lognormal_2P, "__init__", failing)
    crossed = cross_check(ABSORBERS, BROKEN, fit_distributions(ABSORBERS, BROKEN))
    assert [fit.name for fit in crossed.fits] == ["weibull"]
    assert any(text.endswith("weibull: the optimizer gave up") for text in crossed.differences_found)
    assert any("finds no lognormal fit: no maximum" in text for text in crossed.differences_found)
