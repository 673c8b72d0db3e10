"""``wearsim remaining``: what is left of a life after a reading in service."""

from pathlib import Path

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
    working,
)
from wearsim.errors import WearsimError

_POSITIVE = click.FloatRange(min=0.0, min_open=True)


@click.command(short_help="Hours left after one reading in service.")
@click.argument("case", type=CasePath(path_type=Path), metavar="CASE")
@click.option(
    "--hours",
    required=True,
    type=_POSITIVE,
    metavar="H",
    callback=finite,
    help="Running hours of the part that was measured, sprocket or chain, since it was new.",
)
@click.option(
    "--depth-mm",
    type=_POSITIVE,
    metavar="MM",
    callback=finite,
    help="Depth worn off a tooth at the deepest point.",
)
@click.option(
    "--over-pins-mm",
    type=_POSITIVE,
    metavar="MM",
    callback=finite,
    help="How much less the measurement over pins is than when new.",
)
@click.option(
    "--elongation", type=_POSITIVE, metavar="PERCENT", callback=finite, help="Elongation of the chain."
)
@click.option(
    "--reading-error-mm",
    type=_POSITIVE,
    default=0.02,
    show_default=True,
    metavar="MM",
    callback=finite,
    help="Error of a reading in mm, to either side.",
)
@click.option(
    "--reading-error-percent",
    type=_POSITIVE,
    default=0.05,
    show_default=True,
    metavar="PERCENT",
    callback=finite,
    help="Error of an elongation, to either side.",
)
@click.option("--json", "as_json", is_flag=True, help="As one JSON object.")
@overrides
@common_options
def remaining(
    case: Path,
    hours: float,
    depth_mm: float | None,
    over_pins_mm: float | None,
    elongation: float | None,
    reading_error_mm: float,
    reading_error_percent: float,
    as_json: bool,
    settings: tuple[str, ...],
) -> None:
    """Print the hours that are left of CASE; one reading replaces the wear coefficient.

    Give one of --depth-mm, --over-pins-mm and --elongation. Life times coefficient is
    constant, so the answer is exact as long as the coefficient is.
    """
    given = [value for value in (depth_mm, over_pins_mm, elongation) if value is not None]
    if len(given) != 1:
        raise click.UsageError("give exactly one of --depth-mm, --over-pins-mm, --elongation")
    (loaded,) = load_cases([case], settings, as_json)
    from wearsim.study.remaining.model import DEPTH, ELONGATION, OVER_PINS, SingleReading, remaining_life
    from wearsim.study.remaining.sheet import remaining_json, remaining_text

    quantity = DEPTH if depth_mm is not None else ELONGATION if elongation is not None else OVER_PINS
    error = reading_error_percent if elongation is not None else reading_error_mm
    try:
        with working(f"wearing {loaded.title}") as report_progress:
            found = remaining_life(loaded, SingleReading(quantity, given[0], error, hours), report_progress)
    except WearsimError as fault:
        if as_json:
            click.echo(error_json(case.stem, fault))
        raise
    if as_json:
        content = remaining_json(found, loaded.inputs)
        print_json(content, case, found.warnings)
    else:
        show(remaining_text(found, loaded.inputs))
