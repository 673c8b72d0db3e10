"""What no file of wearsim does: run text as code, unpickle, or open a connection of its own."""

import ast
from pathlib import Path

import pytest

import wearsim

ROOT = Path(wearsim.__file__).parent
FILES = {path.relative_to(ROOT).as_posix(): path for path in sorted(ROOT.rglob("*.py"))}

CODE = {"eval", "exec", "compile", "__import__"}
PICKLES = {"pickle", "cPickle", "dill", "shelve", "marshal", "joblib"}
NETWORK = {"socket", "urllib.request", "http.client", "requests", "httpx", "ftplib", "smtplib", "aiohttp"}
CONNECTED = {
    "runner/workers.py": "the Dask scheduler that --scheduler names",
    "page/request_guard.py": "the page of ui, on 127.0.0.1",
    "page/server.py": "the same",
}
"""Files that hold a socket, and what it is for."""


def imported(tree):
    """Modules that a file imports, wherever it does."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield node.module


@pytest.mark.parametrize("file", FILES)
def test_file(file):
    tree = ast.parse(FILES[file].read_text("utf-8"))
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
    assert not CODE & {call.func.id for call in calls if isinstance(call.func, ast.Name)}
    modules = set(imported(tree))
    assert not PICKLES & modules
    assert file in CONNECTED or not NETWORK & modules
    for call in calls:
        for keyword in call.keywords:
            allowed = isinstance(keyword.value, ast.Constant) and keyword.value.value is False
            assert keyword.arg not in ("shell", "allow_pickle") or allowed, ast.unparse(call)
