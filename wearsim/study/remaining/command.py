"""``wearsim remaining``: what is left of a life after readings in service."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import click

from wearsim.command.colours import show
from wearsim.command.complete import CasePath
from wearsim.command.options import (
    common_options,
    error_json,
    finite,
    load_cases,
    overrides,
    print_json,
    warn,
    working,
)
from wearsim.errors import WearsimError

if TYPE_CHECKING:
    pass

_POSITIVE = click.FloatRange(min=0.0, min_open=True)


@click.command(short_help="Remaining life from readings in service.")
@click.argument("case", type=CasePath(path_type=Path), metavar="CASE")
@click.argument(
    "readings",
    required=False,
    type=click.Path(path_type=Path, exists=True, dir_okay=False),
    metavar="[READINGS]",
)
@click.option(
    "--hours",
    type=_POSITIVE,
    metavar="H",
    callback=finite,
    help="Running hours of the measured part (sprocket or chain) since it was new.",
)
@click.option(
    "--depth-mm", type=_POSITIVE, metavar="MM", callback=finite, help="Greatest wear depth on a tooth, in mm."
)
@click.option(
    "--over-pins-mm",
    type=_POSITIVE,
    metavar="MM",
    callback=finite,
    help="Decrease of the measurement over pins since new, in mm.",
)
@click.option(
    "--elongation",
    type=_POSITIVE,
    metavar="PERCENT",
    callback=finite,
    help="Elongation of the chain, in percent.",
)
@click.option(
    "--reading-error-mm",
    type=_POSITIVE,
    default=0.02,
    show_default=True,
    metavar="MM",
    callback=finite,
    help="Error of a reading, plus or minus, in mm.",
)
@click.option(
    "--reading-error-percent",
    type=_POSITIVE,
    default=0.05,
    show_default=True,
    metavar="PERCENT",
    callback=finite,
    help="Error of an elongation, plus or minus; in READINGS, the default standard deviation.",
)
@click.option("--out", type=click.Path(path_type=Path), help="New folder for tables and a picture.")
@click.option("--force", is_flag=True, help="Replace an existing folder.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@overrides
@common_options
def remaining(
    case: Path,
    readings: Path | None,
    hours: float | None,
    depth_mm: float | None,
    over_pins_mm: float | None,
    elongation: float | None,
    reading_error_mm: float,
    reading_error_percent: float,
    out: Path | None,
    force: bool,
    as_json: bool,
    settings: tuple[str, ...],
) -> None:
    """Print the remaining hours of CASE; readings replace its wear coefficient.

    With one reading: --hours and one of --depth-mm, --over-pins-mm and --elongation. Life times
    coefficient is constant, so the answer is exact as long as the coefficient stays the same.

    With READINGS (.csv), the log of one chain by hours, km or date: chain_length_mm over links,
    elongation_percent, gauge_percent with go or no-go, and relubrications. The answer has intervals of
    50 and 90 %. For a whole drive, readings are of the chain.
    """
    values = (depth_mm, over_pins_mm, elongation)
    given = [value for value in values if value is not None]
    if readings is not None:
        if given or hours is not None:
            raise click.UsageError("READINGS hold hours and values: leave out --hours and the like")
        _of_chain(case, readings, reading_error_percent, out, force, as_json, settings)
        return
    if hours is None:
        raise click.UsageError("give READINGS, or --hours and one reading")
    if len(given) != 1:
        raise click.UsageError("give exactly one of --depth-mm, --over-pins-mm, --elongation")
    if out is not None:
        raise click.UsageError("--out needs READINGS: one reading has neither table nor picture")
    (loaded,) = load_cases([case], settings, as_json)
    from wearsim.drive.drive_case import chain_case
    from wearsim.study.remaining.model import DEPTH, ELONGATION, OVER_PINS, SingleReading, remaining_life
    from wearsim.study.remaining.sheet import remaining_json, remaining_text

    quantity = DEPTH if depth_mm is not None else ELONGATION if elongation is not None else OVER_PINS
    error = reading_error_percent if elongation is not None else reading_error_mm
    with _failing(case, as_json), working(f"wearing {loaded.title}") as report_progress:
        found = remaining_life(loaded, SingleReading(quantity, given[0], error, hours), report_progress)
    if as_json:
        content = remaining_json(found, chain_case(loaded).inputs)
        print_json(content, case, found.warnings)
    else:
        show(remaining_text(found, chain_case(loaded).inputs))


def _of_chain(
    case: Path,
    readings: Path,
    usual_error: float,
    out: Path | None,
    force: bool,
    as_json: bool,
    settings: tuple[str, ...],
) -> None:
    """Answer a table of readings."""
    if out is not None:
        from wearsim.files import check_folder

        check_folder(out, force)
    (loaded,) = load_cases([case], settings, as_json)
    from wearsim.study.remaining.chain_sheet import chain_json, chain_text, save_chain
    from wearsim.study.remaining.chain_state import chain_state

    with _failing(case, as_json):
        found = chain_state(loaded, readings, usual_error)
    if as_json:
        print_json(chain_json(found), case, found.warnings)
    else:
        show(chain_text(found))
    if out is not None:
        save_chain(found, out, force)
        warn(f"written to {out}")


@contextmanager
def _failing(case: Path, as_json: bool) -> Iterator[None]:
    """Print an error as JSON too, where that is asked for."""
    try:
        yield
    except WearsimError as fault:
        if as_json:
            click.echo(error_json(case.stem, fault))
        raise
