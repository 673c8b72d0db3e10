"""What a terminal shows in colour; click leaves colours off everywhere else."""

import os
import re

import click

_OUTSIDE = re.compile(r"\bOUTSIDE\b|\bOVERLOADED\b|(?<=^  )Overloaded:", re.MULTILINE)
_WARNING = re.compile(r"(?<=^  )(?:Warnings(?! +none$)|warning(?=  ))|\bwarning:", re.MULTILINE)


def uses_colour() -> bool | None:
    """Return that no colour is wanted by the environment; None leaves it to whether there is a terminal.

    https://no-color.org: any text but none in ``NO_COLOR``.
    """
    unwanted = os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb"
    return False if unwanted else None


def coloured(text: str) -> str:
    r"""Return a text whose warnings and what is outside of its limits stand out.

    Examples
    --------
    >>> coloured("70.85 <= 32.67 MPa OUTSIDE")
    '70.85 <= 32.67 MPa \x1b[31m\x1b[1mOUTSIDE\x1b[0m'
    >>> coloured("  Warnings   none"), coloured("not outside")
    ('  Warnings   none', 'not outside')
    """
    text = _OUTSIDE.sub(lambda found: click.style(found[0], fg="red", bold=True), text)
    return _WARNING.sub(lambda found: click.style(found[0], fg="yellow", bold=True), text)


def show(text: str) -> None:
    """Print an answer on stdout."""
    click.echo(coloured(text))
