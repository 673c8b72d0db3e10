"""V4: curves of elongation, running-in and lubrication

Typical figures from a bicycle shop and from a chain manufacturer
([run_in.csv](../tests/validation/data/run_in.csv)). The engine runs `bicycle-17t-road` with
`wear.running_in_factor` and `wear.running_in_distance_mm`, an exponentially decaying running-in.

Calibrated on three figures for a length of 1397 mm: 2 mm in the first 150 km, 95 % of the excess in
the first 100 km, then 2.5 mm in 2000 km. It predicts that the running-in is below 0.15 % and over by
200 km, that the curve is straight afterwards, and the total elongation at 2500 km. The coefficients
of the oiled and the degreased chain have the ratio of the wear scars of the rollers, 13.

Failures: two figures. The curve of a chain that is not re-oiled bends upward; without `[lubrication]`
the coefficient of the engine does not depend on the age of the lubricant, so its late curve stays
straight. And the running-in of a bicycle chain is above the 0.1 % of the industrial guide: the two
sources differ, and the engine follows the one used for calibration.

The row *with the age of the lubricant* uses `[lubrication]`: the coefficient of a chain that is not
re-oiled rises to 13 times between 2000 and 2500 km (the distances are assumed). The knee follows from
the input; the row only shows that there is an upward knee.

Not shown: how much a chain runs in, since both keys are fitted, or for how many hours; the right
order of oiled and degreased follows from the given coefficients. Running-in by conforming surfaces,
as in real joints, is not in the engine.
"""

import numpy as np
import pytest

import wearsim

CASE = "bicycle-17t-road"
KM_PER_HOUR = 33.0
OVER_BY = 100.0
"""Distance in which 95 % of the excess are worn [km]."""


@pytest.fixture(scope="module")
def figures(data):
    return data("run_in").set_index("quantity").value


@pytest.fixture(scope="module")
def later_rate(figures):
    """Elongation in a km after the run-in."""
    return figures.later_lengthening / figures.chain_length / figures.later_distance


@pytest.fixture(scope="module")
def coefficient(grown, later_rate):
    return 1e-8 * 1e5 * later_rate / grown(1e-8, 1000.0).rate


@pytest.fixture(scope="module")
def excess(figures, later_rate):
    """Run-in beyond the later rate, all of it, and the distance over which it falls to 1/e."""
    distance = OVER_BY / np.log(20.0)
    first = figures.run_in_lengthening / figures.chain_length
    first -= later_rate * figures.run_in_distance
    return float(first / -np.expm1(-figures.run_in_distance / distance)), float(distance)


@pytest.fixture(scope="module")
def oiled(grown, coefficient, excess, later_rate, request):
    """Growth with running-in over 2500 km."""
    amount, distance = excess
    case = wearsim.load_case(request.path.parents[2] / "cases" / f"{CASE}.toml")
    cycles_per_km = case.cycles_per_hour / KM_PER_HOUR
    path = case.drive.contact(case).joint_sliding_per_cycle * cycles_per_km * distance
    return grown(
        coefficient,
        2500.0,
        f"wear.running_in_factor={float(1.0 + amount / (later_rate * distance))!r}",
        f"wear.running_in_distance_mm={float(path)!r}",
    )


def late_line(growth):
    """Slope and intercept of the second half."""
    late = growth.distance >= 0.5 * growth.distance[-1]
    return np.polyfit(growth.distance[late], growth.elongation[late], 1)


def test_amount(oiled, measured):
    measured(
        "running-in: intercept of the late line",
        100.0 * late_line(oiled)[1],
        0.14,
        ("below", 0.15),
        "passed",
        unit="%",
        scatter="range of 100 to 200 km",
    )


def test_amount_of_industrial_chains(oiled, figures, measured):
    measured(
        "the same, industrial guide",
        100.0 * late_line(oiled)[1],
        "below 0.1, usually",
        ("below", figures.industrial_run_in),
        "failed",
        unit="%",
    )


def test_over_by_200_km(oiled, measured):
    slope, start = late_line(oiled)
    measured(
        "fraction of the running-in left at 200 km",
        (start + slope * 200.0 - oiled.at(200.0)) / start,
        "over by 200 km, or 20 h",
        ("below", 0.05),
        "passed",
    )


def test_straight_after(oiled, measured):
    slope, start = late_line(oiled)
    after = oiled.distance >= 200.0
    off = np.abs(oiled.elongation[after] - start - slope * oiled.distance[after]).max()
    measured(
        "greatest deviation from a straight line after 200 km, over the growth since",
        off / (oiled.elongation[-1] - oiled.at(200.0)),
        "nearly linear",
        ("below", 0.05),
        "passed",
    )


def test_whole_length(oiled, figures, measured):
    measured(
        "elongation at 2500 km",
        oiled.at(figures.whole_distance) * figures.chain_length,
        float(figures.whole_lengthening),
        ("within", 1.0),
        "passed",
        unit="mm",
        scatter="4 to 5 mm at 2150 km, 5 mm in 2000 to 3000 km",
    )


def test_degreased_is_steeper(oiled, grown, coefficient, figures, measured):
    dry = grown(figures.dry_over_oiled * coefficient, 500.0)
    measured(
        "late rate, degreased over oiled",
        dry.rate / (1e5 * late_line(oiled)[0]),
        "steeper, nearly straight",
        ("above", 2.0),
        "passed",
    )


def test_knee_without_oil(oiled, measured):
    marks = [oiled.at(km) for km in (500.0, 1000.0, 2000.0, 2500.0)]
    measured(
        "not re-oiled: last rate over the previous one",
        (marks[3] - marks[2]) / (marks[1] - marks[0]),
        "a knee upward",
        ("above", 1.05),
        "failed",
    )


def test_knee_by_age_of_the_lubricant(grown, coefficient, figures, measured):
    age = (
        "lubrication.lasts_km=2000",
        "lubrication.fades_over_km=500",
        f"lubrication.dry_factor={float(figures.dry_over_oiled)!r}",
    )
    # The end of a run each: a line between two rows of a history would cut the knee.
    marks = [grown(coefficient, km, *age).elongation[-1] for km in (500.0, 1000.0, 2000.0, 2500.0)]
    measured(
        "not re-oiled, with the age of the lubricant: last rate over the previous one",
        (marks[3] - marks[2]) / (marks[1] - marks[0]),
        "a knee upward",
        ("above", 1.05),
        "passed",
    )
