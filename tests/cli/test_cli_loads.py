"""``wearsim loads``: what the teeth of a wrapped sprocket carry, as a table and as JSON."""

import json
import math

import pytest

CASE = """\
format_version = 1
title = "ANSI 40"
chain.designation = "ANSI 40"
sprocket = { teeth = 20, profile = "ansi_b29" }
joint.pitch = "uniform"
load = { tension_N = 1000, speed_rpm = 100 }
wear.specific_wear_rate_mm2_per_N = 5e-11
[drive]
mate_teeth = 20
slack_tension_N = 20
link_stiffness_N_per_mm = 5e4
"""
ISSUE = ("tooth", "tension_N", "force_N", "pressure_angle_deg", "radius_shift_mm")


@pytest.fixture
def case(tmp_path):
    path = tmp_path / "ansi40.toml"
    path.write_text(CASE)
    return path


def refuse(constant):
    raise AssertionError(f"{constant} in the JSON")


@pytest.fixture
def loads(cli, case):
    """Function that runs ``loads --json`` on the case and returns its object."""

    def run(*arguments):
        done = cli("loads", case, "--json", *arguments)
        assert (done.code, done.err) == (0, "")
        return json.loads(done.out, parse_constant=refuse)

    return run


def column(found, name):
    return [row[name] for row in found["teeth"]]


def test_json_has_the_numbers_of_the_reference_table(loads):
    """1 % of elongation; the table is printed to whole newtons, 24.0 degrees and 0.422 mm."""
    found = loads("--elongation", "1")
    assert set(ISSUE) <= set(found["teeth"][0])
    assert column(found, "tooth") == list(range(1, 11))
    tension = [1000, 613, 370, 224, 136, 84, 52, 32, 21, 14]
    force = [455, 285, 172, 104, 63, 38, 23, 14, 9, 8]
    assert column(found, "tension_N") == pytest.approx(tension, abs=0.6)
    assert column(found, "force_N") == pytest.approx(force, abs=0.6)
    assert column(found, "pressure_angle_deg")[0] == pytest.approx(24.0, abs=0.06)
    assert column(found, "radius_shift_mm")[0] == pytest.approx(0.422, abs=6e-4)
    assert found["slack_tension_N"] == 20.0
    assert (found["phase"], found["elongation_percent"], found["case"]) == (1.0, 1.0, "ansi40")
    assert found["first_link"] == "any"


def test_other_columns_follow_from_those(loads):
    """Seat radius less the pitch radius 12.7/(2 sin 9), load over the standard width 0.93 b1."""
    found = loads()
    radius = 6.35 / math.sin(math.radians(9.0))
    width = {round(row["force_N"] / row["load_per_width_N_per_mm"], 9) for row in found["teeth"]}
    assert len(width) == 1
    assert 6.5 < width.pop() < 7.9
    for row in found["teeth"]:
        shift = row["seat_radius_mm"] - radius
        assert row["radius_shift_mm"] == pytest.approx(shift, abs=1e-9)
    assert 0.0 < found["min_slack_tension_N"] < 20.0
    speed = 20 * 12.7e-3 * 100 / 60
    assert found["centrifugal_tension_N"] == pytest.approx(0.6 * speed**2, rel=0.1)
    assert set(found) == {
        "schema_version",
        "wearsim_version",
        "case",
        "phase",
        "elongation_percent",
        "first_link",
        "teeth",
        "slack_tension_N",
        "centrifugal_tension_N",
        "min_slack_tension_N",
        "assumptions",
        "warnings",
    }
    assert set(found["teeth"][0]) == {
        *ISSUE,
        "load_per_width_N_per_mm",
        "seat_radius_mm",
        "contact_arc_length_mm",
    }


def test_phases(loads):
    """Tooth 1 takes from less than 20 N to 426 N within a pitch, one roller more before its end."""
    found = [loads("--phase", phase) for phase in ("0", "0.5", "1")]
    first = [column(each, "force_N")[0] for each in found]
    assert first[0] < 20.0 < first[1] < first[2] == pytest.approx(426.0, abs=0.6)
    assert [len(each["teeth"]) for each in found] == [11, 11, 10]
    assert column(found[0], "force_N")[1:] == pytest.approx(column(found[2], "force_N"), abs=1e-5)


def test_worst_phase(loads):
    """Alternating links at 3 %: no phase and no kind of first link loads a tooth more."""
    how = ("--elongation", "3", "--set", "joint.pitch=alternating", "--set", "mechanism.phases=4")
    worst = loads("--worst", *how)
    largest = max(column(worst, "force_N"))
    assert largest > 621.0  # on the first tooth at the end of a pitch behind an inner link
    for phase in ("0", "0.25", "0.5", "0.75", "1"):
        assert max(column(loads("--phase", phase, *how), "force_N")) <= largest + 1e-6
    assert worst["first_link"] in ("inner", "outer")


def test_rollers_aloft_are_numbers(loads):
    """Tooth 1 carries nothing and the tension goes on."""
    found = loads("--elongation", "3", "--phase", "0.25", "--set", "joint.pitch=alternating")
    assert column(found, "force_N")[0] == 0.0
    assert column(found, "tension_N")[:2] == pytest.approx([1000.0, 1000.0], rel=1e-12)
    assert found["first_link"] == "inner"
    numbers = [value for row in found["teeth"] for value in row.values()]
    assert all(math.isfinite(value) for value in numbers)


@pytest.mark.parametrize("role", ["driver", "driven"])
@pytest.mark.parametrize("mate", [10, 20, 60])
def test_wrap_by_the_mate(loads, mate, role):
    """180 degrees + 2 asin((d - d_mate)/(2 a)) at a = 40 pitches, a roller every 18 degrees."""
    apart = 12.7 * (1 / math.sin(math.radians(9.0)) - 1 / math.sin(math.pi / mate))
    wrap = 180.0 + 2.0 * math.degrees(math.asin(apart / (2.0 * 508.0)))
    found = loads(
        *("--set", f"drive.mate_teeth={mate}", "--set", "drive.centre_distance_mm=508"),
        *("--set", f"sprocket.role={role}"),
    )
    assert len(found["teeth"]) == math.ceil(wrap / 18.0 - 1e-6)


@pytest.mark.wide
def test_driven_sprocket_sheds_its_load_faster(loads):
    """sin(phi +- delta)/sin(phi +- delta + 18), phi = 29 degrees, mu = 0.1: 0.7157 and 0.5992."""
    friction = (
        "--set",
        "mechanism.friction_roller_tooth=0.1",
        "--set",
        "mechanism.friction_roller_bush=0.9",
        "--set",
        "drive.slack_tension_N=100",
    )
    for role, ratio in (("driver", 0.7157), ("driven", 0.5992)):
        found = loads(*friction, "--set", f"sprocket.role={role}")
        assert column(found, "tension_N")[1] == pytest.approx(1000.0 * ratio, rel=0.015)


def test_table(cli, case):
    done = cli("loads", case, "--elongation", "2")
    assert (done.code, done.err) == (0, "")
    lines = done.out.splitlines()
    assert lines[0] == (
        "ANSI 40: 10 rollers, wrap angle 180.0 degrees, elongation 2 %, phase 1, any link after tooth 1"
    )
    assert max(map(len, lines)) <= 107
    rows = [line.split() for line in lines[3:13]]
    assert [int(row[0]) for row in rows] == list(range(1, 11))
    tension = [1000, 562, 306, 168, 93, 52, 30, 18, 12, 12]
    assert [float(row[1]) for row in rows] == pytest.approx(tension, abs=0.6)
    assert float(rows[0][4]) == pytest.approx(19.8, abs=0.06)
    assert float(rows[0][5]) == pytest.approx(0.823, abs=1e-3)
    assert "slack span 20 N" in lines[-2]
    assert lines[-1] == "  Assumes    7 assumptions and 25 defaults: --explain shows them"
    assert "roller positions minimise" in cli("loads", case, "--explain").out


def test_chain_that_jumps(cli, case):
    """The error names the slack tension that holds, and holds."""
    few = ("--set", "drive.slack_tension_N=0.1")
    done = cli("loads", case, *few)
    assert (done.code, done.out) == (2, "")
    assert "the chain jumps" in done.err
    named = done.err.split("at least ")[1].split()[0]
    assert 0.1 < float(named) < 20.0
    assert cli("loads", case, "--set", f"drive.slack_tension_N={named}").code == 0
    assert cli("check", case, *few).code == 2
    assert cli("life", case, "--json", *few).code == 2


@pytest.mark.parametrize(
    "arguments",
    [
        ("--worst", "--phase", "0.5"),
        ("--phase", "1.5"),
        ("--elongation", "-1"),
        ("--set", "drive.slack_tension_N=2000"),
        ("--set", "drive.slack_tension_N=nan"),
        ("--set", "drive.no_such_key=1"),
    ],
)
def test_faults_of_the_input(cli, case, arguments):
    done = cli("loads", case, *arguments)
    assert (done.code, done.out) == (2, "")
    assert done.err
    assert "Traceback" not in done.err


def test_case_without_a_wrap(cli, drive):
    done = cli("loads", drive())
    assert (done.code, done.out) == (2, "")
    assert "mechanism.kind" in done.err
    assert "the loads of this flank are in flank.csv of wearsim life --out" in done.err
    assert cli("loads", "nowhere.toml").code == 2
