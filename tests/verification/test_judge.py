"""The court of laws: likelihoods by hand and by SciPy, integrals, and data whose law is known."""

import numpy as np
import pytest
from scipy import stats
from scipy.integrate import quad

from wearsim.study.judge.laws import laws_for, ln_shape
from wearsim.study.judge.model import judge_series
from wearsim.study.judge.sampler import draws
from wearsim.study.judge.series_scatter import Scatter, forecasts, log_scores, quantiles
from wearsim.study.judge.wear_series import WearReading, wear_series

pytestmark = pytest.mark.wide


def columns(*values):
    return [np.array([[value]]) for value in values]


def scatter(series, walk, reading):
    return Scatter(*columns(series, walk, reading))


def test_likelihood_of_two_readings_by_hand():
    """ln w = 0.3, 0.5 about 0 with variances 0.25, 0.25 + 0.01 and covariance 0.25: det = 0.0051."""
    data = wear_series([WearReading("a", 1.0, np.exp(0.3)), WearReading("a", 2.0, np.exp(0.5))], "h", "um")
    found = forecasts(np.zeros((1, 2)), scatter(0.5, 0.0, 0.1), data)
    square = (0.26 * 0.3**2 - 2 * 0.25 * 0.3 * 0.5 + 0.26 * 0.5**2) / 0.0051
    by_hand = -np.log(2 * np.pi) - 0.5 * np.log(0.0051) - 0.5 * square
    assert found.log_likelihood[0] == pytest.approx(by_hand, rel=1e-12)


def test_forecast_of_a_known_series_by_hand():
    """After ln w = 0.3 25/26 of it the series': mean 0.288, variance 0.0096 + 0.02 + 0.01."""
    first, later = WearReading("a", 1.0, np.exp(0.3)), WearReading("a", np.e, 1.0, held_out=True)
    found = forecasts(
        np.zeros((1, 2)), scatter(0.5, np.sqrt(0.02), 0.1), wear_series([first, later], "h", "um")
    )
    assert found.mean[0, 1] == pytest.approx(0.3 * 0.25 / 0.26)
    assert found.variance[0, 1] == pytest.approx(0.25 * 0.01 / 0.26 + 0.02 + 0.01)


def test_likelihood_by_scipy():
    random = np.random.default_rng(3)
    exposure = np.array([1.0, 2.0, 5.0, 20.0])
    readings = [
        WearReading(name, s, w, error=0.05)
        for name in "ab"
        for s, w in zip(exposure, np.exp(random.normal(size=4)), strict=True)
    ]
    data, ln_law = wear_series(readings, "h", "um"), random.normal(size=(1, 8))
    found = forecasts(ln_law, scatter(0.4, 0.3, 0.2), data)
    walked = np.minimum.outer(np.log(exposure), np.log(exposure))
    off = np.log(data.wear) - ln_law[0]
    expected = 0.0
    for part in (slice(0, 4), slice(4, 8)):
        own = np.diag(0.2**2 + (0.05 * np.exp(-ln_law[0, part])) ** 2)
        expected += stats.multivariate_normal.logpdf(off[part], cov=0.4**2 + 0.3**2 * walked + own)
    assert found.log_likelihood[0] == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(("censored", "expected"), [(1, stats.norm.logsf), (-1, stats.norm.logcdf)])
def test_a_censored_reading_after_another(censored, expected):
    readings = [WearReading("a", 1.0, np.exp(0.3)), WearReading("a", 2.0, np.exp(0.7), censored=censored)]
    found = forecasts(np.zeros((1, 2)), scatter(0.5, 0.0, 0.1), wear_series(readings, "h", "um"))
    mean, variance = 0.3 * 0.25 / 0.26, 0.25 * 0.01 / 0.26 + 0.01
    known = stats.norm.logpdf(0.3, scale=np.sqrt(0.26))
    assert found.log_likelihood[0] == pytest.approx(known + expected(0.7, mean, np.sqrt(variance)))


def test_what_a_censored_reading_leaves():
    """Mean and variance of the state are those of the joint distribution, by integration."""
    readings = [WearReading("a", 1.0, 1.0, censored=1), WearReading("a", 2.0, 1.0, held_out=True)]
    found = forecasts(np.zeros((1, 2)), scatter(0.5, 0.0, 0.3), wear_series(readings, "h", "um"))

    def moment(power):
        density = lambda z: z**power * stats.norm.pdf(z, scale=0.5) * stats.norm.cdf(z / 0.3)  # noqa: E731
        return quad(density, -5, 5)[0]

    mean = moment(1) / moment(0)
    assert found.mean[0, 1] == pytest.approx(mean)
    assert found.variance[0, 1] == pytest.approx(moment(2) / moment(0) - mean**2 + 0.09)


def test_scores_and_quantiles_of_a_mixture():
    """Two draws, 0 and 1 with sd 0.5: the density at ln w = 1 is the mean of both."""
    data = wear_series([WearReading("a", 1.0, np.e, held_out=True)], "h", "um")
    both = Scatter(*(np.full((2, 1), value) for value in (0.3, 0.0, 0.4)))
    found = forecasts(np.array([[0.0], [1.0]]), both, data)
    densities = stats.norm.pdf(1.0, [0.0, 1.0], 0.5)
    assert log_scores(found, data)[0] == pytest.approx(np.log(densities.mean()))
    assert quantiles(found, 0.5)[0] == pytest.approx(np.exp(0.5), rel=1e-5)
    low = np.log(quantiles(found, 0.05)[0])
    assert stats.norm.cdf(low, [0.0, 1.0], 0.5).mean() == pytest.approx(0.05, rel=1e-4)


def test_draws_of_a_normal_posterior():
    """Three readings of variance 0.5 and a normal expectation: mean and variance in closed form."""
    readings = np.array([1.0, 2.0, 4.5])
    found = draws(lambda x: -((x - readings) ** 2).sum(axis=1), np.zeros(1), np.array([2.0]), 4000)
    variance = 1.0 / (1.0 / 4.0 + 3.0 / 0.5)
    assert found.mean() == pytest.approx(variance * 7.5 / 0.5, abs=4.0 * np.sqrt(variance / 4000) * 2)
    assert found.std() == pytest.approx(np.sqrt(variance), rel=0.05)


def law_of(data, name):
    return next(law for law in laws_for(data) if law.name == name)


def shape(data, name, values):
    columned = dict(zip(values, columns(*values.values()), strict=True))
    return np.exp(ln_shape(law_of(data, name), columned, data))[0]


def test_lubricant_age_is_the_integral_of_its_ramp():
    """Oiled after the second of three readings: the age starts again there."""
    readings = [
        WearReading("a", 2.0, 1.0),
        WearReading("a", 5.0, 1.0, relubricated=True),
        WearReading("a", 15.0, 1.0),
    ]
    data = wear_series(readings, "h", "um")

    def worn(hours):
        ramp = lambda s: 1.0 + 9.0 * np.clip((s - 3.0) / 4.0, 0.0, 1.0)  # noqa: E731
        return quad(ramp, 0.0, hours, points=[3.0, 7.0] if hours > 7 else None)[0]

    constants = {"dry_factor_less_1": 9.0, "lasts": 3.0 / 15.0, "fades_over": 4.0 / 15.0}
    found = 15.0 * shape(data, "lubricant age", constants)
    assert found == pytest.approx([2.0, worn(5.0), worn(5.0) + worn(10.0)])


def test_running_in_is_the_integral_of_its_coefficient():
    data = wear_series([WearReading("a", 2.0, 1.0), WearReading("a", 10.0, 1.0)], "h", "um")
    found = 10.0 * shape(data, "running-in", {"run_in_factor_less_1": 4.0, "run_in": 0.3})
    expected = [quad(lambda s: 1.0 + 4.0 * np.exp(-s / 3.0), 0.0, hours)[0] for hours in (2.0, 10.0)]
    assert found == pytest.approx(expected)


def test_slip_and_t_gamma():
    """A tenth of 3 m rolled is slid; 5.3 x of mild wear for each metre rolled, 55 of severe wear."""
    readings = [WearReading("a", 3.0, 1.0, slip=0.1, t_gamma=2.0), WearReading("b", 6.0, 1.0, t_gamma=20.0)]
    data = wear_series(readings, "m", "um")
    assert 6.0 * shape(data, "Archard", {}) == pytest.approx([0.3, 6.0])
    assert 6.0 * shape(data, "T-gamma", {}) == pytest.approx([3.0 * 10.6, 6.0 * 55.0])


def test_environments_add_up():
    """2 h dry, 3 h wet at 4 times the rate, 5 h dry; another series begins anew."""
    readings = [
        WearReading("a", 2.0, 1.0, environment="dry"),
        WearReading("a", 5.0, 1.0, environment="wet"),
        WearReading("a", 10.0, 1.0, environment="dry"),
        WearReading("b", 4.0, 1.0, environment="wet"),
    ]
    found = 10.0 * shape(wear_series(readings, "h", "um"), "environment", {"wet over dry": 4.0})
    assert found == pytest.approx([2.0, 14.0, 19.0, 16.0])


EXPOSURE = np.array([1.0, 2.0, 4.0, 8.0, 12.0, 16.0])


def simulated(worn, seed, series=9, sd=(0.2, 0.03), held_out=lambda s, load: s > 8.0, **fields):
    """Readings of a known law, loads 1, 3 and 9 by turns; the last two of each series are held out."""
    random = np.random.default_rng(seed)
    found = []
    for number in range(series):
        load = (1.0, 3.0, 9.0)[number % 3]
        own = random.normal(scale=sd[0])
        for place, (s, wear) in enumerate(zip(EXPOSURE, worn(EXPOSURE, load), strict=True)):
            read = wear * np.exp(own + random.normal(scale=sd[1]))
            given = {name: values[place] for name, values in fields.items()}
            found.append(WearReading(str(number), s, read, load=load, held_out=held_out(s, load), **given))
    return wear_series(found, "h", "um", "relubricated" in fields)


WET = np.array([0, 1, 0, 0, 1, 0])
PHASES = np.diff(EXPOSURE, prepend=0.0)
KNOWN = {
    "Archard": (lambda s, p: 2.0 * p * s, {}),
    "cycle power": (lambda s, p: 2.0 * p * s**0.3, {}),
    "powers": (lambda s, p: 2.0 * p**0.4 * s**0.4, {"held_out": lambda s, load: load == 3.0}),
    "running-in": (lambda s, p: p * (s + 6.0 * (1.0 - np.exp(-s / 1.5))), {}),
    "offset": (lambda s, p: p * (5.0 + s), {}),
    "lubricant age": (
        lambda s, p: (
            p * (s + 14.0 * np.where(s > 4.0, np.where(s < 7.0, (s - 4.0) ** 2 / 6.0, s - 5.5), 0.0))
        ),
        {"relubricated": [False] * 6, "held_out": lambda s, load: s > 12.0},
    ),
    "environment": (
        lambda s, p: p * np.cumsum(PHASES * np.where(WET, 8.0, 1.0)),
        {"environment": ["wet" if wet else "dry" for wet in WET]},
    ),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", KNOWN)
def test_the_law_behind_the_data_wins(name):
    worn, fields = KNOWN[name]
    found = judge_series(simulated(worn, 5, **fields), 300, lambda _, scatter: scatter == "factor")
    assert name in found.ties
    assert found.simplest.law in (name, f"{name}, load power"), found.ties
    assert not found.objections
    assert found.simplest.median_error < 0.15


def test_constants_are_found():
    found = judge_series(simulated(KNOWN["powers"][0], 5), 300, lambda law, _: law == "powers").best
    constants = {one.name: one for one in found.constants}
    assert constants["exposure_exponent"].low < 0.4 < constants["exposure_exponent"].high
    assert constants["load_exponent"].low < 0.4 < constants["load_exponent"].high


def test_a_factor_that_wanders_is_told_from_one_that_stays():
    random = np.random.default_rng(8)
    found = []
    for number in range(20):
        drift = np.cumsum(0.3 * random.normal(size=6) * np.sqrt(np.log(2.0)))
        wear = EXPOSURE * np.exp(drift + 0.02 * random.normal(size=6))
        found += [WearReading(str(number), s, w, held_out=s > 8) for s, w in zip(EXPOSURE, wear, strict=True)]
    judged = judge_series(wear_series(found, "h", "um"), 300, lambda law, _: law == "Archard")
    assert judged.best.scatter == "walk" and not judged.laws[1].tied


@pytest.mark.slow
def test_bands_of_200_data_sets_hold_what_they_say():
    """The last two readings of 5 known series, 200 times: shares in the bands, to 3 standard errors."""
    inside = {0.5: [], 0.9: []}
    for seed in range(200):
        data = simulated(KNOWN["powers"][0], seed, series=5, sd=(0.3, 0.1))
        found = judge_series(data, 100, lambda *names: names == ("powers", "factor")).best
        inside[0.5].append(found.coverage_50)
        inside[0.9].append(found.coverage_90)
    for share, held in inside.items():
        assert abs(np.mean(held) - share) < 3.0 * np.std(held) / np.sqrt(200), (share, np.mean(held))


def test_readings_without_any_law_are_told():
    random = np.random.default_rng(4)
    found = [
        WearReading(str(number), s, float(np.exp(random.normal())), held_out=s > 8)
        for number in range(10)
        for s in EXPOSURE
    ]
    judged = judge_series(wear_series(found, "h", "um"), 300)
    assert any("constant wear" in text for text in judged.objections)


def test_a_law_that_breaks_later_is_told():
    """Wear in proportion up to 8 h, then 5 times as much at once: no band holds it."""
    data = simulated(lambda s, p: p * s * np.where(s > 8.0, 5.0, 1.0), 6)
    judged = judge_series(data, 300)
    assert any("the 90 % band" in text for text in judged.objections)
