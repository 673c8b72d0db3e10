"""``wearsim remaining``: what is left of a life after readings in service."""

from pathlib import Path
from typing import Any

import click

from wearsim.command.answered import Shown, shown_options
from wearsim.command.complete import CasePath, ReadingsPath
from wearsim.command.options import (
    common_options,
    finite,
    given_parameters,
    keeping_runs,
    load_cases,
    overrides,
    sprocket_option,
    working,
)

_POSITIVE = click.FloatRange(min=0.0, min_open=True)


@click.command(short_help="Estimate the remaining life from readings in service.")
@click.argument("case", type=CasePath(path_type=Path), metavar="CASE")
@click.argument("readings", required=False, type=ReadingsPath(), metavar="[READINGS]")
@click.option(
    "--reading",
    type=click.Path(dir_okay=False, path_type=Path),
    metavar="FILE",
    help="The reading.toml of wearsim scan: hours, depth and its error.",
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
    "--size-over-pins-mm",
    type=_POSITIVE,
    metavar="MM",
    callback=finite,
    help="Measurement over pins of the roller's diameter itself, in mm.",
)
@click.option(
    "--new-over-pins-mm",
    type=_POSITIVE,
    metavar="MM",
    callback=finite,
    help="Measurement over pins of the new sprocket; by default that of the case.",
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
@shown_options("tables and a picture")
@sprocket_option
@keeping_runs
@overrides
@common_options
def remaining(
    case: Path,
    readings: Path | None,
    reading: Path | None,
    hours: float | None,
    depth_mm: float | None,
    over_pins_mm: float | None,
    size_over_pins_mm: float | None,
    new_over_pins_mm: float | None,
    elongation: float | None,
    reading_error_mm: float,
    reading_error_percent: float,
    sprocket: str | None,
    shown: Shown,
    settings: tuple[str, ...],
) -> None:
    """Print the remaining hours of CASE; readings replace its wear coefficient.

    With one reading: --reading, or --hours and one of --depth-mm, --over-pins-mm, --size-over-pins-mm and
    --elongation; for the teeth of a whole drive also --sprocket. Life times coefficient is constant, so
    the answer is exact as long as the coefficient stays the same.

    With READINGS (.csv), the log of one chain by hours, km or date: chain_length_mm over links,
    elongation_percent, gauge_percent with go or no-go, and relubrications. The answer has intervals of
    50 and 90 %.
    """
    values = (depth_mm, over_pins_mm, size_over_pins_mm, elongation)
    given = [value for value in values if value is not None]
    if readings is not None:
        if given or hours is not None or sprocket is not None or reading is not None:
            raise click.UsageError("READINGS hold hours and values: leave out --hours, --sprocket and so on")
        shown.check(case, readings)
        (loaded,) = load_cases([case], settings, shown.as_json)
        from wearsim.study.remaining import answer

        with shown.failing(case.stem):
            of_chain = answer.remaining(loaded, readings=readings, error=reading_error_percent)
        shown.save(of_chain, case)
        return
    if shown.out is not None:
        raise click.UsageError("--out needs READINGS: one reading has neither table nor picture")
    single: dict[str, Any]
    if reading is not None:
        if given or hours is not None or new_over_pins_mm is not None or _says_error():
            text = "--reading holds hours, depth and error: leave out --hours, --depth-mm and so on"
            raise click.UsageError(text)
        single = {"reading": reading}
    elif hours is None:
        raise click.UsageError("give READINGS, --reading, or --hours and one reading")
    elif len(given) != 1:
        raise click.UsageError(
            "give exactly one of --depth-mm, --over-pins-mm, --size-over-pins-mm, --elongation"
        )
    else:
        single = {
            "hours": hours,
            "depth": depth_mm,
            "over_pins": over_pins_mm,
            "size_over_pins": size_over_pins_mm,
            "new_over_pins": new_over_pins_mm,
            "elongation_percent": elongation,
            "error": reading_error_percent if elongation is not None else reading_error_mm,
        }
    (loaded,) = load_cases([case], settings, shown.as_json)
    from wearsim.study.remaining import answer

    with shown.failing(case.stem), working(f"wearing {loaded.title}") as progress:
        found = answer.remaining(loaded, **single, sprocket=sprocket, progress=progress)
    shown.show(found, case)


def _says_error() -> bool:
    """Whether the user gives the error of a reading."""
    given = given_parameters(click.get_current_context())
    return any(one.name in ("reading_error_mm", "reading_error_percent") for one in given)
