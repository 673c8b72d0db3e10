"""Courses for any values of keys, from those that are run."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from wearsim.case.load import load_case
from wearsim.geometry.profile import Vector
from wearsim.simulation import simulate
from wearsim.study.calibration.course import Course
from wearsim.study.runner.design import replaced

_SPACING = 0.05
"""Of the logarithms of values that are run."""


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
        """Return the depth of a point.

        Parameters
        ----------
        part : float
            Time as a part of the life.
        arc_length : float
            Place along the new flank [mm].
        kind : int
            Number of the gap from 1.

        Returns
        -------
        float
            Depth [mm].
        """
        return math.fsum(share * one.depth_at(part, arc_length, kind) for share, one in self.shares)

    def recess(self, part: float, kind: int) -> Vector:
        """Return how far the worn flank lies behind the new one.

        Parameters
        ----------
        part : float
            Time as a part of the life.
        kind : int
            Number of the gap from 1.

        Returns
        -------
        numpy.ndarray
            At the chords of the new flank [mm].
        """
        return np.asarray(sum(share * one.recess(part, kind) for share, one in self.shares))

    def history(self, quantity: str, part: float) -> float:
        """Return a quantity of the history.

        Parameters
        ----------
        quantity : str
            Column of history.csv.
        part : float
            Time as a part of the life.

        Returns
        -------
        float
            In the unit of the column.
        """
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
