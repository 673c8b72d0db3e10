"""What a Python session shows of an object: one line of text, and a table in a notebook."""

from collections.abc import Iterable
from html import escape

_LONGEST, _TITLE = 200, 90
"""Letters of one line, and of the title in it."""

_STYLE = "text-align: left; vertical-align: top"


def one_line(kind: str, title: str, *texts: str) -> str:
    """Return an object in one line, cut where it is long.

    Examples
    --------
    >>> one_line("Case", "Hoist", "20 teeth")
    '<Case: Hoist; 20 teeth>'
    """
    text = "; ".join(filter(None, (_cut(title, _TITLE), *texts)))
    return f"<{kind}: {_cut(text, _LONGEST)}>"


def _cut(text: str, longest: int) -> str:
    text = " ".join(text.split())
    return text if len(text) <= longest else f"{text[: longest - 3]}..."


def html_rows(title: str, rows: Iterable[tuple[str, str]]) -> str:
    """Return a title and labelled lines of text as HTML.

    Examples
    --------
    >>> html_rows("A & B", [("Life", "> 5 h")]).count("&gt; 5 h")
    1
    """
    lines = "".join(
        f'<tr><th style="{_STYLE}">{escape(label)}</th><td style="{_STYLE}">{escape(text)}</td></tr>'
        for label, text in rows
        if text
    )
    return f"<strong>{escape(title)}</strong><table>{lines}</table>"
