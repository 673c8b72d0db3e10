"""Wear coefficients of one drive, and the hours that are left to it, from what was measured."""

from collections.abc import Sequence
from pathlib import Path

from wearsim.case.document import read_document
from wearsim.case.load import load_case
from wearsim.case.model import Case, WrapDrive
from wearsim.errors import CaseError, Fault
from wearsim.study.calibration.answer import Calibration, Options
from wearsim.study.calibration.fitting import Fitting
from wearsim.study.calibration.parameters import EXPONENT, SHAPES, shape_values
from wearsim.study.calibration.readings import ELONGATION, OVER_PINS, Reading, read_readings
from wearsim.study.constant import check_constant
from wearsim.study.scatter import plain_document


def calibrate(
    path: Path, measurements: Path, overrides: Sequence[str] = (), options: Options | None = None
) -> Calibration:
    """Fit the coefficients of a case to what was measured.

    The coefficient of the teeth is fitted where there are readings of the teeth, that of the
    joints where there are elongations, and what the options name besides: bounded least squares
    of the residuals over their stated errors, intervals by the profile of the likelihood.

    Parameters
    ----------
    path : pathlib.Path
        The case; its limits are those of the remaining life.
    measurements : pathlib.Path
        CSV file as `read_readings` takes it.
    overrides : sequence of str
        ``table.key=VALUE``.
    options : Options, optional
        How to fit.

    Returns
    -------
    Calibration
        The values, the hours left, and how well the readings are met.

    Raises
    ------
    CaseError
        The case or a cell is wrong, or the case does not know a reading.
    WearsimError
        The case cannot be run.
    """
    options = options or Options()
    document = read_document(path, overrides)
    case = load_case(path, overrides)
    check_constant(case, "calibrate")
    readings = read_readings(measurements)
    _check(case, readings, options, str(measurements))
    tables = plain_document(document, case).data
    return Fitting(case, tables, readings, options, str(measurements)).calibration()


def _check(case: Case, readings: Sequence[Reading], options: Options, file: str) -> None:
    wrap = isinstance(case.drive, WrapDrive)
    faults = [
        Fault(f"{reading.quantity} needs a chain that wraps the sprocket: set kind = 'wrap'", "", file,
              reading.row)
        for reading in readings
        if reading.quantity in (ELONGATION, OVER_PINS) and not wrap
    ]  # fmt: skip
    for key in options.shapes:
        if key == EXPONENT and case.wear.law == "archard":
            text = "law = 'archard' has the exponent 1: set law = 'power' to fit it"
            faults.append(Fault(text, key, "--fit"))
        elif key not in SHAPES:
            text = f"must be one of {', '.join(SHAPES)}: coefficients are fitted anyway"
            faults.append(Fault(text, key, "--fit"))
        elif key not in shape_values(case):
            faults.append(Fault("must be a key of the case", key, "--fit"))
    if options.shapes and all(reading.quantity == ELONGATION for reading in readings):
        faults.append(Fault("needs readings of the teeth", options.shapes[0], "--fit"))
    if faults:
        raise CaseError(faults)
