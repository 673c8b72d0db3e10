"""``wearsim doctor``: a sound installation, and each way in which one can be broken."""

import json
import os
import re
import stat
import subprocess
import sys
import tempfile
import tomllib
from importlib import metadata
from pathlib import Path

import pytest

import wearsim
from wearsim.cli import doctor
from wearsim.extras import libraries
from wearsim.jit import compiled

ROOT = Path(__file__).parents[2]


def findings(cli, code):
    done = cli("doctor", "--json")
    assert done.code == code, done.out
    content = json.loads(done.out)
    assert content["schema_version"] == 1
    assert content["in_order"] is (code == 0)
    found = {one["name"]: one for one in content["findings"]}
    assert all(one["advice"] or one["state"] == "ok" for one in found.values())
    failed = [name for name, one in found.items() if one["state"] == "failed"]
    return found, failed


def test_sound_installation(cli):
    found, failed = findings(cli, 0)
    assert failed == []
    assert found["self-test"]["found"].startswith("a life of 26102")
    assert found["numpy"]["found"] == metadata.version("numpy")
    assert "files" in found["cache of kernels"]["found"]
    text = cli("doctor").out
    assert text.endswith("all required components are working\n")
    for name in found:
        assert name in text


def installed(monkeypatch, **versions):
    """Pretend versions of libraries; None is one that is not installed."""
    real = metadata.version

    def version(name):
        if name not in versions:
            return real(name)
        if versions[name] is None:
            raise metadata.PackageNotFoundError(name)
        return versions[name]

    monkeypatch.setattr(metadata, "version", version)


@pytest.mark.parametrize(("version", "found"), [(None, "not installed"), ("0.12.1", "0.12.1")])
def test_library_missing_or_too_old(cli, monkeypatch, version, found):
    installed(monkeypatch, tomlkit=version)
    content, failed = findings(cli, 1)
    assert failed == ["tomlkit"]
    assert content["tomlkit"]["found"] == found
    assert content["tomlkit"]["advice"].endswith("pip install 'tomlkit>=0.12.2'")
    text = cli("doctor").out
    assert "failed  tomlkit" in text and text.endswith("failed: tomlkit\n")


@pytest.mark.parametrize(("version", "state"), [("99.0.1", "note"), ("2.5.99", "ok"), ("2.0.0rc1", "ok")])
def test_newer_library_is_noted(cli, monkeypatch, version, state):
    installed(monkeypatch, numpy=version)
    content, _ = findings(cli, 0)
    assert content["numpy"]["state"] == state
    assert ("newer than tested" in content["numpy"]["advice"]) is (state == "note")


@pytest.mark.parametrize(
    ("version", "state", "code"), [((3, 10, 4), "failed", 1), ((3, 99, 0), "note", 0), ((3, 11, 0), "ok", 0)]
)
def test_python(cli, monkeypatch, version, state, code):
    class Sys:
        version_info = version
        executable = sys.executable

    monkeypatch.setattr(doctor, "sys", Sys)
    content, _ = findings(cli, code)
    assert content["Python"]["state"] == state


def test_no_cache(cli, monkeypatch):
    monkeypatch.setattr(compiled, "cache_folder", lambda: None)
    content, failed = findings(cli, 1)
    assert failed == ["cache of kernels"]
    assert "NUMBA_CACHE_DIR" in content["cache of kernels"]["advice"]


def test_cache_in_the_temporary_folder_is_noted(cli, monkeypatch, tmp_path):
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    folder = tmp_path / "cache"
    folder.mkdir()
    (folder / "a.nbc").write_bytes(bytes(2_000_000))
    monkeypatch.setattr(compiled, "cache_folder", lambda: folder)
    content, _ = findings(cli, 0)
    assert content["cache of kernels"]["state"] == "note"
    assert content["cache of kernels"]["found"] == f"{folder}: 1 files, 2.0 MB"


def test_wrong_number(cli, monkeypatch):
    """A machine whose kernels are wrong by a thousandth."""
    monkeypatch.setattr(doctor, "KNOWN_CYCLES", doctor.KNOWN_CYCLES * 1.001)
    content, failed = findings(cli, 1)
    assert failed == ["self-test"]
    assert "do not trust results" in content["self-test"]["advice"]


def test_kernel_that_does_not_compile(cli, monkeypatch):
    def broken(case):
        raise RuntimeError("LLVM ERROR")

    monkeypatch.setattr(doctor.wearsim, "simulate", broken, raising=False)
    content, failed = findings(cli, 1)
    assert failed == ["self-test"]
    assert content["self-test"]["found"] == "RuntimeError: LLVM ERROR"


def test_missing_files(cli, monkeypatch):
    monkeypatch.setattr(wearsim.cli.doctor, "shipped_cases", dict)
    content, failed = findings(cli, 1)
    assert failed == ["self-test"]
    assert "missing" in content["self-test"]["found"]


def test_no_temporary_folder(cli, monkeypatch):
    def none():
        raise FileNotFoundError("No usable temporary directory found")

    monkeypatch.setattr(tempfile, "gettempdir", none)
    content, failed = findings(cli, 1)
    assert "temporary folder" in failed
    assert "TMPDIR" in content["temporary folder"]["advice"]


def test_missing_extra_and_browser_are_only_noted(cli, monkeypatch):
    installed(monkeypatch, pyarrow=None, xlsxwriter="3.0.0")
    monkeypatch.setenv("PATH", "")
    content, _ = findings(cli, 0)
    assert content["extra parquet"]["advice"] == "pip install 'wearsim[parquet]'"
    assert content["extra report"]["advice"] == "pip install 'wearsim[report]'"
    assert content["extra report"]["state"] == "note"
    assert content["browser"]["found"] == "none found"


@pytest.fixture
def read_only(tmp_path):
    """A folder that cannot be written, and what takes root's right to write anyway."""
    folder = tmp_path / "locked"
    folder.mkdir()
    folder.chmod(stat.S_IRUSR | stat.S_IXUSR)
    plain = "-dac_override,-dac_read_search"
    drop = ("setpriv", f"--bounding-set={plain}", f"--inh-caps={plain}") if not os.getuid() else ()
    yield folder, drop
    folder.chmod(stat.S_IRWXU)


LOCKED = """
import os, sys, tempfile
import wearsim.cli
from wearsim.jit import compiled
compiled._folder()  # kernels from the cache that there is
tempfile.tempdir = os.environ["HOME"] = os.environ["NUMBA_CACHE_DIR"] = sys.argv[1]
sys.argv = ["wearsim", "doctor", "--json"]
wearsim.cli.main()
"""


@pytest.mark.wide
def test_read_only_folders(read_only):
    folder, drop = read_only
    done = subprocess.run(
        [*drop, sys.executable, "-c", LOCKED, str(folder)],
        env={**os.environ, "PYTHONPATH": str(Path(wearsim.__file__).parents[1])},
        cwd=folder,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 1, done.stderr
    found = {one["name"]: one for one in json.loads(done.stdout)["findings"]}
    for name in ("cache of kernels", "temporary folder", "working folder"):
        assert found[name]["state"] == "failed"
    assert found["working folder"]["found"] == f"{folder}: Permission denied"
    assert found["self-test"]["state"] == "ok"


def demanded(entries):
    """Name and lowest version of libraries in pyproject.toml."""
    return {tuple(re.split(r">=", entry, maxsplit=1)) for entry in entries}


def test_table_of_libraries_is_that_of_the_project():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    wanted = {"": demanded(project["dependencies"])}
    for extra, entries in project["optional-dependencies"].items():
        if extra not in ("test", "dev"):
            wanted[extra] = demanded(entry for entry in entries if "wearsim[" not in entry)
    found = {}
    for known in libraries():
        found.setdefault(known.extra, set()).add((known.name, known.lowest))
    assert found == wanted
    assert project["requires-python"] == f">={'.'.join(map(str, doctor.LOWEST_PYTHON))}"
