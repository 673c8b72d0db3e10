"""``wearsim uncertainty --cross-check``: the fits repeated by the library reliability."""

import json
import subprocess
import sys
from importlib.util import find_spec

import pytest

SCATTER = """\
[uncertainty]
"wear.specific_wear_rate_mm2_per_N" = {distribution = "lognormal", sigma_ln = 0.6}
"""

PROGRAM = """\
import sys
import numpy as np
import pandas as pd
import wearsim.cli
before, table = np.geterr(), pd.DataFrame({"x": [1.0, 123456.789012]})
printed = str(table)
try:
    wearsim.cli.main()
finally:
    assert "reliability" in sys.modules
    assert (np.geterr(), str(table)) == (before, printed)
"""


@pytest.fixture
def case(drive):
    path = drive()
    path.write_text(path.read_text() + SCATTER)
    return path


@pytest.fixture
def library():
    if find_spec("reliability") is None:
        pytest.skip("reliability is not installed")


def horizon(cli, case):
    """Setting of a horizon that one in four lives outlasts."""
    plain = json.loads(cli("uncertainty", case, "--samples", 64, "--json").out)
    return "--set", f"run.horizon_hours={1.2 * plain['p50_hours']!r}"


@pytest.mark.wide
@pytest.mark.usefixtures("library")
def test_suspensions(cli, case):
    options = ("uncertainty", case, "--samples", 128, *horizon(cli, case))
    done = cli(*options, "--cross-check", "--json")
    found, plain = json.loads(done.out), json.loads(cli(*options, "--json").out)
    assert done.code == 0
    crossed = found.pop("cross_check")
    assert found == plain
    assert found["p90_hours"] is None
    assert crossed["library"].startswith("reliability ")
    assert [fit["name"] for fit in crossed["fits"]] == [fit["name"] for fit in found["fits"]]
    for ours, theirs in zip(found["fits"], crossed["fits"], strict=True):
        for name in ("shape", "scale_hours"):
            assert theirs[name] == pytest.approx(ours[name], rel=0.01)
            assert theirs[f"{name}_low"] < theirs[name] < theirs[f"{name}_high"]
    lognormal = crossed["fits"][0]
    assert lognormal["name"] == "lognormal"
    assert lognormal["shape_low"] < 0.6 < lognormal["shape_high"]


@pytest.mark.usefixtures("library")
def test_text_names_the_library_and_its_bounds(cli, case):
    done = cli("uncertainty", case, "--samples", 64, "--cross-check")
    head, *lines = done.out.partition("cross-check  by reliability ")[2].splitlines()[:3]
    assert head.endswith("parameters with their 95 % bounds")
    assert [line.split()[0] for line in lines] == ["lognormal", "weibull"]
    assert all(" to " in line for line in lines)
    assert "cross-check" not in cli("uncertainty", case, "--samples", 64).out


@pytest.mark.usefixtures("library")
def test_gears_without_a_life(cli, tmp_path):
    path = tmp_path / "gears.toml"
    path.write_text(
        "format_version = 1\n[gear]\npinion_teeth = 19\nwheel_teeth = 61\nmodule_mm = 3.0\n"
        "face_width_mm = 30.0\nnodes = 61\n[load]\ntorque_N_m = 100.0\nspeed_rpm = 1450.0\n"
        "[wear]\nspecific_wear_rate_mm2_per_N = 1e-11\n[stop]\ncritical_depth_mm = 0.02\n"
        "[run]\nhorizon_hours = 1e-3\n"
    )
    done = cli("uncertainty", path, "--samples", 8, "--cross-check")
    assert done.code == 0
    assert ": no fit\n" in done.out


@pytest.mark.wide
@pytest.mark.usefixtures("library")
def test_library_is_kept_to_itself(case):
    """Nothing else on stdout, no warning; numpy goes on telling of overflows, pandas prints as before."""
    options = ["uncertainty", str(case), "--samples", "32", "--cross-check", "--json", "-q"]
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", PROGRAM, *options], capture_output=True, text=True
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert len(json.loads(done.stdout)["cross_check"]["fits"]) == 2


def test_missing_library_is_named_before_the_study(cli, case, tmp_path, monkeypatch):
    missing = {"reliability"}
    monkeypatch.setattr(
        "importlib.util.find_spec", lambda name, *more: None if name in missing else find_spec(name, *more)
    )
    done = cli("uncertainty", case, "--cross-check", "--out", tmp_path / "out")
    assert (done.code, done.out) == (2, "")
    assert "--cross-check: needs reliability" in done.err
    assert "pip install 'wearsim[crosscheck]'" in done.err
    assert not (tmp_path / "out").exists()
