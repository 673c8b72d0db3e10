"""Whether a case knows what was measured, and whether that can be."""

from collections.abc import Iterator, Sequence

from wearsim.case.model import Case
from wearsim.errors import CaseError, Fault
from wearsim.mechanisms.wrap.drive import instead_of
from wearsim.readings.chain_readings import LENGTH
from wearsim.readings.contradictions import ambiguous_reading
from wearsim.study.calibrate.calibration import CalibrationOptions
from wearsim.study.calibrate.parameters import BEYOND, EXPONENT, shape_ranges, shape_values
from wearsim.study.calibrate.predicted_history import PredictedHistory
from wearsim.study.calibrate.readings import DEEPEST, OVER_PINS, POINT, PROFILE, SIZE, Reading

_NONE, _FAR = 3.0, 5.0
"""Errors by which a value may lie below 0, and beyond the depth at the limit."""


def check_readings(case: Case, readings: Sequence[Reading], options: CalibrationOptions, file: str) -> None:
    """Raise where the case does not know what was measured or what is to be fitted."""
    faults = [
        Fault(text, "", file, reading.row) for reading in readings for text in _not_known(case, reading)
    ]
    for key in options.shapes:
        if key == EXPONENT and case.wear.law == "archard":
            text = "law = 'archard' has the exponent 1: set law = 'power' to fit it"
            faults.append(Fault(text, key, "--fit"))
        elif key not in shape_ranges(case):
            text = f"must be one of {', '.join(shape_ranges(case))}: coefficients are fitted anyway"
            faults.append(Fault(text, key, "--fit"))
        elif key not in shape_values(case):
            faults.append(Fault("must be a key of the case", key, "--fit"))
    if options.shapes and all(reading.of_chain for reading in readings):
        faults.append(Fault("needs readings of the teeth", options.shapes[0], "--fit"))
    if faults:
        raise CaseError(faults)


def check_of_chain(readings: Sequence[Reading], file: str) -> None:
    """Raise where readings of a whole drive are of its teeth, as they say not of which sprocket."""
    faults = [
        Fault(
            f"{one.quantity} is read on the teeth of one sprocket: name it by --sprocket, a file for each",
            "quantity",
            file,
            one.row,
        )
        for one in readings
        if not one.of_chain
    ]
    if faults:
        raise CaseError(faults)


def _not_known(case: Case, reading: Reading) -> Iterator[str]:
    wrap, name = case.drive.rests, reading.quantity
    if (reading.of_chain or name in (LENGTH, OVER_PINS, SIZE)) and not wrap:
        yield f"{name} needs a chain that wraps the sprocket: {instead_of(case)}"
    if (reading.of_chain or name == OVER_PINS) and reading.gap_kind is not None:
        yield f"gap_kind must be empty for {name}"
    if name == PROFILE and case.inputs["mechanism"]["kind"] == "prescribed":
        yield "a table of loads has no flank to lay a profile on: give depths"
    if reading.value < -_NONE * reading.error:
        yield (
            f"value must not be more than {_NONE:g} errors below 0, is {reading.value:g}: wear is counted "
            "as positive"
        )


def reading_faults(reading: Reading, new: PredictedHistory) -> list[str]:
    """Return what is wrong with a reading of the teeth."""
    found, kinds = [], new.kinds
    if reading.quantity in (POINT, PROFILE) and kinds > 1 and reading.gap_kind is None:
        found.append(
            f"gap_kind is needed, as the gaps of this drive wear in {kinds} ways: 1 for those that meet "
            "inner links, 2 for those that meet outer links"
        )
    if reading.gap_kind is not None and reading.gap_kind > kinds:
        found.append(f"gap_kind must be at most {kinds}, is {reading.gap_kind}")
    if reading.quantity == OVER_PINS:
        ambiguous = ambiguous_reading(new.result.history_columns[OVER_PINS], reading.error)
        found += [f"over_pins_mm {ambiguous}"] if ambiguous else []
    if reading.quantity == POINT and reading.arc_length > new.arc_length[-1]:
        found.append(
            f"arc_length_mm must be at most {new.arc_length[-1]:.4g}, the length of the flank, is "
            f"{reading.arc_length:g}"
        )
    greatest = (1.0 + BEYOND) * new.greatest + _FAR * reading.error
    if reading.quantity in (DEEPEST, POINT) and reading.value > greatest:
        found.append(
            f"value must lie within the limit of the case, a depth of {new.greatest:.4g} mm, is "
            f"{reading.value:g}: raise the limits of [stop]"
        )
    return found
