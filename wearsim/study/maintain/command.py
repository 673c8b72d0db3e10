"""``wearsim maintain``: when to replace the chain, and what that costs."""

from dataclasses import replace
from pathlib import Path

import click

from wearsim.command.answered import Shown, shown_options
from wearsim.command.complete import CasePath
from wearsim.command.options import common_options, keeping_runs, load_cases, overrides, working


@click.command(short_help="When to replace chain and sprockets, and at what cost.")
@click.argument("case", type=CasePath(path_type=Path), metavar="CASE")
@shown_options("tables, summary and picture")
@keeping_runs
@overrides
@common_options
def maintain(case: Path, shown: Shown, settings: tuple[str, ...]) -> None:
    """Compare when to replace the chain of CASE while its sprocket stays.

    [maintenance] gives the elongations to compare, the prices, and whether the sprocket is turned.
    Also lists numbers of teeth and links close to those of the case, with the lives of four of them.

    For a whole drive ([[sprocket]] twice or more): when to replace which part, from the life of each
    part and the prices in [maintenance].
    """
    (loaded,) = load_cases([case], settings, shown.as_json)
    from wearsim.study.maintain import answer

    shown.check()
    with shown.failing(case.stem), working(f"wearing {loaded.title}") as progress:
        found = replace(answer.maintain(loaded, progress=progress), source=str(case))
    shown.save(found, case)
