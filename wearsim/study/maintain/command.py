"""``wearsim maintain``: when to replace the chain, and what that costs."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import click

from wearsim.command.colours import show
from wearsim.command.complete import CasePath
from wearsim.command.options import common_options, error_json, load_cases, overrides, print_json, warn
from wearsim.errors import WearsimError


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
    from wearsim.study.whole_drive.command import is_drive, planned

    if is_drive(case):
        planned(case, settings, as_json, out, force)
        return
    (loaded,) = load_cases([case], settings, as_json)
    from wearsim.files import check_folder
    from wearsim.study.maintain.model import maintain as compare_policies
    from wearsim.study.maintain.sheet import maintenance_json, maintenance_text, save_maintenance

    if out is not None:
        check_folder(out, force)
    try:
        with progress() as report_progress:
            plan = compare_policies(loaded, report_progress)
    except WearsimError as error:
        if as_json:
            click.echo(error_json(case.stem, error))
        raise
    if out is not None:
        save_maintenance(plan, out, force)
    if as_json:
        print_json(maintenance_json(plan), case, plan.warnings)
    else:
        show(maintenance_text(plan))
    if out is not None:
        warn(f"written to {out}")


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
