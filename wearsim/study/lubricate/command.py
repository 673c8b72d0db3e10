"""``wearsim lubricate``: when to lubricate again, and what that costs."""

from pathlib import Path

import click

from wearsim.command.answered import Shown, shown_options
from wearsim.command.complete import CasePath
from wearsim.command.options import common_options, keeping_runs, load_cases, overrides, working


@click.command(short_help="Compare relubrication intervals and lubricants.")
@click.argument("case", type=CasePath(path_type=Path), metavar="CASE")
@shown_options("table, summary and picture")
@keeping_runs
@overrides
@common_options
def lubricate(case: Path, shown: Shown, settings: tuple[str, ...]) -> None:
    """Compare relubrication intervals of CASE: lives of its parts, and cost per 1000 h.

    [lubrication] gives how long the lubricant lasts, its price and the minutes of work,
    [[lubrication.option]] other lubricants, and [maintenance] the prices of chain and sprockets.
    """
    (loaded,) = load_cases([case], settings, shown.as_json)
    from wearsim.study.lubricate import answer

    shown.check()
    with shown.failing(case.stem), working(f"wearing {loaded.title}") as progress:
        found = answer.lubricate(loaded, progress=progress)
    shown.save(found, case)
