"""The bar of a Python session: what it shows in a notebook, on a terminal and nowhere."""

import sys
from types import SimpleNamespace

import pytest

import wearsim


class Screen:
    """What a notebook shows, the last of it last."""

    def __init__(self):
        self.shown = []

    def display(self, what, display_id):
        assert display_id
        self.shown.append(what)
        return SimpleNamespace(update=self.shown.append)


@pytest.fixture
def notebook(monkeypatch):
    screen = Screen()
    display = SimpleNamespace(HTML=str, display=screen.display)
    shell = SimpleNamespace(display=display, get_ipython=lambda: SimpleNamespace(kernel=True))
    monkeypatch.setitem(sys.modules, "IPython", shell)
    return screen


def test_a_notebook_shows_a_bar_and_then_nothing(notebook, capsys):
    with wearsim.progress_bar("a < b") as progress:
        progress(0.25)
        assert notebook.shown[-1] == 'a &lt; b <progress max="1" value="0.250"></progress>'
    assert notebook.shown[-1] == ""
    assert capsys.readouterr() == ("", "")


def test_a_terminal_shows_a_bar(monkeypatch, capsys):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setenv("FORCE_COLOR", "1")
    with wearsim.progress_bar("wearing") as progress:
        progress(0.5)
    assert "wearing" in capsys.readouterr().err


def test_a_file_shows_nothing(capsys):
    with wearsim.progress_bar("wearing") as progress:
        progress(0.5)
    assert capsys.readouterr() == ("", "")


def test_a_run_tells_the_bar(notebook):
    case = {
        "format_version": 1,
        "chain": {"designation": "16B-1"},
        "sprocket": {"teeth": 20, "profile": "evolute"},
        "load": {"tension_N": 2000, "speed_rpm": 100},
        "wear": {"condition": "hardened, oiled"},
    }
    with wearsim.progress_bar("cases") as progress:
        wearsim.sweep(case, {"load.speed_rpm": [50, 100]}, progress=progress)
        assert 'value="1.000"' in notebook.shown[-1]
