"""Ranges, corrections and lubrication of the published rules of chain wear life."""

import math

import pytest

from wearsim.catalogue.catalogues import catalogue_rows
from wearsim.chain.practice_rules import geometric_mean, opinions, outside_practice
from wearsim.errors import CaseError
from wearsim.lubrication.lubrication_life_factor import lubrication_life_factor
from wearsim.lubrication.recommended import lubrication_speed_limits, recommended_lubrication


def hours(drive) -> dict[str, float | None]:
    return {one.rule.name: one.hours for one in opinions(drive)}


def notes(drive) -> dict[str, str]:
    return {one.rule.name: one.note for one in opinions(drive)}


def test_a_shock_factor_counts_with_the_exponent_of_each_rule(drive):
    steady, shocks = hours(drive()), hours(drive(shock_factor=1.35))
    exponents = {name: math.log(steady[name] / shocks[name]) / math.log(1.35) for name in steady}
    assert exponents == pytest.approx(
        {
            "rating rule": 3,
            "Vorobyev 4350": 1,
            "Vorobyev 5200": 1,
            "handbook cube law": 3,
            "DIN 8195 pressure": 3,
            "GOST pressure, m = 3": 3,
            "GOST pressure, m = 1.5": 1.5,
        }
    )


def test_hours_are_in_proportion_to_the_elongation(drive):
    whole, half = hours(drive()), hours(drive(elongation=0.015))
    assert half == pytest.approx({name: 0.5 * found for name, found in whole.items()})


def test_two_strands_carry_1_7_times_the_pull_of_one_for_the_same_hours(drive):
    single = drive()
    duplex = drive(pull=1.7 * single.pull, bearing_area=2 * single.bearing_area, strands=2)
    assert hours(duplex) == pytest.approx(hours(single))


@pytest.mark.parametrize(
    ("changes", "without", "reason"),
    [
        ({"pitch": 80.0, "pull": 1e3}, "rating rule", "no rating above a pitch of 76.2 mm"),
        (
            {"pitch": 66.0, "pull": 1e3},
            "handbook cube law",
            "c2 is tabulated for pitches from 9.525 to 63.5 mm",
        ),
        ({"pitch": 9.0, "pull": 1e3}, "handbook cube law", "c2 is tabulated"),
        ({"speed": 10.0}, "DIN 8195 pressure", "p_v is tabulated from 0.1 to 10 m/s"),
        ({"speed": 1600.0, "pull": 1e3}, "DIN 8195 pressure", "p_v is tabulated"),
        ({"speed": 1601.0, "pull": 1e3}, "GOST pressure, m = 3", "not tabulated for 19.05 mm at 1601 rpm"),
        ({"speed": 10.0}, "Vorobyev 5200", "in use from about 0.1 to 10 m/s"),
        ({"links": 50}, "Vorobyev 4350", "need more links"),
        ({"strands": 4, "pull": 1e3}, "GOST pressure, m = 1.5", "m_p is tabulated for up to 3 strands"),
    ],
)
def test_a_rule_has_no_hours_outside_its_range(drive, changes, without, reason):
    changed = drive(**changes)
    assert hours(changed)[without] is None
    assert reason in notes(changed)[without]
    assert geometric_mean(opinions(changed)) is not None


@pytest.mark.parametrize(
    ("no", "pull", "limit"),
    [(1, 45.1 * 89.3, "45 MPa"), (12, 35.1 * 89.3, "35 MPa, twice [p]")],  # [p] at 1200 rpm is 17.5 MPa
)
def test_no_rule_has_hours_beyond_what_practice_knows(drive, no, pull, limit):
    beyond = drive(no, pull=pull)
    assert outside_practice(beyond).endswith(f"in practice at most {limit}")
    assert set(hours(beyond).values()) == {None}
    assert all(note.startswith("outside any published practice") for note in notes(beyond).values())
    assert geometric_mean(opinions(beyond)) is None
    assert not outside_practice(drive(no, pull=0.99 * pull))


def test_hours_that_nobody_has_seen_say_so(drive):
    light = drive(pull=300.0)
    assert hours(light)["rating rule"] > 1e5
    assert "wear does not end the life of a chain" in notes(light)["rating rule"]
    assert "not wear" not in notes(drive())["rating rule"]


def test_a_rule_without_hours_leaves_its_school_to_the_others(drive):
    slow = drive(speed=10.0)  # 0.07 m/s: neither Vorobyev nor DIN
    found = hours(slow)
    assert geometric_mean(opinions(slow)) == pytest.approx(
        math.sqrt(found["rating rule"] * found["GOST pressure, m = 3"])
    )


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"pitch": 0.0, "pull": -1.0}, "(?s)pitch must be above 0.*pull must be above 0"),
        ({"ratio": 0.5}, "ratio must be at least 1, is 0.5"),
        ({"strands": 7}, "strands must be at most 6, are 7"),
        ({"lubrication": "honey"}, "lubrication must be one of drip, .*is 'honey'"),
        ({"environment": "fog"}, "environment must be one of clean, .*is 'fog'"),
    ],
)
def test_numbers_and_words_that_cannot_be(drive, changes, words):
    with pytest.raises(CaseError, match=words):
        drive(**changes)


@pytest.mark.parametrize(
    ("pitch", "drip", "bath"),
    # ft/min of types A and B by ANSI numbers 40 to 160
    [
        (12.7, 300, 2300),
        (15.875, 250, 2000),
        (19.05, 220, 1800),
        (25.4, 170, 1500),
        (31.75, 150, 1300),
        (38.1, 130, 1200),
        (44.45, 115, 1100),
        (50.8, 100, 1000),
    ],
)
def test_speed_limits_of_lubrication_are_those_in_feet_a_minute(pitch, drip, bath):
    assert lubrication_speed_limits(pitch) == pytest.approx((drip * 0.00508, bath * 0.00508), abs=0.06)
    assert recommended_lubrication(pitch, 0.98 * drip * 0.00508) == "drip"
    assert recommended_lubrication(pitch, 1.02 * drip * 0.00508) == "oil bath"
    assert recommended_lubrication(pitch, 1.02 * bath * 0.00508) == "forced"


@pytest.mark.parametrize("edge", [12.7, 15.875, 50.8])
def test_speed_limits_of_lubrication_do_not_jump(edge):
    below, above = (lubrication_speed_limits(edge * factor) for factor in (1 - 1e-9, 1 + 1e-9))
    assert below == pytest.approx(above, rel=1e-6)


@pytest.mark.parametrize(
    ("supplied", "environment", "state", "factor"),
    [
        ("forced", "clean", "better than recommended", 1.5),
        ("oil bath", "clean", "as recommended", 1.0),
        ("drip", "clean", "one type below", 0.4),
        ("oil bath", "dust", "one type below", 0.4),
        ("drip", "dust", "insufficient", 0.1),
        ("forced", "dust", "as recommended", 1.0),
        ("manual", "clean", "insufficient", 0.1),
        ("oil bath", "mud", "insufficient, dirty", 0.03),
        ("dry", "clean", "dry, clean", 0.04),
        ("dry", "wet", "dry, dirty", 0.008),
    ],
)
def test_life_with_another_lubrication_than_a_bath(drive, supplied, environment, state, factor):
    found = lubrication_life_factor(supplied, "oil bath", environment)
    assert (found.state, found.factor) == (state, factor)
    assert found.low <= found.factor <= found.high
    other = drive(10, lubrication=supplied, environment=environment)  # 1.33 m/s
    assert other.recommended == "oil bath"
    expected = {name: factor * one for name, one in hours(drive(10)).items()}
    assert hours(other) == pytest.approx(expected)


@pytest.mark.parametrize("supplied", ["manual", "greased"])
def test_a_brush_now_and_then_is_less_than_drip(supplied):
    assert lubrication_life_factor(supplied, "drip").state == "now and then"


@pytest.mark.parametrize(
    "table",
    [
        "din_joint_pressure",
        "lubrication_life_factors",
        "practice_rules",
        "recommended_lubrication",
        "wear_pitch_factors",
    ],
)
def test_every_row_has_a_source(table):
    assert all(row["source"].strip() for row in catalogue_rows(table))
