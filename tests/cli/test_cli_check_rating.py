"""``wearsim check`` on a wrapped chain: is the drive inside its rating.

Published answers of five selection examples: A Shigley 17-5, B a no. 50 and C a no. 80 drive, D a
conveyor with ПР-25,4, E the rating point of no. 40. 1 hp = 0.745699872 kW.
"""

import json
import re
from pathlib import Path

import pytest

CASES = Path(__file__).parents[2] / "cases"
HP = 0.745699872
WRAPPED = [
    "a140-17t-starved",
    "a50-20t-drip",
    "a80-20t-oilbath",
    "pr254-27t-greased",
    "a40-19t-rating",
    "08b-19t-wrap",
    "d6-crawler-27t-wrap",
    "520-15t-wrap",
    "bicycle-17t-road",
]


@pytest.fixture
def checked(cli):
    """Function that checks a shipped case with settings: the JSON object."""

    def check(name, *settings):
        options = [part for text in settings for part in ("--set", text)]
        done = cli("check", "--json", CASES / f"{name}.toml", *options)
        assert done.code == 0, done.err
        return json.loads(done.out)

    return check


def test_loads_of_a_heavy_drive_are_grouped(cli, tmp_path):
    """24B-1 pulled by 20 kW at 80 rpm: more than 20 000 N on the shafts."""
    path = tmp_path / "heavy.toml"
    drive = ("--chain", "24B-1", "--driver", 19, "--driven", 38, "--power", 20, "--rpm", 80)
    assert cli("init", *drive, "--out", path).code == 0
    text = cli("check", path).out
    assert re.search(r"shaft 2\d \d{3} N", text)
    assert not re.search(r"\de[+-]\d", text)


def finding(content, name):
    (found,) = [entry for entry in content["rating"] if entry["name"] == name]
    return found


def test_a_three_strands_of_no_140(checked):
    """176 hp over 2.5 = 70.4 hp a strand, rating 72.4 hp; 76 links at 25.104 pitches."""
    content = checked("a140-17t-starved")
    found = finding(content, "plate fatigue")
    assert found["value"] / HP == pytest.approx(175.5, abs=0.05)
    assert round(found["limit"] / HP / 2.5, 1) == 72.4
    assert found["ok"]
    assert found["note"] == ""
    assert "76 links, centre distance 1115.88 mm = 25.1041 pitches" in content["notes"][0]
    told = [text for text in content["warnings"] if "rating" in text]
    assert all("joint pressure" in text and "for information here" in text for text in told)


def test_b_no_50_needs_20_046_teeth(checked):
    """15 hp: 20.046 teeth by the plates, 14.184 by the rollers; 114 links at 35.6 pitches."""
    content = checked("a50-20t-drip")
    plates, rollers = (finding(content, name) for name in ("plate fatigue", "roller impact"))
    assert plates["value"] / HP == pytest.approx(15.0, rel=1e-9)
    assert round(20.0 * (plates["value"] / plates["limit"]) ** (1 / 1.08), 3) == 20.046
    assert round(20.0 * (rollers["value"] / rollers["limit"]) ** (2 / 3), 3) == 14.184
    assert (plates["ok"], rollers["ok"]) == (False, True)
    assert "114 links, centre distance 564.99 mm = 35.5900 pitches" in content["notes"][0]


def test_c_no_80_is_outside_its_rating(checked):
    """Required 40.2 hp, rating 39.33 hp."""
    found = finding(checked("a80-20t-oilbath"), "plate fatigue")
    assert round(found["value"] / HP, 1) == 40.2
    assert round(found["limit"] / HP, 2) == 39.33
    assert not found["ok"]


def test_d_conveyor_stays_below_its_joint_pressure(checked):
    """Pull 2110 N with K_e = 1.3 on 179.7 mm2, allowed 31 MPa; 100 links at 769 mm, 1.303 m/s."""
    content = checked("pr254-27t-greased")
    found = finding(content, "joint pressure")
    assert found["value"] == pytest.approx(1.3 * 2110 / 179.7, rel=1e-3)
    assert found["value"] < 31 < found["limit"]
    assert found["note"] == ""
    assert finding(content, "plate fatigue")["note"].startswith("indicative")
    assert "100 links, centre distance 768.57 mm" in content["notes"][0]
    assert content["notes"][1].startswith("2.75 kW at 1.303 m/s: pull 2110")


def test_e_rating_point_of_no_40(checked):
    """4.60 kW = 6.17 hp is the rating itself, of 19 teeth: all three power rules agree."""
    content = checked("a40-19t-rating")
    plates, corrected = (finding(content, name) for name in ("plate fatigue", "corrected power"))
    assert round(plates["limit"] / HP, 2) == 6.17
    assert (plates["value"], plates["ok"]) == (pytest.approx(4.6), True)
    assert (corrected["value"], corrected["limit"]) == (plates["value"], plates["limit"])


@pytest.mark.parametrize("name", WRAPPED)
def test_table_is_marked_and_narrow(cli, checked, name):
    done = cli("check", CASES / f"{name}.toml")
    assert (done.code, done.err) == (0, "")
    lines = done.out.splitlines()
    table = [line for line in lines if line.startswith(("  rating", "  drive", "     "))]
    assert max(len(line) for line in table) <= 100
    rated = {line[11:34].strip(): line for line in lines if line.startswith("  rating   ")}
    for found in checked(name)["rating"]:
        assert list(found) == ["name", "value", "limit", "unit", "ok", "source", "note", "load"]
        line = rated[found["name"]]
        assert ("OUTSIDE" in line or "informs" in line) == (not found["ok"])
        assert "OUTSIDE" not in line or not found["note"].startswith("for information")
        assert f" {found['unit']} " in line
    warned = [line for line in lines if line.startswith("  warning  outside a rating: ")]
    outside = [found for found in checked(name)["rating"] if not found["ok"]]
    assert len(warned) == len(outside)
    assert all(found["name"] in line for found, line in zip(outside, warned, strict=True))
    told = [text for text in checked(name)["warnings"] if text.startswith("outside a rating")]
    assert [line[11:] for line in warned] == told


def test_notes_of_rules_stand_once_below_the_table(cli):
    out = cli("check", CASES / "520-15t-wrap.toml").out
    assert out.count("[1] indicative, the formula is for the A series; series not known") == 1
    assert out.count("[2] indicative, the table is for GOST 13568 chains") == 1
    (line,) = [line for line in out.splitlines() if line.startswith("  rating   roller impact")]
    assert line.endswith("OUTSIDE  ANSI B29.1, H2 [1]")


def test_strand_has_no_rating(cli, drive):
    path = drive()
    assert "rating" not in json.loads(cli("check", "--json", path).out)
    assert "  rating" not in cli("check", path).out


def test_wheel_is_rated_by_the_small_sprocket(checked):
    """57 teeth driven at 1000/3 rpm are the drive of 19 teeth at 1000 rpm."""
    wheel = checked(
        "a40-19t-rating",
        "sprocket.teeth=57",
        "sprocket.role=driven",
        "drive.mate_teeth=19",
        "load.speed_rpm=333.3333333333333",
    )
    for one, other in zip(checked("a40-19t-rating")["rating"], wheel["rating"], strict=True):
        assert other["name"] == one["name"]
        assert (other["value"], other["limit"]) == pytest.approx((one["value"], one["limit"]))
    assert "small sprocket 19 teeth at 1000 rpm, ratio 3" in wheel["notes"][1]


@pytest.mark.parametrize(
    ("key", "changed"),
    [
        ("service_factor", {"plate fatigue", "roller impact", "corrected power"}),
        ("joint_application_factor", {"joint pressure"}),
    ],
)
def test_factor_raises_what_it_is_for(checked, key, changed):
    before, after = checked("a40-19t-rating"), checked("a40-19t-rating", f"drive.{key}=1.4")
    for one, other in zip(before["rating"], after["rating"], strict=True):
        factor = 1.4 if one["name"] in changed else 1.0
        if key == "service_factor" and one["name"] == "joint pressure":
            factor = 1.35  # moderate shocks in K_e too
        assert other["value"] == pytest.approx(factor * one["value"], rel=1e-12)
        assert other["limit"] == one["limit"]
    taken = f"drive.{key} = 1 ("
    assert any(text.startswith(taken) for text in before["assumptions"])
    assert not any(text.startswith(taken) for text in after["assumptions"])


@pytest.mark.parametrize(
    ("key", "value"),
    [("service_factor", "0.9"), ("service_factor", "11"), ("joint_application_factor", "0.4")],
)
def test_factor_out_of_range(cli, key, value):
    done = cli("check", CASES / "a40-19t-rating.toml", "--set", f"drive.{key}={value}")
    assert done.code == 2
    assert f"drive.{key}: must be " in done.err


SLACK = "drive.slack_tension_N=100"
"""So short a wrap would jump with the tension of its sag."""


@pytest.mark.parametrize(
    ("settings", "value", "limit", "ok"),
    [
        ((), 3.0, 3.0, True),
        (("stop.elongation_percent=3.2",), 3.2, 3.0, False),
        (("drive.mate_teeth=72",), 2.778, 2.778, True),
        (("drive.mate_teeth=100", "stop.elongation_percent=2.1", SLACK), 2.1, 2.0, False),
    ],
)
def test_limit_of_elongation(checked, settings, value, limit, ok):
    """3 %, or 200/z of the larger sprocket: 2.778 for 72 teeth, 2 for 100."""
    found = finding(checked("a40-19t-rating", *settings), "elongation at the end")
    assert (found["value"], found["limit"], found["ok"]) == (value, limit, ok)


def test_low_safety_is_warned_of_once(checked):
    """Of 13.9 kN a seventh is 1986 N; 8 kW at 4.022 m/s pull 1989 N."""
    content = checked("a40-19t-rating", "load.power_kW=8")
    assert not finding(content, "safety against breaking")["ok"]
    assert len([text for text in content["warnings"] if "tensile" in text]) == 1


def test_no_rule_knows_the_track_but_that_of_elongation(checked):
    """No table holds a pitch of 203.2 mm; the ANSI formula ends at 76.2 mm."""
    content = checked("d6-crawler-27t-wrap")
    assert [found["name"] for found in content["rating"]] == ["elongation at the end"]
    assert "small sprocket 13.5 teeth at 17.5 rpm" in content["notes"][1]


@pytest.mark.parametrize(("name", "percent"), [("a40-19t-rating", "1.36"), ("a140-17t-starved", "1.70")])
def test_polygon_effect(checked, name, percent):
    """1 - cos(180/z), as tables print it."""
    assert checked(name)["notes"][2].startswith(
        f"polygon effect: the speed of the chain varies by {percent} %"
    )


@pytest.mark.parametrize(
    ("name", "settings", "text"),
    [
        ("a40-19t-rating", (), "every tooth meets every roller"),
        ("a50-20t-drip", (), "divisor 2: a tooth meets 57 of the rollers, always inner or always"),
        ("a50-20t-drip", ("joint.pitch=uniform",), "a tooth meets 57 of the rollers"),
        ("d6-crawler-27t-wrap", (), "27 teeth and 42 links have the common divisor 3"),
    ],
)
def test_who_meets_whom(checked, name, settings, text):
    note = checked(name, *settings)["notes"][3]
    assert text in note
    assert ("only inner" in note) == ("only inner" in text)
