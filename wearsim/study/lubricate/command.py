"""``wearsim lubricate``: when to lubricate again, and what that costs."""

from pathlib import Path

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


@click.command(short_help="Compare relubrication intervals and lubricants.")
@click.argument("case", type=CasePath(path_type=Path), metavar="CASE")
@click.option("--out", type=click.Path(path_type=Path), help="New folder for table, summary and picture.")
@click.option("--force", is_flag=True, help="Replace an existing folder.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@overrides
@common_options
def lubricate(case: Path, out: Path | None, force: bool, as_json: bool, settings: tuple[str, ...]) -> None:
    """Compare relubrication intervals of CASE: lives of its parts, and cost per 1000 h.

    [lubrication] gives how long the lubricant lasts, its price and the minutes of work,
    [[lubrication.option]] other lubricants, and [maintenance] the prices of chain and sprockets.
    """
    from wearsim.files import check_folder

    (loaded,) = load_cases([case], settings, as_json)
    from wearsim.study.lubricate.runs import lubricate as compare_intervals
    from wearsim.study.lubricate.sheet import lubrication_json, lubrication_text, save_lubrication

    if out is not None:
        check_folder(out, force)
    try:
        with working(f"wearing {loaded.title}") as report_progress:
            study = compare_intervals(loaded, report_progress)
    except WearsimError as error:
        if as_json:
            click.echo(error_json(case.stem, error))
        raise
    if out is not None:
        save_lubrication(study, out, force)
    if as_json:
        print_json(lubrication_json(study), case, study.warnings)
    else:
        show(lubrication_text(study))
    if out is not None:
        warn(f"written to {out}")
