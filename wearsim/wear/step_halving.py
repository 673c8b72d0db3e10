"""Runs of dwelling contacts side by side, and with steps that are halved until the life settles."""

import math
import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

from wearsim.contact.resting_engagement import RestingContact
from wearsim.contact.stop_limits import StopLimit
from wearsim.wear.implicit_steps import RestingTrajectory, reported_progress, run_resting
from wearsim.wear.law import WearLaw
from wearsim.wear.resting_bodies import StartState
from wearsim.wear.trajectory import Trajectory, difference

_MAX_LEVELS = 3
"""Times that the steps are halved at most."""

_SAFETY = 2.75
"""On the error of a run: with it the stated error holds for 98 of 100 random drives."""


def run_together(
    contacts: Sequence[tuple[RestingContact, int]],
    law: WearLaw,
    stop_limits: tuple[StopLimit, ...],
    horizon: float,
    start: StartState | None = None,
    progress: Callable[[float], None] = lambda part: None,
) -> list[RestingTrajectory]:
    """Run several contacts side by side, each with its own size of steps."""
    stop = threading.Event()

    def _first(part: float) -> bool:
        progress(part)
        return not stop.is_set()

    def _others(part: float) -> bool:
        return not stop.is_set()

    watches = [_first, *[_others] * (len(contacts) - 1)]
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        runs = [
            pool.submit(run_resting, contact, law, stop_limits, horizon, level, 0.0, watch, start)
            for (contact, level), watch in zip(contacts, watches, strict=True)
        ]
        try:
            return [run.result() for run in runs]
        except BaseException:
            stop.set()
            raise


def advance_resting(
    contact: RestingContact,
    law: WearLaw,
    stop_limits: tuple[StopLimit, ...],
    horizon: float,
    life_tolerance: float,
    start: StartState | None = None,
    progress: Callable[[float], None] = lambda part: None,
) -> tuple[RestingTrajectory, float]:
    """Wear outlines and chain by steps that are halved until the life is within its tolerance."""
    first = [(contact, 1), (contact, 0)]
    if start is None:
        first.append((contact.coarsened(), 0))
    fine, coarse, *sparse = run_together(first, law, stop_limits, horizon, start, progress)
    by_points = sum(difference(coarse, run) for run in sparse)
    runs = [coarse, fine]
    while len(runs) <= _MAX_LEVELS:
        settled = halving_error(runs, by_points) <= life_tolerance
        # Where the points alone are too few, smaller steps would not help.
        if settled or halving_error(runs, 0.0) <= 0.5 * life_tolerance:
            break
        watch = reported_progress(progress)
        runs.append(run_resting(contact, law, stop_limits, horizon, len(runs), 0.0, watch, start))
    return runs[-1], halving_error(runs, by_points)


def halving_error(runs: Sequence[Trajectory], by_points: float) -> float:
    """Return how wrong the last of some runs may be, each with half the steps of the one before.

    The error of a run goes with its step, but by leaps, as rollers change their places from step to
    step. On random drives the root of the step is what bounds it: of what a life moves by since a
    run of n times the step, 1/(sqrt(n) - 1) may be left.

    Equation physics.md (W14).

    Parameters
    ----------
    runs : sequence of Trajectory
        At least two.
    by_points : float
        Relative difference of the life on half the points.

    Returns
    -------
    float
        Relative.
    """
    last = len(runs) - 1
    by_steps = max(
        difference(runs[last], run) / (math.sqrt(2 ** (last - level)) - 1.0)
        for level, run in enumerate(runs[:last])
    )
    return _SAFETY * (by_steps + by_points)
