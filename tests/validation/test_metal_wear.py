"""V1: wear of metal specimens at three loads

12 specimens, 4 each at 10, 50 and 100 g, measured at 8 numbers of cycles from 2 to 500
([metal_wear.csv](../tests/validation/data/metal_wear.csv)). The logarithm of the reading is assumed
to be linear in the logarithms of load and cycles, with a constant factor for each specimen: the
log-normal scatter of `wearsim uncertainty`. Only the law and the statistics are tested; the engine
runs in two rows only.

Calibrated on 10 and 100 g, it predicts 50 g; calibrated on all readings up to 50 cycles, it predicts
those at 100, 200 and 500. The population band covers 90 % of all specimens at one load; the band of
a known specimen uses its own factor from its first 5 readings. The engine, with Archard's constant
coefficient, is calibrated at 10 g and 50 cycles.

Failures: at 50 g the wear grows more slowly than at the other two loads (exponents 0.168 against
0.20), so the prediction is too high beyond 100 cycles. Bands are too narrow, with 8 to 10 of 12
specimens where 10.8 are expected: specimens at one load drift together, and specimen 105 falls
behind, which a constant factor cannot describe. No constant coefficient gives wear that slows
down like this in any geometry (Archard: cycles to the power 1 for a depth, 1/3 for the scar width
of a cylinder, 1/4 for that of a ball; load likewise).

The rows *power law* do not use the engine: load and cycles have fitted powers, about 0.65 and
0.19, each specimen has a drifting factor, as fitted by `wearsim judge` ([which law](laws.md)). The
law is fitted up to 50 cycles, or to 10 and 50 g. Its means pass where those of the engine fail. Its
bands hold 10 or 11 of 12; at 200 and 500 cycles one specimen is only 0.2 % inside the edge.

Not shown: anything about a chain or a tooth, or a coefficient: geometry, materials and the
meaning of the reading (depth or width) are unknown.
"""

import numpy as np
import pytest
from scipy import stats

import wearsim
from wearsim.case.keys.study_tables import Distribution
from wearsim.runner.scatter import quantile
from wearsim.study.judge.model import judge_series
from wearsim.study.judge.wear_series import WearReading, wear_series

CYCLES = (100, 200, 500)


@pytest.fixture(scope="module")
def wear(data):
    table = data("metal_wear")
    return table.assign(log=np.log(table.wear_um), load=np.log(table.load_g), run=np.log(table.cycles))


def fitted(table):
    """Constant and the exponents of load and cycles."""
    terms = np.column_stack([np.ones(len(table)), table.load, table.run])
    return np.linalg.lstsq(terms, table.log, rcond=None)[0]


def law(constants, load_g, cycles):
    return float(np.exp(constants @ [1.0, np.log(load_g), np.log(cycles)]))


@pytest.mark.parametrize(
    ("cycles", "verdict"),
    [
        (2, "passed"),
        (5, "passed"),
        (10, "passed"),
        (20, "passed"),
        (50, "passed"),
        (100, "passed"),
        (200, "failed"),
        (500, "failed"),
    ],
)
def test_a_load_between_two_others(wear, measured, cycles, verdict):
    constants = fitted(wear[wear.load_g != 50])
    found = wear[(wear.load_g == 50) & (wear.cycles == cycles)].wear_um
    measured(
        f"mean of 50 g after {cycles} cycles",
        law(constants, 50, cycles),
        float(found.mean()),
        ("percent", 15),
        verdict,
        unit="um",
        scatter=f"sd {100 * found.std() / found.mean():.0f} % of 4",
    )


@pytest.mark.parametrize("cycles", CYCLES)
def test_later_wear_of_the_load_furthest_off(wear, measured, cycles):
    early, late = wear[wear.cycles <= 50], wear[wear.cycles == cycles].set_index("specimen")
    slope, at_mean = pooled(early)
    predicted = np.exp(at_mean + slope * (np.log(cycles) - early.run.mean()))
    means = late.assign(predicted=predicted).groupby("load_g")[["predicted", "wear_um"]].mean()
    load = (means.predicted / means.wear_um - 1.0).abs().idxmax()
    measured(
        f"mean of {load} g after {cycles} cycles from those up to 50, largest deviation of the loads",
        float(means.predicted[load]),
        float(means.wear_um[load]),
        ("percent", 15),
        "passed",
        unit="um",
        scatter=f"sd {100 * late.wear_um[late.load_g == load].std() / means.wear_um[load]:.0f} % of 4",
    )


def pooled(early):
    """Exponent of the cycles within specimens, and the mean logarithm of each specimen."""
    own = early.groupby("specimen")
    run = early.run - own.run.transform("mean")
    slope = float((run * (early.log - own.log.transform("mean"))).sum() / (run**2).sum())
    return slope, own.log.mean()


def residual(early, slope):
    """Standard deviation within specimens, less the common exponent and a constant for each."""
    own = early.groupby("specimen")
    run = early.run - own.run.transform("mean")
    rest = early.log - own.log.transform("mean") - slope * run
    free = len(early) - own.ngroups - 1
    return float(np.sqrt((rest**2).sum() / free)), free, float((run**2).sum())


@pytest.mark.parametrize(("cycles", "verdict"), [(100, "passed"), (200, "failed"), (500, "failed")])
def test_band_of_known_specimens(wear, measured, cycles, verdict):
    early = wear[wear.cycles <= 50]
    slope, at_mean = pooled(early)
    sd, free, spread = residual(early, slope)
    away = np.log(cycles) - early[early.specimen == 101].run.mean()
    half = stats.t.ppf(0.95, free) * sd * np.sqrt(1.0 + 1.0 / 5.0 + away**2 / spread)
    found = wear[wear.cycles == cycles].set_index("specimen").log
    measured(
        f"specimens of 12 in their own 90 % band after {cycles} cycles",
        0.9 * 12,
        float((np.abs(found - at_mean - slope * away) <= half).sum()),
        ("found", (10, 12)),
        verdict,
        scatter=f"within specimens {100 * sd:.0f} %",
    )


@pytest.mark.parametrize(("cycles", "verdict"), [(100, "failed"), (200, "passed"), (500, "failed")])
def test_band_of_the_population(wear, measured, cycles, verdict):
    early = wear[wear.cycles <= 50]
    constants = fitted(early)
    rest = early.log - np.column_stack([np.ones(len(early)), early.load, early.run]) @ constants
    scatter = Distribution(distribution="lognormal", sigma_ln=float(rest.std(ddof=3)))
    found = wear[wear.cycles == cycles]
    median = [law(constants, load, cycles) for load in found.load_g]
    low, high = np.array([quantile(scatter, value)(np.array([0.05, 0.95])) for value in median]).T
    measured(
        f"specimens of 12 in the 90 % band of the population after {cycles} cycles",
        0.9 * 12,
        float(((low <= found.wear_um) & (found.wear_um <= high)).sum()),
        ("found", (10, 12)),
        verdict,
        scatter=f"sigma_ln {scatter.sigma_ln:.2f}",
    )


def test_scatter_stays_with_the_specimen(wear, measured):
    """Scatter by the reading would leave the two halves uncorrelated, above 0.5 once in ten times."""
    off = wear.log - wear.groupby(["load_g", "cycles"]).log.transform("mean")
    early, late = (
        off[part].groupby(wear.specimen[part]).mean() for part in (wear.cycles <= 50, wear.cycles > 50)
    )
    measured(
        "correlation of a specimen's mean offset up to 50 cycles with that beyond",
        1.0,
        float(np.corrcoef(early, late)[0, 1]),
        ("within", 0.5),
        "passed",
        scatter="0 where readings scatter, 1 where specimens do",
    )


def engine_depth(write, load, cycles):
    """Depth of an even contact of load, worn by Archard's law with a coefficient of 1 in these units."""
    case = write(
        {"load_per_width_N_per_mm": load, "slip_ratio": 1.0},
        {"law": "archard", "specific_wear_rate_mm2_per_N": 1e-7},
        depth=1e-7 * load * cycles * 1.001,
        horizon_cycles=cycles,
    )
    return wearsim.simulate(case).max_depth


@pytest.mark.parametrize(("load", "cycles"), [(10, 500), (100, 50)])
def test_constant_coefficient(wear, even_contact, measured, load, cycles):
    mean = wear.groupby(["load_g", "cycles"]).wear_um.mean()
    scale = mean[10, 50] / engine_depth(even_contact, 10.0, 50)
    measured(
        f"engine, Archard with constant coefficient: {load} g, {cycles} cycles",
        scale * engine_depth(even_contact, float(load), cycles),
        float(mean[load, cycles]),
        ("percent", 15),
        "failed",
        unit="um",
        scatter="15 % at 10 g, 4 % at 100 g",
    )


def law_of_powers(wear, held_out, particles):
    """Readings in columns, and the 5, 50 and 95 % points that the law of powers gives for each."""
    readings = [
        WearReading(str(one.specimen), one.cycles, one.wear_um, load=one.load_g, held_out=held_out(one))
        for one in wear.itertuples()
    ]
    data = wear_series(readings, "cycles", "um")
    found = judge_series(data, particles, lambda *names: names == ("powers", "walk")).best
    return wear.assign(**dict(zip(("low", "middle", "high"), found.bands[[0, 2, 4]], strict=True)))


@pytest.fixture(scope="module")
def from_early(wear):
    return law_of_powers(wear, lambda one: one.cycles > 50, 8000)


@pytest.mark.wide
@pytest.mark.parametrize(("load", "cycles"), [(10, 500), (100, 50)])
def test_law_of_powers(wear, from_early, measured, load, cycles):
    found = from_early if cycles > 50 else law_of_powers(wear, lambda one: one.load_g == 100, 400)
    own = found[(found.load_g == load) & (found.cycles == cycles)]
    measured(
        f"power law, not the engine: {load} g, {cycles} cycles",
        float(own.middle.mean()),
        float(own.wear_um.mean()),
        ("percent", 15),
        "passed",
        unit="um",
        scatter="15 % at 10 g, 4 % at 100 g",
    )


@pytest.mark.parametrize("cycles", CYCLES)
def test_band_of_known_specimens_that_wander(from_early, measured, cycles):
    own = from_early[from_early.cycles == cycles]
    measured(
        f"power law, not the engine: specimens of 12 in their own 90 % band after {cycles} cycles",
        0.9 * 12,
        float(((own.low <= own.wear_um) & (own.wear_um <= own.high)).sum()),
        ("found", (10, 12)),
        "passed",
        scatter="drifting factors",
    )
