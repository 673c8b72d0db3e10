"""V6: bands of the growth of bicycle chains

13 end points from 13 riders: elongation after a distance
([chain_lives.csv](../tests/validation/data/chain_lives.csv)). The fastest chain grew 88 times as fast
as the slowest; agreement with one of them would prove nothing. The engine runs `bicycle-17t-road`
(50/17 teeth, 210 N chain tension, 33 km/h, all assumed).

None of these data are used for calibration. The widest band covers the wear conditions of the
catalogue for joints, from the low end of `hardened, oiled` to the high end of `soil-contaminated`.
The bands by V2 use its coefficient and, for gritty conditions, that coefficient times its factor for
wet, each with a factor of 3 up and down. For the chain in a closed case (40/16 teeth, hub sprocket at
200 rpm, 200 W at 25 km/h, 295 N chain tension, 108 links: assumed) the coefficient of V2 predicts the
elongation at the distance of its reading; a factor of 2 is allowed.

Failures: one row lies outside the band of the catalogue: touring in sand, which needs 1.4 times the
highest coefficient of the table at the assumed tension. Four rows lie below the bands by V2: these
chains grew less than a third as fast as the commuter's chains.

Not shown: that a prediction for a single drive is more accurate than the band; the factor of 2
for the closed case rests on assumed teeth and power, whose effect is as large.
"""

import pytest

from wearsim.catalogue.catalogues import wear_conditions

TRIAL = 1e-8


@pytest.fixture(scope="module")
def rates(data):
    """Percent in 1000 km of each row, at the nearest end of its range of distances."""
    table = data("chain_lives")
    return [
        (1e3 * row.elongation_percent / row.high_km, 1e3 * row.elongation_percent / row.low_km)
        for row in table.itertuples()
    ]


@pytest.fixture(scope="module")
def rate_per_coefficient(grown):
    """Percent in 1000 km over the coefficient of the joints: the engine is linear in it."""
    return grown(TRIAL, 1000.0).rate / TRIAL


def inside(rates, *bands):
    return sum(any(low <= greatest and least <= high for low, high in bands) for least, greatest in rates)


def test_catalogue(rates, rate_per_coefficient, measured):
    conditions = wear_conditions()
    low, high = conditions["hardened, oiled"].low, conditions["soil-contaminated"].high
    band = rate_per_coefficient * low, rate_per_coefficient * high
    measured(
        f"rows within {band[0]:.2g} to {band[1]:.2g} % in 1000 km, conditions of the catalogue",
        len(rates),
        float(inside(rates, band)),
        ("found", (len(rates), len(rates))),
        "failed",
        scatter="factor 88 between rows",
    )


def test_bands_of_the_commuter(rates, rate_per_coefficient, commuter, wet_factor, measured):
    clean = rate_per_coefficient * commuter.coefficient
    bands = [(part / 3.0, part * 3.0) for part in (clean, wet_factor * clean)]
    measured(
        f"rows within {bands[0][0]:.2g} to {bands[1][1]:.2g} % in 1000 km, clean and gritty by V2",
        len(rates),
        float(inside(rates, *bands)),
        ("found", (len(rates), len(rates))),
        "failed",
        scatter="factor 88 between rows",
    )


def test_enclosed_chain(data, commuter, grown, measured):
    row = data("chain_lives").set_index("chain").loc["KMC X8 in an enclosed case"]
    growth = grown(
        commuter.coefficient,
        float(row.low_km),
        "sprocket.teeth=16",
        "drive.mate_teeth=40",
        "drive.links=108",
        "load.speed_rpm=200",
        speed=25.0,
    )
    measured(
        "elongation of the chain in a closed case at 4605 km, coefficient of V2",
        100.0 * growth.at(row.low_km),
        float(row.elongation_percent),
        ("factor", 2),
        "passed",
        unit="%",
        scatter="one gauge",
    )
