"""``wearsim maintain``: when to replace the chain, and what that costs."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from wearsim.command.answered import Shown, shown_options
from wearsim.command.complete import CasePath
from wearsim.command.options import common_options, finite, keeping_runs, load_cases, overrides, working

if TYPE_CHECKING:
    from wearsim.readings.teeth_as_read import Teeth


@click.command(short_help="Plan when to replace chain and sprockets, and the cost.")
@click.argument("case", type=CasePath(path_type=Path), metavar="CASE")
@click.argument(
    "readings",
    required=False,
    type=click.Path(path_type=Path, exists=True, dir_okay=False),
    metavar="[READINGS]",
)
@click.option(
    "--teeth",
    type=click.Choice(("case", "chain")),
    default="case",
    show_default=True,
    help="With READINGS: teeth wear as in the case, or faster or slower by the same factor as the chain.",
)
@click.option(
    "--reading-error-percent",
    type=click.FloatRange(min=0.0, min_open=True),
    default=0.05,
    show_default=True,
    metavar="PERCENT",
    callback=finite,
    help="Default standard deviation of an elongation in READINGS.",
)
@shown_options("tables, summary and picture")
@keeping_runs
@overrides
@common_options
def maintain(
    case: Path,
    readings: Path | None,
    teeth: "Teeth",
    reading_error_percent: float,
    shown: Shown,
    settings: tuple[str, ...],
) -> None:
    """Compare when to replace the chain of CASE while its sprocket stays.

    [maintenance] gives the elongations to compare, the prices, and whether the sprocket is turned.
    Also lists numbers of teeth and links close to those of the case, with the lives of four of them.

    For a whole drive ([[sprocket]] twice or more): when to replace which part, from the life of each
    part and the prices in [maintenance].

    With READINGS (.csv), the log of its chain as for wearsim remaining: the state of all parts now, and
    the jobs of the next twelve months with their days, parts and cost. Needs service.hours_per_day. A row
    new with the name of a sprocket in a column sprocket says when that was new.
    """
    (loaded,) = load_cases([case], settings, shown.as_json)
    from wearsim.study.maintain import answer

    shown.check(*([case, readings] if readings else []))
    with shown.failing(case.stem), working(f"wearing {loaded.title}") as progress:
        if readings is not None:
            year = answer.maintain(
                loaded, readings=readings, error=reading_error_percent, teeth=teeth, progress=progress
            )
            shown.save(year, case)
            return
        found = answer.maintain(loaded, progress=progress)
    shown.save(found, case)
