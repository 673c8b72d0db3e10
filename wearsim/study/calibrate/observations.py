"""What coefficients say of every reading, over its error."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from wearsim.geometry.profile_points import Vector
from wearsim.readings.chain_readings import ELONGATION, NO_GO, side_of_mark
from wearsim.readings.posterior import log_probability
from wearsim.study.calibrate.history_interpolation import WeightedHistory
from wearsim.study.calibrate.lubricated_time import LubricatedTime
from wearsim.study.calibrate.predicted_history import PredictedHistory
from wearsim.study.calibrate.readings import DEEPEST, POINT, Reading


@dataclass(frozen=True)
class PredictedState:
    """A drive with one set of coefficients."""

    predicted: WeightedHistory | None  # how its teeth wear; None where that is not asked for
    life: float  # of the teeth [lubricated h], nan with that
    elongation_rate: float  # of its chain [%/lubricated h]
    time: LubricatedTime

    def part(self, hours: float) -> float:
        """Return which part of the life of the teeth has gone after so many hours run."""
        return self.time.lubricated(hours) / self.life

    def elongation(self, hours: float) -> float:
        """Return the elongation of the chain after so many hours run [%]."""
        return self.elongation_rate * self.time.lubricated(hours)


@dataclass(frozen=True)
class ReadingResidual:
    """One value as it was measured and as it is predicted."""

    row: int  # line of the reading in its file
    hours: float  # running time [h]
    quantity: str  # what it is
    arc_length: float  # where on the flank [mm], nan for what has no place
    value: float  # in the unit of the quantity, the error as standard deviation
    predicted: float  # in the unit of the quantity, the error as standard deviation
    error: float  # in the unit of the quantity, the error as standard deviation
    residual: float  # predicted less measured over the error, those of one profile made independent


class Observation(Protocol):
    """A reading that a state can be held against."""

    @property
    def reading(self) -> Reading:
        """What was measured."""

    @property
    def freedom(self) -> int:
        """Independent values less what registration takes."""

    @property
    def left_out(self) -> int:
        """Points that could not be used."""

    def residuals(self, state: PredictedState) -> Vector:
        """Return independent residuals of size 1."""

    def shown(self, state: PredictedState) -> list[ReadingResidual]:
        """Return the values beside their predictions."""


@dataclass(frozen=True, eq=False)
class GaugeReading:
    """One measured value."""

    reading: Reading  # the reading

    @property
    def freedom(self) -> int:
        """One value."""
        return 1

    @property
    def left_out(self) -> int:
        """No points."""
        return 0

    def predicted(self, state: PredictedState) -> float:
        """Return what the reading should be, in its unit."""
        if self.reading.quantity == ELONGATION:
            return state.elongation(self.reading.hours)
        assert state.predicted is not None
        part = state.part(self.reading.hours)
        return state.predicted.mean(lambda one: self._of_teeth(one, part))

    def _of_teeth(self, predicted: PredictedHistory, part: float) -> float:
        reading = self.reading
        if reading.quantity == DEEPEST and reading.gap_kind is not None:
            return predicted.deepest(part, reading.gap_kind)
        if reading.quantity == DEEPEST:
            return predicted.history(DEEPEST, part)
        if reading.quantity == POINT:
            return predicted.depth_at(part, reading.arc_length, reading.gap_kind or 1)
        return predicted.history(reading.quantity, 0.0) - predicted.history(reading.quantity, part)

    def residuals(self, state: PredictedState) -> Vector:
        """Return independent residuals of size 1."""
        return np.array([(self.predicted(state) - self.reading.value) / self.reading.error])

    def shown(self, state: PredictedState) -> list[ReadingResidual]:
        """Return the value beside its prediction."""
        reading, predicted = self.reading, self.predicted(state)
        return [
            ReadingResidual(
                reading.row,
                reading.hours,
                reading.quantity,
                reading.arc_length,
                reading.value,
                predicted,
                reading.error,
                (predicted - reading.value) / reading.error,
            )
        ]


@dataclass(frozen=True, eq=False)
class GoNoGoReading:
    """A side of the mark of a gauge: its probability takes the place of a density.

    The square of the residual is -2 ln of it, so that the sum of squares stays -2 ln of the likelihood
    but for a constant.
    """

    reading: Reading  # the reading

    @property
    def freedom(self) -> int:
        """None: a side of a mark fixes no value, unless the fit misses it."""
        return 0

    @property
    def left_out(self) -> int:
        """No points."""
        return 0

    def misses(self, state: PredictedState) -> bool:
        """Whether the elongation lies on the wrong side of the mark, which then counts as a value."""
        below = state.elongation(self.reading.hours) < self.reading.value
        return below == (self.reading.result == NO_GO)

    def residuals(self, state: PredictedState) -> Vector:
        """Return the residual, not negative."""
        reading = self.reading
        predicted = np.array([state.elongation(reading.hours)])
        side = side_of_mark(reading.row, reading.hours, reading.value, reading.result, reading.error)
        return np.sqrt(-2.0 * log_probability(side, predicted))

    def shown(self, state: PredictedState) -> list[ReadingResidual]:
        """Return the mark beside the prediction."""
        reading, predicted = self.reading, state.elongation(self.reading.hours)
        return [
            ReadingResidual(
                reading.row,
                reading.hours,
                reading.quantity,
                reading.arc_length,
                reading.value,
                predicted,
                reading.error,
                float(self.residuals(state)[0]),
            )
        ]
