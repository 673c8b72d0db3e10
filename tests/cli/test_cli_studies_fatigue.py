"""Studies of cases with ``[fatigue]``: lives end by wear or by contact fatigue, whichever is first."""

import json
import math
from pathlib import Path

import pytest

CASES = Path(__file__).parents[2] / "cases"
HARD = '[fatigue.sprocket]\ntreatment = "surface_hardened"\nhardness_HRC = 45\n'
CERTAIN = '"wear.specific_wear_rate_mm2_per_N" = {distribution = "lognormal", sigma_ln = 0.0}\n'
Z10 = 1.2815516


@pytest.fixture
def case(drive):
    """Function that writes the test drive with a hardened sprocket, a tension and more tables."""

    def write(more="", depth=0.7):
        path = drive(critical_depth_mm=depth)
        text = path.read_text().replace("power_kW = 3\n", "tension_N = 3543.0\n")
        path.write_text(text + HARD + more)
        return path

    return write


@pytest.fixture
def swept(cli, tmp_path):
    """Function that sweeps a case and holds every row against ``life``."""

    def run(path, grid):
        study = tmp_path / "study.toml"
        study.write_text(f'format_version = 1\ntitle = "Test"\ncase = "{path}"\n[grid]\n{grid}')
        done = cli("sweep", study, "--json")
        assert done.code == 0
        rows = [json.loads(line) for line in done.out.splitlines()]
        for row in rows:
            settings = [f"--set={key}={value}" for key, value in row["inputs"].items()]
            found = json.loads(cli("life", path, "--json", *settings).out)
            assert row["life_hours"] == found["governing_life_hours"]
            by_wear = found["governing_life"] in (None, "wear")
            assert row["stop"] == found["stop" if by_wear else "governing_life"]
            assert row["warnings"] == "\n".join(found["warnings"])
        return done, rows

    return run


def test_rows_are_what_life_prints(case, swept):
    """By wear at a small depth, by fatigue at a large one, from the start under a large load."""
    done, rows = swept(
        case(), '"stop.critical_depth_mm" = [0.02, 0.7]\n"load.tension_N" = [1000, 3543, 16500]\n'
    )
    stops = [row["stop"] for row in rows]
    assert set(stops) == {"critical_depth_mm", "sprocket_fatigue"}
    assert [row["life_hours"] for row in rows][-1] == 0.0
    assert "left out" not in done.err


def test_horizon_before_both(case, swept):
    _, [row] = swept(case(), '"run.horizon_hours" = [50.0]\n')
    assert (row["life_hours"], row["stop"], row["hours_run"]) == (None, "horizon_hours", 50.0)


def test_gears(swept):
    path = CASES / "fzg-c14-16t-mild.toml"
    _, rows = swept(path, '"wear.specific_wear_rate_mm2_per_N" = [1e-10, 1e-12]\n')
    stops = [row["stop"] for row in rows]
    assert stops[0] == "critical_depth_mm"
    assert stops[1].endswith("_fatigue")


def test_wrap(drive, swept):
    path = drive(profile='"iso606"\n#')
    text = path.read_text().replace("evolute_offset_mm = 5.6\nnodes = 51", "nodes = 101")
    more = "[mechanism]\nphases = 2\n[run]\nlife_tolerance = 0.1\n"
    path.write_text(text.replace('"iso606"\n# = "evolute"', '"iso606"') + HARD + more)
    _, rows = swept(path, '"fatigue.load_factor" = [1.0, 40.0]\n')
    assert rows[1]["stop"] == "sprocket_fatigue"
    assert rows[1]["life_hours"] <= rows[0]["life_hours"]


@pytest.mark.wide
def test_percentiles_are_those_of_fatigue_where_it_governs(cli, case):
    """The stress goes with the root of the load and the life with its sixth power down: L F^3."""
    scatter = '"load.tension_N" = {distribution = "lognormal", sigma_ln = 0.04}\n'
    path = case(f"[uncertainty]\n{CERTAIN}{scatter}")
    options = ("uncertainty", path, "--samples", 32)
    done = cli(*options, "--json")
    found = json.loads(done.out)
    assert done.code == 0
    ratio = found["p10_hours"] / found["p50_hours"]
    assert ratio == pytest.approx(math.exp(-3.0 * 0.04 * Z10), rel=1e-2)
    assert "a life ends by wear or by contact fatigue" in " ".join(found["assumptions"])
    assert any("ends the life before wear" in text for text in found["warnings"])
    p10 = found["p10_hours"]
    assert cli(*options, "--require-hours", 0.99 * p10).code == 0
    assert cli(*options, "--require-hours", 1.01 * p10).code == 4


@pytest.mark.wide
def test_lives_of_no_hours(cli, case, tmp_path):
    """They count among the percentiles, but no distribution that starts at 0 has them."""
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    path = case("[uncertainty]\n" + CERTAIN)
    options = ("--set", "load.tension_N=16500", "--samples", 16, "--out", tmp_path / "out")
    done = cli("uncertainty", path, *options, "--json")
    found = json.loads(done.out)
    assert (done.code, found["p10_hours"], found["p90_hours"], found["fits"]) == (0, 0.0, 0.0, [])
    scatter = '[uncertainty]\n"load.tension_N" = {distribution = "uniform", low = 3e3, high = 3e4}\n'
    found = json.loads(cli("uncertainty", case(scatter), "--samples", 16, "--json").out)
    assert found["p90_hours"] > found["p10_hours"] == 0.0
    assert found["fits"] == []


@pytest.mark.slow
def test_indices_are_of_the_life_that_governs(cli, case):
    pytest.importorskip("SALib", reason="SALib is not installed")
    scatter = (
        '"load.tension_N" = {distribution = "lognormal", sigma_ln = 0.04}\n'
        '"fatigue.load_factor" = {distribution = "lognormal", sigma_ln = 0.02}\n'
    )
    path = case(f"[uncertainty]\n{CERTAIN}{scatter}")
    path.write_text(path.read_text().replace(HARD, f"[fatigue]\nload_factor = 2.0\n{HARD}"))
    path.write_text(path.read_text().replace("tension_N = 3543.0", "tension_N = 1771.5"))
    options = ("sensitivity", path, "--trajectories", 4, "--samples")
    found = json.loads(cli(*options, 16, "--json").out)
    shares = {row["key"]: row["total_index"] for row in found["keys"]}
    assert shares["load.tension_N"] == pytest.approx(0.8, abs=0.1)
    assert shares["fatigue.load_factor"] == pytest.approx(0.2, abs=0.1)
    assert all(row["value_for_double_life"] is None for row in found["keys"])
    text = cli(*options, 8).out
    assert text.count("-> not calculated") == 3
    assert "warning: values that double the life are not calculated" in text
    done = cli(*options, 8, "--set", "load.tension_N=16500")
    assert done.code == 3
    assert "have a life of 0 h by contact fatigue" in done.err


def test_page_gives_no_percentiles_by_the_coefficient_alone(cli, case, tmp_path):
    wear = '"wear.specific_wear_rate_mm2_per_N" = {distribution = "lognormal", sigma_ln = 0.5}\n'
    path = case(f"[uncertainty]\n{wear}")
    assert cli("report", path, "--out", tmp_path / "out").code == 0
    assert "9 of 10 last longer" not in (tmp_path / "out" / "index.html").read_text("utf-8")
