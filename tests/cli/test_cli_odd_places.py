"""Files that are none, places that lead nowhere, and an environment that says nonsense."""

import json
import os
import shutil
from pathlib import Path

import pytest

from wearsim.command.options import BAD_INPUT

NO_FILE = "it is a pipe or a device, not a regular file"


@pytest.fixture
def pipe(tmp_path, not_for_ever):
    """Return a pipe that nobody writes to: to open it would wait for ever."""
    path = tmp_path / "pipe"
    os.mkfifo(path)
    return path


def refused(done, *words):
    assert done.code == BAD_INPUT
    assert done.out == ""
    for word in words:
        assert word in done.err


@pytest.mark.parametrize("command", ["check", "life", "loads"])
def test_pipe_and_device_are_no_case(cli, pipe, command):
    refused(cli(command, pipe), f"must be a readable file: {NO_FILE}")
    refused(cli(command, "/dev/zero"), f"must be a readable file: {NO_FILE}")


def test_pipe_is_no_picture(cli, drive, pipe, tmp_path):
    refused(
        cli("scan", pipe, "--case", drive(), "--out", tmp_path / "scan"),
        f"must be a picture, but cannot be opened ({NO_FILE})",
    )


@pytest.mark.parametrize("profile", ["points", "dxf"])
def test_pipe_is_no_flank(cli, drive, pipe, profile):
    place = pipe.rename(pipe.with_suffix(".dxf")) if profile == "dxf" else pipe
    path = drive()
    lines = [f'profile = "points"\npoints_file = "{place.name}"' if line.startswith("profile") else line
             for line in path.read_text("utf-8").splitlines()]  # fmt: skip
    path.write_text("\n".join(lines), "utf-8")
    refused(cli("check", path), "sprocket.points_file", NO_FILE)


def test_pipe_is_no_log_and_no_price_list(cli, pipe):
    refused(cli("remaining", "520-15t-wrap", pipe), NO_FILE)
    refused(cli("judge", pipe), NO_FILE)
    need = ("--power", 3, "--rpm", 120, "--ratio", 2, "--hours", 5000)
    refused(cli("select", *need, "--price", pipe), NO_FILE)


def test_case_of_gigabytes_is_not_read(cli, tmp_path):
    """A sparse file: it has no blocks on the disk."""
    path = tmp_path / "large.toml"
    with path.open("wb") as file:
        file.truncate(3_000_000_000)
    refused(cli("check", path), "it has 3e+03 MB, 2 MB are the most")


def test_lines_of_another_file_are_not_quoted(cli, drive, tmp_path):
    (tmp_path / "secret").write_text(
        "anna:x:0:0:words:/root:/bin/bash\nme:x:1:1::/home/me:/bin/sh\n", "utf-8"
    )
    (tmp_path / "points.csv").symlink_to("secret")
    path = drive()
    text = path.read_text("utf-8").replace('profile = "evolute"', 'profile = "points"')
    path.write_text(text.replace("[sprocket]", '[sprocket]\npoints_file = "points.csv"'), "utf-8")
    done = cli("check", path)
    refused(done, "points.csv:1: column 1 must be one of x_mm, y_mm: its head is no name")
    assert "anna" not in done.err
    assert "home" not in done.err


def test_links_in_a_loop_are_no_place(cli, drive, tmp_path):
    (tmp_path / "one").symlink_to("two")
    (tmp_path / "two").symlink_to("one")
    refused(cli("life", drive(), "--out", tmp_path / "one"), "must be reachable")
    refused(cli("report", drive(), "--out", tmp_path / "one" / "sheet.html"), "must be reachable")


def test_empty_folders_of_others_are_not_replaced(cli, drive, tmp_path):
    (tmp_path / "mine" / "to be filled").mkdir(parents=True)
    refused(cli("life", drive(), "--out", tmp_path / "mine", "--force"), "but holds to be filled")
    assert (tmp_path / "mine" / "to be filled").is_dir()


def test_whole_disk_is_not_walked(cli, drive, monkeypatch):
    seen = []
    walked = Path.rglob

    def watched(self, pattern):
        for path in walked(self, pattern):
            seen.append(path)
            yield path

    monkeypatch.setattr(Path, "rglob", watched)
    refused(cli("life", drive(), "--out", "/", "--force"), "move that away, or choose another place")
    assert len(seen) < 100


@pytest.mark.parametrize(
    ("name", "value"),
    [
        *(("NUMBA_NUM_THREADS", value) for value in ("many", "0", 5000 * "9")),
        *(("SOURCE_DATE_EPOCH", value) for value in ("yesterday", "253402300800")),
    ],
)
def test_variables_that_libraries_read(cli, drive, monkeypatch, name, value):
    monkeypatch.setenv(name, value)
    refused(cli("life", drive()), f"environment variable {name}: must be a whole number", "unset it")


def test_backend_of_windows_does_not_matter(cli, drive, tmp_path, monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "nonsense")
    done = cli("report", drive(), "--out", tmp_path / "sheet")
    assert (done.code, done.err) == (0, "")


@pytest.mark.parametrize("arguments", [("life", "16b-20t-oiled", "--out", "run"), ("doctor",)])
def test_working_folder_that_is_gone(cli, tmp_path, monkeypatch, arguments):
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    (tmp_path / "gone").rmdir()
    refused(cli(*arguments), "working folder: must exist, but is gone", "change to another folder")


def test_no_temporary_folder(cli, drive, tmp_path, monkeypatch):
    def none(*arguments, **names):
        raise FileNotFoundError(2, "No usable temporary directory found")

    monkeypatch.setattr("tempfile.TemporaryDirectory", none)
    done = cli("report", drive(nodes=21), "--out", tmp_path / "sheet.html")
    refused(done, "temporary folder: must be writable", "set TMPDIR to a folder")


def outside(tmp_path):
    """A case whose points lie beside its folder, not in it."""
    source = Path(__file__).parents[2] / "cases" / "beet-harvester-18t-soil.toml"
    folder = tmp_path / "drives"
    folder.mkdir()
    shutil.copy(source.with_suffix(".csv"), tmp_path / "flank.csv")
    text = source.read_text("utf-8").replace(f"{source.stem}.csv", "../flank.csv")
    (folder / "drive.toml").write_text(text, "utf-8")
    return folder / "drive.toml"


@pytest.mark.parametrize(
    "arguments",
    [
        ["life", "CASE"],
        ["check", "CASE"],
        ["profile", "CASE"],
        ["sweep", "STUDY", "--jobs", "2"],
        ["compare", "CASE", "CASE", "--set", "load.tension_N=1900"],
    ],
    ids=lambda arguments: arguments[0],
)
def test_files_outside_the_folder_of_a_case(cli, tmp_path, arguments):
    """Refused, unless that is allowed for this one command."""
    case = outside(tmp_path)
    study = tmp_path / "study.toml"
    study.write_text(
        'format_version = 1\ncase = "drives/drive.toml"\n[grid]\n"load.tension_N" = [1900, 2000]\n'
    )
    words = [{"CASE": str(case), "STUDY": str(study)}.get(word, word) for word in arguments]
    allowed = cli(*words, "--allow-outside")
    assert allowed.code == 0, allowed.err
    refused = cli(*words)
    assert refused.code == 2
    assert f"{case}:24: sprocket.points_file: must name a file in the folder" in refused.err


@pytest.fixture
def no_utf_8(drive):
    """Return the place of a case whose name holds a byte that is no UTF-8."""
    path = drive()
    return Path(shutil.copy(path, path.with_name(os.fsdecode(b"a\xffb.toml"))))


def test_name_that_is_no_utf_8_is_printable(cli, no_utf_8, tmp_path):
    run = tmp_path / "run"
    done = cli("life", no_utf_8, "--out", run)
    assert done.code == 0 and "a\ufffdb.toml" in done.out
    assert done.out.encode()
    assert json.loads((run / "result.json").read_text("utf-8"))["case"] == "a\ufffdb"
    assert cli("export", no_utf_8, "--out", tmp_path / "wheel.dxf").code == 0


def test_names_that_are_no_utf_8_tell_cases_apart(cli, drive, no_utf_8):
    done = cli("compare", no_utf_8, drive())
    assert done.code == 0 and "a\ufffdb.toml]" in done.out


def test_missing_file_whose_name_is_no_utf_8(cli):
    done = cli("life", os.fsdecode(b"none\xff.toml"), "--json")
    assert done.code == BAD_INPUT
    assert json.loads(done.out.encode())["case"] == "none\ufffd"


def test_text_that_is_no_utf_8_is_refused(cli, drive, tmp_path):
    for option in ("--project", "--set"):
        text = os.fsdecode(b"title=a\xff")
        done = cli("report", drive(), option, text, "--out", tmp_path / "sheet.html")
        refused(done, f"'{option}': must be UTF-8 text")
