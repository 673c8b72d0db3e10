"""No module needs another that needs it, also not within a function."""

import ast
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import wearsim

ROOT = Path(wearsim.__file__).parent


def name_of(path):
    parts = ("wearsim", *path.relative_to(ROOT).with_suffix("").parts)
    return ".".join(parts).removesuffix(".__init__")


MODULES = {name_of(path): path for path in ROOT.rglob("*.py")}


def imports_of(source):
    """Modules of wearsim that a text imports when it runs, wherever in it."""
    found = set()
    tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            node.body = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "relative imports are not followed"
            below = {f"{node.module}.{alias.name}" for alias in node.names}
            modules = below & MODULES.keys()
            found |= modules if modules == below else {*modules, node.module}
    return found & MODULES.keys()


def circle_of(graph):
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return error.args[1]
    return None


def test_no_circles():
    graph = {name: imports_of(path.read_text("utf-8")) - {name} for name, path in MODULES.items()}
    assert len(graph) > 100
    assert circle_of(graph) is None


def test_imports_are_found_everywhere():
    source = "if TYPE_CHECKING:\n import wearsim.errors\ndef f():\n from wearsim import extras, load_case\n"
    assert imports_of(source) == {"wearsim", "wearsim.extras"}
    assert circle_of({"a": {"b"}, "b": {"c"}, "c": {"a"}}) is not None
    assert circle_of({"a": {"b", "c"}, "b": {"c"}}) is None
