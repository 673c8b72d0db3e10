"""The disk cache of compiled kernels: never stale, never in the way, never a stranger's.

A life after an edit is compared with the interpreted life of the same edited sources.
"""

import os
import shutil
import stat
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import numba
import pytest
from numba import float64

import wearsim
from wearsim.jit import compiled, object_code
from wearsim.jit.compiled import cache_folder, kernel, source_hash

LIFE = """
import wearsim
from wearsim.jit.compiled import cache_folder
case = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "nodes": 11, "evolute_offset_mm": 5.5,
                 "contact_start_mm": 30.67, "contact_end_mm": 4.0},
    "load": {"tension_N": 5000, "speed_rpm": 100},
    "wear": {"law": "archard", "specific_wear_rate_mm2_per_N": 1e-8},
    "stop": {"critical_depth_mm": 0.001},
    "run": {"method": "per_cycle", "life_tolerance": 0.01},
}
print(wearsim.simulate(wearsim.load_case(case)).cycles, cache_folder(), sep="\\n")
"""


def life(package, prefix=(), script=LIFE, **variables):
    """Life and cache folder of a process with a copy of the package; None removes a variable."""
    chosen = {"PYTHONPATH": str(package), "NUMBA_DISABLE_JIT": "0", **variables}
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1", **chosen}
    done = subprocess.run(
        [*prefix, sys.executable, "-c", script],
        env={name: value for name, value in environment.items() if value is not None},
        cwd=package,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    cycles, folder = done.stdout.split("\n")[:2]
    return float(cycles), None if folder == "None" else Path(folder)


def at_once(*runs):
    """What runs started at the same time return."""
    with ThreadPoolExecutor() as threads:
        return [started.result() for started in [threads.submit(run) for run in runs]]


@pytest.fixture
def package(tmp_path):
    """Folder with a copy of the package."""
    source = Path(wearsim.__file__).parent
    folder = tmp_path / "copy"
    shutil.copytree(source, folder / "wearsim", ignore=shutil.ignore_patterns("__pycache__"))
    return folder


HELPER = """
from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import float64


@kernel(float64(float64))
def scaled(value):
    return 1.0 * value
"""


def edit(path, old, new):
    """Replace a text that stands in a file exactly once."""
    text = path.read_text(encoding="utf-8")
    assert text.count(old) == 1
    path.write_text(text.replace(old, new), encoding="utf-8")


@pytest.mark.slow
def test_edited_helper_changes_the_answer_and_cold_starts_share_the_cache(package, tmp_path):
    """Twice the depth per cycle is half the life; a helper is linked into its caller."""
    kernels, cache = package / "wearsim" / "kernels", str(tmp_path / "cache")
    (kernels / "scaled.py").write_text(HELPER, encoding="utf-8")
    source = kernels / "hertz_wear.py"
    edit(source, "depth[j] = factor\n", "depth[j] = scaled(factor)\n")
    edit(source, "import math\n", "import math\n\nfrom wearsim.kernels.scaled import scaled\n")
    run = partial(life, package, NUMBA_CACHE_DIR=cache)
    (before, folder), again = at_once(run, run)
    assert (before, folder) == again
    assert list(Path(cache).rglob("per_cycle_loop.run_cycles-*.o"))
    edit(kernels / "scaled.py", "1.0 * value", "2.0 * value")
    after, other = run()
    assert after == pytest.approx(before / 2.0, rel=0.005)
    assert folder.parent == other.parent == Path(cache)
    assert folder != other


@pytest.fixture
def read_only(package):
    """The package and an unwritable home, and what takes root's right to write anyway."""
    home = package.parent / "home"
    home.mkdir()
    folders = [home, package, *(path for path in package.rglob("*") if path.is_dir())]
    for folder in folders:
        folder.chmod(stat.S_IRUSR | stat.S_IXUSR)
    plain = "-dac_override,-dac_read_search"
    drop = ("setpriv", f"--bounding-set={plain}", f"--inh-caps={plain}") if not os.getuid() else ()
    unset = dict.fromkeys(("NUMBA_CACHE_DIR", "XDG_CACHE_HOME"))
    yield package, {**unset, "prefix": drop, "HOME": str(home)}
    for folder in folders:
        folder.chmod(stat.S_IRWXU)


NO_TEMPORARY_FOLDER = "import os, tempfile; tempfile.tempdir = os.environ['HOME']\n" + LIFE


@pytest.mark.slow
def test_read_only_install_runs_without_a_home(read_only, tmp_path):
    package, settings = read_only
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    (cycles, folder), (cycles_without, none) = at_once(
        partial(life, package, **settings, TMPDIR=str(temporary)),
        partial(life, package, script=NO_TEMPORARY_FOLDER, **{**settings, "NUMBA_CACHE_DIR": os.devnull}),
    )
    assert folder.parent == temporary / f"wearsim-{os.getuid()}"
    assert stat.S_IMODE(folder.parent.stat().st_mode) == 0o700
    assert none is None
    assert cycles == cycles_without


@pytest.fixture
def temporary(tmp_path, monkeypatch):
    """A temporary folder, with no other place to write."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setenv("NUMBA_CACHE_DIR", os.devnull)
    return tmp_path


def test_fallback_is_private(temporary):
    shared = temporary / f"wearsim-{os.getuid()}"
    assert cache_folder() == shared / f"numba-{source_hash()}"
    assert stat.S_IMODE(shared.stat().st_mode) == 0o700


@pytest.mark.parametrize("mode", [0o720, 0o702, 0o740, 0o704, 0o777])
def test_fallback_refuses_a_folder_open_to_others(temporary, mode):
    shared = temporary / f"wearsim-{os.getuid()}"
    shared.mkdir()
    shared.chmod(mode)
    assert cache_folder() is None


def test_fallback_refuses_a_link_and_a_file(temporary):
    shared = temporary / f"wearsim-{os.getuid()}"
    (temporary / "mine").mkdir(mode=0o700)
    shared.symlink_to(temporary / "mine")
    assert cache_folder() is None
    shared.unlink()
    shared.touch()
    assert cache_folder() is None


def test_fallback_refuses_the_folder_of_another_user(temporary, monkeypatch):
    stranger = os.getuid() + 1
    (temporary / f"wearsim-{stranger}").mkdir(mode=0o700)
    monkeypatch.setattr(os, "getuid", lambda: stranger)
    assert cache_folder() is None


def test_no_temporary_folder_at_all(temporary, monkeypatch):
    def none():
        raise FileNotFoundError

    monkeypatch.setattr(tempfile, "gettempdir", none)
    assert cache_folder() is None


def test_users_own_cache_folder_is_left_alone(tmp_path, monkeypatch):
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))
    doubled = kernel(float64(float64))(lambda value: 2.0 * value)
    assert doubled(21.0) == 42.0
    assert str(tmp_path) == numba.config.CACHE_DIR
    assert not list(tmp_path.iterdir())
    monkeypatch.setattr(object_code, "_NJIT", lambda *args, **kwargs: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        kernel(float64(float64))(lambda value: value)(1.0)
    assert str(tmp_path) == numba.config.CACHE_DIR


FRAMES = """
import sys
import numpy as np
from wearsim.kernels.flank_geometry import flank_frame

angle = np.linspace(0.0, 2.0, 37) ** 2
x, y = 50.0 * np.cos(angle) + 0.01 * np.sin(90.0 * angle), 49.0 * np.sin(angle)
quick, compiled = np.empty((2, 4, 37))
flank_frame(x, y, *quick)
assert "llvmlite" not in sys.modules
# Points that turn back on themselves have no circle: Python raises, compiled code goes on.
flank_frame(np.array([0.0, 1.0, 0.0]), np.zeros(3), *np.empty((4, 3)))
assert "llvmlite" in sys.modules
flank_frame(x, y, *compiled)
print(float(quick.tobytes() == compiled.tobytes()), None, sep="\\n")
"""


def test_quick_kernels_give_the_same_bits_before_machine_code_is_loaded():
    assert life(Path(wearsim.__file__).parents[1], script=FRAMES) == (1.0, None)


def test_hash_is_of_every_kernel_source_and_of_the_versions(package, monkeypatch):
    folders = package / "wearsim" / "jit", package / "wearsim" / "kernels"
    monkeypatch.setattr(compiled, "_HERE", folders[0])
    monkeypatch.setattr(compiled, "_KERNELS", folders[1])
    found = {source_hash()}
    sources = sorted(source for folder in folders for source in folder.glob("*.py"))
    assert len(sources) > 20
    for source in sources:
        source.write_text(source.read_text(encoding="utf-8") + "\n", encoding="utf-8")
        found.add(source_hash())
    monkeypatch.setattr("importlib.metadata.version", lambda name: "0")
    found.add(source_hash())
    assert len(found) == 2 + len(sources)
