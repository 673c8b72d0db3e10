"""Kernels in machine code: what they take, what they refuse, and what is done where there is a doubt.

Expected numbers are those of the same kernels in Python, or of a formula beside them.
"""

import ctypes
import itertools
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from wearsim.jit import compiled, machine_code
from wearsim.jit.compiled import Kernel, kernel, kernel_of
from wearsim.jit.machine_code import MachineCode, keep, kept
from wearsim.jit.object_code import object_code
from wearsim.jit.signatures import VECTOR, float64


def in_machine_code(name):
    """A kernel in machine code, made anew."""
    kernel = kernel_of(name)
    return kernel, MachineCode(kernel.name, kernel.signature, object_code(kernel))


@pytest.fixture(scope="module")
def between():
    return in_machine_code("controlled_steps.between")


def test_numbers_and_tables_come_as_they_are(between):
    kernel, code = between
    generator = np.random.default_rng(7)
    start, end = np.cumsum(generator.random((2, 8, 5)), axis=0)
    for row, part, point in ((0, 0.3, 4), (2, 0.7, 1), (1, np.float64(0.1), np.int64(3))):
        expected = kernel.function(start, end, 1.5, row, part, point)
        assert code(start, end, 1.5, row, part, point) == expected


def test_array_that_machine_code_would_misread_is_refused(between):
    _, code = between
    good = np.ones((8, 5))
    unwritable = good.copy()
    unwritable.flags.writeable = False
    for bad in (good.astype(np.float32), good.astype(np.int64), good[0], good[:, ::2], good.T, unwritable):
        with pytest.raises(TypeError, match=r"kernel controlled_steps\.between: an array must be of float64"):
            code(bad, good, 1.0, 0, 0.5, 0)


def test_numbers_of_another_kind_and_too_few_are_refused(between):
    _, code = between
    good = np.ones((8, 5))
    for bad in ((good, good, 1.0, 0.5, 0.5, 0), (good, good, 1.0), (good, good, "1", 0, 0.5, 0)):
        with pytest.raises((TypeError, ValueError, ctypes.ArgumentError)):
            code(*bad)


def test_kernel_that_another_one_calls_is_linked_in():
    """The normals of a circle of 50 mm point along its radii."""
    _, code = in_machine_code("flank_geometry.flank_frame")
    angle = np.linspace(0.1, 1.3, 200)
    x, y = 50.0 * np.cos(angle), 50.0 * np.sin(angle)
    normal_x, normal_y, curvature, arc = np.empty((4, 200))
    code(x, y, normal_x, normal_y, curvature, arc)
    assert np.abs(normal_x) == pytest.approx(np.cos(angle), abs=1e-4)
    assert np.abs(curvature) == pytest.approx(1.0 / 50.0, rel=1e-3)


def test_damaged_file_counts_as_none(tmp_path):
    path = tmp_path / "code.o"
    assert kept(path) is None
    keep(b"machine code", path)
    assert kept(path) == b"machine code"
    assert [one.name for one in tmp_path.iterdir()] == ["code.o"]
    content = path.read_bytes()
    for damaged in (content[:-1], content[1:], content.replace(b"code", b"c0de"), b""):
        path.write_bytes(damaged)
        assert kept(path) is None


NUMBERS = {
    "severity.severe_multiple": (2.0, 10.0),
    "severity.t_gamma_rate": (30.0,),
    "wrap_stage.area_of_work": (2.0, 0.1, 0.05, 3.0),
    "gear_pair.turned_by_depth": (0.1, 1.0, 2.0, 0.3, 0.4, 1.2, 0.7),
}
"""Kernels of one cache, and what they are called with."""


@pytest.fixture(scope="module")
def made():
    """Machine code of these kernels by their names."""
    return {name: object_code(kernel_of(name)) for name in NUMBERS}


@pytest.fixture
def cache(tmp_path, monkeypatch, made):
    """Kernels that nobody has called yet with their files in a full cache, and what shows each right."""
    monkeypatch.setattr(compiled, "_folder", lambda: tmp_path)
    # What stands for a compiler counts: a file that is not believed is made anew.
    monkeypatch.setattr("wearsim.jit.object_code.object_code", lambda one: made[one.name])
    for name, code in made.items():
        keep(code, Kernel(kernel_of(name).function, "", False).object_file)

    def right(name):
        known = kernel_of(name)
        again = Kernel(known.function, known.signature, False)
        answer = again(*NUMBERS[name])
        assert isinstance(again.compiled, MachineCode)
        assert answer == known.function(*NUMBERS[name])
        assert kept(again.object_file) == made[name]

    files = {name: tmp_path / f"{name}{machine_code.file_ending()}" for name in NUMBERS}
    return files, right


@pytest.mark.parametrize(("one", "other"), [*itertools.permutations(NUMBERS, 2)])
def test_files_that_are_swapped_are_compiled_anew(cache, one, other):
    files, right = cache
    files[other].write_bytes(files[one].read_bytes())
    assert kept(files[other]) is None
    right(one)
    right(other)


def test_file_of_other_sources_counts_as_none(tmp_path):
    """The folder says of which sources the code is."""
    for folder in ("new", "old"):
        (tmp_path / folder).mkdir()
    keep(b"machine code", tmp_path / "old" / "code.o")
    (tmp_path / "old" / "code.o").rename(tmp_path / "new" / "code.o")
    assert kept(tmp_path / "new" / "code.o") is None


def test_damaged_files_are_compiled_anew(cache):
    files, right = cache
    for name, file in files.items():
        whole = file.read_bytes()
        for place in (0, 31, 32, 40, len(whole) // 2, len(whole) - 1):
            file.write_bytes(whole[:place] + bytes([whole[place] ^ 1]) + whole[place + 1 :])
            right(name)
            file.write_bytes(whole[:place])
            right(name)


@pytest.mark.usefixtures("not_for_ever")
def test_pipe_and_device_in_place_of_a_file_are_not_waited_for(cache):
    files, right = cache
    for name, file in files.items():
        file.unlink()
        os.mkfifo(file)
        right(name)
        file.unlink()
        file.symlink_to("/dev/zero")
        right(name)


def test_large_file_in_place_of_machine_code_is_not_read(tmp_path, monkeypatch):
    keep(b"machine code", tmp_path / "code.o")
    os.truncate(tmp_path / "code.o", 3_000_000_000)
    monkeypatch.setattr(Path, "read_bytes", None)
    assert kept(tmp_path / "code.o") is None


def test_file_that_cannot_be_written_is_left_out(tmp_path):
    keep(b"machine code", tmp_path / "none" / "code.o")
    assert not list(tmp_path.iterdir())


def test_kernel_with_memory_of_its_own_is_left_to_numba():
    def doubled(values):
        own = np.empty(values.size)
        for j in range(values.size):
            own[j] = 2.0 * values[j]
        return own[1]

    made = kernel(float64(VECTOR))(doubled)
    assert object_code(made) == b""
    assert made(np.array([3.0, 21.0])) == 42.0


NUMBA_FIRST = """
from wearsim.jit.compiled import kernel_of
from wearsim.jit.object_code import numba_function, object_code
one = kernel_of("controlled_steps.between")
assert numba_function(one, None).overloads
print(len(object_code(one)))
"""


@pytest.mark.wide
def test_kernel_that_numba_has_compiled_in_full_before_is_linked_all_the_same():
    """In a process of its own: what numba compiles in full first depends on what ran before."""
    done = subprocess.run([sys.executable, "-c", NUMBA_FIRST], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) > 1000


def test_processes_without_the_libraries_of_c_leave_kernels_to_numba(monkeypatch, tmp_path):
    monkeypatch.setattr(compiled, "usable", lambda: False)
    known = kernel_of("controlled_steps.states_between")
    again = Kernel(known.function, known.signature, False)
    assert compiled.not_in_cache([again]) == []
    assert not isinstance(again.compiled, MachineCode)
    path, wanted = np.random.default_rng(3).random((4, 8, 5)).cumsum(axis=0), np.array([0.5, 2.25])
    here, there = np.zeros((2, 2, 8, 5))
    again(np.arange(4.0), path, wanted, here)
    known.function(np.arange(4.0), path, wanted, there)
    assert here.tobytes() == there.tobytes()


ENDING = "from wearsim.jit.machine_code import file_ending; print(file_ending(), end='')"


def ending(**variables):
    """Ending of the files of a process with some settings."""
    environment = {**os.environ, **variables}
    done = subprocess.run([sys.executable, "-c", ENDING], env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_settings_of_numba_have_files_of_their_own(tmp_path):
    assert ending() == ending(NUMBA_CACHE_DIR=str(tmp_path)) == machine_code.file_ending()
    assert len({ending(), ending(NUMBA_OPT="1"), ending(NUMBA_CPU_NAME="generic")}) == 3


def test_other_processor_has_files_of_its_own(monkeypatch):
    endings = {machine_code.file_ending.__wrapped__()}
    for name, value in (("get_host_cpu_name", "i486"), ("get_process_triple", "m68k-unknown-linux-gnu")):
        with monkeypatch.context() as patch:
            patch.setattr(f"llvmlite.binding.{name}", lambda value=value: value)
            endings.add(machine_code.file_ending.__wrapped__())
    with monkeypatch.context() as patch:
        patch.setattr(
            "llvmlite.binding.get_host_cpu_features", lambda: type("", (), {"flatten": lambda _: "-avx"})()
        )
        endings.add(machine_code.file_ending.__wrapped__())
    assert len(endings) == 4
