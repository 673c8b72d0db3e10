"""Modules of the page that need its library are not looked through for examples where it is missing."""

from importlib.util import find_spec
from pathlib import Path

_UI = Path(__file__).parent / "wearsim" / "ui"

collect_ignore = [
    str(path)
    for path in sorted(_UI.glob("*.py"))
    if find_spec("nicegui") is None and "nicegui" in path.read_text(encoding="utf-8")
]
