"""A case on standard input."""

import io
import sys

import pytest

from wearsim.input.document import stdin_bytes


@pytest.fixture
def typed(monkeypatch):
    """Function that puts a text on standard input."""

    def put(text):
        stdin_bytes.cache_clear()
        monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(text.encode())))

    yield put
    stdin_bytes.cache_clear()


@pytest.mark.parametrize("command", ["life", "check", "loads"])
def test_case_on_stdin(cli, drive, typed, command):
    path = drive("case")
    typed(path.read_text())
    found, expected = (cli(command, one, "--json") for one in ("-", path))
    assert (found.code, found.out) == (expected.code, expected.out)


@pytest.mark.wide
def test_case_and_stdin_side_by_side(cli, drive, typed, tmp_path):
    typed(drive(teeth=25).read_text())
    assert cli("compare", "-", drive(), "--out", tmp_path / "out").code == 0


def test_fault_on_stdin(cli, drive, typed):
    typed(drive(teeth="'x'").read_text())
    done = cli("life", "-")
    assert done.code == 2
    assert done.err.startswith("-:6: sprocket.teeth: ")
