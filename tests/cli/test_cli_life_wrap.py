"""``wearsim life`` on a wrapped sprocket: lives of chain and sprocket, limits, folder, refusals."""

import json
import re

import jsonschema
import numpy as np
import pytest

import wearsim
from wearsim.cli.schema import result_schema
from wearsim.result import Life, LowerBound, WearResult

CASE = """
format_version = 1
title = "Wrapped drive"
[chain]
designation = "ANSI 40"
[sprocket]
teeth = 20
profile = "ansi_b29"
nodes = 101
[mechanism]
kind = "wrap"
phases = 2
[drive]
mate_teeth = 20
links = 114
slack_tension_N = 50
[joint]
pitch = "uniform"
specific_wear_rate_mm2_per_N = 1e-9
[load]
tension_N = 1000
speed_rpm = 100
[wear]
specific_wear_rate_mm2_per_N = 1e-9
[stop]
critical_depth_mm = 0.03
elongation_percent = 1
[run]
horizon_hours = 20000
life_tolerance = 0.05
"""
SHORT = ("--set", "run.horizon_hours=100")
FAST_CHAIN = ("--set", "joint.specific_wear_rate_mm2_per_N=1.5e-8")


@pytest.fixture
def wrapped(tmp_path):
    path = tmp_path / "wrapped.toml"
    path.write_text(CASE, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def conforms():
    return jsonschema.Draft202012Validator(result_schema()).validate


def strict(line):
    """JSON without NaN and Infinity, which Python would read."""

    def refuse(name):
        raise AssertionError(name)

    return json.loads(line, parse_constant=refuse)


ANSWERS = {}


def answer(cli, path, *settings):
    """JSON of the case with these settings, run once."""
    if settings not in ANSWERS:
        ANSWERS[settings] = strict(cli("life", "--json", path, *settings).out)
    return ANSWERS[settings]


def limits(line):
    return {state["name"]: (state["limit"], state["value"]) for state in line["limits"]}


@pytest.mark.wide
def test_answer_on_screen(cli, wrapped):
    done = cli("life", wrapped, "--explain")
    text = " ".join(done.out.split())
    found = answer(cli, wrapped)
    assert (done.code, done.err) == (0, "")
    assert text.startswith("Wrapped drive Life ")
    for label, key in (("Life", ""), ("chain", "chain_"), ("sprocket", "sprocket_")):
        hours = float(re.search(rf"{label} ([\d .]+) h", text)[1].replace(" ", ""))
        assert hours == pytest.approx(found[f"{key}life_hours"], rel=1e-3)
    for part in (
        "until 0.03 mm is worn off",
        "Band from factor 3 to either side Ends sprocket, tooth wear, ",
        "Limits at the end of the life critical_depth_mm 0.03 of 0.03, elongation_percent 0.",
        "Worn most 0.03 mm at ",
        "from the gap's right tip; peak pressure ",
        "10 % of the articulation angle of 18 degrees",
        "every tooth alike",
    ):
        assert part in text
    assert "nan" not in text
    assert max(map(len, done.out.splitlines()[:-1])) <= 110


def test_json(cli, wrapped, conforms):
    line = answer(cli, wrapped)
    conforms(line)
    assert line["stop"] == "critical_depth_mm"
    assert line["life_hours"] == line["sprocket_life_hours"] < line["chain_life_hours"]
    # 1 % of 12.7 mm by 1e-9 mm2/N at 1050 N over 44.5 mm2, 2 pi 3.98/20 mm a loop of 5.7 turns.
    loop = 1e-9 * 1050.0 / 44.5 * 2.0 * np.pi * 3.98 / 20.0 / 12.7
    assert line["chain_life_hours"] == pytest.approx(0.01 / loop * 5.7 / 6000.0, rel=0.01)
    assert line["cycles"] == pytest.approx(6000.0 * line["life_hours"], rel=1e-12)
    found = limits(line)
    assert found["critical_depth_mm"] == (0.03, pytest.approx(0.03, rel=1e-9))
    share = line["life_hours"] / line["chain_life_hours"]
    assert found["elongation_percent"] == (1.0, pytest.approx(share, rel=1e-3))
    assert line["life_hours_low"] == pytest.approx(line["life_hours"] / 3.0, rel=1e-12)
    assert line["life_hours_high"] == pytest.approx(line["life_hours"] * 3.0, rel=1e-12)
    assert 0.0 <= line["numerical_error"] < 0.1
    assert 0.0 < line["final_peak_pressure_MPa"] < line["initial_peak_pressure_MPa"]


def test_chain_ends_first(cli, wrapped, conforms):
    """The run goes on with new chains to the sprocket's own limit; the life is the chain's."""
    line = answer(cli, wrapped, *FAST_CHAIN)
    conforms(line)
    assert (line["stop"], line["stop_value"]) == ("elongation_percent", 1.0)
    assert line["life_hours"] == line["chain_life_hours"] < line["sprocket_life_hours"]
    assert line["hours_run"] == line["sprocket_life_hours"]
    found = limits(line)
    assert found["elongation_percent"] == (1.0, pytest.approx(1.0, rel=1e-6))
    assert 0.0 < found["critical_depth_mm"][1] < 0.03
    assert line["max_depth_mm"] == pytest.approx(0.03, rel=1e-9)
    text = " ".join(cli("life", wrapped, *FAST_CHAIN).out.split())
    assert "until the chain elongation reaches 1 %" in text
    chains = int(re.search(r"with (\d+) chains, each replaced at its limit", text)[1])
    assert chains == int(line["sprocket_life_hours"] / line["chain_life_hours"]) + 1


def test_tip_land_is_watched(cli, wrapped):
    """The new tooth has 1.132 mm; no more is asked for, and the state is told."""
    done = cli("life", wrapped, "--set", "stop.min_tip_land_mm=1.15")
    assert done.code == 2
    assert "must be below the tip land of the new tooth, 1.132 mm" in done.err
    line = answer(cli, wrapped, *SHORT, "--set", "stop.min_tip_land_mm=0.5")
    assert limits(line)["min_tip_land_mm"] == (0.5, pytest.approx(1.132, abs=5e-3))


def test_gaps_of_two_kinds(cli, wrapped, tmp_path):
    """Alternating links on 20 teeth and 114 links: flank.csv tells both gaps."""
    folder = tmp_path / "out"
    done = cli("life", wrapped, *SHORT, "--explain", "--set", "joint.pitch=alternating", "--out", folder)
    assert "teeth of two kinds" in " ".join(done.out.split())
    kinds = WearResult.load(folder).flank_columns["gap_kind"]
    assert set(np.unique(kinds)) == {1.0, 2.0}


def test_bound_of_a_short_horizon(cli, wrapped, conforms):
    done = cli("life", "--json", wrapped, *SHORT)
    line = strict(done.out)
    conforms(line)
    assert (line["stop"], line["life_reached"]) == ("horizon_hours", False)
    for key in ("life_hours", "chain_life_hours", "sprocket_life_hours", "cycles"):
        assert line[key] is None
    assert line["hours_run"] == pytest.approx(100.0, rel=1e-12)
    depth, elongation = (limits(line)[key] for key in ("critical_depth_mm", "elongation_percent"))
    assert 0.0 < depth[1] < depth[0] and 0.0 < elongation[1] < elongation[0]
    text = " ".join(cli("life", wrapped, *SHORT).out.split())
    assert "Life > 100 h (limit not reached)" in text
    assert "chain > 100 h, sprocket > 100 h" in text


def test_chain_within_a_horizon_that_the_sprocket_outlives(cli, wrapped):
    """The chain's life is known, the sprocket's is a bound."""
    hours = answer(cli, wrapped, *FAST_CHAIN)["chain_life_hours"]
    line = answer(cli, wrapped, *FAST_CHAIN, "--set", f"run.horizon_hours={1.2 * hours}")
    assert line["chain_life_hours"] == line["life_hours"] == pytest.approx(hours, rel=1e-9)
    assert line["sprocket_life_hours"] is None
    assert line["hours_run"] == pytest.approx(1.2 * hours, rel=1e-9)


def test_folder_holds_all_of_the_result(cli, wrapped, tmp_path, conforms):
    folder = tmp_path / "out"
    line = strict(cli("life", "--json", wrapped, *FAST_CHAIN, "--out", folder).out)
    names = {"result.json", "case.lock.toml", "environment.json", "history.csv", "flank.csv"}
    assert names <= {path.name for path in folder.iterdir()}
    saved = WearResult.load(folder)
    assert saved.summary() == line
    assert isinstance(saved.parts["chain"], Life)
    assert saved.life == saved.parts["chain"]
    again = wearsim.simulate(wearsim.load_case(wrapped, ["joint.specific_wear_rate_mm2_per_N=1.5e-8"]))
    for name, values in again.history_columns.items():
        np.testing.assert_array_equal(saved.history_columns[name], values, err_msg=name)
    for name, values in again.flank_columns.items():
        np.testing.assert_array_equal(saved.flank_columns[name], values, err_msg=name)
    assert set(saved.flank_columns["gap_kind"]) == {1.0}


def test_folder_of_a_bound(cli, wrapped, tmp_path):
    folder = tmp_path / "out"
    cli("life", wrapped, *SHORT, "--out", folder)
    saved = WearResult.load(folder)
    assert isinstance(saved.life, LowerBound)
    assert all(isinstance(part, LowerBound) for part in saved.parts.values())
    with pytest.raises(wearsim.WearsimError, match="no limit was met within 100 h"):
        saved.parts["chain"].hours  # noqa: B018


@pytest.mark.wide
def test_locked_case_gives_the_same_life(cli, wrapped, tmp_path):
    folder = tmp_path / "out"
    line = strict(cli("life", "--json", wrapped, "--out", folder).out)
    again = strict(cli("life", "--json", folder / "case.lock.toml").out)
    for key in ("life_hours", "chain_life_hours", "stop", "limits"):
        assert again[key] == line[key]


def test_every_cycle_on_its_own_is_refused(cli, wrapped, conforms):
    """Some 1e7 updates of a millisecond; the message says which number of cycles is possible."""
    phases = ("--set", "mechanism.phases=8", "--set", "sprocket.nodes=201")
    slow = (*phases, "--set", "run.method=per_cycle")
    done = cli("life", "--json", wrapped, *slow)
    assert done.code == 3
    error = strict(done.out)["error"]
    conforms(strict(done.out))
    assert error["kind"] == "ConvergenceError"
    assert "must stay below 200000 updates" in error["message"]
    least = int(re.search(r"take cycles_per_update = (\d+)", error["message"])[1])
    assert least > 1
    coarse = 400 * least
    line = answer(cli, wrapped, *slow, "--set", f"run.cycles_per_update={coarse}")
    advance = answer(cli, wrapped, *phases)
    assert line["method"] == "per_cycle"
    assert line["updates"] == pytest.approx(line["cycles"] / coarse, abs=1.0)
    assert line["life_hours"] == pytest.approx(advance["life_hours"], rel=0.02)


@pytest.mark.wide
def test_required_hours(cli, wrapped):
    hours = answer(cli, wrapped)["life_hours"]
    assert cli("life", wrapped, "--require-hours", 0.9 * hours).code == 0
    assert cli("life", wrapped, "--require-hours", 1.1 * hours).code == 4


def test_coarse_grid_and_narrow_tolerance_warn(cli, wrapped):
    line = answer(cli, wrapped, "--set", "run.life_tolerance=1e-3")
    assert line["numerical_error"] > 1e-3
    assert any("use more nodes or phases" in text for text in line["warnings"])
