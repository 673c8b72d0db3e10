"""Wear coefficients of one drive, and the hours that are left to it, from what was measured."""

from collections.abc import Sequence
from pathlib import Path

from wearsim.drive.drive_case import DriveCase, with_one_wear
from wearsim.drive.load_case import load_case
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
    drive its chain can be read.
    """
    options = options or CalibrationOptions()
    document = read_document(source, overrides)
    given = load_case(source, overrides)
    if options.teeth == "chain":
        with_one_wear(given)
    case = given.chain_case
    check_no_running_in(case, "calibrate")
    readings, log = read_readings(measurements, case)
    if isinstance(given, DriveCase):
        check_of_chain(readings, str(measurements))
        tables = with_whole_paths(document).data
    else:
        tables = plain_document(document, case).data
    check_readings(case, readings, options, str(measurements))
    return CaseFit(case, tables, readings, options, LubricatedTime.of(given, log)).calibration()
