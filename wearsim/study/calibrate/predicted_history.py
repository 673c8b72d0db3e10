"""How everything that can be measured goes on with one set of coefficients, on any scale of time."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from wearsim.geometry.measured.registration import feet
from wearsim.geometry.profile_points import Profile, Vector, chord_lengths
from wearsim.result import Life, WearResult

_SAME = 1e-9


@dataclass(frozen=True, eq=False)
class PredictedHistory:
    """A run until its limit; with other coefficients of the same ratios it is only stretched."""

    result: WearResult  # the run
    _over_time: dict[tuple[float, int], Vector] = field(default_factory=dict, init=False)

    @cached_property
    def hours(self) -> float:
        """Hours until the limit of the teeth [h]."""
        return self.result.parts.get("sprocket", self.result.life).hours_run

    @property
    def reached(self) -> bool:
        """Whether the limit is met before the horizon."""
        return isinstance(self.result.parts.get("sprocket", self.result.life), Life)

    @property
    def kinds(self) -> int:
        """Gaps that are told apart."""
        return int(self._depth.shape[1])

    @property
    def greatest(self) -> float:
        """Depth of the deepest point at the end [mm]."""
        return float(self._depth.max())

    @property
    def arc_length(self) -> Vector:
        """Places of the points along the new flank [mm]."""
        return self.result.flank_columns["arc_length_mm"][: self._depth.shape[2]]

    @cached_property
    def nominal(self) -> Profile:
        """The new flank."""
        x, y = self._outlines
        return Profile(x[0, 0], y[0, 0])

    def deepest(self, part: float, kind: int) -> float:
        """Return the depth of the deepest point of a gap."""
        return _on_line(part * self.hours, self._times, self._depth[:, kind - 1].max(axis=1))

    def depth_at(self, part: float, arc_length: float, kind: int) -> float:
        """Return the depth of a point."""
        place = arc_length, kind
        if place not in self._over_time:
            rows = self._depth[:, kind - 1]
            self._over_time[place] = np.array([np.interp(arc_length, self.arc_length, row) for row in rows])
        return _on_line(part * self.hours, self._times, self._over_time[place])

    def recess(self, part: float, kind: int) -> Vector:
        """Return how far the worn flank lies behind the new one, along the normals of that."""
        times, rows, hours = self._times, self._recess[:, kind - 1], part * self.hours
        after = int(np.clip(np.searchsorted(times, hours), 1, times.size - 1))
        share = (hours - times[after - 1]) / (times[after] - times[after - 1])
        return np.asarray(rows[after - 1] + share * (rows[after] - rows[after - 1]))

    @cached_property
    def chords(self) -> Vector:
        """Places of the points along the chords of the new flank [mm]."""
        return chord_lengths(self.nominal.x, self.nominal.y)

    def history(self, quantity: str, part: float) -> float:
        """Return a quantity of the history."""
        columns = self.result.history_columns
        return _on_line(part * self.hours, columns["time_hours"], columns[quantity])

    @cached_property
    def _times(self) -> Vector:
        columns = self.result.history_columns
        shots = np.unique(self.result.flank_columns["cycles"])
        return np.asarray(np.interp(shots, columns["cycles"], columns["time_hours"]))

    @cached_property
    def _depth(self) -> Vector:
        return self._flank("depth_mm")

    @cached_property
    def _outlines(self) -> tuple[Vector, Vector]:
        return self._flank("x_mm"), self._flank("y_mm")

    @cached_property
    def _recess(self) -> Vector:
        arc, recess = feet(self.nominal, *self._outlines)
        inside = (arc > _SAME) & (arc < self.chords[-1] - _SAME)
        found = np.empty_like(arc)
        for place in np.ndindex(arc.shape[:2]):
            on = inside[place]
            found[place] = np.interp(self.chords, arc[place][on], recess[place][on])
        return found

    def _flank(self, name: str) -> Vector:
        columns = self.result.flank_columns
        kinds = int(columns["gap_kind"].max()) if "gap_kind" in columns else 1
        shots = np.unique(columns["cycles"]).size
        return columns[name].reshape(shots, kinds, -1)


def _on_line(at: float, times: Vector, values: Vector) -> float:
    """Interpolate, and go on beyond the end as in the last interval."""
    if at <= times[-1]:
        return float(np.interp(at, times, values))
    rate = (values[-1] - values[-2]) / (times[-1] - times[-2])
    return float(values[-1] + rate * (at - times[-1]))
