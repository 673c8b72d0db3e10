"""Studies of whole drives: ``wearsim sweep`` and ``uncertainty`` of [[sprocket]]."""

import json

import pandas as pd
import pytest

pytest.importorskip("pyarrow", reason="pyarrow is not installed")

SWEEP = """\
format_version = 1
case = "drive.toml"
[grid]
"sprocket.2.teeth" = [20, 25]
"""


@pytest.fixture
def drive(tmp_path, two_sprockets):
    path = tmp_path / "drive.toml"
    # Teeth that wear faster than the chain: a run ends with its first one.
    path.write_text(two_sprockets.replace("= 5e-9", "= 1e-7"))
    (tmp_path / "sweep.toml").write_text(SWEEP)
    return path


def life(cli, path, *settings):
    """Lives of chain and sprockets as `wearsim life` has them."""
    found = json.loads(cli("life", path, "--json", *settings).out)
    return [found["chain_life_hours"], *(one["sprocket_life_hours"] for one in found["sprockets"])]


@pytest.mark.wide
def test_a_sweep_gives_the_lives_of_all_parts(cli, drive, tmp_path):
    out = tmp_path / "out"
    done = cli("sweep", tmp_path / "sweep.toml", "--out", out)
    assert done.code == 0, done.err
    table = pd.read_csv(out / "cases.csv")
    columns = ["chain_life_hours", "driver_life_hours", "roll_life_hours"]
    assert list(table[columns].iloc[1]) == life(cli, drive, "--set", "sprocket.2.teeth=25")
    assert (table[columns].iloc[0] != table[columns].iloc[1]).all()
    assert list(table["stop"]) == ["driver", "driver"]
    assert list(table["life_hours"]) == list(table["driver_life_hours"])
    assert done.out.splitlines()[0] == (
        "| sprocket.2.teeth | life, h | ended by | chain, h | driver, h | roll, h |"
    )
    # What is finished is taken from the folder.
    again = cli("sweep", tmp_path / "sweep.toml", "--out", out)
    assert again.out == done.out


def test_what_no_drive_can_have_is_refused_before_a_run(cli, drive, tmp_path):
    study = tmp_path / "sweep.toml"
    for text, message in (
        (SWEEP.replace("[20, 25]", "[20, 2]"), "sprocket.2.teeth"),
        (SWEEP.replace("2.teeth", "2.teth"), "must be a key of a case"),
    ):
        study.write_text(text)
        done = cli("sweep", study)
        assert done.code == 2 and message in done.err
    # Feasible by itself, not in this drive.
    study.write_text(SWEEP.replace("[20, 25]", "[20, 400]"))
    done = cli("sweep", study, "--set", "run.horizon_hours=20")
    assert done.code == 5
    assert "failed: " in done.out and "> 20 (limit not reached)" in done.out
    good, bad = done.out.splitlines()[2:]
    assert good.endswith("| limit not reached | limit not reached | limit not reached |")
    assert bad.endswith("|  |  |  |  |")


@pytest.mark.slow
def test_uncertainty_says_which_part_ends_first(cli, drive, tmp_path):
    fast = ("--set", "joint.specific_wear_rate_mm2_per_N=4e-7", "--set", "run.horizon_hours=14")
    out = tmp_path / "out"
    done = cli("uncertainty", drive, "--samples", "2", "--json", "--out", out, *fast)
    assert done.code == 0, done.err
    found = json.loads(done.out)
    assert found["ends_first"] == {"chain": 1.0, "driver": 0.0, "roll": 0.0}
    assert found["p50_hours"] < 14.0
    assert found["median_life_hours"]["roll"] is None
    assert set(found["inputs"]) == {"wear.specific_wear_rate_mm2_per_N", "joint.specific_wear_rate_mm2_per_N"}
    text = (out / "summary.md").read_text()
    assert "ends first   chain in 100 %" in text
    assert "roll not reached" in text


def test_one_wear_for_all_is_needed_to_scatter(cli, drive):
    own = "sprocket.2.wear={specific_wear_rate_mm2_per_N = 4e-9}"
    done = cli("uncertainty", drive, "--samples", "4", "--set", own)
    assert done.code == 2
    assert "sprocket.2.wear: must be left out here" in done.err
