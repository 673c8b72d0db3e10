"""Every result names the wearsim that computed it, as ``wearsim --version`` prints it."""

import json
from pathlib import Path

import pytest

import wearsim
from tests import damage

SIZING = Path(__file__).parents[2] / "cases" / "sizing"
READING = ("--hours", "100", "--depth-mm", "0.01", "--reading-error-mm", "0.001")
SCATTER = '[uncertainty]\n"wear.specific_wear_rate_mm2_per_N" = {distribution = "lognormal", sigma_ln = 1}\n'
STUDY = 'format_version = 1\ncase = "drive.toml"\n[grid]\n"sprocket.teeth" = [20, 25]\n'
OPTIMISE = """\
[optimise]
objectives = ["life_hours"]
[optimise.parameters]
"sprocket.evolute_offset_mm" = {low = 5.5, high = 6.0}
"""


@pytest.fixture
def version(cli):
    """What ``wearsim --version`` prints behind the words before it."""
    return cli("--version").out.split()[-1]


def heads(cli, *arguments):
    """First two keys and values of every object that a command prints."""
    done = cli(*arguments, "--json")
    assert done.code == 0, done.err
    return [list(json.loads(line).items())[:2] for line in done.out.splitlines()]


def head(version):
    return [("schema_version", 1), ("wearsim_version", version)]


@pytest.mark.parametrize(
    "arguments", [("life",), ("check",), ("remaining", *READING)], ids=lambda arguments: arguments[0]
)
def test_answers_on_a_sprocket(cli, drive, version, arguments):
    assert heads(cli, arguments[0], drive(), *arguments[1:]) == [head(version)]


@pytest.mark.parametrize(
    ("command", "more", "options"),
    [
        ("uncertainty", SCATTER, ("--samples", 8)),
        ("sensitivity", SCATTER, ("--samples", 8)),
        ("optimise", OPTIMISE, ("--evaluations", 10)),
    ],
)
def test_answers_of_studies_of_a_case(cli, drive, version, command, more, options):
    path = drive()
    path.write_text(path.read_text() + "[run]\nlife_tolerance = 0.1\n" + more)
    assert heads(cli, command, path, *options) == [head(version)]


@pytest.fixture
def sweep(drive, tmp_path):
    """A sweep of two cases."""
    drive()
    path = tmp_path / "study.toml"
    path.write_text(STUDY)
    return path


def test_sweep(cli, sweep, version):
    assert heads(cli, "sweep", sweep) == [head(version)] * 2


def test_folder_of_a_study(cli, sweep, tmp_path, version):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    assert cli("sweep", sweep, "--out", tmp_path / "out").code == 0
    assert json.loads((tmp_path / "out" / "study.json").read_text())["wearsim_version"] == version


@pytest.mark.wide
@pytest.mark.parametrize("command", ["life", "check", "loads", "maintain"])
def test_answers_on_a_whole_drive(cli, two_sprockets, tmp_path, version, command):
    (tmp_path / "drive.toml").write_text(two_sprockets)
    assert heads(cli, command, tmp_path / "drive.toml") == [head(version)]


def test_calculation_and_its_folder(cli, tmp_path, version):
    out = tmp_path / "out"
    (found,) = heads(cli, "handbook", "strength", SIZING / "strength-a-tempered.toml", "--out", out)
    assert found == head(version)
    assert json.loads((out / "result.json").read_text())["wearsim_version"] == version


def test_stored_result_keeps_the_version_that_computed_it(cli, drive, tmp_path, version):
    run = tmp_path / "run"
    assert cli("life", drive(), "--out", run).code == 0
    assert json.loads((run / "result.json").read_text())["wearsim_version"] == version
    path = run / "environment.json"
    path.write_text(path.read_text().replace(version, "0.1.0"))
    damage.without_digests(run)
    assert wearsim.WearResult.load(run).summary()["wearsim_version"] == "0.1.0"


def test_no_answer_begins_without_it():
    """All take the head of answers; what is told of a failure holds no number to trace."""
    package = Path(wearsim.__file__).parent
    own = {
        str(path.relative_to(package))
        for path in package.rglob("*.py")
        if '"schema_version": 1' in path.read_text("utf-8")
    }
    assert own == {"_version.py", str(Path("command", "options.py"))}
