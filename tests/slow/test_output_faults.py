"""A full disk, two writers of one folder, and processes that compile into one cache.

A disk is full here where no file may grow beyond some bytes (RLIMIT_FSIZE): writing fails as on a full
one, with an error of the system.
"""

import resource
import signal
import subprocess
import sys

import pytest

COMMANDS = {
    "life": "life 16b-20t-oiled --force --out {}/run",
    "drive": "life packaging-conveyor --force --out {}/run",
    "workbook": "life 16b-20t-oiled --force --xlsx {}/life.xlsx",
    "report": "report 16b-20t-oiled --force --out {}/sheet.html",
    "picture": "animate 16b-20t-oiled --force --out {}/wear.gif",
    "export": "export 16b-20t-oiled --force --out {}/wheel.dxf",
    "gauge": "export 16b-20t-oiled --force --template {}/gauge.pdf",
    "marker sheet": "scan --force --sheet {}/sheet.pdf",
    "table": "select --power 3 --rpm 120 --ratio 2.7 --hours 15000 --force --csv {}/drives.csv",
    "calculation": "handbook strength strength-a-tempered --force --out {}/strength",
}


def begun(line, folder, **options):
    words = [word.format(folder) for word in line.split()]
    return subprocess.Popen(
        [sys.executable, "-m", "wearsim", *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        **options,
    )


def ended(line, folder, **options):
    """Exit code, and what was said."""
    process = begun(line, folder, **options)
    answer, said = process.communicate()
    return process.returncode, answer, said


def full():
    """Let no file of a new process grow beyond 1500 bytes, and writing fail there."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1500, 1500))


def contents(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.slow
@pytest.mark.parametrize("name", COMMANDS)
def test_full_disk(name, tmp_path):
    """The old output stays, nothing is left beside it, and the message names the place."""
    code, _, said = ended(COMMANDS[name], tmp_path)
    assert code == 0, said
    before = contents(tmp_path)
    code, _, said = ended(COMMANDS[name], tmp_path, preexec_fn=full)
    assert code == 2, said
    assert str(tmp_path) in said and "File too large" in said
    assert "bug in wearsim" not in said and "Traceback" not in said
    assert contents(tmp_path) == before


@pytest.mark.slow
def test_two_writers_of_one_folder(tmp_path):
    """Each replaces the folder whole, or is told that the other one writes."""
    line = "life 16b-20t-oiled --force --out {}/run"
    assert ended(line, tmp_path)[0] == 0
    names = set(contents(tmp_path))
    both = [begun(line, tmp_path), begun(line, tmp_path)]
    said = [one.communicate()[1] for one in both]
    assert sorted(one.returncode for one in both) in ([0, 0], [0, 2]), said
    assert set(contents(tmp_path)) == names
    assert [path.name for path in tmp_path.iterdir()] == ["run"]
    code, _, message = ended("compare {}/run", tmp_path)
    assert code == 0, message


@pytest.mark.slow
def test_four_processes_compile_into_one_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache"))
    four = [begun("life 16b-20t-oiled", tmp_path) for _ in range(4)]
    answers = {one.communicate() for one in four}
    assert {one.returncode for one in four} == {0}
    assert len({answer for answer, _ in answers}) == 1
    assert {ended("life 16b-20t-oiled", tmp_path)[1]} == {answer for answer, _ in answers}
