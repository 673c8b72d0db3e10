"""``wearsim ui``: what is refused before a page is served; tests/browser has the rest."""

import importlib.util
import io
import socket
import sys
from pathlib import Path

import pytest

from wearsim.cli.ui import _Opened
from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_drive
from wearsim.drive.simulate import simulate
from wearsim.input.document import CaseText, stdin_bytes
from wearsim.page import request_guard as listener
from wearsim.page.answers import answer_to
from wearsim.page.case_file import read_file
from wearsim.page.edited_input import EditedInput

FOUND = importlib.util.find_spec("click")


@pytest.fixture
def installed(monkeypatch):
    """Pretend that the extra is installed, and fail where it would be loaded."""
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: FOUND)
    monkeypatch.setattr(listener, "loopback_socket", lambda port: pytest.fail("served"))


@pytest.mark.parametrize("missing", ["nicegui", "plotly", "jinja2"])
def test_missing_extra(cli, monkeypatch, drive, missing):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == missing else FOUND)
    done = cli("ui", drive())
    assert (done.code, done.out) == (2, "")
    assert "pip install 'wearsim[ui]'" in done.err and missing in done.err


def test_file_that_is_not_there(cli, installed, tmp_path):
    done = cli("ui", tmp_path / "none.toml")
    assert done.code == 2
    assert "none.toml: must be a readable file" in done.err


@pytest.mark.parametrize("setting", ["power", "=3", "load..x=3"])
def test_setting_of_no_key(cli, installed, drive, setting):
    done = cli("ui", drive(), "--set", setting)
    assert done.code == 2
    assert f"--set {setting}: must have the form table.key=VALUE" in done.err


def test_setting_of_what_is_no_toml(cli, installed, tmp_path):
    (tmp_path / "a.toml").write_text("[")
    done = cli("ui", tmp_path / "a.toml", "--set", "load.power_kW=3")
    assert done.code == 2 and "must be valid TOML" in done.err


def test_port_that_is_taken(cli, monkeypatch, drive):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: FOUND)
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        done = cli("ui", drive(), "--port", port)
    assert (done.code, done.out) == (2, "")
    assert f"--port {port}: must be free" in done.err


@pytest.mark.parametrize("port", ["-1", "65536", "x"])
def test_port_that_is_none(cli, port):
    assert cli("ui", "--port", port).code == 2


def test_there_is_no_other_address(cli):
    assert "--host" not in cli("ui", "--help").out
    assert cli("ui", "--host", "192.0.2.1").code == 2


def test_help_names_the_extra(cli):
    done = cli("ui", "--help")
    assert done.code == 0 and "wearsim[ui]" in done.out


def test_a_page_begins_with_what_is_typed_or_with_a_shipped_case(monkeypatch):
    """Neither is a file that the page could write over."""
    stdin_bytes.cache_clear()
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(b"title = 'typed'\n")))
    file, text = _Opened(Path("-"), ())()
    stdin_bytes.cache_clear()
    assert (file.path, file.content, text) == (Path("drive.toml"), None, "title = 'typed'\n")
    file, text = _Opened(Path("16b-20t-oiled"), ())()
    assert (file.path, file.content) == (Path("16b-20t-oiled.toml"), None)
    assert 'designation = "16B-1"' in text


def test_the_first_drive_is_within_its_ratings_and_needs_no_warning():
    """On coarse flanks, as neither depends on them."""
    file, text = _Opened(None, ())()
    coarse = ["mechanism.phases=2", "run.life_tolerance=0.1", "sprocket.1.nodes=51", "sprocket.2.nodes=51"]
    found = drive_life(load_drive(CaseText(file.path, text), coarse))
    assert found.overloaded == () and found.doubts == () and found.reference.ratings
    assert all(rating.ok for rating in found.reference.ratings)


@pytest.mark.parametrize("kind", ["drive", "sprocket"])
def test_sheet_is_the_file_of_the_report_command(cli, drive, two_sprockets, tmp_path, kind):
    path, out = drive(), tmp_path / "out"
    arguments = ["--single-file"] if kind == "sprocket" else []
    if kind == "drive":
        path.write_text(two_sprockets)
    edited = EditedInput(CaseText(path, path.read_text()), read_file(path), lambda: False, print)
    answer = answer_to(edited)
    sheet = answer.sheet(simulate(answer.drive if kind == "drive" else answer.case))
    assert cli("report", path, "--out", out, *arguments).code == 0
    assert sheet == (out / "index.html").read_text(encoding="utf-8")
