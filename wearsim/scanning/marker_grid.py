"""The markers of the sheet: a grid of dots, some of them rings, about a free circle for the sprocket.

The origin is the middle of the circle, x to the right and y up. The dot (i, j) lies at (10 i, 10 j) mm on
every paper; which dots are rings tells any piece of the grid from any other one, turned and mirrored too.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wearsim.geometry.profile_points import Vector
from wearsim.scanning.papers import PAPERS

SPACING = 10.0
"""Distance of dots [mm]."""

DOT, HOLE = 3.0, 1.5
"""Radius of a dot, and of the hole of a ring [mm]."""

RULER = 100.0
"""Length of the ruler [mm]."""

FARTHEST = 20
"""Largest number of a column or row of any paper."""

_EDGE, _WORDS = 12.0, 62.0
"""Margin of the paper from which dots begin, and height of the words at its lower edge [mm]."""

_CLEAR = 3.0
"""Way from the free circle to the dots [mm]."""

Numbers = NDArray[np.int64]


def is_ring(column: Numbers, row: Numbers) -> NDArray[np.bool_]:
    """Tell which dots are rings: about half of them, so that no two pieces of 40 dots are alike by 4 / 5.

    Examples
    --------
    >>> is_ring(np.array([1, 0]), np.array([0, 1]))  # 102 and 91, modulo 97
    array([ True, False])
    """
    mixed = (
        60 * column**3
        + 7 * row**3
        + 63 * column**2 * row
        + 34 * column * row**2
        + 22 * column * row
        + 42 * column
        + 84 * row
    )
    return np.asarray(mixed % 97 < 48)


@dataclass(frozen=True)
class MarkerSheet:
    """The sheet on a paper."""

    paper: str

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the paper [mm]."""
        return PAPERS[self.paper]

    @property
    def _reach(self) -> tuple[int, int]:
        """Largest column and row."""
        width, height = self.size
        return (int((0.5 * width - _EDGE) / SPACING), int((0.5 * (height - _EDGE - _WORDS)) / SPACING))

    @property
    def origin(self) -> tuple[float, float]:
        """Middle of the free circle, from the lower left corner of the paper [mm]."""
        return 0.5 * self.size[0], self.size[1] - _EDGE - SPACING * self._reach[1]

    @property
    def free_radius(self) -> float:
        """Radius of the circle that has no dots [mm]."""
        return free_radius(self._reach[0])

    @property
    def dots(self) -> Numbers:
        """Columns and rows of all dots, shape (n, 2)."""
        across, up = self._reach
        column, row = np.meshgrid(np.arange(-across, across + 1), np.arange(-up, up + 1))
        free = np.hypot(column, row) * SPACING < self.free_radius + DOT + 0.5 * _CLEAR
        return np.column_stack([column[~free], row[~free]])


def free_radius(columns: int) -> float:
    """Return the radius of the circle without dots between outermost columns [mm].

    Examples
    --------
    >>> free_radius(9)
    84.0
    """
    return SPACING * columns - DOT - _CLEAR


def dot_points(dots: Numbers) -> Vector:
    """Return the middles of dots by their columns and rows [mm]."""
    return SPACING * np.asarray(dots, dtype=float)


def largest_wheel(sheet: MarkerSheet) -> float:
    """Return the tip diameter of the largest sprocket that leaves all dots free [mm], rounded down.

    Examples
    --------
    >>> largest_wheel(MarkerSheet("a4"))
    165.0
    """
    return 5.0 * math.floor(2.0 * sheet.free_radius / 5.0)
