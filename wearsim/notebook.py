"""What a Python session shows of an object: one line of text, and a table or a picture in a notebook."""

import sys
from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

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


def html_rows(title: str, rows: Iterable[tuple[str, str | Sequence[str]]]) -> str:
    """Return a title and labelled text as HTML; of several texts their number, which opens to all of them.

    Examples
    --------
    >>> html_rows("A & B", [("Life", "> 5 h"), ("Warnings", [])]).count("&gt; 5 h")
    1
    """
    lines = "".join(
        f'<tr><th style="{_STYLE}">{escape(label)}</th><td style="{_STYLE}">{_shown(text)}</td></tr>'
        for label, text in rows
        if text
    )
    return f"<strong>{escape(title)}</strong><table>{lines}</table>"


def _shown(text: str | Sequence[str]) -> str:
    if isinstance(text, str):
        return escape(text)
    if len(text) == 1:
        return escape(text[0])
    return f"<details><summary>{len(text)}</summary>{'<br>'.join(map(escape, text))}</details>"


_drawn: list[object] = []
"""The picture that the cell which runs has drawn last."""


def show_after_semicolon(picture: object) -> None:
    """Have a notebook show a picture although the cell ends with a semicolon, as it shows those of pyplot.

    The last picture of a cell is shown; without the semicolon the notebook shows what the cell returns.
    """
    shell = sys.modules.get("IPython")
    session: Any = shell and shell.get_ipython()
    if not hasattr(session, "kernel"):
        return
    if not _drawn:
        session.events.register("post_run_cell", _show_drawn)
    _drawn[:] = [picture]


def _show_drawn(ended: Any) -> None:
    shell = sys.modules["IPython"]
    session = shell.get_ipython()
    session.events.unregister("post_run_cell", _show_drawn)
    picture = _drawn.pop()
    if ended.success and session.displayhook.quiet():
        shell.display.display(picture)
