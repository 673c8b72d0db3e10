"""What an engineer knows of a drive, as options of a command and as questions on a terminal."""

from collections.abc import Callable
from typing import Any

import click

from wearsim.command.complete import complete_chain
from wearsim.drive.known_drive import KNOWN, Known, Values, read_known
from wearsim.errors import CaseError


def drive_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add an option for everything that may be known of a drive."""
    for known in reversed(KNOWN):
        add = click.option(
            known.option,
            metavar=known.metavar,
            help=known.help,
            shell_complete=complete_chain if known.option == "--chain" else _completing(known.words),
        )
        function = add(function)
    return function


def _completing(words: tuple[str, ...]) -> Callable[..., list[str]]:
    return lambda context, parameter, incomplete: [word for word in words if word.startswith(incomplete)]


def ask_for_drive() -> str:
    """Ask for everything one by one, and again for what does not fit; return the text of the drive."""
    from wearsim.drive.drive_start import start_text

    typed: dict[str, str | None] = {}
    questions = [known for known in KNOWN if known.asked]
    while True:
        for known in questions:
            typed[known.name] = _answer(known, read_known(typed)[0])
        try:
            return start_text(typed)
        except CaseError as error:
            wrong = {fault.file for fault in error.faults}
            questions = [known for known in KNOWN if known.asked and known.option in wrong]
            if not questions:
                raise
            click.echo(str(error), err=True)


def _answer(known: Known, values: Values) -> str:
    def _checked(text: str) -> str:
        try:
            known.read(text)
        except ValueError as error:
            raise click.UsageError(str(error)) from None
        return text

    default = known.default(values)
    return str(click.prompt(known.what, default=default, value_proc=_checked, show_default=bool(default)))
