"""What commands share: options, exit codes and the form of a failed case."""

import json
import logging
import math
import os
import re
import sys
import traceback
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, cast, overload

import click
from click.core import ParameterSource

from wearsim.command.complete import complete_setting
from wearsim.errors import CaseError, Fault, GeometryError, OutputError, WearsimError
from wearsim.input.named_files import allow_outside, printable

if TYPE_CHECKING:
    from wearsim.case.model import Case
    from wearsim.drive.drive_case import DriveCase
    from wearsim.drive.drive_result import DriveLife
    from wearsim.result import WearResult


Function = TypeVar("Function", bound=Callable[..., Any])

BAD_INPUT, FAILED, NOT_MET, SOME_FAILED = 2, 3, 4, 5


def common_options(function: Function) -> Function:
    """Add ``-q`` and ``--debug``, which every command takes."""

    def _quiet(context: click.Context, parameter: click.Parameter, value: bool) -> None:
        if value:
            context.find_root().meta["wearsim.quiet"] = True

    function = click.option(
        "-q",
        "--quiet",
        is_flag=True,
        expose_value=False,
        callback=_quiet,
        help="Print no warnings and no progress on stderr.",
    )(function)
    return click.option("--debug", is_flag=True, expose_value=False, help="Show the traceback of an error.")(
        _with_whole_texts(function)
    )


def _with_whole_texts(function: Function) -> Function:
    """Have a command refuse texts on its line that are no UTF-8, which no page and no drawing can hold."""

    @wraps(function)
    def _checked(*arguments: Any, **values: Any) -> Any:
        context = click.get_current_context()
        for parameter in given_parameters(context):
            value = context.params.get(parameter.name or "")
            texts = value if isinstance(value, tuple) else (value,)
            if any(isinstance(text, str) and text != printable(text) for text in texts):
                raise click.BadParameter("must be UTF-8 text, but is not: type it anew", context, parameter)
        return function(*arguments, **values)

    return cast("Function", _checked)


def overrides(function: Function) -> Function:
    """Add ``--set`` and ``--allow-outside``, which every command takes whose CASE may name files."""
    return settings_option(outside_option(function))


def outside_option(function: Function) -> Function:
    """Add ``--allow-outside``, with which a command also reads files outside the folder of its case."""

    def _allow(context: click.Context, parameter: click.Parameter, allowed: bool) -> None:
        if allowed:
            context.with_resource(allow_outside())

    return click.option(
        "--allow-outside",
        is_flag=True,
        expose_value=False,
        callback=_allow,
        help="Read files that the case names also where they lie outside its folder.",
    )(function)


def settings_option(function: Function) -> Function:
    """Add ``--set``, which gives the command ``settings``: keys of the case with their values."""
    return click.option(
        "--set",
        "settings",
        multiple=True,
        metavar="TABLE.KEY=VALUE",
        shell_complete=complete_setting,
        help="Set a key of the case; VALUE is TOML, or else plain text. Repeatable.",
    )(function)


def keeping_runs(function: Function) -> Function:
    """Add ``--fresh`` to a command that runs cases, whose runs are kept for the next one."""

    def _keep(context: click.Context, parameter: click.Parameter, fresh: bool) -> None:
        if fresh or context.resilient_parsing:
            return
        from wearsim.result.kept_runs import keep_runs, runs_folder

        keep_runs(runs_folder())
        context.call_on_close(lambda: keep_runs(None))

    return click.option(
        "--fresh",
        is_flag=True,
        expose_value=False,
        callback=_keep,
        help="Run every case anew, even if an earlier command has run the same.",
    )(function)


def sprocket_option(function: Function) -> Function:
    """Add ``--sprocket``, for commands that are about one sprocket."""
    return click.option("--sprocket", metavar="NAME", help="Name of the sprocket, if the CASE has several.")(
        function
    )


def explain_option(function: Function) -> Function:
    """Add ``--explain`` to a command whose answer rests on assumptions."""
    return click.option(
        "--explain", is_flag=True, help="Print every assumption and default instead of their number."
    )(function)


def given_parameters(context: click.Context) -> list[click.Parameter]:
    """Return what is on the command line, not what is left to its default."""
    by_hand = ParameterSource.COMMANDLINE
    return [one for one in context.command.params if context.get_parameter_source(one.name or "") is by_hand]


def warn(text: str) -> None:
    """Print a note on stderr unless ``-q`` was given."""
    if not click.get_current_context().find_root().meta.get("wearsim.quiet"):
        click.echo(coloured(printable(text)), err=True)


@contextmanager
def working(text: str) -> Iterator[Callable[[float], None]]:
    """Show on a terminal's stderr that something is under way, and the time left once that is known.

    What it is going to call is compiled before, which has a bar of its own.
    """
    from wearsim.jit.compiled import compile_expected

    compile_expected()
    if click.get_current_context().find_root().meta.get("wearsim.quiet"):
        yield lambda part: None
        return
    with _announced_times(), _bar(text) as report_progress:
        yield report_progress


@contextmanager
def _announced_times() -> Iterator[None]:
    """Print on stderr how long a run will take, where it says so before it begins."""
    log, handler = logging.getLogger("wearsim"), _Announced()
    level = log.level
    log.setLevel(logging.INFO)
    log.addHandler(handler)
    try:
        yield
    finally:
        log.removeHandler(handler)
        log.setLevel(level)


class _Announced(logging.Handler):
    """What the parts of wearsim log, above the bar."""

    def emit(self, record: logging.LogRecord) -> None:
        """Print a line; a bar takes sys.stderr over while it shows, which click would pass by."""
        print(record.getMessage(), file=sys.stderr)


@contextmanager
def _bar(text: str) -> Iterator[Callable[[float], None]]:
    """Show a bar on a terminal's stderr."""
    if not sys.stderr.isatty():
        yield lambda part: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeRemainingColumn

    columns = (
        SpinnerColumn(),
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(text, total=None)
        yield lambda part: bar.update(task, completed=part, total=1.0)


@overload
def worn(case: "Case") -> "WearResult": ...


@overload
def worn(case: "Case | DriveCase") -> "WearResult | DriveLife": ...


def worn(case: "Case | DriveCase") -> "WearResult | DriveLife":
    """Run a case and show on a terminal how far it is."""
    from wearsim.drive.simulate import simulate

    with working(f"wearing {case.title}") as report_progress:
        return simulate(case, report_progress)


def answer_text(result: "WearResult | DriveLife", source: str, explain: bool = False) -> str:
    """Return the answer to a case as it is printed, on request with all that it rests on."""
    from wearsim.result import WearResult

    if isinstance(result, WearResult):
        from wearsim.report.answer import answer

        return answer(result, source, explain)
    from wearsim.report.drive.drive_text import drive_text

    return drive_text(result, source, explain)


def print_json(content: Mapping[str, Any], source: Path, warnings: Iterable[str] = ()) -> None:
    """Print an object on one line of stdout, and warnings on stderr."""
    click.echo(printable(json.dumps(content, ensure_ascii=False, allow_nan=False)))
    for text in warnings:
        warn(f"{source}: warning: {text}")


def show_error(error: WearsimError, path: Path | None = None) -> None:
    """Print an error on stderr, with its traceback if ``--debug`` was given."""
    if "--debug" in sys.argv:
        traceback.print_exception(error)
    else:
        click.echo(printable(f"{path}: {error}" if path else str(error)), err=True)


def show_failed_parts(results: "Mapping[Path, WearResult | DriveLife]") -> bool:
    """Show what the runs of single sprockets of drives have failed with; whether there are any."""
    errors = [
        (path, f"{name!r}: {error}")
        for path, result in results.items()
        for name, error in result.failed.items()
    ]
    for path, text in errors:
        show_error(WearsimError(text), path)
    return bool(errors)


def exit_code(error: WearsimError) -> int:
    """Return the exit code of an error."""
    return BAD_INPUT if isinstance(error, CaseError | OutputError) else FAILED


def error_json(case: str, error: WearsimError) -> str:
    """Return a failed case as one line of JSON."""
    first = error.faults[0] if isinstance(error, CaseError) else Fault(str(error))
    file, _, override = first.file.partition("--set ")
    content = {
        "kind": type(error).__name__,
        "message": str(error),
        "file": file or None,
        "line": first.line or None,
        "key": first.key or override or None,
    }
    return printable(json.dumps({"schema_version": 1, "case": case, "error": content}, ensure_ascii=False))


def load_cases(paths: Sequence[Path], settings: Sequence[str], as_json: bool) -> "list[Case | DriveCase]":
    """Load all cases before the first one runs; report all faults of all of them."""
    from wearsim.drive.load_case import load_case

    cases, failed = [], False
    for path in paths:
        try:
            case = load_case(path, settings)
            case.check()
            cases.append(case)
        except (CaseError, GeometryError) as error:
            failed = True
            if as_json:
                click.echo(error_json(path.stem, error))
            show_error(error)
    if failed:
        raise click.exceptions.Exit(BAD_INPUT)
    return cases


def finite(context: click.Context, parameter: click.Parameter, value: float | None) -> float | None:
    """Refuse nan and infinity, which click's ranges let pass."""
    if value is None or math.isfinite(value):
        return value
    raise click.BadParameter(f"{value} is not a finite number.")


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
    click.echo(coloured(printable(text)))
