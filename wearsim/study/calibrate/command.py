"""``wearsim calibrate``: coefficients and hours left from what was measured in service."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from wearsim.command.answered import Shown, shown_options
from wearsim.command.complete import CasePath, ReadingsPath
from wearsim.command.options import common_options, finite, overrides, sprocket_option, working

if TYPE_CHECKING:
    from wearsim.geometry.measured.registration import Freedom
    from wearsim.readings.teeth_as_read import Teeth


@click.command(short_help="Fit wear coefficients to measurements.")
@click.argument("case", type=CasePath(path_type=Path), metavar="CASE")
@click.argument("measurements", type=ReadingsPath(), metavar="MEASUREMENTS")
@click.option(
    "--fit",
    "shapes",
    multiple=True,
    metavar="KEY",
    help="Also fit wear.pressure_exponent or mechanism.roller_slip_fraction. Repeatable.",
)
@click.option(
    "--register",
    type=click.Choice(("turn", "free", "none")),
    default="turn",
    show_default=True,
    help="Registration of measured profiles: turn about the axis, turn and shift (free), or none.",
)
@click.option(
    "--cutoff-mm",
    type=click.FloatRange(min=0.01, max=100.0),
    default=0.8,
    show_default=True,
    metavar="MM",
    callback=finite,
    help="Cut-off wavelength of the profile filter, in mm.",
)
@click.option(
    "--confidence",
    type=click.FloatRange(min=0.5, max=0.999),
    default=0.9,
    show_default=True,
    callback=finite,
    help="Confidence level of the intervals.",
)
@click.option(
    "--teeth",
    type=click.Choice(("case", "chain")),
    default="case",
    show_default=True,
    help="Of readings of the chain alone: teeth wear as the case says, or by the factor of the chain.",
)
@shown_options("tables and pictures")
@sprocket_option
@overrides
@common_options
def calibrate(
    case: Path,
    measurements: Path,
    shapes: tuple[str, ...],
    register: "Freedom",
    cutoff_mm: float,
    confidence: float,
    teeth: "Teeth",
    sprocket: str | None,
    shown: Shown,
    settings: tuple[str, ...],
) -> None:
    """Fit the wear coefficients of CASE (.toml) to MEASUREMENTS (.csv), and print the remaining hours.

    Each row of the table is a reading: time_hours (or distance_km, or date), quantity (max_depth_mm,
    depth_mm at arc_length_mm, over_pins_mm, elongation_percent, chain_length_mm over links,
    gauge_percent with result, or profile with a points_file), value, and error, its standard
    deviation. Rows with the quantity relubrication give the times of relubrication, and replace the
    schedule of [lubrication]. For a whole drive, readings are of the chain, and of the teeth of the
    sprocket that --sprocket names. --out writes fit.csv,
    fitted_values.csv, summary.md, pictures, and the case with the fitted values. Needs pandera
    (pip install 'wearsim[study]').
    """
    from wearsim.extras import check_installed

    check_installed(("pandera",), "study", "calibrate")
    shown.check(case, measurements)
    from wearsim.study.calibrate.answer import CalibrationResult
    from wearsim.study.calibrate.calibration import CalibrationOptions
    from wearsim.study.calibrate.model import calibrate as calibrated

    options = CalibrationOptions(shapes, register, cutoff_mm, confidence, sprocket or "", teeth)
    with working(f"fitting {case.stem}"):
        found = calibrated(case, measurements, settings, options)
    shown.save(CalibrationResult(found), case)
