"""A bar for the progress of a run: in a notebook, or on a terminal."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from html import escape
from typing import Any


@contextmanager
def progress_bar(text: str = "") -> Iterator[Callable[[float], None]]:
    """Show how much of a run is done, for the argument ``progress`` of all functions that run something.

    Parameters
    ----------
    text : str
        What is under way.

    Yields
    ------
    callable
        Takes the part that is done, from 0 to 1. Where there is neither a notebook nor a terminal it
        shows nothing.

    Examples
    --------
    >>> import wearsim
    >>> with wearsim.progress_bar("wearing") as progress:
    ...     progress(0.5)
    """
    notebook = _notebook()
    if notebook is not None:
        yield from _in_notebook(notebook, text)
    elif sys.stderr.isatty():
        yield from _on_terminal(text)
    else:
        yield lambda part: None


def _notebook() -> Any:
    """Return IPython's ways to show something where this runs in a notebook."""
    shell = sys.modules.get("IPython")
    if shell is None or not hasattr(shell.get_ipython(), "kernel"):
        return None
    from IPython import display

    return display


def _in_notebook(display: Any, text: str) -> Iterator[Callable[[float], None]]:
    def bar(part: float) -> Any:
        return display.HTML(f'{escape(text)} <progress max="1" value="{part:.3f}"></progress>')

    shown = display.display(bar(0.0), display_id=True)
    yield lambda part: shown.update(bar(part))
    shown.update(display.HTML(""))


def _on_terminal(text: str) -> Iterator[Callable[[float], None]]:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    columns = TextColumn("{task.description}", markup=False), BarColumn(), TimeRemainingColumn()
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(text, total=1.0)
        yield lambda part: bar.update(task, completed=part)
