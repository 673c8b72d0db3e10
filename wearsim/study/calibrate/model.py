"""Wear coefficients of one drive, and the hours that are left to it, from what was measured."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from wearsim.case.model import Case
from wearsim.drive.drive_case import DriveCase, with_one_wear
from wearsim.drive.load_case import load_case
from wearsim.errors import CaseError, Fault
from wearsim.input.document import CaseSource, read_document
from wearsim.runner.scaled_percentiles import check_no_running_in
from wearsim.runner.scatter import plain_document, with_whole_paths
from wearsim.study.calibrate.calibration import Calibration, CalibrationOptions
from wearsim.study.calibrate.coefficient_fit import CaseFit
from wearsim.study.calibrate.lubricated_time import LubricatedTime
from wearsim.study.calibrate.reading_checks import check_of_chain, check_readings
from wearsim.study.calibrate.readings import read_readings


def calibrate(
    source: CaseSource,
    measurements: Path,
    overrides: Sequence[str] = (),
    options: CalibrationOptions | None = None,
) -> Calibration:
    """Fit the coefficients of a case to what was measured.

    The coefficient of the teeth is fitted where there are readings of the teeth, that of the
    joints where there are elongations, and what the options name besides: bounded least squares
    of the residuals over their stated errors, intervals by the profile of the likelihood. Of a whole
    drive its chain can be read, and the teeth of the sprocket that the options name.
    """
    options = options or CalibrationOptions()
    document = read_document(source, overrides)
    given = load_case(source, overrides)
    if options.teeth == "chain" or options.sprocket:
        with_one_wear(given)
    case = _read_case(given, options.sprocket)
    check_no_running_in(case, "calibrate")
    readings, log, time = read_readings(measurements, case)
    if isinstance(given, DriveCase) and not options.sprocket:
        check_of_chain(readings, str(measurements))
        tables = with_whole_paths(document).data
    else:
        tables = plain_document(document, case).data
    check_readings(case, readings, options, str(measurements))
    found = CaseFit(case, tables, readings, options, LubricatedTime.of(given, log)).calibration()
    of_time = time.warnings(min(reading.hours for reading in readings))
    return replace(found, warnings=(*of_time, *found.warnings))


def _read_case(given: Case | DriveCase, sprocket: str) -> Case:
    """Return the case of what was read: of the sprocket that is named, else of the chain."""
    if not sprocket:
        return given.chain_case
    cases = given.titled_cases() if isinstance(given, DriveCase) else {}
    if sprocket not in cases:
        names = ", ".join(cases) or "none, as this case is no whole drive"
        raise CaseError(
            [Fault(f"must name a sprocket of the drive, {names} (got {sprocket!r})", "--sprocket")]
        )
    return cases[sprocket]
