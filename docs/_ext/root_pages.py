"""Pages of the checkout's root, such as CHANGELOG.md, included on the site: their links point from there."""

import re
from pathlib import Path

from sphinx.application import Sphinx

_LINK = re.compile(r"\[([^\]\[]+)\]\((?!https?:|#)([^)]+)\)")


def _seen_from_docs(link: re.Match[str]) -> str:
    """A page of docs is a link still; of any other file only the name is left."""
    text, target = link.groups()
    return f"[{text}]({target.removeprefix('docs/')})" if target.startswith("docs/") else f"`{target}`"


def _rewrite(app: Sphinx, path: Path, page: str, content: list[str]) -> None:
    if path.parts[0] == "..":
        content[0] = _LINK.sub(_seen_from_docs, content[0])


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the rewriting."""
    app.connect("include-read", _rewrite)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
