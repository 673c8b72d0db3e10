"""Runs of dwelling contacts side by side, and with steps that are halved until the life settles."""

import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

from wearsim.contact.dwelling import Dwelling
from wearsim.wear.bodies import Start
from wearsim.wear.criteria import Criterion
from wearsim.wear.dwelling import DwellingTrajectory, reporting, run_dwelling
from wearsim.wear.law import Law
from wearsim.wear.trajectory import difference

_MOST_LEVELS = 3


def run_together(
    contacts: Sequence[tuple[Dwelling, int]],
    law: Law,
    criteria: tuple[Criterion, ...],
    horizon: float,
    start: Start | None = None,
    progress: Callable[[float], None] = lambda part: None,
) -> list[DwellingTrajectory]:
    """Run several contacts side by side, each with its own size of steps.

    Parameters
    ----------
    contacts : sequence of tuple
        Outlines with their contacts, and the level of each run.
    law : Law
        The wear law.
    criteria : tuple of Criterion
        Limits of the outlines, the depth criterion first.
    horizon : float
        Cycles at which the runs end in any case.
    start : Start, optional
        Worn outlines and a used chain to begin with; contacts on the same points then.
    progress : callable, optional
        Told how much of the first run is done, from 0 to 1.

    Returns
    -------
    list of DwellingTrajectory
        In the order of the contacts.

    Raises
    ------
    ContactError
        The chain jumps, or nothing slides under load.
    ConvergenceError
        A pressure cannot be found.
    """
    stop = threading.Event()

    def _first(part: float) -> bool:
        progress(part)
        return not stop.is_set()

    def _others(part: float) -> bool:
        return not stop.is_set()

    watches = [_first, *[_others] * (len(contacts) - 1)]
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        runs = [
            pool.submit(run_dwelling, contact, law, criteria, horizon, level, 0.0, watch, start)
            for (contact, level), watch in zip(contacts, watches, strict=True)
        ]
        try:
            return [run.result() for run in runs]
        except BaseException:
            stop.set()
            raise


def advance_dwelling(
    contact: Dwelling,
    law: Law,
    criteria: tuple[Criterion, ...],
    horizon: float,
    life_tolerance: float,
    start: Start | None = None,
) -> tuple[DwellingTrajectory, float]:
    """Wear outlines and chain by steps that are halved until the life settles.

    Parameters
    ----------
    contact : Dwelling
        The outlines and their contacts.
    law : Law
        The wear law.
    criteria : tuple of Criterion
        Limits of the outlines, the depth criterion first.
    horizon : float
        Cycles at which the run ends in any case.
    life_tolerance : float
        Relative tolerance of the life.
    start : Start, optional
        Worn outlines and a used chain to begin with; new ones otherwise.

    Returns
    -------
    tuple of DwellingTrajectory and float
        The finest run, and the relative difference to the one before, which is about
        its error.

    Raises
    ------
    ContactError
        The chain jumps, or nothing slides under load.
    ConvergenceError
        A pressure cannot be found.
    """
    levels = ((contact, 1), (contact, 0))
    fine, coarse = run_together(levels, law, criteria, horizon, start)
    runs = coarse, fine
    return halve_steps(contact, law, criteria, horizon, life_tolerance, runs, start)


def halve_steps(
    contact: Dwelling,
    law: Law,
    criteria: tuple[Criterion, ...],
    horizon: float,
    life_tolerance: float,
    runs: tuple[DwellingTrajectory, DwellingTrajectory],
    start: Start | None = None,
    progress: Callable[[float], None] = lambda part: None,
) -> tuple[DwellingTrajectory, float]:
    """Go on from runs of the levels 0 and 1 until two successive lives agree.

    Parameters
    ----------
    contact : Dwelling
        The outlines and their contacts.
    law : Law
        The wear law.
    criteria : tuple of Criterion
        Limits of the outlines, the depth criterion first.
    horizon : float
        Cycles at which the run ends in any case.
    life_tolerance : float
        Relative tolerance of the life.
    runs : tuple of DwellingTrajectory
        Those of the levels 0 and 1.
    start : Start, optional
        What they began with.
    progress : callable, optional
        Told how much of each further run is done, from 0 to 1.

    Returns
    -------
    tuple of DwellingTrajectory and float
        The finest run, and the relative difference to the one before, which is about
        its error.

    Raises
    ------
    ContactError
        The chain jumps, or nothing slides under load.
    ConvergenceError
        A pressure cannot be found.
    """
    coarse, fine = runs
    change, level = difference(fine, coarse), 1
    while change > 0.5 * life_tolerance and level < _MOST_LEVELS:
        level += 1
        watch = reporting(progress)
        coarse, fine = (
            fine, run_dwelling(contact, law, criteria, horizon, level, 0.0, watch, start)
        )  # fmt: skip
        change = difference(fine, coarse)
    return fine, change
