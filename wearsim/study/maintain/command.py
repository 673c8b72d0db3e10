"""``wearsim maintain``: when to replace the chain, and what that costs."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from wearsim.command.colours import show
from wearsim.command.complete import CasePath
from wearsim.command.options import (
    common_options,
    error_json,
    load_cases,
    overrides,
    print_json,
    warn,
    working,
)
from wearsim.errors import WearsimError

if TYPE_CHECKING:
    from wearsim.case.model import Case
    from wearsim.drive.drive_case import DriveCase


@click.command(short_help="When to replace chain and sprockets, and at what cost.")
@click.argument("case", type=CasePath(path_type=Path), metavar="CASE")
@click.option("--out", type=click.Path(path_type=Path), help="New folder for tables, summary and picture.")
@click.option("--force", is_flag=True, help="Replace an existing folder.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@overrides
@common_options
def maintain(case: Path, out: Path | None, force: bool, as_json: bool, settings: tuple[str, ...]) -> None:
    """Compare when to replace the chain of CASE while its sprocket stays.

    [maintenance] gives the elongations to compare, the prices, and whether the sprocket is turned.
    Also lists numbers of teeth and links close to those of the case, with the lives of four of them.

    For a whole drive ([[sprocket]] twice or more): when to replace which part, from the life of each
    part and the prices in [maintenance].
    """
    (loaded,) = load_cases([case], settings, as_json)
    from wearsim.files import check_folder

    if out is not None:
        check_folder(out, force)
    try:
        answer = _answer(loaded, str(case))
    except WearsimError as error:
        if as_json:
            click.echo(error_json(case.stem, error))
        raise
    if out is not None:
        answer.save(out, force)
    if as_json:
        print_json(answer.summary, case, answer.warnings)
    else:
        show(answer.text)
    if out is not None:
        warn(f"written to {out}")


class _Answer(NamedTuple):
    """A plan as it is shown."""

    text: str
    summary: dict[str, Any]
    warnings: tuple[str, ...]
    save: Callable[[Path, bool], None]


def _answer(case: "Case | DriveCase", source: str) -> _Answer:
    """Return the plan of a drive by the lives of its parts, of one sprocket by policies that are run."""
    from wearsim.case.model import Case

    if isinstance(case, Case):
        from wearsim.study.maintain.model import maintain as compare_policies
        from wearsim.study.maintain.sheet import maintenance_json, maintenance_text, save_maintenance

        with progress() as report_progress:
            policies = compare_policies(case, report_progress)
        save = partial(save_maintenance, policies)
        return _Answer(maintenance_text(policies), maintenance_json(policies), policies.warnings, save)
    from wearsim.drive.life import drive_life
    from wearsim.drive.maintenance import drive_plan
    from wearsim.report.drive.plan_sheet import plan_json, plan_text, save_plan

    with working(f"wearing {case.title}") as report_progress_of_lives:
        found = drive_life(case, report_progress_of_lives).complete()
    plan = drive_plan(found)
    return _Answer(plan_text(plan, source), plan_json(plan), found.warnings, partial(save_plan, plan))


@contextmanager
def progress() -> Iterator[Callable[[int, int, str], None]]:
    """Show on a terminal's stderr which of several runs is under way, and the time left."""
    quiet = click.get_current_context().find_root().meta.get("wearsim.quiet")
    if quiet or not sys.stderr.isatty():
        yield lambda done, of, what: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}"), BarColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("")
        yield lambda done, of, what: bar.update(task, completed=done, total=of, description=what)
