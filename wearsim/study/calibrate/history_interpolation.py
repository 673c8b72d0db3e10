"""Courses for any values of keys, from those that are run."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from wearsim.drive.drive_case import DriveCase
from wearsim.drive.load_case import load_case
from wearsim.drive.part_life import simulate
from wearsim.errors import ConvergenceError
from wearsim.geometry.profile_points import Vector
from wearsim.runner.design import replaced
from wearsim.study.calibrate.predicted_history import PredictedHistory

Taken = TypeVar("Taken", float, Vector)

_SPACING = 0.05
"""Of the logarithms of values that are run."""


@dataclass(frozen=True)
class WeightedHistory:
    """Courses of neighbouring values, taken together at equal parts of their lives."""

    shares: tuple[tuple[float, PredictedHistory], ...]  # they sum to 1

    @property
    def hours(self) -> float:
        """Hours until the limit of the teeth [h]."""
        return math.exp(self.mean(lambda one: math.log(one.hours)))

    @property
    def new(self) -> PredictedHistory:
        """One of them, for all that does not depend on the wear."""
        return self.shares[0][1]

    def mean(self, take: Callable[[PredictedHistory], Taken]) -> Taken:
        """Return what all of them say, by their shares."""
        return sum(share * take(one) for share, one in self.shares)  # type: ignore[return-value]


@dataclass(frozen=True)
class LogInterpolation:
    """The logarithm of a factor on a value, with the ends of it that are allowed."""

    value: float  # the logarithm, from low to high
    low: float  # the logarithm, from low to high
    high: float  # the logarithm, from low to high

    def nodes(self) -> list[tuple[float, float]]:
        """Return the logarithms that are run beside it, with their shares."""
        below = math.floor(self.value / _SPACING)
        ends = [max(_SPACING * below, self.low), min(_SPACING * (below + 1), self.high)]
        if self.value <= ends[0]:
            return [(1.0, ends[0])]
        if self.value >= ends[1]:
            return [(1.0, ends[1])]
        share = (self.value - ends[0]) / (ends[1] - ends[0])
        return [(1.0 - share, ends[0]), (share, ends[1])]


class PredictedHistories:
    """Courses by the values of keys, run where they are needed.

    Of a whole drive they are those of one sprocket. They are run for the values of the case times powers of
    exp(0.05); in between they are interpolated, which for the depth of a point is good to 1e-4 of it.
    """

    def __init__(self, tables: Mapping[str, Any], sprocket: str = "") -> None:
        self._tables, self._sprocket = tables, sprocket
        self._found: dict[tuple[tuple[str, float], ...], PredictedHistory] = {}

    @property
    def runs(self) -> int:
        """Runs so far."""
        return len(self._found)

    @property
    def numerical_error(self) -> float:
        """The largest of the runs."""
        return max((one.result.numerical_error for one in self._found.values()), default=0.0)

    def weighted(self, given: Mapping[str, float], logs: Mapping[str, LogInterpolation]) -> WeightedHistory:
        """Return the course with other values of some keys."""
        corners: list[tuple[float, dict[str, float]]] = [(1.0, dict(given))]
        for key, log in logs.items():
            corners = [
                (part * share, {**values, key: given[key] * math.exp(node)})
                for part, values in corners
                for share, node in log.nodes()
            ]
        return WeightedHistory(tuple((share, self._at(values)) for share, values in corners))

    def _at(self, values: Mapping[str, float]) -> PredictedHistory:
        key = tuple(sorted(values.items()))
        if key not in self._found:
            tables = self._tables
            for name, value in key:
                tables = replaced(tables, name.split("."), value)
            # How the lubricant ages is a matter of time alone, which readings are held against.
            found = load_case(tables)
            single = found.single_cases[self._sprocket] if isinstance(found, DriveCase) else found
            case = replace(single, lubrication=None)
            predicted = PredictedHistory(simulate(case))
            if not predicted.reached:
                raise ConvergenceError(
                    f"calibrate: the limit must be reached for a life to be scaled, but is not in "
                    f"{predicted.hours:.3g} h: check the wear coefficient and the limits of [stop]"
                )
            self._found[key] = predicted
        return self._found[key]
