"""How wrong a life may be numerically: by its steps and by its grid."""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from wearsim.geometry.profile_points import Vector
from wearsim.wear.problem import AnyContact
from wearsim.wear.trajectory import Trajectory, compared

SAFETY = 1.1
"""On the error of a grid: with it the stated error holds for 98 of 100 random drives."""


def grid_error(spacing: float, others: Iterable[tuple[float, float]]) -> float:
    """Return how wrong a life is by its grid at most, as lives on other grids tell it.

    Where an error grows in proportion to the spacing h at the ends of the flank, a life that
    moves by d on a grid of spacing h' is wrong by d h / |h' - h|. Kinks of the load make lives
    converge by leaps, and errors of both ends may cancel by accident on one grid: so what all
    the grids tell is added up.

    Equation physics.md (A5).

    Parameters
    ----------
    spacing : float
        Of the points at the ends [mm].
    others : iterable of tuple of float
        That of other grids [mm], and the relative difference of the life there.

    Returns
    -------
    float
        Relative error, held in tests on random cases.

    Examples
    --------
    Every second point moves the life by 1 %, every fourth by 3 %:

    >>> round(grid_error(0.1, [(0.2, 0.01), (0.4, 0.03)]) / SAFETY, 6)
    0.02
    """
    told = (change * spacing / abs(other - spacing) for other, change in others)
    return SAFETY * math.fsum(told)


EXCEEDS = "exceeds the tolerance"
"""What warnings say of an error that is larger than its tolerance."""


def exceeds(error: float, tolerance: float) -> str:
    """Return in words that an error is larger than its tolerance, with digits enough to see it.

    Examples
    --------
    >>> exceeds(0.0312, 0.01)
    'numerical error 0.031 exceeds the tolerance 0.01'
    >>> exceeds(0.01004, 0.01)
    'numerical error 0.01004 exceeds the tolerance 0.01'
    """
    digits = next(d for d in range(2, 18) if float(f"{error:.{d}g}") > tolerance)
    return f"numerical error {error:.{digits}g} {EXCEEDS} {tolerance:g}"


def depth_missed(x: Vector, y: Vector, depth: Vector) -> float:
    """Return how much deeper a flank is between its points than at the deepest of them.

    Examples
    --------
    The depths 1 - (s - 0.25)^2 have their greatest, 1, between s = 0 and s = 1:

    >>> s = np.array([-1.0, 0.0, 1.0])
    >>> depth = 1.0 - (s - 0.25) ** 2
    >>> round(depth_missed(s, 0.0 * s, depth) * float(depth.max()), 12)
    0.0625
    """
    deepest = int(depth.argmax())
    if deepest in (0, depth.size - 1):
        return 0.0
    near = slice(deepest - 1, deepest + 2)
    before, after = np.hypot(np.diff(x[near]), np.diff(y[near]))
    rise, fall = np.diff(depth[near]) / (before, after)
    bend = (fall - rise) / (before + after)
    slope = (rise * after + fall * before) / (before + after)
    return float(-slope * slope / (4.0 * bend) / depth[deepest]) if bend < 0.0 else 0.0


@dataclass(frozen=True)
class GridStudy:
    """What a run comes to on three grids, each with half the points of the one before."""

    points: tuple[int, ...]  # of the grids, the finest first
    # what is compared: `cycles`, or `max_depth_mm` when the first ends where a run ends at the horizon
    quantity: str
    values: tuple[float, ...]  # on each grid
    # observed order of convergence, log2 of the ratio of the two differences; nan where these have different
    # signs or vanish
    order: float

    @property
    def extrapolates(self) -> bool:
        """Whether the order is near enough to 2 for Richardson's extrapolation."""
        return LEAST_ORDER <= self.order <= MAX_ORDER

    @property
    def error(self) -> float:
        """Relative error of the finest: Richardson's, else the spread of all three; inf where it is 0."""
        fine, middle, _ = self.values
        if self.extrapolates:
            return abs(middle - fine) / (math.pow(2.0, self.order) - 1.0) / fine
        spread: float = max(self.values) - min(self.values)
        return spread / fine if fine > 0.0 else math.inf


LEAST_ORDER, MAX_ORDER = 1.5, 2.5
"""Orders between which an error may be extrapolated; kinks of the load share give about 0."""


def grid_study(contact: AnyContact, run_on: Callable[[AnyContact], Trajectory]) -> GridStudy:
    """Run a case on all, on half and on a quarter of its points."""
    half = contact.coarsened()
    grids = [contact, half, half.coarsened()]
    reached, values = compared(*map(run_on, grids))
    near, far = values[1] - values[0], values[2] - values[1]
    order = math.log2(far / near) if near * far > 0.0 else math.nan
    points = tuple(grid.profile.x.size for grid in grids)
    return GridStudy(points, "cycles" if reached else "max_depth_mm", tuple(values), order)
