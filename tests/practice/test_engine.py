"""Hours of the engine against published practice, which is no measurement."""

import math
from collections.abc import Callable

import pytest

from tests.practice.conftest import DRIVES, Row, engine_band, engine_case, engine_hours
from wearsim.chain.practice_drive import PracticeDrive
from wearsim.chain.practice_rules import geometric_mean, opinions

SPEEDS = (50, 100, 200, 400, 600, 800, 1000)
PITCHES = {"ANSI 40": 12.7, "ANSI 50": 15.875, "ANSI 60": 19.05, "ANSI 80": 25.4}
ALLOWED = {50: (35, 35), 200: (31.5, 30), 400: (28.5, 26), 600: (26, 23.5), 800: (24, 21), 1000: (22.5, 19)}
"""[p] of GOST practice up to 15.875 and to 25.4 mm [MPa]."""


def rated_power(pitch: float, teeth: int, speed: float) -> float:
    """The smaller of H1 and H2 of ANSI B29.1 [kW]."""
    inch = pitch / 25.4
    plates = 0.004 * teeth**1.08 * speed**0.9 * inch ** (3 - 0.07 * inch)
    rollers = 17e3 * teeth**1.5 * inch**0.8 / speed**1.5
    return 0.7457 * min(plates, rollers)


def drive_row(chain: str, pitch: float, speed: float, power: float, links: int = 120) -> Row:
    """19 and 57 teeth at a power, as a row of drives.csv."""
    like = next(row for row in DRIVES if row["chain"] == chain or row["pitch_mm"] == pitch)
    pull = 6e7 * power / (19 * pitch * speed)
    own = {"chain": chain, "pitch_mm": pitch, "teeth": 19, "mate_teeth": 57, "speed_rpm": speed}
    return {**like, **own, "links": links, "pull_N": pull}


def test_rating_point_of_no_40() -> None:
    assert engine_hours(engine_case(drive_row("ANSI 40", 12.7, 1000, 4.6))) == pytest.approx(15e3, rel=0.1)


@pytest.mark.parametrize("speed", SPEEDS)
@pytest.mark.parametrize("chain", PITCHES)
def test_along_the_rating(chain: str, speed: float) -> None:
    """The rating is for 15 000 h at every speed; a constant rate gives 225 000 h at 50 rpm."""
    row = drive_row(chain, PITCHES[chain], speed, rated_power(PITCHES[chain], 19, speed))
    case = engine_case(row)
    assert 10e3 <= engine_hours(case) <= 30e3
    if speed <= 100:
        assert engine_hours(case.with_({"joint.law": "constant"})) > 100e3


@pytest.mark.parametrize("speed", ALLOWED)
@pytest.mark.parametrize(
    ("chain", "pitch", "place"), [("08B-1", 12.7, 0), ("12B-1", 19.05, 1), ("16B-1", 25.4, 1)]
)
def test_along_the_allowable_pressure(chain: str, pitch: float, place: int, speed: float) -> None:
    area = {"08B-1": 50.3, "12B-1": 89.3, "16B-1": 210.7}[chain]
    power = ALLOWED[speed][place] * area * 19 * pitch * speed / 6e7
    assert 8e3 <= engine_hours(engine_case(drive_row(chain, pitch, speed, power))) <= 30e3


def test_packaging_conveyor() -> None:
    assert 4e3 <= engine_hours(engine_case(DRIVES[0])) <= 27e3


def test_every_drive_is_near_the_mean_of_the_routes(row: Row, drive: Callable[..., PracticeDrive]) -> None:
    mean = geometric_mean(opinions(drive(row["no"])))
    assert mean is not None
    assert 1 / 2.5 <= engine_hours(engine_case(row)) / mean <= 2.5


def test_band_holds_the_routes(drive: Callable[..., PracticeDrive]) -> None:
    """At least 80 % of the single rules on all drives."""
    inside = []
    for row in DRIVES:
        low, high = engine_band(engine_case(row))
        inside += [low <= one.hours <= high for one in opinions(drive(row["no"])) if one.hours is not None]
    assert len(inside) == 7 * len(DRIVES)
    assert sum(inside) >= 0.8 * len(inside)


def test_band_is_twice_to_two_and_a_half_within_the_window() -> None:
    low, high = engine_band(engine_case(DRIVES[1]))
    hours = engine_hours(engine_case(DRIVES[1]))
    assert 1.9 <= high / hours <= 2.2
    assert 2.4 <= hours / low <= 2.7


def test_exponents_of_links_ratio_and_elongation() -> None:
    """As by equation (4.1): X, i/(i + 1) at one z1, and eps; with the pull and the slack as they are."""
    row = drive_row("ANSI 60", 19.05, 100, 2.0)
    case = engine_case(row).with_({"drive.slack_tension_N": 40.0})
    hours = engine_hours(case)
    assert engine_hours(case.with_({"drive.links": 240})) == pytest.approx(2.0 * hours, rel=1e-9)
    assert engine_hours(case.with_({"stop.elongation_percent": 1.5})) == pytest.approx(hours / 2, rel=1e-9)
    even = case.with_({"drive.mate_teeth": 19})
    assert engine_hours(even) == pytest.approx(hours * (1 / 19 + 1 / 57) / (2 / 19), rel=1e-9)


def test_band_widens_where_the_rate_is_extrapolated() -> None:
    """Slow, and with nothing said of the lubrication: each cause adds to the logarithm by squares."""
    inside, slow = (engine_case(drive_row("ANSI 40", 12.7, n, rated_power(12.7, 19, n))) for n in (1000, 100))
    bands = [case.drive.wear_band("chain", case.wear) for case in (inside, slow)]
    wider = math.exp(math.hypot(math.log(bands[0].high), math.log(1.8)))
    assert bands[1].high == pytest.approx(wider, rel=1e-9)
    rates = {"condition": None, "specific_wear_rate_mm2_per_N": 5e-11}
    unknown = inside.with_({f"wear.{key}": value for key, value in rates.items() if value is not None})
    band = unknown.drive.wear_band("chain", unknown.wear)
    assert band.high == pytest.approx(math.exp(math.hypot(math.log(bands[0].high), math.log(5.0))), rel=1e-9)


def test_band_of_a_constant_rate_holds_the_law() -> None:
    """The constant rate of old cases at 100 rpm: its band tells how far off practice it is."""
    case = engine_case(drive_row("ANSI 60", 19.05, 100, rated_power(19.05, 19, 100)))
    low, high = engine_band(case.with_({"joint.law": "constant"}))
    assert low <= engine_hours(case) <= high
