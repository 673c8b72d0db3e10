"""V10: bicycle chains with 67 lubricants

Elongation of chains on one rig in six blocks of 1000 km, clean, dust, clean, wet, clean, wet with mud
([lubricant_blocks.csv](../tests/validation/data/lubricant_blocks.csv)), and the distance that one
application lasts
([lubricant_single_application.csv](../tests/validation/data/lubricant_single_application.csv)).
The engine runs `bicycle-17t-road` on the rig's conditions (250 W at 100 rpm, 50/22 teeth: assumed)
with its law of lubrication; a test compares the blocks of the case with the closed form used by the
fit. Elongation is given as a fraction of the allowance, 0.5 %.

Coefficients (clean; the additions by dust, wet and mud; the fraction of these that a relubrication
removes; running-in) scatter about those of their category. A block scatters about the law with heavy
tails. All are drawn from the readings; a reading of 0 means less than half a step of 1/350. Chains
left the test because of earlier readings, so the likelihood needs no correction for them. *In their
band* counts readings of lubricants whose later blocks, or whose allowances, were left out: they are
predicted from their own earlier blocks and from the other lubricants. 80 to 97 % may be in 90 % bands,
35 to 65 % in 50 % bands.

Calibrated on the open readings. Blocks 5 and 6 of 14 lubricants and 37 distances are withheld. They
will be compared with their forecast (`reports/reference/forecast_lubricants.md`).

Failures: the bands of block 3 are too narrow (some 45 of 58 readings are in the 90 % bands), those of
block 4 too wide. With oils, chains grow faster in the clean block after dust than in dust, which no
fraction removed by a relubrication can give: the after-effect of dirt exceeds its direct effect. And
the readings of one application do not show the assumed knee: for 7 of 12 lubricants allowance and
jump are at the same distance, with a mean growth up to there many times that of the clean block.
These lubricants fade before the jump.

Not shown: a coefficient, since it occurs in a product with the assumed teeth; an effect of
teeth, tension or speed; running-in, except in the first 1000 km; wear of teeth; how the lubricant
fades, as it is renewed before that in the blocks.
"""

import numpy as np
import pandas as pd
import pytest

import wearsim

pytestmark = pytest.mark.wide

WITHIN_90, WITHIN_50 = (0.80, 0.97), (0.35, 0.65)
"""Parts of the readings that bands may hold: stated before."""


@pytest.fixture(scope="module")
def rig(research):
    return research("lubricant_rig")


@pytest.fixture(scope="module")
def forecast(research):
    return research("forecast_lubricants")


@pytest.fixture(scope="module")
def table(forecast):
    return forecast.lubricants()[0]


@pytest.fixture(scope="module")
def fitted(forecast, table):
    return forecast.draws_of(table[forecast.READ].to_numpy(dtype=float)[None], table, 1000)


@pytest.fixture(scope="module")
def programme(rig):
    """Return the elongations of the shipped case at the ends of the blocks, with some coefficients."""

    def grown(coefficient, factors, removed):
        inputs = {**wearsim.load_case(rig.CASE, list(rig.RIG)).inputs}
        inputs.pop("maintenance")
        phases = [
            {
                "hours": block.hours,
                "relubrications": block.relubrications,
                "contaminations": block.contaminations,
                "contamination_factor": factors[block.environment],
            }
            for block in rig.BLOCKS
        ]
        inputs["lubrication"] = {"contamination_removed": removed, "phase": phases}
        inputs["joint"] = {"specific_wear_rate_mm2_per_N": coefficient}
        inputs["stop"] = {"elongation_percent": 5.0, "critical_depth_mm": 0.2}
        for end in np.cumsum(rig.HOURS):
            inputs["run"] = {"horizon_hours": float(end), "life_tolerance": 0.1}
            yield wearsim.simulate(wearsim.load_case(inputs)).history_columns["elongation_percent"][-1]

    return grown


def test_case_gives_the_growth_of_the_blocks(rig, programme):
    factors = {"clean": 1.0, "dust": 3.0, "wet": 8.0, "extreme": 12.0}
    ends = list(programme(5e-10, factors, 0.4))
    clean = np.array(5e-7 / rig.coefficient_of_rate())
    dirt = {name: clean * (factor - 1.0) for name, factor in factors.items()}
    grown = rig.growth(clean, np.array(0.0), dirt, np.array(0.4))
    np.testing.assert_allclose(np.diff(ends, prepend=0.0) / 0.5, grown, rtol=1e-9)


def test_growth_of_a_clean_block_after_dust_by_hand(rig):
    """Half of the dirt goes with each relubrication, so 1/2, 1/4, 1/8 of it are there for a third each."""
    dirt = {"dust": np.array(0.02), "wet": np.array(0.0), "extreme": np.array(0.0)}
    grown = rig.growth(np.array(0.01), np.array(0.0), dirt, np.array(0.5))
    assert grown[2] == pytest.approx(31.0 * (0.01 + 0.02 * (1 / 2 + 1 / 4 + 1 / 8) / 3))


def test_an_application_of_the_case_lasts_by_the_closed_form(rig, research):
    """0.05 of the allowance in 1000 km up to 2000 km, then 1.5: the rest of 0.9 takes 600 km."""
    inputs = {
        **wearsim.load_case(rig.CASE, list(rig.RIG)).inputs,
        "service": {"km_per_hour": rig.KM_PER_HOUR},
    }
    inputs.pop("maintenance")
    inputs["joint"] = {
        "specific_wear_rate_mm2_per_N": 1e-3 * 5e-5 * rig.KM_PER_HOUR * rig.coefficient_of_rate()
    }
    inputs["lubrication"] = {"lasts_km": 2000.0, "dry_factor": 30.0}
    run = wearsim.simulate(wearsim.load_case(inputs))
    assert rig.KM_PER_HOUR * run.parts["chain"].hours_run == pytest.approx(2600.0, rel=1e-9)
    assert research("lubricant_ages").allowance(2000.0, 5e-5, 1.5e-3) == pytest.approx(2600.0)


LEFT_OUT = {
    "blocks 5 and 6 from 1 to 4": (4, 6),
    "block 4 from 1 to 3": (3, 4),
    "block 3 from 1 and 2": (2, 3),
}
"""First block left out, and the one before which those that count end."""


@pytest.fixture(scope="module")
def held(forecast, table, fitted):
    """Readings left out, by what they are, and whether they are in their bands."""
    drawn = {}
    for what, (first, end) in LEFT_OUT.items():
        found = forecast.left_out_blocks(table, first, 900, groups=4)
        drawn[what] = {cell: draws for cell, draws in found.items() if cell[1] in forecast.READ[first:end]}
    wear = forecast.lubricated(fitted)
    drawn["one application"] = forecast.left_out_applications(table, wear, 400)
    read = forecast.read_in(table)
    return {what: forecast.held(forecast.bands(cells), read) for what, cells in drawn.items()}


def in_bands(found, column, share, limits, what, verdict, measured):
    number = len(found)
    measured(
        f"{what}: readings of {number} in their {share} % band",
        found[column].sum(),
        f"{0.01 * share * number:.1f} expected",
        ("range", (np.ceil(limits[0] * number), np.floor(limits[1] * number))),
        verdict,
        scatter=f"sd {np.sqrt(1e-4 * share * (100 - share) * number):.1f}",
    )


@pytest.mark.parametrize(
    ("what", "verdict"),
    [
        ("blocks 5 and 6 from 1 to 4", "passed"),
        ("block 4 from 1 to 3", "failed"),
        ("block 3 from 1 and 2", "failed"),
        ("one application", "passed"),
    ],
)
def test_bands_of_90_percent(held, measured, what, verdict):
    in_bands(held[what], "in_90", 90, WITHIN_90, what, verdict, measured)


def test_bands_of_50_percent(held, measured):
    blocks = pd.concat([held[what] for what in LEFT_OUT])
    in_bands(blocks, "in_50", 50, WITHIN_50, "all these blocks", "passed", measured)
    in_bands(held["one application"], "in_50", 50, WITHIN_50, "one application", "passed", measured)


@pytest.fixture(scope="module")
def modelled(forecast, table, fitted):
    """Growth by the law alone, without scatter of blocks: (draws, lubricants, 6)."""
    return forecast.coefficients.wear(fitted.theta[:, 0])


def ratio(table, modelled, forecast, rig, over, under, kept):
    """Growth per hour in a block over that in another: its median by the law, and as read."""
    read = table[forecast.READ].to_numpy(dtype=float)
    kept = kept & ~np.isnan(read[:, over]) & (read[:, under] > 0)
    rate = np.median(modelled, axis=0)[kept] / rig.HOURS, read[kept] / rig.HOURS
    law, seen = (rates[:, over] / rates[:, under] for rates in rate)
    return np.median(law), seen


@pytest.mark.parametrize(
    ("what", "over", "under", "category", "verdict"),
    [
        ("dust over clean", 1, 0, None, "passed"),
        ("wet over clean", 3, 0, None, "passed"),
        ("clean after dust over dust, waxes", 2, 1, "wax", "passed"),
        ("clean after dust over dust, oils", 2, 1, "wet_drip", "failed"),
        ("clean after wet over wet", 4, 3, None, "passed"),
    ],
)
def test_ratios_within_a_lubricant(
    forecast, rig, table, modelled, measured, what, over, under, category, verdict
):
    kept = table.category.str.contains(category or "").to_numpy()
    law, seen = ratio(table, modelled, forecast, rig, over, under, kept)
    low, middle, high = np.quantile(seen, (0.25, 0.5, 0.75))
    measured(
        f"growth per hour, {what}, median",
        law,
        middle,
        ("percent", 20),
        verdict,
        scatter=f"quartiles {low:.2g} and {high:.2g} of {len(seen)}",
    )


def test_wet_and_mud_go_together(forecast, table, fitted, measured):
    """Block 6 as it would be read of lubricants whose block 4 was."""
    read = table[forecast.READ].to_numpy(dtype=float)
    both = np.flatnonzero(~np.isnan(read[:, 5]))
    drawn = np.log(np.maximum(fitted.readings(np.random.default_rng(4), both), 1e-3))
    measured(
        "correlation of the logarithms of blocks 4 and 6",
        np.median([np.corrcoef(sample[:, 3], sample[:, 5])[0, 1] for sample in drawn]),
        np.corrcoef(np.log(read[both, 3]), np.log(read[both, 5]))[0, 1],
        ("within", 0.3),
        "passed",
        scatter="12 lubricants; 0.85 is stated for 21",
    )


def test_knee_of_one_application(forecast, table, fitted, measured):
    """After the jump on clean road a chain should grow as the one without lubricant, 0.903 in 1000 km."""
    road = table[table.road_allowance_km.notna()]
    lubricated = forecast.lubricated(fitted)[road.index, 0]
    left = (road.road_allowance_km - road.road_jump_km).to_numpy()
    knee = left > 0
    after = 1000.0 * (1.0 - lubricated * road.road_jump_km)[knee] / left[knee]
    measured(
        "growth per 1000 km after the jump, median",
        0.903,
        np.median(after),
        ("factor", 2),
        "passed",
        scatter=f"{after.min():.2g} to {after.max():.2g} of {len(after)}",
    )
    measured(
        "lubricants of 12 whose allowance lies beyond the jump",
        len(road),
        float(knee.sum()),
        ("within", 1),
        "failed",
    )
    straight = 1.0 / (lubricated * road.road_jump_km)[~knee]
    measured(
        "allowance at the jump: mean growth to there over the lubricated one, median",
        1.0,
        np.median(straight),
        ("factor", 2),
        "failed",
        scatter=f"{straight.min():.2g} to {straight.max():.2g} of {len(straight)}",
    )
