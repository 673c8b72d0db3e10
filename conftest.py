"""Modules of the page are looked through for examples where they have some and its library is not missed."""

from importlib.util import find_spec
from pathlib import Path


def _looked_through(path: Path) -> bool:
    text = path.read_text(encoding="utf-8")
    return ">>> " in text and (find_spec("nicegui") is not None or "nicegui" not in text)


_PAGE = Path(__file__).parent / "wearsim" / "page"

collect_ignore = [str(path) for path in sorted(_PAGE.glob("*.py")) if not _looked_through(path)]
