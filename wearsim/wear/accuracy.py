"""How wrong a life may be numerically: by its steps and by its grid."""

import math
from dataclasses import dataclass

from wearsim.contact.dwelling import Dwelling
from wearsim.contact.engagement import Contact
from wearsim.wear.advance import run_advance
from wearsim.wear.criteria import Criterion
from wearsim.wear.law import Law
from wearsim.wear.trajectory import Trajectory, difference


def grid_error(
    run: Trajectory,
    contact: Contact | Dwelling,
    law: Law,
    criteria: tuple[Criterion, ...],
    horizon: float,
    life_tolerance: float,
) -> float:
    """Return how much a life moves when every second point of the flank is left out.

    Parameters
    ----------
    run : Trajectory
        The run on all points.
    contact : Contact or Dwelling
        The flank and its contact.
    law : Law
        The wear law.
    criteria : tuple of Criterion
        Limits, the depth criterion first.
    horizon : float
        Loading cycles at which the run ends in any case.
    life_tolerance : float
        Relative tolerance of the life.

    Returns
    -------
    float
        Relative difference, an estimate of the error of the finer grid.
    """
    coarse, _ = run_advance(contact.coarsened(), law, criteria, horizon, life_tolerance)
    return difference(run, coarse)


@dataclass(frozen=True)
class GridStudy:
    """What a run comes to on three grids, each with half the points of the one before.

    Attributes
    ----------
    points : tuple of int
        Of the grids, the finest first.
    quantity : str
        What is compared: ``cycles``, or ``max_depth_mm`` where a run ends at the horizon.
    values : tuple of float
        On each grid.
    order : float
        Observed order of convergence, log2 of the ratio of the two differences; nan where these
        have different signs or vanish.
    """

    points: tuple[int, ...]
    quantity: str
    values: tuple[float, ...]
    order: float

    @property
    def extrapolates(self) -> bool:
        """Whether the order is near enough to 2 for Richardson's extrapolation."""
        return LEAST_ORDER <= self.order <= MOST_ORDER

    @property
    def error(self) -> float:
        """Relative error of the finest: Richardson's, else the spread of all three."""
        fine, middle, _ = self.values
        if self.extrapolates:
            return abs(middle - fine) / (math.pow(2.0, self.order) - 1.0) / fine
        spread: float = max(self.values) - min(self.values)
        return spread / fine


LEAST_ORDER, MOST_ORDER = 1.5, 2.5
"""Orders between which an error may be extrapolated; kinks of the load share give about 0."""


def grid_study(
    contact: Contact | Dwelling,
    law: Law,
    criteria: tuple[Criterion, ...],
    horizon: float,
    life_tolerance: float,
) -> GridStudy:
    """Run a case on all, on half and on a quarter of its points.

    Parameters
    ----------
    contact : Contact or Dwelling
        The flank and its contact.
    law : Law
        The wear law.
    criteria : tuple of Criterion
        Limits, the depth criterion first.
    horizon : float
        Loading cycles at which the run ends in any case.
    life_tolerance : float
        Relative tolerance of each life.

    Returns
    -------
    GridStudy
        Of the three runs.
    """
    grids = [contact, contact.coarsened(), contact.coarsened().coarsened()]
    runs = [run_advance(grid, law, criteria, horizon, life_tolerance)[0] for grid in grids]
    reached = all(run.met is not None for run in runs)
    values = [float(run.cycles[-1] if reached else run.depth[-1].max()) for run in runs]
    near, far = values[1] - values[0], values[2] - values[1]
    order = math.log2(far / near) if near * far > 0.0 else math.nan
    points = tuple(grid.profile.x.size for grid in grids)
    return GridStudy(points, "cycles" if reached else "max_depth_mm", tuple(values), order)
