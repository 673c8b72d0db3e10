"""Pictures in a notebook: shown once, with and without a semicolon."""

import sys
from types import SimpleNamespace

import pytest

from wearsim.notebook import show_after_semicolon

DRAW = "from matplotlib.figure import Figure\nfrom wearsim.report.result_pictures import shown\n"


@pytest.mark.parametrize(
    ("quiet", "success", "expected"), [(True, True, [2]), (False, True, []), (True, False, [])]
)
def test_last_picture_of_a_cell_that_returns_nothing_is_shown(monkeypatch, quiet, success, expected):
    hooks, pictures = [], []
    events = SimpleNamespace(
        register=lambda _, hook: hooks.append(hook), unregister=lambda _, hook: hooks.remove(hook)
    )
    session = SimpleNamespace(kernel=True, events=events, displayhook=SimpleNamespace(quiet=lambda: quiet))
    shell = SimpleNamespace(get_ipython=lambda: session, display=SimpleNamespace(display=pictures.append))
    monkeypatch.setitem(sys.modules, "IPython", shell)
    for picture in (1, 2):
        show_after_semicolon(picture)
    for hook in hooks:
        hook(SimpleNamespace(success=success))
    assert (pictures, hooks) == (expected, [])


@pytest.fixture
def cell(monkeypatch):
    """Function that runs a cell in a real IPython and returns how many pictures it shows."""
    pytest.importorskip("IPython", reason="IPython is not installed")
    from IPython.core.interactiveshell import InteractiveShell

    shell = InteractiveShell()
    shell.kernel = object()
    pictures = []
    monkeypatch.setattr("IPython.get_ipython", lambda: shell)
    monkeypatch.setattr("IPython.display.display", pictures.append)
    monkeypatch.setattr(shell.displayhook, "write_format_data", lambda *_: pictures.append("returned"))

    def run(code):
        pictures.clear()
        assert shell.run_cell(DRAW + code, store_history=True).success
        return len(pictures)

    return run


@pytest.mark.parametrize(
    ("code", "shows"),
    [
        ("shown(Figure())", 1),
        ("shown(Figure());", 1),
        ("shown(Figure()); shown(Figure());", 1),
        ("figure = shown(Figure())", 0),
        ("1 + 1;", 0),
    ],
)
def test_ipython_shows_a_picture_once(cell, code, shows):
    assert cell(code) == shows
    assert cell("None") == 0
