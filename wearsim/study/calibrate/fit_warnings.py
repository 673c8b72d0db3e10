"""What a calibration takes for granted, and what its user should look at."""

import math
from collections.abc import Iterator, Sequence
from itertools import combinations

from scipy.stats import chi2

from wearsim.case.model import Case
from wearsim.drive.wrap_life import chain_band
from wearsim.geometry.profile_points import Vector
from wearsim.quantities import grouped
from wearsim.readings.chain_readings import GO, NO_GO
from wearsim.readings.contradictions import (
    CHAIN,
    JOINTS,
    TEETH,
    WearReading,
    band_warning,
    contradiction_warnings,
    contradictions,
)
from wearsim.readings.relubrications import RelubricationLog
from wearsim.readings.teeth_as_read import TEETH_WORDS, teeth_warning
from wearsim.runner.scatter import coefficient_key
from wearsim.study.calibrate.calibration import CalibrationOptions, FittedCoefficient, PartLife
from wearsim.study.calibrate.least_squares import LeastSquaresFit
from wearsim.study.calibrate.observations import Observation, PredictedState
from wearsim.study.calibrate.parameters import EXPONENT, JOINT, shape_ranges
from wearsim.study.calibrate.readings import PROFILE, Reading

_TOGETHER = 0.95
"""Correlation above which two values are looked at together."""

_WIDE = 2.0
"""Ratio of the ends of an interval above which a value counts as not determined."""

_TOO_GOOD = 0.001

_MANY = 0.25
"""Part of the points of a profile above which it matters that they are left out."""


def fit_assumptions(
    case: Case, readings: Sequence[Reading], options: CalibrationOptions, log: RelubricationLog
) -> Iterator[str]:
    """Give what a fit takes for granted."""
    yield _conditions(case, log)
    yield (
        "errors of the readings are normal, independent and as stated; intervals hold them only, not "
        "errors of the model"
    )
    moved = {
        "none": "not moved",
        "turn": "turned about the axis (a datum that is off it by some hundredths of a millimetre can "
        "cost more than the intervals, see --register free)",
        "free": "turned and shifted",
    }
    if any(reading.x.size for reading in readings):
        yield (
            f"measured profiles are {moved[options.freedom]} to fit and smoothed by the Gaussian "
            f"filter of ISO 16610-21, cut-off {options.cutoff:g} mm; the model is smoothed alike"
        )
    chain, teeth = (any(one.of_chain == of_chain for one in readings) for of_chain in (True, False))
    if chain and not teeth:
        yield TEETH_WORDS[options.teeth]
    if chain and teeth and log.hours:
        yield "sprocket and chain were both new at time 0 of the log"
    if case.drive.wear_coefficients and teeth:
        yield (
            "the runs take the joints' wear over that of the teeth as it came out, without its error"
            if chain
            else "the coefficient of the joints deviates by the same factor as that of the teeth"
        )


def _conditions(case: Case, log: RelubricationLog) -> str:
    """Say what stays as it was."""
    if log.hours:
        return (
            "the coefficients of lubricated contacts are constant over the whole life, the load stays as it "
            f"was, and contacts are relubricated every {grouped(log.mean_interval)} h as before, in place of "
            "what [lubrication] says"
        )
    if case.lubrication is not None and not case.lubrication.steady:
        return (
            "the coefficients of lubricated contacts are constant over the whole life, the load stays as it "
            "was, and contacts are relubricated as [lubrication] says, from a new part on"
        )
    return "the coefficients are constant over the whole life, load and lubrication do not change"


def fit_warnings(
    case: Case,
    values: Sequence[FittedCoefficient],
    correlation: Vector,
    found: LeastSquaresFit,
    observations: Sequence[Observation],
    freedom: int,
    options: CalibrationOptions,
) -> Iterator[str]:
    """Give what is doubtful about a fit."""
    if [one.key for one in values] == [JOINT]:
        yield from teeth_warning(values[0].value / values[0].in_case, options.teeth)
    yield from _identifiability(values, correlation)
    yield from _residuals(found, freedom)
    yield from _outside_bands(case, values)
    for one in observations:
        if one.left_out > _MANY * one.reading.x.size:
            yield (
                f"line {one.reading.row}: {one.left_out} of {one.reading.x.size} points lie beyond the "
                "ends of the flank and are left out: check that the profile is that of this flank"
            )
    if case.fatigue is not None:
        yield "contact fatigue is left out: what remains is by wear ([fatigue] may end it sooner)"
    yield from case.warnings


def _outside_bands(case: Case, values: Sequence[FittedCoefficient]) -> Iterator[str]:
    """Give coefficients outside of their bands; that of the teeth goes with the values fitted besides."""
    shaped = any(one.key in shape_ranges(case) for one in values)
    of_teeth = {} if shaped else {coefficient_key(case): TEETH}
    for one in values:
        factor = one.value / one.in_case
        if one.key == JOINT:
            yield from band_warning(factor, chain_band(case), JOINTS)
        elif one.key in of_teeth:
            yield from band_warning(factor, case.drive.wear_band("sprocket", case.wear), TEETH)


def warnings_of_readings(observations: Sequence[Observation], state: PredictedState) -> Iterator[str]:
    """Give readings of one coefficient that exclude each other; profiles are left to the sum of squares."""
    single = [one for one in observations if one.reading.quantity != PROFILE]
    for of_chain in (False, True):
        alike = [_beside(one, state) for one in single if one.reading.of_chain == of_chain]
        yield from contradiction_warnings(contradictions(alike))


def _beside(one: Observation, state: PredictedState) -> WearReading:
    """Return a reading of one value beside what a fit says of it."""
    reading, (row,) = one.reading, one.shown(state)
    kind = CHAIN if reading.of_chain else f"{reading.quantity} {reading.arc_length} {reading.gap_kind}"
    read = f"{row.value:.4g} %" if reading.of_chain else f"{reading.quantity} = {row.value:.4g}"
    return WearReading(
        line=reading.row,
        hours=reading.hours,
        kind=kind,
        low=-math.inf if reading.result == GO else row.value,
        high=math.inf if reading.result == NO_GO else row.value,
        error=row.error,
        predicted=row.predicted,
        words=f"{reading.result} at {read}" if reading.result else read,
    )


def _identifiability(values: Sequence[FittedCoefficient], correlation: Vector) -> Iterator[str]:
    inseparable = set()
    for (i, one), (j, other) in combinations(enumerate(values), 2):
        alike = abs(correlation[i, j])
        if alike > _TOGETHER and _loose(one) and _loose(other):
            inseparable |= {one.key, other.key}
            ways = "their ratio" if correlation[i, j] > 0.0 else "their product"
            yield (
                f"the data cannot tell {one.key} and {other.key} apart (correlation "
                f"{correlation[i, j]:.2f}): they determine little more than {ways}; "
                "fix one of them, or measure where they act differently"
            )
    # The unit of a coefficient goes with the exponent, and with that its size.
    judged = values[1:] if any(value.key == EXPONENT for value in values) else values
    for value in judged:
        if _loose(value) and value.key not in inseparable:
            yield (f"the data hardly determine {value.key}: measure it separately, or keep the case's value")


def _loose(value: FittedCoefficient) -> bool:
    interval = value.interval
    return not interval.known or interval.high > _WIDE * interval.low


def _residuals(found: LeastSquaresFit, freedom: int) -> Iterator[str]:
    if freedom == 0:
        yield "there are as many fitted values as readings: nothing is left to check the fit by"
        if found.chi_square > 1.0:
            yield "and no values meet the readings: check them"
        return
    if found.scale > 1.0:
        yield (
            f"the readings are {found.scale:.2g} times as far from the fit as their errors say: check "
            "them, the errors and the load; the intervals are widened by as much"
        )
    if chi2.cdf(found.chi_square, freedom) < _TOO_GOOD:
        size = math.sqrt(found.chi_square / freedom)
        yield (
            f"the readings are only {size:.2g} times as far from the fit as their errors say: the errors "
            "are stated too large, or the readings are not independent"
        )


def warnings_of_runs(settled: bool, numerical_error: float, parts: Sequence[PartLife]) -> Iterator[str]:
    """Give what is doubtful about the runs that readings were held against."""
    if not settled:
        yield "the fit has not settled: its runs or the registration still change with it"
    for part in parts:
        half = 0.5 * math.log(part.interval.high / part.interval.low)
        if part.name != "chain" and numerical_error > half:
            yield (
                f"the numerical error of the runs, {numerical_error:.1g}, is larger than the interval of "
                f"the {part.name}'s life, +-{100 * half:.1g} %: use more nodes and phases, a smaller "
                "run.life_tolerance"
            )
