"""What the commands of calculations share: a CASE in; text, JSON or a folder out."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from wearsim._version import ANSWER_HEAD
from wearsim.command.complete import CasePath
from wearsim.command.options import (
    common_options,
    error_json,
    exit_code,
    overrides,
    print_json,
    show,
    show_error,
    warn,
)
from wearsim.errors import WearsimError

if TYPE_CHECKING:
    from wearsim.report.calculation_sheet import CalculationSheet

Compute = Callable[..., "CalculationSheet"]
Option = Callable[[Callable[..., Any]], Callable[..., Any]]


def calculation(name: str, short_help: str, *options: Option) -> Callable[[Compute], click.Command]:
    """Make a command of a function from a case and overrides to a sheet."""

    def _decorate(compute: Compute) -> click.Command:
        def _run(
            case: Path, out: Path | None, force: bool, as_json: bool, settings: tuple[str, ...], **own: object
        ) -> None:
            _show(partial(compute, **own), case, out, force, as_json, settings)

        _run.__doc__ = compute.__doc__
        command = common_options(overrides(_run))
        for option in (
            *options,
            click.option("--json", "as_json", is_flag=True, help="Print one JSON object."),
            click.option("--force", is_flag=True, help="Replace an existing folder."),
            click.option(
                "--out", type=click.Path(path_type=Path), help="New folder for tables and pictures."
            ),
            click.argument("case", type=CasePath(path_type=Path), metavar="CASE"),
        ):
            command = option(command)
        return click.command(name, short_help=short_help)(command)

    return _decorate


def _show(
    compute: Compute, case: Path, out: Path | None, force: bool, as_json: bool, settings: tuple[str, ...]
) -> None:
    if out is not None:
        from wearsim.files import check_folder

        check_folder(out, force)
    try:
        found = compute(case, settings)
    except WearsimError as error:
        if not as_json:
            raise
        click.echo(error_json(case.stem, error))
        show_error(error)
        raise click.exceptions.Exit(exit_code(error)) from None
    sheet = replace(found, content={**ANSWER_HEAD, "case": case.stem, **found.content})
    if out is not None:
        sheet.save(out, force)
    if as_json:
        print_json(sheet.content, case, sheet.warnings)
    else:
        show(sheet.text)
        for text in sheet.warnings:
            warn(f"{case}: warning: {text}")
    if out is not None:
        warn(f"written to {out}")
