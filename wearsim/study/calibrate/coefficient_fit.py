"""The fit of one case to its readings."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from wearsim.case.model import Case
from wearsim.chain.joint_wear import JointLaw
from wearsim.drive.wrap_life import wrap_of
from wearsim.errors import CaseError, Fault, GeometryError
from wearsim.geometry.profile_points import Vector
from wearsim.lubrication.keys import SCHEDULES
from wearsim.quantities import grouped
from wearsim.readings.chain_readings import GAUGE
from wearsim.runner.design import replaced
from wearsim.runner.scatter import coefficient_key
from wearsim.study.calibrate.calibration import Calibration, CalibrationOptions, FittedCoefficient, PartLife
from wearsim.study.calibrate.fit_warnings import (
    fit_assumptions,
    fit_warnings,
    warnings_of_readings,
    warnings_of_runs,
)
from wearsim.study.calibrate.history_interpolation import PredictedHistories
from wearsim.study.calibrate.least_squares import (
    LeastSquaresFit,
    LeastSquaresProblem,
    fit_least_squares,
    profile_interval,
    stated_at,
)
from wearsim.study.calibrate.lubricated_time import LubricatedTime
from wearsim.study.calibrate.measured_profiles import ProfileObservation, observation
from wearsim.study.calibrate.observations import GoNoGoReading, Observation, PredictedState
from wearsim.study.calibrate.parameters import JOINT, JOINT_SOURCE, FitParameters, shape_ranges, shape_values
from wearsim.study.calibrate.reading_checks import reading_faults
from wearsim.study.calibrate.readings import PROFILE, Reading

_FOREVER = 1e15
"""Horizon of the runs [h]: the limit must be reached, as all times are scaled."""

_SAME_RATIO = 2e-3
"""Relative change of the ratio of both coefficients that a run is not repeated for."""

_SETTLED, _MAX_ROUNDS = 1e-4, 20

_ENOUGH = 2.0
"""Horizon of the calibrated case over its life, at least."""

_AT_END = 0.1
"""How near the logarithm of a life may come to an end of those that are searched."""

_POINTS = 400
"""Times at which the elongation of the fit is told."""

_TRIED = 45
"""Lives that the search starts from, about a factor of 2 apart."""


class CaseFit:
    """The fit of one case."""

    def __init__(
        self,
        case: Case,
        tables: Mapping[str, Any],
        readings: Sequence[Reading],
        options: CalibrationOptions,
        time: LubricatedTime,
    ) -> None:
        self.tables, self.time = tables, time
        self.case, self.readings, self.options, self.file = case, readings, options, time.log.file
        chain = any(reading.of_chain for reading in readings)
        joint, rate, self.chain_hours = _joints(case)
        self.parameters = FitParameters(
            predictions=PredictedHistories(
                replaced(tables, ("run", "horizon_hours"), _FOREVER), options.sprocket
            ),
            coefficient=case.wear.coefficient,
            joint=joint,
            elongation_rate=rate,
            teeth=any(not reading.of_chain for reading in readings),
            chain=chain,
            shapes={key: shape_values(case)[key] for key in options.shapes},
            ranges=shape_ranges(case),
            last=max((time.lubricated(one.hours) for one in readings if not one.of_chain), default=math.nan),
            time=time,
            ratio=1.0,
        )
        self.settled = True
        self.observations = self._observed(None)
        self.freedom = sum(one.freedom for one in self.observations) - self.parameters.size
        gauges = any(reading.quantity == GAUGE for reading in readings)
        if self.freedom < 0:
            text = (
                f"must hold at least as many independent values as are fitted, {self.parameters.size}, "
                f"but holds {self.freedom + self.parameters.size}: measure more, or fit less"
                + (" (a gauge fixes no value, but wearsim remaining takes it alone)" if gauges else "")
            )
            raise CaseError([Fault(text, "", self.file)])

    @property
    def teeth_follow(self) -> bool:
        """Whether the teeth take the factor of the chain."""
        return self.parameters.chain and not self.parameters.teeth and self.options.teeth == "chain"

    def calibration(self) -> Calibration:
        """Return the whole answer."""
        found = self._fit()
        self._check_reached(found)
        values, correlation = self._values(found)
        state = self.parameters.state(found.point)
        shown = tuple(row for one in self.observations for row in one.shown(state))
        parts = self._parts(found, values)
        return Calibration(
            case=self.case,
            options=self.options,
            values=values,
            parts=parts,
            chi_square=found.chi_square,
            freedom=self.freedom,
            scale=found.scale,
            readings=len(self.readings),
            relubrications=self.time.log,
            moves=tuple(one.moved for one in self.observations if isinstance(one, ProfileObservation)),
            shown=shown,
            chain_course=self._chain_course(state),
            runs=self.parameters.predictions.runs,
            tables=self._fitted_tables(values, parts),
            assumptions=(
                *fit_assumptions(self.case, self.readings, self.options, self.time.log),
                *self.case.assumptions,
            ),
            warnings=(
                *warnings_of_readings(self.observations, state),
                *fit_warnings(
                    self.case, values, correlation, found, self.observations, self.freedom, self.options
                ),
                *self.time.log.warnings(self.case.lubrication),
                *warnings_of_runs(self.settled, self.parameters.predictions.numerical_error, parts),
            ),
        )

    def _chain_course(self, state: PredictedState) -> tuple[Vector, Vector]:
        """Return the elongation [%] over the time of the readings of the chain [h]."""
        if not self.parameters.chain:
            return np.empty(0), np.empty(0)
        hours = np.linspace(0.0, self._last(teeth=False), _POINTS)
        return hours, np.array([state.elongation(one) for one in hours.tolist()])

    def _observed(self, state: PredictedState | None) -> list[Observation]:
        """Return the readings, profiles registered by what is known of the wear."""
        options, parameters = self.options, self.parameters
        new = parameters.predicted(np.zeros(parameters.size)).new if parameters.teeth else None
        found, faults = [], []
        for reading in self.readings:
            wrong = []
            if new is not None and not reading.of_chain:
                wrong = reading_faults(reading, new)
            try:
                if not wrong:
                    found.append(observation(reading, new, options.freedom, options.cutoff, state))
            except GeometryError as error:
                wrong.append(str(error))
            faults += [Fault(text, "", self.file, reading.row) for text in wrong]
        if faults:
            raise CaseError(faults)
        return found

    def _fit(self) -> LeastSquaresFit:
        """Fit again until registration and the ratio of both coefficients go with what comes out."""
        found = fit_least_squares(self._problem(), self._nearest(self.parameters.start))
        for _ in range(_MAX_ROUNDS):
            before = found.point
            again = self._follow(before)
            if not again:
                break
            found = fit_least_squares(self._problem(), before)
            if float(np.abs(found.point - before).max()) < _SETTLED:
                break
        else:
            self.settled = False
        return self._with_missed_gauges(found)

    def _with_missed_gauges(self, found: LeastSquaresFit) -> LeastSquaresFit:
        """Return a fit to which each gauge on the wrong side of its mark adds a degree of freedom."""
        state = self.parameters.state(found.point)
        self.freedom += sum(isinstance(one, GoNoGoReading) and one.misses(state) for one in self.observations)
        return stated_at(self._problem(), found.point)

    def _follow(self, point: Vector) -> bool:
        """Take up what a fit says about the runs and the registration; whether it matters."""
        parameters = self.parameters
        ratio = self._ratio(point) if parameters.teeth and parameters.chain else 1.0
        moved = abs(math.log(ratio / parameters.ratio)) > _SAME_RATIO
        if moved:
            self.parameters = replace(parameters, ratio=ratio)
        scanned = any(reading.quantity == PROFILE for reading in self.readings)
        if scanned:
            self.observations = self._observed(self.parameters.state(point))
        return moved or scanned

    def _ratio(self, point: Vector) -> float:
        coefficient, joints, *_ = self.parameters.swapped(point)
        return math.exp(joints - coefficient)

    def _nearest(self, point: Vector) -> Vector:
        """Return a start whose life is nearest to the readings, which costs no runs."""
        if not self.parameters.teeth:
            return point
        problem = self._problem()
        low, high = problem.low, problem.high
        tried = [np.array([life, *point[1:]]) for life in np.linspace(low[0], high[0], _TRIED)]
        squares = [float(np.sum(problem.residuals(one) ** 2)) for one in tried]
        return tried[int(np.argmin(squares))]

    def _problem(self) -> LeastSquaresProblem:
        return self._restated(lambda point: point, self.parameters.bounds)

    def _last(self, teeth: bool) -> float:
        """Hours of the last reading of the teeth or of the chain [h]."""
        return max((one.hours for one in self.readings if one.of_chain != teeth), default=math.nan)

    def _restated(
        self, point_of: Callable[[Vector], Vector], bounds: tuple[Vector, Vector]
    ) -> LeastSquaresProblem:
        parameters, observations = self.parameters, self.observations

        def residuals(logs: Vector) -> Vector:
            state = parameters.state(point_of(logs))
            return np.concatenate([one.residuals(state) for one in observations])

        return LeastSquaresProblem(residuals, *bounds, self.freedom)

    def _check_reached(self, found: LeastSquaresFit) -> None:
        """Raise where the best life is only an end of those that were searched."""
        if not self.parameters.teeth:
            return
        low, high = self.parameters.bounds
        if found.point[0] < low[0] + _AT_END:
            text = (
                f"must not lie more than a quarter of the life beyond the limit, but the readings until "
                f"{self._last(teeth=True):g} h do: raise the limits of [stop]"
            )
            raise CaseError([Fault(text, "time_hours", self.file)])
        if found.point[0] > high[0] - _AT_END:
            least = profile_interval(self._problem(), found, 0, self.options.confidence)
            life = self.time.running(math.exp(least.low))
            text = (
                f"must show wear, but go with none: the life is at least {grouped(life)} h "
                f"({100 * self.options.confidence:g} %); measure later or better"
            )
            raise CaseError([Fault(text, "value", self.file)])

    def _values(self, found: LeastSquaresFit) -> tuple[tuple[FittedCoefficient, ...], Vector]:
        """Return the values with their intervals, and their correlations."""
        parameters = self.parameters
        problem = self._restated(parameters.swapped, parameters.bounds_of_coefficients())
        stated = stated_at(problem, parameters.swapped(found.point))
        given = {}
        if parameters.teeth:
            given[coefficient_key(self.case)] = parameters.coefficient
        if parameters.chain:
            given[JOINT] = wrap_of(self.case).referred_here.joint.coefficient
        given |= parameters.shapes
        holds = _where_rates_hold(self.case)
        values = []
        for index, (key, start) in enumerate(given.items()):
            interval = profile_interval(problem, stated, index, self.options.confidence)
            value = start * math.exp(stated.point[index])
            values.append(FittedCoefficient(key, value, start, interval.scaled(start), holds.get(key, "")))
        return tuple(values), stated.correlation

    def _fitted_tables(
        self, values: Sequence[FittedCoefficient], parts: Sequence[PartLife]
    ) -> Mapping[str, Any]:
        """Tables of the case with the values, the bands of known coefficients, and enough time."""
        tables = self._tables_here() if JOINT in self.case.drive.wear_coefficients else self.tables
        banded = {JOINT} if self.parameters.shapes else {JOINT, coefficient_key(self.case)}
        for one in values:
            tables = replaced(tables, one.key.split("."), one.value)
            if one.key in banded and one.interval.known:
                band = max(one.interval.high / one.value, one.value / one.interval.low)
                tables = replaced(tables, (one.key.partition(".")[0], "band_factor"), band)
        if self.parameters.chain:
            tables = replaced(tables, JOINT_SOURCE.split("."), self._source())
        if self.teeth_follow:
            (joints,) = values
            teeth = joints.value / joints.in_case * self.parameters.coefficient
            tables = replaced(tables, coefficient_key(self.case).split("."), teeth)
        longest = max(part.life for part in parts)
        horizon = max(self.case.run.horizon_hours, _ENOUGH * longest)
        if self.time.log.hours:
            given = {key: value for key, value in tables["lubrication"].items() if key not in SCHEDULES}
            tables = {**tables, "lubrication": {**given, **self.time.log.schedule}}
        return replaced(tables, ("run", "horizon_hours"), horizon)

    def _tables_here(self) -> Mapping[str, Any]:
        """Tables of a wrap whose rate of joints is told by where they run; of what is not fitted its band."""
        tables, here = self.tables, wrap_of(self.case).referred_here
        if not self.parameters.teeth and "condition" in tables["wear"]:
            key = coefficient_key(self.case).partition(".")[2]
            of_teeth = {name: value for name, value in tables["wear"].items() if name != key}
            tables = {**tables, "wear": of_teeth}
        for key, setting in {**here.wear_coefficients, **here.wear_settings}.items():
            tables = replaced(tables, key.split("."), setting)
        low, high = here.joint.band[:2]
        return replaced(tables, ("joint", "band_factor"), max(high, 1.0 / low))

    def _source(self) -> str:
        """Say where the coefficient of the joints comes from."""
        count = sum(one.of_chain for one in self.readings)
        return f"wearsim calibrate, {count} reading{'s' if count > 1 else ''} in {Path(self.file).name}"

    def _parts(self, found: LeastSquaresFit, values: Sequence[FittedCoefficient]) -> tuple[PartLife, ...]:
        parts = []
        if self.parameters.teeth:
            interval = profile_interval(self._problem(), found, 0, self.options.confidence).scaled(1.0)
            name = "pinion" if "gear" in self.case.inputs else "sprocket"
            life = self.time.running(math.exp(found.point[0]))
            parts.append(PartLife(name, self._last(teeth=True), life, interval.mapped(self.time.running)))
        if self.parameters.chain:
            (joints,) = (value for value in values if value.key == JOINT)
            whole = self.chain_hours * joints.in_case
            hours, interval = self._last(teeth=False), joints.interval.inverse(whole)
            life = self.time.running(whole / joints.value)
            parts.append(PartLife("chain", hours, life, interval.mapped(self.time.running)))
        return tuple(parts)


def _where_rates_hold(case: Case) -> Mapping[str, str]:
    """Say where the coefficients of a wrap hold, of those that change with pressure, speed and pitch."""
    if JOINT not in case.drive.wear_coefficients:
        return {}
    joint = wrap_of(case).referred_here.joint
    found = {}
    if not joint.law.is_constant:
        found[JOINT] = f"{_at(joint.law)}, elsewhere by joint.law = 'pressure_speed'"
    if joint.tooth_law is not None:
        found[coefficient_key(case)] = f"{_at(joint.tooth_law)} beside wear.condition, elsewhere by joint.law"
    return found


def _at(law: JointLaw) -> str:
    pressure, speed, pitch = law.reference
    return f"at {pressure:.4g} MPa, {speed:.4g} rpm and {pitch:.4g} mm pitch"


def _joints(case: Case) -> tuple[float, float, float]:
    """Coefficient of the joints, elongation a hour [%/h] and hours of a chain with it."""
    if JOINT not in case.drive.wear_coefficients:
        return math.nan, math.nan, math.nan
    contact = wrap_of(case).contact(case)
    hours = contact.cycles_per_mate / case.cycles_per_hour
    return case.drive.wear_coefficients[JOINT], 100.0 * contact.elongation_limit / hours, hours
