"""Coefficients and hours left from what was measured in service."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from wearsim.case.model import Case
from wearsim.drive.case_input import CaseInput, given_input, loaded
from wearsim.drive.drive_case import DriveCase
from wearsim.errors import Allowed, Range, check_ranges
from wearsim.extras import check_installed
from wearsim.files import given_bytes
from wearsim.geometry.measured.registration import Freedom
from wearsim.quantities import grouped
from wearsim.readings.dated_rows import readings_file
from wearsim.readings.teeth_as_read import Teeth
from wearsim.report.public_answer import DrawnAnswer
from wearsim.study.calibrate.calibration import Calibration, CalibrationOptions
from wearsim.study.calibrate.model import calibrate as fitted
from wearsim.study.calibrate.sheet import (
    calibration_files,
    calibration_json,
    calibration_text,
    parts_table,
    readings_table,
    values_table,
)

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

_ALLOWED: dict[str, Allowed] = {
    "register": ("turn", "free", "none"),
    "cutoff": Range(0.01, 100.0),
    "confidence": Range(0.5, 0.999),
    "teeth": ("case", "chain"),
}


@dataclass(frozen=True, repr=False, eq=False)
class CalibrationResult(DrawnAnswer):
    """A case fitted to readings.

    Attributes
    ----------
    found : Calibration
        Values, intervals and residuals as objects.
    """

    _tables = ("parts", "values", "readings")

    found: Calibration

    @property
    def title(self) -> str:
        """What the case is about."""
        return self.found.case.title

    @property
    def headline(self) -> str:
        """The hours that are left to each part."""
        return ", ".join(f"{grouped(one.remaining)} h left to the {one.name}" for one in self.found.parts)

    @property
    def text(self) -> str:
        """What ``wearsim calibrate`` prints."""
        return calibration_text(self.found)

    @property
    def explained(self) -> str:
        """The text with every assumption and default."""
        return calibration_text(self.found, explain=True)

    @property
    def case(self) -> Case | DriveCase:
        """The case, or the whole drive, with the fitted values."""
        return loaded(self.found.tables)

    @property
    def values(self) -> "pd.DataFrame":
        """What was fitted, with the ends of its intervals."""
        return values_table(self.found).frame()

    @property
    def parts(self) -> "pd.DataFrame":
        """Life and hours left of sprocket and chain, with the ends of their intervals."""
        return parts_table(self.found).frame()

    @property
    def readings(self) -> "pd.DataFrame":
        """Every reading beside its prediction."""
        return readings_table(self.found).frame()

    def _content(self) -> dict[str, Any]:
        return calibration_json(self.found)

    def pictures(self) -> "dict[str, Figure]":
        """Return readings with the fitted wear, and the residuals.

        Returns
        -------
        dict of matplotlib.figure.Figure
            By their names.
        """
        from wearsim.study.calibrate.figure import calibration_figures

        return calibration_figures(self.found)

    def _files(self) -> Mapping[str, str]:
        return calibration_files(self.found)

    def _write(self, place: Path) -> None:
        super()._write(place)
        for path in self.found.case.files:
            (place / "inputs").mkdir(exist_ok=True)
            (place / "inputs" / path.name).write_bytes(given_bytes(path))


def calibrate(
    case: CaseInput,
    readings: "str | PathLike[str] | pd.DataFrame | Sequence[Mapping[str, Any]]",
    *,
    fit: Sequence[str] = (),
    register: Freedom = "turn",
    cutoff: float = 0.8,
    confidence: float = 0.9,
    sprocket: str = "",
    teeth: Teeth = "case",
) -> CalibrationResult:
    """Fit the wear coefficients of a case to readings, and tell the hours left.

    Parameters
    ----------
    case : Case, DriveCase, path or mapping
        One sprocket or a gear pair, or a whole drive whose chain or one of whose sprockets was read.
    readings : path, pandas.DataFrame or sequence of mapping
        Columns ``quantity``, ``value``, ``error``, one of ``time_hours``, ``distance_km`` and ``date``,
        and those that a quantity needs; rows ``relubrication`` have a time only. Paths are relative to
        the file, else to the working directory.
    fit : sequence of str
        Keys that are fitted too: ``wear.pressure_exponent``, ``mechanism.roller_slip_fraction``, constants of
        a wear law of your own (`wear_law`), such as ``wear.constants.m``, within their range or else 1/5 to 5
        times their value.
    register : str
        How a measured profile may be moved: ``turn``, ``free`` or ``none``.
    cutoff : float
        Cut-off wavelength of the filter of profiles [mm].
    confidence : float
        Of the intervals.
    sprocket : str
        On which teeth were read, of a whole drive.
    teeth : str
        What the teeth of the fitted case wear by where only the chain was read: ``case``, what the case
        says, or ``chain``, as much faster or slower than that as the joints do.

    Returns
    -------
    CalibrationResult
        ``parts``, ``values``, ``readings``, and the fitted ``case``.

    Raises
    ------
    CaseError
        What is wrong with the case or the readings, or pandera is not installed (extra ``study``).
    GeometryError
        Register, cutoff, confidence or teeth are outside their ranges.
    """
    check_installed(("pandera",), "study", "calibrate")
    given_options = {"register": register, "cutoff": cutoff, "confidence": confidence, "teeth": teeth}
    check_ranges("calibrate", given_options, _ALLOWED)
    options = CalibrationOptions(tuple(fit), register, cutoff, confidence, sprocket, teeth)
    given = given_input(case)
    with readings_file(readings) as file:
        return CalibrationResult(fitted(given, file, (), options))
