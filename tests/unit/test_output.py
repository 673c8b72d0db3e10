"""A place holds the old, the new or nothing."""

import hashlib
import os
import stat
import subprocess
import sys
import time

import pytest

from wearsim import __version__
from wearsim.errors import OutputError
from wearsim.files import check_free, new_file, new_folder, write_file


def tree(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


FILLED = ["run", "run/.wearsim", "run/history.csv"]


def fill(run, error=None, text="new"):
    with new_folder(run, force=True) as place:
        (place / "history.csv").write_text(text)
        if error:
            raise error


def test_new_folder_takes_its_name_when_complete(tmp_path):
    with new_folder(tmp_path / "a" / "run", force=False) as place:
        (place / "history.csv").write_text("new")
        assert not (tmp_path / "a" / "run").exists()
    assert tree(tmp_path) == ["a", "a/run", "a/run/.wearsim", "a/run/history.csv"]


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
@pytest.mark.parametrize("old", [True, False])
def test_failure_leaves_the_old_or_nothing(tmp_path, error, old):
    run = tmp_path / "run"
    if old:
        fill(run, text="old")
    expected = OutputError if isinstance(error, OSError) else KeyboardInterrupt
    with pytest.raises(expected):
        fill(run, error)
    assert tree(tmp_path) == (FILLED if old else [])
    assert not old or (run / "history.csv").read_text() == "old"


@pytest.mark.parametrize("error", [OSError(5, "Input/output error"), KeyboardInterrupt()])
def test_failure_of_the_last_rename_brings_the_old_back(tmp_path, monkeypatch, error):
    run = tmp_path / "run"
    fill(run, text="old")
    rename = os.rename

    def failing(source, target):
        if str(source).endswith("new"):
            raise error
        rename(source, target)

    monkeypatch.setattr(os, "rename", failing)
    with pytest.raises((OutputError, KeyboardInterrupt)):
        fill(run)
    assert tree(tmp_path) == FILLED
    assert (run / "history.csv").read_text() == "old"


def test_folder_in_the_way(tmp_path):
    with (
        pytest.raises(OutputError, match=r"must not exist yet, but does: .* or --force"),
        new_folder(tmp_path, force=False),
    ):
        pytest.fail("must not be entered")


def test_force_replaces_a_folder(tmp_path):
    run = tmp_path / "run"
    with new_folder(run, force=False) as place:
        (place / "inputs").mkdir()
        (place / "inputs" / "flank.csv").write_text("old")
    fill(run)
    assert tree(tmp_path) == FILLED


def test_force_does_not_replace_a_file(tmp_path):
    run = tmp_path / "run"
    run.write_text("old")
    with pytest.raises(OutputError, match="is a file"):
        fill(run)
    assert run.read_text() == "old"


def test_parent_is_a_file(tmp_path):
    (tmp_path / "file").write_text("x")
    with (
        pytest.raises(OutputError, match=r"must lie in a folder, but .*file is a file"),
        new_folder(tmp_path / "file" / "run", force=False),
    ):
        pytest.fail("must not be entered")
    with pytest.raises(OutputError, match=r"must lie in a folder, but .*file is a file"):
        write_file(tmp_path / "file" / "x.csv", "history.csv", force=False)
    assert tree(tmp_path) == ["file"]


def test_name_too_long(tmp_path):
    with pytest.raises(OutputError, match="File name too long"):
        check_free(tmp_path / ("history.csv" * 300), force=False)


def test_file_is_written_with_the_usual_rights(tmp_path):
    mask = os.umask(0o022)
    try:
        write_file(tmp_path / "a" / "x.csv", "é\n", force=False)
    finally:
        os.umask(mask)
    path = tmp_path / "a" / "x.csv"
    assert path.read_bytes() == "é\n".encode()
    assert stat.S_IMODE(path.stat().st_mode) == 0o644
    assert tree(tmp_path) == ["a", "a/x.csv"]


def test_file_in_the_way(tmp_path):
    path = tmp_path / "x.csv"
    path.write_text("old")
    with pytest.raises(OutputError, match="must not exist yet"):
        write_file(path, "new", force=False)
    assert path.read_text() == "old"
    write_file(path, "new", force=True)
    assert path.read_text() == "new"
    with pytest.raises(OutputError, match="must be a file"):
        write_file(tmp_path, "new", force=True)


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
def test_failed_file_leaves_the_old_one(tmp_path, monkeypatch, error):
    path = tmp_path / "x.csv"
    path.write_text("old")

    def failing(source, target):
        raise error

    monkeypatch.setattr(os, "replace", failing)
    with pytest.raises((OutputError, KeyboardInterrupt)):
        write_file(path, "new", force=True)
    assert tree(tmp_path) == ["x.csv"]
    assert path.read_text() == "old"


WRITER = """\
import sys
from pathlib import Path
from wearsim import files as output
rename = output.os.rename

def stuck(source, target):
    rename(source, target)
    if str(target).endswith("old"):
        print("ready", flush=True)
        sys.stdin.read()

output.os.rename = stuck
with output.new_folder(Path(sys.argv[1]), force=True) as place:
    (place / "history.csv").write_text("killed")
    if not Path(sys.argv[1]).exists():
        print("ready", flush=True)
        sys.stdin.read()
"""


@pytest.fixture
def writer():
    """Function that starts a process which stops in the middle of writing a folder."""
    started = []

    def start(run):
        pipe = subprocess.PIPE
        process = subprocess.Popen([sys.executable, "-c", WRITER, run], stdin=pipe, stdout=pipe)
        started.append(process)
        assert process.stdout.readline() == b"ready\n"
        return process

    yield start
    for process in started:
        process.kill()
        process.communicate()


def beside(path):
    """Return how the names begin of what is written beside a place."""
    return f".wearsim-{hashlib.sha256(path.name.encode()).hexdigest()[:12]}-"


@pytest.mark.parametrize("name", [".flank.csv.original", ".flank.csv.ab12cd_9", ".flank.csv.bak"])
def test_what_is_named_like_a_copy_is_of_the_user(tmp_path, name):
    mine = tmp_path / name
    mine.write_text("mine")
    os.utime(mine, (1e9, 1e9))
    write_file(tmp_path / "flank.csv", "all of it", force=True)
    assert mine.read_text() == "mine"


def test_pipe_beside_is_not_waited_for(tmp_path, not_for_ever):
    """Whoever may write into a folder can put one there."""
    folder = tmp_path / f"{beside(tmp_path / 'run')}ab12cd_9"
    folder.mkdir()
    for pipe in (tmp_path / f"{beside(tmp_path / 'flank.csv')}ab12cd_9", folder / "writer.lock"):
        os.mkfifo(pipe)
        os.utime(pipe, (1e9, 1e9))
    write_file(tmp_path / "flank.csv", "all of it", force=True)
    fill(tmp_path / "run")
    assert (tmp_path / "run" / "history.csv").exists()


def test_longest_name_of_a_file(tmp_path):
    path = tmp_path / f"{251 * 'f'}.csv"
    write_file(path, "all of it", force=False)
    assert list(tmp_path.iterdir()) == [path]


def test_marker_without_end_is_not_read(tmp_path):
    run = tmp_path / "run"
    fill(run)
    os.truncate(run / ".wearsim", 3_000_000_000)
    with pytest.raises(
        OutputError, match=r"\.wearsim: must be readable: it has 3e\+03 MB, 5 MB are the most"
    ):
        fill(run)


def test_what_a_killed_process_left_is_cleared_away(tmp_path, writer):
    """A living writer's folder and that of another place stay."""
    run, other = tmp_path / "run", tmp_path / "run.b"
    writer(run)
    for process in (writer(run), writer(other)):
        process.kill()
        process.communicate()
    assert len(list(tmp_path.glob(".wearsim-*"))) == 3
    fill(run)
    (living,), (of_other,) = (list(tmp_path.glob(f"{beside(path)}*")) for path in (run, other))
    assert (living / "new" / "history.csv").read_text() == "killed"
    assert (of_other / "new").is_dir()
    assert (run / "history.csv").read_text() == "new"


def test_result_that_a_killed_process_moved_aside_comes_back(tmp_path, writer):
    run = tmp_path / "run"
    fill(run)
    process = writer(run)
    assert not run.exists()
    process.kill()
    process.communicate()
    with pytest.raises(OutputError, match="must not exist yet"), new_folder(run, force=False):
        pass
    assert tree(tmp_path) == FILLED
    assert (run / "history.csv").read_text() == "new"


def test_marker_names_what_was_written(tmp_path):
    run = tmp_path / "run"
    with new_folder(run, force=False) as place:
        (place / "inputs").mkdir()
        (place / "inputs" / "a.csv").write_text("a")
        (place / "history.csv").write_text("new")
    head, *names = (run / ".wearsim").read_text().splitlines()
    assert head.startswith(f"written by wearsim {__version__}")
    assert names == ["history.csv", "inputs/a.csv"]


@pytest.mark.parametrize("name", ["notes.csv", "inputs/notes.csv", "result.json"])
def test_what_the_marker_does_not_name_is_kept(tmp_path, name):
    run = tmp_path / "run"
    fill(run, text="old")
    (run / "inputs").mkdir()
    (run / name).write_text("mine")
    with pytest.raises(OutputError, match=f"but holds {name}: move that away"):
        fill(run)
    assert (run / name).read_text() == "mine"
    assert (run / "history.csv").read_text() == "old"


@pytest.mark.parametrize("name", ["result.json", "index.html", "flank.csv"])
def test_folder_without_a_marker_is_not_replaced(tmp_path, name):
    run = tmp_path / "run"
    run.mkdir()
    (run / name).write_text("{}")
    with pytest.raises(OutputError, match=f"but holds {name}"):
        fill(run)


def test_what_a_killed_writer_left_beside_a_file_goes(tmp_path):
    """Also where the clock has been set back since."""
    ends = ("ab12cd_9", "ab12cd_7", "ab12cd_8", "bak")
    left, later, young, another = (tmp_path / f"{beside(tmp_path / 'flank.csv')}{end}" for end in ends)
    for path in (left, later, young, another):
        path.write_text("half of it")
    os.utime(left, (1e9, 1e9))
    os.utime(later, (time.time() + 3600.0,) * 2)
    os.utime(another, (1e9, 1e9))
    write_file(tmp_path / "flank.csv", "all of it", force=True)
    assert {path.name for path in tmp_path.iterdir()} == {"flank.csv", young.name, another.name}


def test_what_another_writer_still_writes_stays(tmp_path):
    path = tmp_path / "flank.csv"
    with new_file(path) as file:
        (beside,) = tmp_path.iterdir()
        os.utime(beside, (1e9, 1e9))
        file.write(b"first")
        write_file(path, "second", force=True)
        assert beside.exists()
    assert path.read_text() == "first"
    assert list(tmp_path.iterdir()) == [path]
