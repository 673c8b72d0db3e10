"""A run of resting contacts with an error that coarser runs bound, made finer until it is small enough."""

import itertools
import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from wearsim.contact.resting_engagement import MateWear, RestingContact
from wearsim.wear.implicit_steps import RestingTrajectory, part_of, reported_progress, run_seated
from wearsim.wear.problem import WearProblem
from wearsim.wear.trajectory import difference

_LEVELS, _REFINED_LEVELS = (1, 2, 3), (1, 2)
"""Times that steps are halved for the error: with the phases as they are, then with twice as many."""

_KEPT = 0.2
"""Part of the progress still to come that is kept for finer runs, of which nobody knows before."""

_COARSE = 0.2
"""Part of the time of a run and the coarser one before it that this one takes."""

_SAFETY, _AT_LEAST = 1.5, 5e-3
"""On the error of a run, and what runs that agree by accident may leave, at level 0: with both the stated
error holds for 98 of 100 random drives."""


def run_together(
    problems: Sequence[tuple[WearProblem[RestingContact], int]],
    progress: Callable[[float], None] = lambda part: None,
) -> list[RestingTrajectory]:
    """Run several problems side by side, each with its own size of steps."""
    stop = threading.Event()

    def _first(part: float) -> bool:
        progress(part)
        return not stop.is_set()

    def _others(part: float) -> bool:
        return not stop.is_set()

    watches = [_first, *[_others] * (len(problems) - 1)]
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        runs = [
            pool.submit(run_seated, problem, level, watch)
            for (problem, level), watch in zip(problems, watches, strict=True)
        ]
        try:
            return [run.result() for run in runs]
        except BaseException:
            stop.set()
            raise


def spared(run: RestingTrajectory, depth_limit: float, error: float) -> float:
    """Return the error of a life that may have ended with a mate before, as near as the depth came then.

    A new mate presses elsewhere: where the depth just misses its limit at the end of a mate, the
    life goes on for long, and a small error of the depth is a large one of the life.
    """
    ends = np.flatnonzero(np.diff(run.mates) > 0.0)
    near = ends[run.all_depth[ends].max(axis=(1, 2)) >= (1.0 - error) * depth_limit]
    return float((1.0 + error) * run.cycles[-1] / run.cycles[near[0]] - 1.0) if near.size else error


def outlives(problem: WearProblem[RestingContact], run: RestingTrajectory, error: float) -> bool:
    """Tell whether a run to its horizon would keep all limits if its depths were wrong by its error."""
    if run.met is not None or run.lost:
        return False
    depth = (1.0 + error) * run.all_depth[-1]
    if not depth.max() < problem.depth_limit:
        return False
    contact, wear = problem.contact, MateWear(float(run.elongation[-1]), float(run.mate_depth[-1]))
    x, y = contact.profile.receded(depth)
    within = all(problem.met(*body) is None for body in zip(x, y, depth, strict=True))
    return within and contact.holds(x, y, wear)


def advance_resting(
    problem: WearProblem[RestingContact],
    life_tolerance: float,
    progress: Callable[[float], None] = lambda part: None,
) -> tuple[RestingTrajectory, float]:
    """Wear outlines and mate until the life is within its tolerance as far as a coarser run tells.

    Beside each run goes one with steps twice as long on half of the points and phases, which takes a quarter
    of the time. It tells how wrong steps, points and phases together make the life. Where that is too much,
    both halve their steps, three times at most; then twice the phases with steps halved once and twice. The
    coarser one goes ahead: where it comes no nearer, or not by half of what is missing, points are what is
    wrong, and the finer one is spared. All runs together take less than thirty times as long as the first.
    A life that a new mate has only just prolonged is as uncertain as the time since. Where a run comes to its
    horizon, and would with depths that are wrong by its error, that holds; the error is that of the depth.

    Equation physics.md (W14).

    Parameters
    ----------
    problem : WearProblem
        What wears and until when; where something has worn off already, on the points of the contact, these
        are kept.
    life_tolerance : float
        Relative error of the life that is asked for.
    progress : callable, optional
        Called with the fraction done, from 0 to 1: it only rises, by a leap where no finer run follows.

    Returns
    -------
    run : RestingTrajectory
        The finest run.
    error : float
        How wrong its life may be, relative; above the tolerance where none of this helps. Of a run to its
        horizon how wrong its depth may be.

    Raises
    ------
    ContactError
        Nothing wears, a mate is worn through, or worn bodies do not hold it from the first cycle on.
    ConvergenceError
        No equilibrium of the mates is found.
    """
    contact, used = problem.contact, problem.start is not None
    finer = None if used else contact.refined()
    tried = itertools.count(1)

    def coarse(contact: RestingContact) -> WearProblem[RestingContact]:
        return problem.on(contact if used else contact.coarsened())

    def bound(run: RestingTrajectory, error: float) -> float:
        return spared(run, problem.depth_limit, error)

    def helps(left: float) -> bool:
        """Whether a finer run with this error gains so much that all others, which gain as much again, do."""
        further = max(left - (error - left), 0.0)
        return bound(run, left) < bound(run, error) and bound(run, further) <= life_tolerance

    first = part_of(progress, 0.0, 1.0 - _KEPT)
    run, other = run_together([(problem.on(contact), 0), (coarse(contact), -1)], first)
    error = _stated(run, other, 0)
    for candidate, levels in ((contact, _LEVELS), (finer, _REFINED_LEVELS)):
        for level in levels:
            if bound(run, error) <= life_tolerance or candidate is None or outlives(problem, run, error):
                break
            begin = 1.0 - _KEPT ** next(tried)
            end = begin + (1.0 - _KEPT) * (1.0 - begin)
            middle = begin + _COARSE * (end - begin)
            other = run_seated(
                coarse(candidate), level - 1, reported_progress(part_of(progress, begin, middle))
            )
            if not helps(_stated(run, other, level)):
                break
            better = run_seated(
                problem.on(candidate), level, reported_progress(part_of(progress, middle, end))
            )
            left = _stated(better, other, level)
            if bound(better, left) >= bound(run, error):
                break
            run, error = better, left
    progress(1.0)
    return run, bound(run, error)


def _stated(run: RestingTrajectory, other: RestingTrajectory, level: int) -> float:
    """Return the error of a run that is stated beside a coarser one."""
    return _SAFETY * difference(run, other) + _AT_LEAST / 2.0**level
