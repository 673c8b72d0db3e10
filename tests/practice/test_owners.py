"""Six owners' chains against the band of a bicycle's hours: at least five must lie in it.

Readings from public threads, their wording and persons left out: distance [km], elongation [%]. The
bicycle is one of 50 to 17 teeth at 200 W and 28 km/h for all: the load is part of what the band must hold.
"""

import pytest

import wearsim
from tests.drives import ROAD_BICYCLE, changed

OWNERS = [(1609, 1.04), (9656, 0.13), (2414, 0.35), (2012, 1.04), (36200, 0.625), (2750, 0.75)]
BICYCLE = changed(ROAD_BICYCLE, {"stop.elongation_percent": 2})


def factors(case: wearsim.Case) -> list[float]:
    """The rate that each owner needs over that of the case."""
    hours = case.drive.contact(case).cycles_per_mate / case.cycles_per_hour
    return [percent / 2.0 * hours / (km / 28.0) for km, percent in OWNERS]


def test_owners_lie_in_the_band() -> None:
    case = wearsim.load_case(BICYCLE)
    band = case.drive.wear_band("chain", case.wear)
    inside = [band.low <= one <= band.high for one in factors(case)]
    assert sum(inside) >= 5
    # The rate itself is not moved to them: they need 2 times as much in the mean.
    assert case.drive.joint.coefficient == 6e-9


def test_a_named_environment_narrows_it_to_that_of_the_environment() -> None:
    """On a rig in dust the lubricant and the range of dust remain, and the spread of the routes."""
    wide = wearsim.load_case(BICYCLE)
    oil = {"lubricant": "wet drip", "environment": "dust"}
    table = {key: value for key, value in BICYCLE.items() if key != "wear"}
    rig = wearsim.load_case({**table, "lubrication": oil})
    one, other = (case.drive.wear_band("chain", case.wear) for case in (wide, rig))
    assert one.low < other.low < 1.0 < other.high < one.high


def test_life_tells_the_band_of_the_case() -> None:
    case = wearsim.load_case(BICYCLE).with_({"run.life_tolerance": 0.1})
    band = case.drive.wear_band("chain", case.wear)
    result = wearsim.simulate(case)
    low, high = result.bands["chain"]
    hours = result.parts["chain"].hours_run
    assert hours / low.hours_run == pytest.approx(band.high, rel=1e-9)
    assert high.hours_run / hours == pytest.approx(1.0 / band.low, rel=1e-9)
