"""How wrong a life may be numerically: by its steps and by its grid."""

from wearsim.contact.engagement import Contact
from wearsim.wear.advance import run_advance
from wearsim.wear.criteria import Criterion
from wearsim.wear.law import Law
from wearsim.wear.trajectory import Trajectory


def difference(run: Trajectory, other: Trajectory) -> float:
    """Return the relative difference of two runs of one case.

    Parameters
    ----------
    run, other : Trajectory
        The runs.

    Returns
    -------
    float
        Of their lives; of their greatest depths where a run did not reach its limit.
    """
    if run.met is not None and other.met is not None:
        return abs(float(other.cycles[-1] / run.cycles[-1]) - 1.0)
    return abs(float(other.depth[-1].max() / run.depth[-1].max()) - 1.0)


def grid_error(
    run: Trajectory,
    contact: Contact,
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
    contact : Contact
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
