"""Where results go: absent, the old or complete; nothing replaced unasked."""

import pytest

from wearsim.errors import ConvergenceError
from wearsim.result import WearResult

FILES = [".wearsim", "case.lock.toml", "environment.json", "flank.csv", "history.csv", "result.json"]


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_one_case_fills_the_folder(cli, drive, tmp_path):
    out = tmp_path / "a" / "run"
    assert cli("life", drive(), "--out", out).code == 0
    assert names(out) == FILES
    assert WearResult.load(out).title == "Test drive"


def test_several_cases_fill_a_folder_each(cli, drive, tmp_path):
    out = tmp_path / "out"
    assert cli("life", drive("one"), drive("two"), "--out", out).code == 0
    assert names(out) == ["one", "two"]
    assert names(out / "one") == names(out / "two") == FILES


def test_cases_of_the_same_name_are_refused(cli, drive, tmp_path):
    (tmp_path / "other").mkdir()
    one = drive()
    two = tmp_path / "other" / "drive.toml"
    two.write_text(one.read_text())
    done = cli("life", one, two, "--out", tmp_path / "out")
    assert (done.code, done.out) == (2, "")
    assert "drive comes twice" in done.err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("kind", ["folder", "file"])
def test_what_exists_is_refused_before_the_run(cli, drive, tmp_path, monkeypatch, kind):
    out = tmp_path / "out"
    out.mkdir() if kind == "folder" else out.write_text("mine")
    monkeypatch.setattr("wearsim.drive.simulate.simulate_single", lambda *given: pytest.fail("was run"))
    done = cli("life", drive(), "--out", out)
    assert (done.code, done.out) == (2, "")
    assert done.err == f"{out}: must not exist yet, but does: choose another place or --force\n"
    done = cli("life", drive("one"), drive("out"), "--out", tmp_path)
    assert done.code == 2


def test_faulty_case_stops_all_before_the_first_runs(cli, drive, tmp_path, monkeypatch):
    monkeypatch.setattr("wearsim.drive.simulate.simulate_single", lambda *given: pytest.fail("was run"))
    done = cli("life", drive("good"), drive("bad", teeth=3), "--out", tmp_path / "out")
    assert done.code == 2
    assert not (tmp_path / "out").exists()


@pytest.mark.wide
def test_force_replaces(cli, drive, tmp_path):
    out = tmp_path / "out"
    assert cli("compare", drive(), drive("b"), "--out", out).code == 0
    assert "summary.csv" in names(out)
    assert cli("life", drive(), "--out", out, "--force").code == 0
    assert names(out) == FILES


@pytest.mark.parametrize("error", [ConvergenceError("life: wrong"), KeyboardInterrupt()])
def test_force_keeps_the_old_when_the_run_ends_early(cli, drive, tmp_path, monkeypatch, error):
    out = tmp_path / "out"
    cli("life", drive(), "--out", out)
    before = (out / "result.json").read_text()

    def failing(*given):
        raise error

    monkeypatch.setattr("wearsim.drive.simulate.simulate_single", failing)
    done = cli("life", drive(power_kW=4), "--out", out, "--force")
    assert done.code == (3 if isinstance(error, ConvergenceError) else 130)
    assert names(out) == FILES
    assert (out / "result.json").read_text() == before
    assert names(tmp_path) == ["drive.toml", "out"]


@pytest.mark.parametrize("options", [(), ("--json",)])
def test_failed_write_leaves_nothing(cli, drive, tmp_path, monkeypatch, options):
    def full(*arguments, **options):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pandas.DataFrame.to_csv", full)
    done = cli("life", drive(), "--out", tmp_path / "out", *options)
    assert done.code == 2
    assert "out: must be writable: No space left on device" in done.err
    assert names(tmp_path) == ["drive.toml"]


def test_lock_holds_overrides_and_runs_again_to_the_same_life(cli, drive, tmp_path):
    one, two = tmp_path / "one", tmp_path / "two"
    cli("life", drive(), "--out", one, "--set", "load.power_kW=4", "--set", "title=Other")
    assert "power_kW = 4.0" in (one / "case.lock.toml").read_text()
    cli("life", one / "case.lock.toml", "--out", two)
    first, second = WearResult.load(one), WearResult.load(two)
    assert first.title == second.title == "Other"
    assert first.life == second.life
    assert (one / "flank.csv").read_bytes() == (two / "flank.csv").read_bytes()
    assert (one / "history.csv").read_bytes() == (two / "history.csv").read_bytes()


def test_lock_holds_the_raised_horizon(cli, drive, tmp_path):
    out = tmp_path / "out"
    cli("life", drive(), "--out", out, "--require-hours", 2e6)
    assert "horizon_hours = 2000000.0" in (out / "case.lock.toml").read_text()
