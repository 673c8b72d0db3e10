"""The coefficients that are fitted, and the state of the drive that a set of them means."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from wearsim.case.model import Case
from wearsim.catalogue.own_wear_laws import own_wear_laws
from wearsim.geometry.profile_points import Vector
from wearsim.runner.design import value_at
from wearsim.study.calibrate.history_interpolation import (
    LogInterpolation,
    PredictedHistories,
    WeightedHistory,
)
from wearsim.study.calibrate.lubricated_time import LubricatedTime
from wearsim.study.calibrate.observations import PredictedState

JOINT, JOINT_SOURCE = "joint.specific_wear_rate_mm2_per_N", "joint.source"
EXPONENT = "wear.pressure_exponent"
SLIP = "mechanism.roller_slip_fraction"

SHAPES = {EXPONENT: (0.2, 5.0), SLIP: (1e-3, 1.0)}
"""Keys of any case that can be fitted besides the coefficients, and their bounds."""

_WIDE = math.log(1e6)
"""Logarithm of the factor within which coefficients are searched."""

BEYOND = 0.25
"""Part of its life by which a reading may lie beyond the limit; the last rate goes on so far."""


@dataclass(frozen=True, eq=False)
class FitParameters:
    """The logarithms that are fitted.

    The first one stands for the coefficient of the teeth where that is fitted; it is the
    logarithm of the life of the teeth, which the data know far better than a coefficient whose
    meaning changes with the others (physics: life times coefficient is constant).
    """

    predictions: PredictedHistories  # runs of the case
    coefficient: float  # that of the teeth in the case
    joint: float  # that of the joints in the case; nan where no chain wears
    elongation_rate: float  # of the chain with that [%/lubricated h]; nan where no chain wears
    teeth: bool  # whether the coefficients of the teeth and of the joints are fitted
    chain: bool  # whether the coefficients of the teeth and of the joints are fitted
    shapes: Mapping[str, float]  # keys that are fitted besides, with their values in the case
    ranges: Mapping[str, tuple[float, float]]  # bounds of such keys
    last: float  # of the last reading of the teeth [lubricated h]; nan where there is none
    time: LubricatedTime
    # coefficient of the joints over that of the teeth in the runs, as a factor of that in the case
    ratio: float

    @property
    def size(self) -> int:
        """Number of the parameters."""
        return self.teeth + self.chain + len(self.shapes)

    @cached_property
    def bounds(self) -> tuple[Vector, Vector]:
        """Bounds of the logarithms; those of the life of the teeth come from the last reading."""
        earliest = math.log(self.last / (1.0 + BEYOND)) if self.teeth else math.nan
        rates = [(earliest, earliest + _WIDE)] * self.teeth + [(-_WIDE, _WIDE)] * self.chain
        low, high = zip(*rates, *self._shape_bounds(), strict=True)
        return np.array(low), np.array(high)

    def _shape_bounds(self) -> list[tuple[float, float]]:
        ends = [(value, *self.ranges[key]) for key, value in self.shapes.items()]
        return [(min(math.log(low / at), 0.0), max(math.log(high / at), 0.0)) for at, low, high in ends]

    @property
    def start(self) -> Vector:
        """The logarithms of the case."""
        point = np.zeros(self.size)
        if self.teeth:
            low, high = self.bounds
            hours = math.log(self.predicted(point).hours)
            point[0] = min(max(hours, low[0]), high[0])
        return point

    def predicted(self, point: Vector) -> WeightedHistory:
        """Return the wear of the teeth that a set of logarithms needs."""
        given = dict(self.shapes)
        if self.ratio != 1.0:
            given[JOINT] = self.ratio * self.joint
        values = point[self.teeth + self.chain :].tolist()
        ends = zip(self.shapes, values, self._shape_bounds(), strict=True)
        return self.predictions.weighted(
            given, {key: LogInterpolation(log, *bounds) for key, log, bounds in ends}
        )

    def state(self, point: Vector) -> PredictedState:
        """Return the drive that a set of logarithms means."""
        joints = math.exp(point[int(self.teeth)]) if self.chain else 1.0
        rate = joints * self.elongation_rate
        if not self.teeth:
            return PredictedState(None, math.nan, rate, self.time)
        return PredictedState(self.predicted(point), math.exp(point[0]), rate, self.time)

    def swapped(self, point: Vector) -> Vector:
        """Return logarithms with the coefficient of the teeth for their life, or the other way round."""
        if not self.teeth:
            return point
        return np.array([math.log(self.predicted(point).hours) - point[0], *point[1:]])

    def bounds_of_coefficients(self) -> tuple[Vector, Vector]:
        """Return bounds of the logarithms of all values over those of the case."""
        low, high = (bound.copy() for bound in self.bounds)
        if self.teeth:
            low[0], high[0] = -4.0 * _WIDE, 4.0 * _WIDE
        return low, high


def shape_ranges(case: Case) -> dict[str, tuple[float, float]]:
    """Return the keys that can be fitted besides the coefficients, with their bounds."""
    own = own_wear_laws().get(case.wear.law)
    constants = own.constants if own is not None else {}
    fitted = {f"wear.constants.{name}": one.fitted for name, one in constants.items()}
    return {**SHAPES, **{key: bounds for key, bounds in fitted.items() if bounds is not None}}


def shape_values(case: Case) -> dict[str, float]:
    """Return the values of the keys that can be fitted besides the coefficients."""
    found = {key: value_at(case.inputs, key) for key in shape_ranges(case)}
    return {key: float(value) for key, value in found.items() if value is not None}
