"""How everything that can be measured goes on with one set of coefficients, on any scale of time."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from wearsim.case.load import load_case
from wearsim.geometry.profile import Profile, Vector
from wearsim.geometry.registration import feet
from wearsim.result import Life, WearResult
from wearsim.simulation import simulate
from wearsim.study.runner.design import replaced

_SAME = 1e-9

_SPACING = 0.05
"""Of the logarithms of values that are run."""


@dataclass(frozen=True, eq=False)
class Course:
    """A run until its limit; with other coefficients of the same ratios it is only stretched.

    Attributes
    ----------
    result : WearResult
        The run.
    """

    result: WearResult
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
    def most(self) -> float:
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

    def depth_at(self, part: float, arc_length: float, kind: int) -> float:
        """Return the depth of a point.

        Parameters
        ----------
        part : float
            Time as a part of the life; beyond 1 the last rate goes on.
        arc_length : float
            Place along the new flank [mm].
        kind : int
            Number of the gap from 1.

        Returns
        -------
        float
            Depth [mm].
        """
        place = arc_length, kind
        if place not in self._over_time:
            rows = self._depth[:, kind - 1]
            self._over_time[place] = np.array(
                [np.interp(arc_length, self.arc_length, row) for row in rows]
            )
        return _on_line(part * self.hours, self._times, self._over_time[place])

    def recess(self, part: float, kind: int) -> Vector:
        """Return how far the worn flank lies behind the new one, along the normals of that.

        Parameters
        ----------
        part : float
            Time as a part of the life; beyond 1 the last rate goes on.
        kind : int
            Number of the gap from 1.

        Returns
        -------
        numpy.ndarray
            At `chords` [mm].
        """
        times, rows, hours = self._times, self._recess[:, kind - 1], part * self.hours
        after = int(np.clip(np.searchsorted(times, hours), 1, times.size - 1))
        share = (hours - times[after - 1]) / (times[after] - times[after - 1])
        return np.asarray(rows[after - 1] + share * (rows[after] - rows[after - 1]))

    @cached_property
    def chords(self) -> Vector:
        """Places of the points along the chords of the new flank [mm]."""
        steps = np.hypot(np.diff(self.nominal.x), np.diff(self.nominal.y))
        return np.concatenate([[0.0], np.cumsum(steps)])

    def history(self, quantity: str, part: float) -> float:
        """Return a quantity of the history.

        Parameters
        ----------
        quantity : str
            Column of history.csv.
        part : float
            Time as a part of the life; beyond 1 the last rate goes on.

        Returns
        -------
        float
            In the unit of the column.
        """
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
        x, y = self._outlines
        found = np.empty_like(x)
        for place in np.ndindex(x.shape[:2]):
            arc, recess = feet(self.nominal, x[place], y[place])
            inside = (arc > _SAME) & (arc < self.chords[-1] - _SAME)
            found[place] = np.interp(self.chords, arc[inside], recess[inside])
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


@dataclass(frozen=True)
class Blend:
    """Courses of neighbouring values, taken together at equal parts of their lives.

    Attributes
    ----------
    shares : tuple of (float, Course)
        They sum to 1.
    """

    shares: tuple[tuple[float, Course], ...]

    @property
    def hours(self) -> float:
        """Hours until the limit of the teeth [h]."""
        return math.exp(math.fsum(share * math.log(one.hours) for share, one in self.shares))

    @property
    def new(self) -> Course:
        """One of them, for all that does not depend on the wear."""
        return self.shares[0][1]

    def depth_at(self, part: float, arc_length: float, kind: int) -> float:
        """Return the depth of a point as `Course` does."""
        return math.fsum(share * one.depth_at(part, arc_length, kind) for share, one in self.shares)

    def recess(self, part: float, kind: int) -> Vector:
        """Return how far the worn flank lies behind the new one as `Course` does."""
        return np.asarray(sum(share * one.recess(part, kind) for share, one in self.shares))

    def history(self, quantity: str, part: float) -> float:
        """Return a quantity of the history as `Course` does."""
        return math.fsum(share * one.history(quantity, part) for share, one in self.shares)


class Courses:
    """Courses by the values of keys, run where they are needed.

    They are run for the values of the case times powers of exp(0.05); in between they are
    interpolated, which for the depth of a point is good to 1e-4 of it.

    Parameters
    ----------
    tables : mapping
        Of the case.
    """

    def __init__(self, tables: Mapping[str, Any]) -> None:
        self._tables = tables
        self._found: dict[tuple[tuple[str, float], ...], Course] = {}

    @property
    def runs(self) -> int:
        """Runs so far."""
        return len(self._found)

    def blend(self, given: Mapping[str, float], logs: Mapping[str, float]) -> Blend:
        """Return the course with other values of some keys.

        Parameters
        ----------
        given : mapping of str to float
            Values by dotted key.
        logs : mapping of str to float
            Logarithms of factors on some of them.

        Returns
        -------
        Blend
            Of two courses for every logarithm between the powers.

        Raises
        ------
        WearsimError
            The case cannot be run with them.
        """
        corners: list[tuple[float, dict[str, float]]] = [(1.0, dict(given))]
        for key, log in logs.items():
            below = math.floor(log / _SPACING)
            share = log / _SPACING - below
            steps = [(1.0 - share, below), (share, below + 1)] if share else [(1.0, below)]
            corners = [
                (part * weight, {**values, key: given[key] * math.exp(_SPACING * step)})
                for part, values in corners
                for weight, step in steps
            ]
        return Blend(tuple((share, self._at(values)) for share, values in corners))

    def _at(self, values: Mapping[str, float]) -> Course:
        key = tuple(sorted(values.items()))
        if key not in self._found:
            tables = self._tables
            for name, value in key:
                tables = replaced(tables, name.split("."), value)
            self._found[key] = Course(simulate(load_case(tables)))
        return self._found[key]
