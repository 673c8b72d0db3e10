"""No module needs another that needs it, also not within a function."""

import runpy
from pathlib import Path

HOUSE = runpy.run_path(str(Path(__file__).parents[2] / ".ci" / "house.py"))
MODULES, imports_of, circles = (HOUSE[name] for name in ("MODULES", "imports_of", "circles"))


def test_no_circles():
    graph = {name: imports_of(path.read_text("utf-8")) - {name} for name, path in MODULES.items()}
    assert len(graph) > 100
    assert circles(graph) == []


def test_imports_are_found_everywhere():
    source = "if TYPE_CHECKING:\n import wearsim.errors\ndef f():\n from wearsim import extras, load_case\n"
    assert imports_of(source) == {"wearsim", "wearsim.extras"}
    assert imports_of(source, for_types=True) == {"wearsim", "wearsim.extras", "wearsim.errors"}


def test_circles_are_found():
    assert circles({"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}}) == [("a", "b", "c")]
    assert circles({"a": {"b", "c"}, "b": {"c"}, "c": set()}) == []
