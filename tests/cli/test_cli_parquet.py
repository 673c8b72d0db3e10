"""``life --parquet``: the tables of a result as Parquet files beside the CSV files."""

import sys
from pathlib import Path

import pandas as pd
import pytest

import wearsim
from wearsim.quantities import quantities
from wearsim.result import WearResult

CASES = Path(__file__).parents[2] / "cases"


def test_without_the_library_nothing_runs(cli, drive, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    done = cli("life", drive(), "--out", tmp_path / "run", "--parquet")
    assert (done.code, done.out) == (2, "")
    text = "--parquet: needs pyarrow, which is not installed: pip install 'wearsim[parquet]'"
    assert text in done.err
    assert not (tmp_path / "run").exists()


def test_needs_a_folder_and_no_solve_for(cli, drive, tmp_path):
    done = cli("life", drive(), "--parquet")
    assert (done.code, done.out) == (2, "")
    assert "--parquet needs --out" in done.err
    options = ("--solve-for", "load.power_kW", "--require-hours", 100)
    assert cli("life", drive(), *options, "--parquet", "--out", tmp_path / "run").code == 2


@pytest.mark.slow
@pytest.mark.parametrize("case", ["16b-20t-oiled.toml", "08b-19t-wrap.toml", "involute-36t-mild.toml"])
def test_same_numbers_types_and_units(cli, tmp_path, case):
    parquet = pytest.importorskip("pyarrow.parquet", reason="pyarrow is not installed")
    run = tmp_path / "run"
    settings = ("--set", "run.horizon_hours=500", "--set", "run.life_tolerance=0.05")
    done = cli("life", CASES / case, "--out", run, "--parquet", *settings)
    assert done.code == 0, done.err
    result = WearResult.load(run)
    for name, expected in (("history", result.history), ("flank", result.flank)):
        path = run / f"{name}.parquet"
        pd.testing.assert_frame_equal(pd.read_parquet(path), expected, check_exact=True)
        for field in parquet.read_schema(path):
            assert field.metadata[b"unit"].decode() == quantities()[field.name].unit
        as_text = (run / f"{name}.csv").stat().st_size
        # The head of a Parquet file takes some kB.
        assert path.stat().st_size < max(as_text, 8000)
    again = cli("life", CASES / case, "--out", run, "--force", *settings)
    assert again.code == 0
    assert not list(run.glob("*.parquet"))


@pytest.mark.slow
def test_a_run_needs_only_its_csv(cli, drive, tmp_path):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    run = tmp_path / "run"
    wearsim.simulate(wearsim.load_case(drive())).save(run, parquet=True)
    before = WearResult.load(run)
    for path in run.glob("*.parquet"):
        path.unlink()
    assert WearResult.load(run).history.equals(before.history)
