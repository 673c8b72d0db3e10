"""How wrong a life may be numerically: by its steps and by its grid."""

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
