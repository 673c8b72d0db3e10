"""``wearsim life``: the answer, its JSON, overrides, limits asked for."""

import json
import re

import jsonschema
import pytest

from wearsim.cli.schema import result_schema
from wearsim.drive.load_case import load_case
from wearsim.drive.part_life import simulate

KEYS = (
    "schema_version",
    "wearsim_version",
    "case",
    "life_hours",
    "cycles",
    "life_reached",
    "hours_run",
    "cycles_run",
    "life_hours_low",
    "life_hours_high",
    "stop",
    "max_depth_mm",
    "max_depth_arc_length_mm",
    "initial_peak_pressure_MPa",
    "final_peak_pressure_MPa",
    "method",
    "updates",
    "assumptions",
    "warnings",
)

TOO_COARSE = {"critical_depth_mm": '0.02\n[run]\nmethod = "per_cycle"\ncycles_per_update = 100000000'}
"""Deeper than the tooth: the contact ends before the limit is met."""


@pytest.fixture(scope="module")
def conforms():
    return jsonschema.Draft202012Validator(result_schema()).validate


def strict(line):
    """JSON without NaN and Infinity, which Python would read."""

    def refuse(name):
        raise AssertionError(name)

    return json.loads(line, parse_constant=refuse)


def test_answer_on_screen(cli, drive):
    path = drive(nodes=201)
    life = simulate(load_case(path)).life
    done = cli("life", path)
    assert done.code == 0
    text = " ".join(done.out.split())
    assert text.startswith("Test drive Life ")
    hours = re.search(r"Life ([\d .]+) h ", text).group(1)
    assert float(hours.replace(" ", "")) == pytest.approx(life.hours, rel=1e-3)
    for part in (
        "cycles at 100 rpm) until 0.02 mm is worn off; numerical error < 0.1 %",
        "Band ",
        " over the band of the wear rate",
        "Worn most ",
        " mm from the root (flank ",
        "MPa",
        " defaults: --explain shows them",
        "Warnings ",
        f"Next wearsim compare {path} --out reports/drive",
    ):
        assert part in text
    assert max(map(len, done.out.splitlines()[:-1])) <= 110
    assert done.err == ""


def test_explain_prints_what_is_counted_otherwise(cli, drive):
    path = drive()
    brief, all_of_it = cli("life", path).out, cli("life", path, "--explain").out
    counts = re.search(r"\n  Assumes    (\d+) assumptions and (\d+) defaults: --explain shows them\n", brief)
    stated, defaults = map(int, counts.groups())
    text = " ".join(all_of_it.split())
    for part in (
        "Assumes 1 the roller does not turn",
        f"; {stated + 1} defaults: ",
        "run.horizon_hours = 1e+06",
        "Band from 'hardened, oiled': typical: ",
        "Removed ",
    ):
        assert part in text
        assert part not in " ".join(brief.split())
    # The lines before and after are the same.
    assert all_of_it.splitlines()[:3] == brief.splitlines()[:3]
    assert all_of_it.splitlines()[-1] == brief.splitlines()[-1]
    json_lines = [cli("life", path, "--json", *more).out for more in ((), ("--explain",))]
    assert json_lines[0] == json_lines[1]
    assert len(strict(json_lines[0])["assumptions"]) == stated + defaults


def test_limit_not_reached_is_a_bound(cli, drive):
    done = cli("life", drive(), "--set", "run.horizon_hours=50")
    assert done.code == 0
    assert re.search(r"Life +> 50 h \(limit not reached\)", done.out)


def test_json_is_one_line_per_case_and_conforms(cli, drive, conforms):
    done = cli("life", "--json", drive("one"), drive("two", power_kW=4))
    assert done.code == 0
    lines = [strict(line) for line in done.out.splitlines()]
    assert [line["case"] for line in lines] == ["one", "two"]
    for line in lines:
        conforms(line)
        assert next(iter(line)) == "schema_version"
        assert set(KEYS) <= set(line)
    assert all("warning: " in line for line in done.err.splitlines())


def test_json_of_a_bound(cli, drive, conforms):
    done = cli("life", "--json", drive(), "--set", "run.horizon_hours=50")
    line = strict(done.out)
    conforms(line)
    assert line["life_hours"] is None and line["cycles"] is None
    assert (line["life_reached"], line["stop"]) == (False, "horizon_hours")
    assert line["hours_run"] == pytest.approx(50.0, rel=1e-12)


def test_json_of_bad_input(cli, drive, conforms, tmp_path):
    bad = drive("bad", teeth=3)
    done = cli("life", "--json", bad, drive("good"), tmp_path / "none.toml")
    assert done.code == 2
    lines = [strict(line) for line in done.out.splitlines()]
    for line in lines:
        conforms(line)
    assert [line["case"] for line in lines] == ["bad", "none"]
    assert (lines[0]["error"]["file"], lines[0]["error"]["line"]) == (str(bad), 6)
    assert lines[0]["error"]["key"] == "sprocket.teeth"
    assert lines[1]["error"]["line"] is None


def test_json_of_a_bad_override(cli, drive, conforms):
    line = strict(cli("life", "--json", drive(), "--set", "sprocket.teeth=3").out)
    conforms(line)
    error = line["error"]
    assert (error["file"], error["line"], error["key"]) == (None, None, "sprocket.teeth")
    assert error["kind"] == "CaseError"


def test_json_of_a_failed_calculation(cli, drive, conforms):
    done = cli("life", "--json", drive(**TOO_COARSE))
    assert done.code == 3
    line = strict(done.out)
    conforms(line)
    assert line["error"]["kind"] == "ConvergenceError"
    assert line["error"]["message"].startswith("wear at cycle ")
    assert line["error"]["message"] in done.err


def test_quiet_silences_warnings(cli, drive):
    path = drive()
    assert "warning: " in cli("life", "--json", path).err
    assert cli("life", "--json", "-q", path).err == ""
    assert cli("-q", "life", "--json", path).err == ""


@pytest.mark.parametrize("setting", ['load.power_kW="1500 W"', "load.power_kW=1.5"])
def test_override_as_toml_value(cli, drive, setting):
    expected = strict(cli("life", "--json", drive("half", power_kW=1.5)).out)["life_hours"]
    assert strict(cli("life", "--json", drive(), "--set", setting).out)["life_hours"] == expected


def test_override_as_plain_word(cli, drive):
    done = cli("life", "--json", drive(), "--set", "wear.condition=soil-contaminated")
    assert "soil-contaminated" in strict(done.out)["band"]


def test_required_hours(cli, drive):
    path = drive()
    hours = strict(cli("life", "--json", path).out)["life_hours"]
    assert cli("life", path, "--require-hours", 0.99 * hours).code == 0
    done = cli("life", path, "--require-hours", 1.01 * hours)
    assert done.code == 4
    assert f"is below {1.01 * hours:g} h" in done.err
    assert "Test drive" in done.out


def test_required_hours_raise_the_horizon(cli, drive):
    """The drive lives about 120 h: a horizon of 50 h hides that, the one asked for does not."""
    path = drive()
    hours = strict(cli("life", "--json", path).out)["life_hours"]
    short = ("--set", "run.horizon_hours=50")
    assert hours > 50
    assert cli("life", path, *short).code == 0
    done = cli("life", "--json", path, *short, "--require-hours", 2 * hours)
    assert done.code == 4
    line = strict(done.out)
    assert line["life_reached"] is True
    assert f"run.horizon_hours = {2 * hours:g} (raised by --require-hours)" in line["assumptions"]
    done = cli("life", "--json", path, *short, "--require-hours", 60)
    assert done.code == 0
    assert strict(done.out)["hours_run"] == pytest.approx(60.0, rel=1e-12)


@pytest.mark.parametrize("hours", ["0", "-5", "nan", "inf", "many"])
def test_required_hours_must_be_a_number(cli, drive, hours):
    done = cli("life", drive(), "--require-hours", hours)
    assert (done.code, done.out) == (2, "")
    assert "--require-hours" in done.err


def test_strict_fails_on_warnings(cli, drive):
    path = drive()
    assert strict(cli("life", "--json", path).out)["warnings"]
    done = cli("life", path, "--strict")
    assert done.code == 4
    assert "and --strict" in done.err


def test_every_case_that_misses_is_named(cli, drive):
    done = cli("life", drive("one"), drive("two"), "--require-hours", 1e6)
    assert done.code == 4
    assert "one: life" in done.err and "two: life" in done.err


def test_some_of_several_fail(cli, drive, conforms, tmp_path):
    cases = (drive("one"), drive("two", **TOO_COARSE), drive("three"))
    done = cli("life", "--json", *cases, "--out", tmp_path / "out")
    assert done.code == 5
    lines = [strict(line) for line in done.out.splitlines()]
    for line in lines:
        conforms(line)
    assert ["error" in line for line in lines] == [False, True, False]
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["one", "three"]
    assert str(cases[1]) in done.err


def test_all_of_several_fail(cli, drive):
    done = cli("life", drive("one", **TOO_COARSE), drive("two", **TOO_COARSE))
    assert (done.code, done.out) == (3, "")
    assert done.err.count("wear at cycle ") == 2


def test_next_command_can_be_pasted(cli, drive):
    path = drive("my drive")
    assert f"wearsim compare '{path}' --out 'reports/my drive'" in " ".join(cli("life", path).out.split())


# -- solving for a key -----------------------------------------------------------------------------


def test_solve_for_prints_value_life_and_slope(cli, drive, conforms):
    """On a strand the life goes with one over the speed: the same cycles take longer."""
    path = drive()
    hours = strict(cli("life", path, "--json").out)["life_hours"]
    requested = ("--solve-for", "load.speed_rpm", "--require-hours", 1.6 * hours)
    done = cli("life", path, "--json", *requested, "--set", "load={tension_N=3000, speed_rpm=100}")
    assert done.code == 0
    line = strict(done.out)
    conforms(line)
    found = line["solve_for"]
    assert found["met"] and found["key"] == "load.speed_rpm"
    assert found["life_hours"] == line["life_hours"] == pytest.approx(1.6 * hours, rel=1e-3)
    assert found["elasticity"] == pytest.approx(-1.0, rel=1e-3)
    assert found["lowest"] <= found["value"] <= found["highest"]
    text = cli("life", path, *requested, "--set", "load={tension_N=3000, speed_rpm=100}").out
    assert text.startswith(f"  Solved     load.speed_rpm = {found['value']:.6g} lasts ")
    assert "1 % more of it gives 1 % less life" in text


def test_solve_for_without_an_answer_is_4(cli, drive, conforms):
    requested = ("--solve-for", "sprocket.face_width_mm", "--require-hours", 1e9)
    done = cli("life", drive(), "--json", *requested)
    assert done.code == 4
    line = strict(done.out)
    conforms(line)
    assert not line["solve_for"]["met"]
    assert "no value of sprocket.face_width_mm was found from " in done.err
    assert line["solve_for"]["value"] == pytest.approx(17.02, rel=1e-3)


@pytest.mark.parametrize(
    ("key", "said"),
    [
        ("load.tension_N", "it is not in the case"),
        ("sprocket.profile", "it is 'evolute'"),
        ("nothing.at_all", "--solve-for must be a key of a case"),
        ("load.powr_kW", "did you mean 'load.power_kW'"),
        ("title", "but it is '"),
        ("wear.speed_exponent", "needs a value above 0 to start from"),
    ],
)
def test_solve_for_needs_a_number(cli, drive, key, said):
    law = (
        "wear={law='drozdov', coefficient=1e-8, pressure_exponent=1, hardness_MPa=2000, "
        "reference_speed_mm_per_s=100, speed_exponent=0}"
    )
    done = cli("life", drive(), "--solve-for", key, "--require-hours", 10, "--set", law)
    assert done.code == 2
    assert key in done.err and said in done.err


def test_solve_for_needs_hours_and_one_case(cli, drive):
    assert cli("life", drive(), "--solve-for", "load.power_kW").code == 2
    two = (drive(), drive("other"))
    assert cli("life", *two, "--solve-for", "load.power_kW", "--require-hours", 9).code == 2


@pytest.mark.wide
def test_solve_for_saves_the_case_that_it_found(cli, drive, tmp_path):
    out = tmp_path / "out"
    requested = ("--solve-for", "load.power_kW", "--require-hours", 100)
    line = strict(cli("life", drive(), "--json", *requested, "--out", out).out)
    again = strict(cli("life", "--json", out / "case.lock.toml").out)
    assert again["life_hours"] == pytest.approx(line["life_hours"], rel=1e-9)


# -- three grids -----------------------------------------------------------------------------------


OWN_POINTS = ("--set", "run.life_tolerance=0.1")
"""A tolerance at which the flank is not refined."""


def test_verify_grid(cli, drive, conforms):
    path = drive()
    text = cli("life", path, "--verify-grid", *OWN_POINTS).out
    line = strict(cli("life", path, "--verify-grid", "--json", *OWN_POINTS).out)
    conforms(line)
    grid = line["grid"]
    assert grid["nodes"] == [51, 26, 13]
    assert grid["values"][0] == pytest.approx(line["cycles"], rel=1e-4)
    shown = "Richardson error" if grid["richardson"] else "spread of the three"
    assert f"{shown} {grid['error']:.1g}" in " ".join(text.split())
    assert "grid" not in strict(cli("life", path, "--json").out)


def test_verify_grid_at_the_horizon(cli, drive, conforms):
    given = (*OWN_POINTS, "--set", "run.horizon_hours=1")
    line = strict(cli("life", drive(), "--verify-grid", "--json", *given).out)
    conforms(line)
    assert line["grid"]["quantity"] == "max_depth_mm"
    assert line["grid"]["values"][0] == pytest.approx(line["max_depth_mm"], rel=1e-4)


@pytest.mark.parametrize("option", ["--verify-grid", "--strict"])
def test_solve_for_alone(cli, drive, option):
    requested = ("--solve-for", "load.power_kW", "--require-hours", 100)
    assert cli("life", drive(), *requested, option).code == 2
