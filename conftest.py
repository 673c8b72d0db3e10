"""Modules of the page that need its library are not looked through for examples where it is missing."""

from importlib.util import find_spec
from pathlib import Path

_PAGE = Path(__file__).parent / "wearsim" / "page"

collect_ignore = [
    str(path)
    for path in sorted(_PAGE.glob("*.py"))
    if find_spec("nicegui") is None and "nicegui" in path.read_text(encoding="utf-8")
]
