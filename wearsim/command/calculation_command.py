"""What the commands of calculations share: a CASE in; text, JSON or a folder out."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from wearsim._version import ANSWER_HEAD
from wearsim.command.answered import Shown, shown_options
from wearsim.command.complete import CasePath
from wearsim.command.options import common_options, print_json, settings_option, show, warn

if TYPE_CHECKING:
    from wearsim.report.calculation_sheet import CalculationSheet

Compute = Callable[..., "CalculationSheet"]
Option = Callable[[Callable[..., Any]], Callable[..., Any]]


def calculation(name: str, short_help: str, *options: Option) -> Callable[[Compute], click.Command]:
    """Make a command of a function from a case and overrides to a sheet."""

    def _decorate(compute: Compute) -> click.Command:
        def _run(case: Path, shown: Shown, settings: tuple[str, ...], **own: object) -> None:
            shown.check()
            with shown.failing(case.stem):
                found = compute(case, settings, **own)
            _show(replace(found, content={**ANSWER_HEAD, "case": case.stem, **found.content}), case, shown)

        _run.__doc__ = compute.__doc__
        command: Callable[..., Any] = common_options(settings_option(_run))
        # Those of the calculation stand after those that all have.
        argument = click.argument("case", type=CasePath(path_type=Path), metavar="CASE")
        for option in (*options, shown_options("tables and pictures"), argument):
            command = option(command)
        return click.command(name, short_help=short_help)(command)

    return _decorate


def _show(sheet: "CalculationSheet", case: Path, shown: Shown) -> None:
    if shown.out is not None:
        sheet.save(shown.out, shown.force)
    if shown.as_json:
        print_json(sheet.content, case, sheet.warnings)
    else:
        show(sheet.words(shown.explain))
        for text in sheet.warnings:
            warn(f"{case}: warning: {text}")
    if shown.out is not None:
        warn(f"written to {shown.out}")
