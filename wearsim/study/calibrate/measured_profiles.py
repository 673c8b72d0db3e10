"""Measured profiles as observations."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from wearsim.geometry.measured.registration import UNSEEN, Freedom, RegisteredProfile, register
from wearsim.geometry.measured.surface_filter import filter_stations, gaussian_weights
from wearsim.geometry.profile_points import Vector
from wearsim.readings.chain_readings import GAUGE
from wearsim.study.calibrate.observations import (
    GaugeReading,
    GoNoGoReading,
    Observation,
    PredictedState,
    ReadingResidual,
)
from wearsim.study.calibrate.predicted_history import PredictedHistory
from wearsim.study.calibrate.readings import PROFILE, Reading


def observation(
    reading: Reading,
    new: PredictedHistory | None,
    freedom: Freedom,
    cutoff: float,
    state: PredictedState | None = None,
) -> Observation:
    """Return a reading as something that a state can be held against."""
    if reading.quantity != PROFILE:
        return GoNoGoReading(reading) if reading.quantity == GAUGE else GaugeReading(reading)
    assert new is not None
    expected = None if state is None else _recess(reading, state)
    registered = register(new.nominal, reading.x, reading.y, freedom, expected)
    return ProfileObservation(reading, registered, cutoff)


@dataclass(frozen=True, eq=False)
class ProfileObservation:
    """A measured profile, registered and smoothed; the model is smoothed and moved alike.

    The smoothed values v = W p of points p with independent errors sigma have the covariance
    sigma^2 W W^T = L L^T: residuals are L^-1 (W p_model - v), less what a movement of the
    points could explain.
    """

    reading: Reading  # the reading
    registered: RegisteredProfile  # its points on the new flank
    cutoff: float  # cut-off wavelength [mm]

    @cached_property
    def stations(self) -> Vector:
        """Places of the smoothed values [mm]."""
        return filter_stations(self.registered.arc_length, self.cutoff)

    @property
    def freedom(self) -> int:
        """Independent values less what registration takes."""
        return int(self.stations.size - self._explained.shape[1])

    @property
    def moved(self) -> tuple[int, float, float, float]:
        """Line of the reading, and how its points were moved: turn [rad], shifts [mm]."""
        found = self.registered
        return self.reading.row, found.turn, found.shift_x, found.shift_y

    @property
    def left_out(self) -> int:
        """Points beyond the ends of the flank."""
        return self.registered.left_out

    @cached_property
    def _weights(self) -> Vector:
        return gaussian_weights(self.registered.arc_length, self.stations, self.cutoff)

    @cached_property
    def _errors(self) -> Vector:
        """Standard deviations of the smoothed values [mm]."""
        return np.asarray(self.reading.error * np.sqrt((self._weights**2).sum(axis=1)))

    @cached_property
    def _whiten(self) -> Callable[[Vector], Vector]:
        covariance = self.reading.error**2 * self._weights @ self._weights.T
        inverse = np.linalg.inv(np.linalg.cholesky(covariance))
        return lambda values: np.asarray(inverse @ values)

    @cached_property
    def _explained(self) -> Vector:
        """Orthonormal residuals that movements cause."""
        moves = self._whiten(self._weights @ self.registered.moves)
        ways, size, _ = np.linalg.svd(moves, full_matrices=False)
        return np.asarray(ways[:, size > UNSEEN * size.max(initial=0.0)])

    def _smoothed(self, state: PredictedState) -> tuple[Vector, Vector]:
        """Measured and predicted recess at the stations [mm]."""
        assert state.predicted is not None
        chords = state.predicted.new.chords
        predicted = np.interp(self.registered.arc_length, chords, _recess(self.reading, state))
        return self._weights @ self.registered.recess, self._weights @ predicted

    def residuals(self, state: PredictedState) -> Vector:
        """Return independent residuals of size 1."""
        measured, predicted = self._smoothed(state)
        whole = self._whiten(predicted - measured)
        return np.asarray(whole - self._explained @ (self._explained.T @ whole))

    def shown(self, state: PredictedState) -> list[ReadingResidual]:
        """Return the smoothed values, moved as fits best, beside their predictions."""
        measured, predicted = self._smoothed(state)
        moves = self._weights @ self.registered.moves
        moved = np.linalg.lstsq(self._whiten(moves), self._whiten(predicted - measured), rcond=None)[0]
        reading, columns = self.reading, (self.stations, measured + moves @ moved, predicted)
        rows = zip(*columns, self._errors, self.residuals(state), strict=True)
        return [
            ReadingResidual(reading.row, reading.hours, PROFILE, *(float(value) for value in row))
            for row in rows
        ]


def _recess(reading: Reading, state: PredictedState) -> Vector:
    """How far the worn flank lies behind the new one at the time of a profile [mm]."""
    assert state.predicted is not None
    part, kind = state.part(reading.hours), reading.gap_kind or 1
    return state.predicted.mean(lambda one: one.recess(part, kind))
