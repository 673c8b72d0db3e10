"""Kernels that are compiled ahead: what is said of it, and that a life then compiles nothing.

The cache of each test is its own and empty at first.
"""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import wearsim
from wearsim.input.mechanism_registry import MECHANISMS
from wearsim.jit.compiled import Kernel, all_kernels

CASES = Path(__file__).parents[2] / "cases"
STRAND, WRAP = CASES / "16b-20t-oiled.toml", CASES / "08b-19t-wrap.toml"
MESSAGE = "compiling once, about "


@pytest.fixture
def cold(tmp_path):
    """Function that runs a command; gives both streams and the files of its cache with their times."""
    cache = tmp_path / "cache"
    program = "import wearsim.cli; wearsim.cli.main()"
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(cache), "NUMBA_DISABLE_JIT": "0"}

    def run(*arguments):
        command = [sys.executable, "-c", program, *map(str, arguments)]
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        files = {path: path.stat().st_mtime_ns for path in cache.rglob("*.*")}
        return done.stdout, done.stderr, files

    return run


@pytest.mark.wide
def test_message_comes_once_and_not_on_stdout(cold):
    out, err, files = cold("life", STRAND)
    assert err.count(MESSAGE) == err.count("\n") == 1
    assert MESSAGE not in out
    assert cold("life", STRAND) == (out, "", files)


@pytest.mark.slow
def test_quiet_run_says_nothing(cold):
    _, err, files = cold("life", "-q", STRAND)
    assert err == ""
    assert files


@pytest.mark.slow
@pytest.mark.parametrize("case", [STRAND, WRAP], ids=["strand", "wrap"])
def test_life_compiles_nothing_after_warm(cold, case):
    out, err, files = cold("warm")
    count = len(all_kernels())
    assert out.startswith(f"{count} of {count} kernels compiled, all are in ")
    assert err.count(MESSAGE) == 1
    assert len({path.name.partition("-")[0] for path in files}) == count
    # One that is left to numba has an empty file: but for the hash of nothing.
    assert min(path.stat().st_size for path in files) > 500
    assert cold("life", case)[1:] == ("", files)
    assert cold("warm")[0].startswith(f"0 of {count} kernels compiled")


@pytest.mark.wide
@pytest.mark.wide
@pytest.mark.parametrize(
    ("kind", "case"),
    [
        ("strand", "16b-20t-oiled"),
        ("prescribed", "hertz-arc-prescribed"),
        ("gear_pair", "involute-36t-mild"),
        ("wrap", "08b-19t-wrap"),
    ],
)
def test_mechanism_names_the_kernels_that_its_life_calls(monkeypatch, kind, case):
    called, call = set(), Kernel.__call__

    def noted(self, *arguments):
        called.update(one.name for one in (self, *arguments) if isinstance(one, Kernel))
        return call(self, *arguments)

    monkeypatch.setattr(Kernel, "__call__", noted)
    wearsim.simulate(wearsim.load_case(CASES / f"{case}.toml"))
    # A quick kernel calls those of its own in Python before machine code is loaded.
    assert called - {"flank_geometry._end_frame"} == set(MECHANISMS[kind].kernels)


def test_warm_needs_a_folder(cli, monkeypatch):
    monkeypatch.setattr("wearsim.jit.compiled.cache_folder", lambda: None)
    done = cli("warm")
    assert (done.code, done.out) == (2, "")
    assert "set NUMBA_CACHE_DIR" in done.err
