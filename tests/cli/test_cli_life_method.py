"""``wearsim life --method`` on every form of drive: runs that are short, and those that are refused."""

import json
import re

import jsonschema
import pytest

from wearsim.cli.schema import result_schema
from wearsim.errors import ConvergenceError

pytestmark = pytest.mark.wide

GEARS = """\
format_version = 1
[gear]
pinion_teeth = 19
wheel_teeth = 61
module_mm = 3
face_width_mm = 30
nodes = 61
[load]
torque_N_m = 100
speed_rpm = 1450
[wear]
specific_wear_rate_mm2_per_N = 1e-9
[stop]
critical_depth_mm = 0.002
"""

PRESCRIBED = """\
format_version = 1
[chain]
pitch_mm = 25.4
roller_diameter_mm = 15.88
inner_width_mm = 17.02
[mechanism]
kind = "prescribed"
table_file = "loads.csv"
[load]
speed_rpm = 100
[wear]
specific_wear_rate_mm2_per_N = 1e-9
[stop]
critical_depth_mm = 0.002
"""

LOADS = """\
arc_length_mm,load_per_width_N_per_mm,flank_curvature_per_mm,sliding_distance_mm
0,60,0.02,0.2
1,100,0.02,0.3
2,120,0.02,0.4
3,100,0.02,0.5
4,60,0.02,0.6
"""

STRAND = """\
format_version = 1
[chain]
designation = "16B-1"
[sprocket]
teeth = 20
profile = "evolute"
evolute_offset_mm = 5.6
nodes = 51
[load]
power_kW = 3
speed_rpm = 100
[wear]
specific_wear_rate_mm2_per_N = 1e-9
[stop]
critical_depth_mm = 0.002
"""

WRAP = """\
format_version = 1
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
[load]
tension_N = 1000
speed_rpm = 100
[wear]
specific_wear_rate_mm2_per_N = 1e-7
[stop]
critical_depth_mm = 0.003
"""

FORMS = {"strand": STRAND, "prescribed": PRESCRIBED, "gears": GEARS, "wrap": WRAP}
PER_CYCLE = ("--method", "per_cycle")
LASTING = ("--set", "wear.specific_wear_rate_mm2_per_N=1e-15")
RATES = {"strand": 1e-15, "prescribed": 1e-17, "gears": 1e-15, "wrap": 1e-10}
"""Of drives with more cycles than a run cycle by cycle may have."""


@pytest.fixture(params=FORMS)
def path(request, tmp_path):
    """A drive of each form that lives some thousand cycles."""
    (tmp_path / "loads.csv").write_text(LOADS)
    file = tmp_path / f"{request.param}.toml"
    file.write_text(FORMS[request.param])
    return file


@pytest.fixture
def strand(tmp_path):
    file = tmp_path / "strand.toml"
    file.write_text(STRAND)
    return file


def line_of(done):
    (line,) = done.out.splitlines()
    content = json.loads(line)
    jsonschema.Draft202012Validator(result_schema()).validate(content)
    return content


def test_every_cycle_is_an_update_and_the_life_that_of_the_steps(cli, path):
    done = cli("life", "--json", path, *PER_CYCLE)
    assert done.code == 0
    line = line_of(done)
    assert (line["method"], line["life_reached"]) == ("per_cycle", True)
    assert line["updates"] - 1 < line["cycles"] <= line["updates"]
    stepped = line_of(cli("life", "--json", path, "--method", "advance"))
    assert stepped["method"] == "advance"
    assert stepped["updates"] < line["updates"]
    assert stepped["cycles"] == pytest.approx(
        line["cycles"], rel=line["numerical_error"] + stepped["numerical_error"]
    )


def test_it_is_the_key_of_the_case(cli, path, tmp_path):
    option = line_of(cli("life", "--json", path, *PER_CYCLE, "--out", tmp_path / "run"))
    assert option == line_of(cli("life", "--json", path, "--set", "run.method=per_cycle"))
    saved = json.loads((tmp_path / "run" / "result.json").read_text())
    assert saved["method"] == "per_cycle"
    assert 'method = "per_cycle"' in (tmp_path / "run" / "case.lock.toml").read_text()


def test_too_many_cycles_are_refused_before_the_run(cli, path, monkeypatch):
    def run(*arguments):
        raise ConvergenceError("it runs")

    monkeypatch.setattr("wearsim.drive.pointwise.run_per_cycle", run)
    monkeypatch.setattr("wearsim.drive.wrap_life.run_resting", run)
    rate = f"wear.specific_wear_rate_mm2_per_N={RATES[path.stem]}"
    asked = ("life", "--json", path, *PER_CYCLE, "--set", rate, "--set", "run.horizon_hours=1e12")
    done = cli(*asked)
    assert done.code == 3
    error = line_of(done)["error"]
    assert error["kind"] == "ConvergenceError"
    found = re.fullmatch(
        r"wear: a cycle-by-cycle run must stay below (\d+) updates, takes (\S+), about \S+ (?:min|h): "
        r'take cycles_per_update = (\d+) or method = "advance"',
        error["message"],
    )
    most, updates, cure = (float(number) for number in found.groups())
    assert updates > most
    assert cure == pytest.approx(updates / most, rel=0.01, abs=1.0)
    cured = cli(*asked, "--set", f"run.cycles_per_update={int(cure)}")
    assert (cured.code, line_of(cured)["error"]["message"]) == (3, "it runs")


def test_horizon_counts_where_it_comes_first(cli, path):
    """A drive that lasts, for a few cycles."""
    done = cli("life", "--json", path, *PER_CYCLE, *LASTING, "--set", "run.horizon_hours=0.01")
    assert done.code == 0
    line = line_of(done)
    assert (line["life_reached"], line["stop"]) == (False, "horizon_hours")
    assert 0 < line["updates"] <= line["cycles_run"] + 1


def test_exit_codes(cli, strand):
    hours = line_of(cli("life", "--json", strand, *PER_CYCLE))["life_hours"]
    assert cli("life", strand, *PER_CYCLE, "--require-hours", 0.9 * hours).code == 0
    assert cli("life", strand, *PER_CYCLE, "--require-hours", 1.1 * hours).code == 4
    done = cli("life", strand, "--method", "percycle")
    assert done.code == 2
    assert "'advance', 'per_cycle'" in done.err


def test_it_goes_before_set_and_the_file(cli, strand):
    strand.write_text(STRAND + '[run]\nmethod = "advance"\n')
    both = ("--set", "run.method=advance", *PER_CYCLE)
    assert line_of(cli("life", "--json", strand, *both))["method"] == "per_cycle"


def test_life_that_is_solved_for(cli, strand):
    asked = ("--solve-for", "load.power_kW", "--require-hours", 1)
    with_option, with_key = (
        json.loads(cli("life", "--json", strand, *asked, *method).out)
        for method in (PER_CYCLE, ("--set", "run.method=per_cycle"))
    )
    assert with_option == with_key
