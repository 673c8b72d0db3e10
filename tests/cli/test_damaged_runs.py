"""A damaged folder of a run: who reads it answers, or names the file, what must hold and what to do."""

import json
import shutil

import pytest

from tests import damage, drives
from tests.cli.conftest import TWO_SPROCKETS
from wearsim import DriveLife, WearResult, load_case, simulate
from wearsim.errors import WearsimError

MOST = {"strand": 120, "drive": 40}
"""Mutations of a run, out of thousands; those that are read all the same go on to the commands."""


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Folders of the run of a sprocket and of a whole drive, in which no digest tells what was changed."""
    import tomllib

    folder = tmp_path_factory.mktemp("runs")
    tables = {
        "strand": drives.changed(
            drives.STRAND, {"sprocket.nodes": 21, "stop.critical_depth_mm": 0.01, "run.life_tolerance": 0.1}
        ),
        "drive": tomllib.loads(TWO_SPROCKETS),
    }
    for name, case in tables.items():
        simulate(load_case(case)).save(folder / name)
        damage.without_digests(folder / name)
    return {name: folder / name for name in tables}


def _message(load, folder):
    """What is said of a folder that is not read; nothing where it is."""
    try:
        load(folder)
    except WearsimError as error:
        return str(error)
    return ""


@pytest.mark.usefixtures("not_for_ever")
@pytest.mark.parametrize("kind", MOST)
def test_damage(cli, runs, kind, tmp_path):
    load = (DriveLife if kind == "drive" else WearResult).load
    work, read = tmp_path / "run", 0
    for one in damage.sample(damage.damages(runs[kind]), MOST[kind]):
        shutil.rmtree(work, ignore_errors=True)
        shutil.copytree(runs[kind], work)
        one.do(work / one.file)
        message = _message(load, work)
        if message:
            assert "run" in message and str(tmp_path) in message, one.name
            continue
        done = cli("compare", work, "--json")
        assert done.code == 0, one.name
        assert json.loads(done.out, parse_constant=pytest.fail), one.name
        read += 1
        if read % 25 == 0:
            wheel = ("--sprocket", "roll") if kind == "drive" else ()
            assert cli("report", work, "--out", tmp_path / "sheet.html", "--force").code in (0, 2), one.name
            assert cli("export", work, *wheel, "--out", tmp_path / "wheel.dxf", "--force").code in (0, 2), (
                one.name
            )
    assert read


@pytest.mark.parametrize(
    ("file", "old", "new", "words"),
    [
        ("result.json", '"updates"', '"update"', "result.json: updates must be given"),
        ("result.json", '"max_depth_mm": ', '"max_depth_mm": -', "result.json: max_depth_mm must be"),
        ("result.json", '"stop_value": ', '"stop_value": 1e400, "old": ', "result.json: stop_value must be"),
        (
            "result.json",
            '"stop": "critical_depth_mm"',
            '"stop": "zzz"',
            "result.json: stop must be critical_depth_mm",
        ),
        (
            "result.json",
            '"hours_run": ',
            '"hours_run": 0, "old": ',
            "result.json: hours_run must be greater than 0",
        ),
        (
            "result.json",
            '"parts": {',
            '"parts": {"chain": {"cycles": 1, "hours": 1}',
            "result.json: parts must be",
        ),
        ("result.json", '"title": "', '"title": "\\ud800', "result.json must hold whole characters"),
        ("flank.csv", "\n0.0,1,", "\n0.0,1.5,", "flank.csv: node must be a whole number in every row"),
        ("flank.csv", "\n0.0,1,", "\n0.0,1,inf", "flank.csv"),
        ("history.csv", "\n0.0,0.0,", "\n1e9,0.0,", "history.csv: cycles must rise from row to row"),
        (
            "history.csv",
            "\n0.0,0.0,0.0,",
            "\n0.0,0.0,hunter2,",
            "history.csv, line 2: max_depth_mm must be a number:",
        ),
        ("history.csv", "\n0.0,", "\n0.0\n0.0,", "history.csv, line 2: must have 7 cells, has 1"),
        ("case.lock.toml", "[stop]", "[stopped]", "case.lock.toml: stop must be given"),
        ("case.lock.toml", 'kind = "strand"', "", "case.lock.toml: mechanism.kind must be given"),
        (
            "case.lock.toml",
            "speed_rpm = 100.0",
            'speed_rpm = "fast"',
            "case.lock.toml: load.speed_rpm must be",
        ),
    ],
)
def test_what_is_wrong_is_named(cli, runs, tmp_path, file, old, new, words):
    work = tmp_path / "run"
    shutil.copytree(runs["strand"], work)
    text = (work / file).read_text("utf-8")
    assert old in text
    (work / file).write_text(text.replace(old, new, 1), "utf-8")
    for command in (
        ("compare",),
        ("report", "--out", tmp_path / "sheet"),
        ("export", "--out", tmp_path / "w.dxf"),
    ):
        done = cli(command[0], work, *command[1:])
        assert done.code == 2
        assert words in done.err
        assert "run its case again" in done.err


def test_times_that_stand_still_are_named(cli, runs, tmp_path):
    work = shutil.copytree(runs["strand"], tmp_path / "run")
    head, row, *rows = (work / "history.csv").read_text("utf-8").splitlines()
    (work / "history.csv").write_text("\n".join([head, row, row, *rows, ""]), "utf-8")
    done = cli("compare", work)
    assert done.code == 2 and "history.csv: cycles must rise in every row" in done.err
