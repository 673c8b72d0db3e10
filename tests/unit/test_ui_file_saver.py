"""Saving the page of ``wearsim ui`` under another name, its questions answered."""

import asyncio

import pytest

pytest.importorskip("nicegui", reason="nicegui is not installed")

from wearsim.page import file_saver as keeping
from wearsim.page.case_file import read_file

WINDOWS = b"\xef\xbb\xbfa = 1\r\nb = 2\r\n"


@pytest.fixture
def answers(monkeypatch):
    """What the user says: the name, and that a file that is there is replaced."""
    given = {"name": "b", "choice": "Replace it"}

    async def ask_name(name):
        return given["name"]

    async def choose(question, choices):
        return given["choice"]

    monkeypatch.setattr(keeping, "ask_name", ask_name)
    monkeypatch.setattr(keeping, "choose", choose)
    monkeypatch.setattr(keeping.ui, "notify", lambda *texts, **options: None)
    return given


@pytest.mark.parametrize("name", ["new", "taken", "a"])
def test_save_as_writes_what_save_does(tmp_path, answers, name):
    path = tmp_path / "a.toml"
    path.write_bytes(WINDOWS)
    (tmp_path / "taken.toml").write_bytes(b"x = 1\n")
    file = read_file(path)
    path.write_bytes(b"changed\n")
    keeper = keeping.FileSaver(file, lambda: file.text, lambda: None, lambda text: None, lambda: None)
    answers["name"] = name
    asyncio.run(keeper.save_as())
    assert (tmp_path / f"{name}.toml").read_bytes() == b"a = 1\r\nb = 2\r\n"
    assert keeper.file.path.name == f"{name}.toml"
    (tmp_path / f"{name}.toml").unlink()
    asyncio.run(keeper.save())
    assert (tmp_path / f"{name}.toml").read_bytes() == b"a = 1\r\nb = 2\r\n"
