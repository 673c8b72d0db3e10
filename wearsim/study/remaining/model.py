"""What is left of a life after one reading in service."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from wearsim.case.model import Case, WearBand
from wearsim.chain.joint_wear import JointLaw
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.part_life import simulate
from wearsim.drive.wrap_life import chain_band, chain_clock, wrap_of
from wearsim.errors import CaseError, Fault
from wearsim.geometry.profile_points import Vector
from wearsim.mechanisms.wrap.drive import instead_of
from wearsim.readings.contradictions import JOINTS, TEETH, ambiguous_reading, band_warning
from wearsim.result import Life, LowerBound
from wearsim.runner.scaled_percentiles import check_no_running_in, check_steady_lubricant

_CONSTANT = ("life times coefficient is constant: load and lubrication do not change",)

DEPTH, OVER_PINS, ELONGATION = "max_depth_mm", "over_pins_mm", "elongation_percent"


@dataclass(frozen=True)
class SingleReading:
    """One reading of wear in service."""

    # `max_depth_mm`, `over_pins_mm` (how much the measurement over pins has become less) or
    # `elongation_percent`
    quantity: str
    value: float  # in the unit of the quantity, both above 0
    error: float  # in the unit of the quantity, both above 0
    hours: float  # running time since the part that was measured, sprocket or chain, was new [h]


@dataclass(frozen=True)
class RemainingLife:
    """What is left of the life of the part that was measured."""

    case: str  # of the case
    title: str  # of the case
    part: str  # `sprocket` or `chain`
    reading: SingleReading  # what was measured
    model_hours: float  # when the case's own coefficient gives that reading [h]
    factor: float  # the coefficient that the reading stands for over that of the case
    coefficient: float  # that the reading stands for, in the unit of the case's law
    life: Life | LowerBound  # from new, and from the reading on
    remaining: Life | LowerBound  # from new, and from the reading on
    # remaining_low, remaining_high: with the reading at the high and at the low end of its error
    remaining_low: Life | LowerBound
    remaining_high: Life | LowerBound
    assumptions: tuple[str, ...]  # what was taken for granted, and what the user should look at
    warnings: tuple[str, ...]  # what was taken for granted, and what the user should look at


@dataclass(frozen=True, eq=False)
class _PartHistory:
    """How a quantity grows with the case's own coefficient, up to the end of the life."""

    hours: Vector
    values: Vector
    life: Life | LowerBound
    coefficient: float
    assumptions: tuple[str, ...]
    warnings: tuple[str, ...]
    exponent: float  # of the hours in the wear, along which it is interpolated

    def hours_of(self, value: float) -> float:
        """Hours at which a value is first reached."""
        highest = np.maximum.accumulate(self.values)
        rising = np.concatenate([[True], highest[1:] > highest[:-1]])
        steady = np.interp(value, highest[rising], self.hours[rising] ** self.exponent)
        return float(steady ** (1.0 / self.exponent))


def read_part(case: Case | DriveCase, reading: SingleReading, sprocket: str | None) -> Case:
    """Return the case of what was read: the chain that all sprockets share, or the sprocket that is named."""
    if reading.quantity == ELONGATION:
        if sprocket is not None:
            raise _fault(reading, "is read of the chain, which all sprockets share: leave the sprocket out")
        return case.chain_case
    if isinstance(case, Case):
        if sprocket is not None:
            raise _fault(reading, "is read on the only sprocket of this case: leave its name out")
        return case
    cases = case.titled_cases()
    if sprocket not in cases:
        got = "" if sprocket is None else f" (got {sprocket!r})"
        names = ", ".join(map(repr, cases))
        raise _fault(reading, f"is read on the teeth of one sprocket: name it, one of {names}{got}")
    return cases[sprocket]


def from_size(case: Case, reading: SingleReading, new: float | None) -> SingleReading:
    """Return what a measurement over pins says: how much less it is than that of the new sprocket."""
    if not case.drive.wear_coefficients:
        raise _fault(reading, f"needs a chain that wraps the sprocket: {instead_of(case)}")
    whole = wrap_of(case).over_pins if new is None else new
    if not reading.value < whole:
        of = "by the case" if new is None else "as given"
        raise _fault(reading, f"must be less than that of the new sprocket, {whole:.4f} mm {of}")
    return replace(reading, value=whole - reading.value)


def remaining_life(
    case: Case, reading: SingleReading, progress: Callable[[float], None] = lambda part: None
) -> RemainingLife:
    """Return the life that remains after a reading in service.

    Wear depends on coefficient times time only. If the case's own coefficient k gives the
    reading after h_m hours and it was made after h, the coefficient is k h_m/h and the life
    is L h/h_m instead of L. Where wear goes with the cycles to a power b the life is the same, and the
    coefficient is k (h_m/h)^b. On a wrap the coefficients of teeth and joints change alike for a
    reading of the sprocket; a reading of the chain gives that of the joints alone. Exact as
    long as the coefficient does not change otherwise.
    """
    exponent = case.wear.cycles_exponent
    instead = (
        "give a table of readings, which takes it into account: of the chain to this command, of the teeth "
        "to wearsim calibrate"
    )
    check_steady_lubricant(case, "remaining", instead)
    if exponent == 1.0:
        check_no_running_in(case, "remaining")
    if not 0.0 < reading.error < reading.value:
        raise _fault(reading, f"must be larger than its error of {reading.error:g}: measure later or better")
    history = _chain(case, reading) if reading.quantity == ELONGATION else _teeth(case, reading, progress)
    greatest = float(history.values.max())
    reached = isinstance(history.life, Life)
    if reading.value > greatest * (1.0 + 1e-12):
        what = "the limit is reached" if reached else "the run ends at run.horizon_hours"
        raise _fault(reading, f"must be at most {greatest:.6g}, its value when {what}")
    model = history.hours_of(reading.value)
    low = history.hours_of(min(reading.value + reading.error, greatest))
    high = history.hours_of(reading.value - reading.error)
    factor = (model / reading.hours) ** exponent
    return RemainingLife(
        case=case.name,
        title=case.title,
        part="chain" if reading.quantity == ELONGATION else "sprocket",
        reading=reading,
        model_hours=model,
        factor=factor,
        coefficient=factor * history.coefficient,
        life=_stretched(history.life, reading.hours / model, 0.0),
        remaining=_stretched(history.life, reading.hours / model, reading.hours),
        remaining_low=_stretched(history.life, reading.hours / low, reading.hours),
        remaining_high=_stretched(history.life, reading.hours / high, reading.hours),
        assumptions=history.assumptions,
        warnings=(*history.warnings, *band_warning(factor, *_band(case, reading))),
    )


def _band(case: Case, reading: SingleReading) -> tuple[WearBand, str]:
    """Return the band of the coefficient that a reading gives, and what that is."""
    if reading.quantity == ELONGATION:
        return chain_band(case), JOINTS
    return case.drive.wear_band("sprocket", case.wear), TEETH


def _stretched(life: Life | LowerBound, stretch: float, gone: float) -> Life | LowerBound:
    """Return a life on another scale of time without the hours that have gone."""
    left = stretch * life.hours_run - gone
    left = left if left > 1e-9 * gone else 0.0
    return type(life)(life.cycles_run / life.hours_run * left, left)


def _fault(reading: SingleReading, message: str) -> CaseError:
    return CaseError([Fault(f"{reading.value:g} {message}", reading.quantity, "reading")])


def _chain(case: Case, reading: SingleReading) -> _PartHistory:
    """Elongation of a chain: linear in cycles of constant coefficient, so that no run is needed."""
    if not case.drive.wear_coefficients:
        raise _fault(reading, f"needs a chain that wraps the sprocket: {instead_of(case)}")
    drive = wrap_of(case)
    contact = drive.contact(case)
    [cycles] = chain_clock(case).running_cycles(np.array([contact.cycles_per_mate])).tolist()
    life = Life(cycles, cycles / case.cycles_per_hour)
    return _PartHistory(
        hours=np.array([0.0, life.hours]),
        values=np.array([0.0, 100.0 * contact.elongation_limit]),
        life=life,
        coefficient=drive.referred_here.joint.coefficient,
        assumptions=(*_CONSTANT, _where_it_holds(drive.referred_here.joint.law), *case.assumptions),
        warnings=case.warnings,
        exponent=case.wear.cycles_exponent,
    )


def _where_it_holds(law: JointLaw) -> str:
    """Say where the coefficient of joints holds, and how it gets into the case."""
    if law.is_constant:
        return (
            "given as joint.specific_wear_rate_mm2_per_N in the case, with joint.source, the coefficient "
            "reproduces this reading without a warning"
        )
    pressure, speed, pitch = law.reference
    return (
        f"the coefficient holds at {pressure:.4g} MPa, {speed:.4g} rpm and {pitch:.4g} mm pitch, elsewhere "
        "by joint.law = 'pressure_speed': wearsim calibrate --out writes the case with it"
    )


def _teeth(case: Case, reading: SingleReading, progress: Callable[[float], None]) -> _PartHistory:
    """Depth or measurement over pins of the sprocket."""
    result = simulate(case, progress)
    columns = result.history_columns
    if reading.quantity not in columns:
        raise _fault(reading, f"needs a sprocket with gaps: {instead_of(case)}")
    values = columns[reading.quantity]
    if reading.quantity == OVER_PINS:
        ambiguous = ambiguous_reading(values, reading.error)
        if ambiguous:
            raise _fault(reading, ambiguous)
        values = values[0] - values
    joints = ("the coefficient of the joints deviates by the same factor as that of the teeth",)
    return _PartHistory(
        hours=columns["time_hours"],
        values=values,
        life=result.parts.get("sprocket", result.life),
        coefficient=case.wear.coefficient,
        assumptions=(*_CONSTANT, *(joints if "chain" in result.parts else ()), *result.assumptions),
        warnings=result.warnings,
        exponent=case.wear.cycles_exponent,
    )
