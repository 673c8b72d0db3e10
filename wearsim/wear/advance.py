"""The production run: physics.md (10) as d(state)/dN = f(state), in long steps.

The state is the cycle loop's: the way of every point along its current normal, and the
depth summed on that way. It obeys a parabolic equation, so explicit jumps over many
cycles are either wrong or slow; the steps of ``kernels.rosenbrock`` are linearly implicit,
stable on any grid and as long as the tolerance allows. The wear coefficient is a factor of
the cycle count, so the run is made with coefficient 1 and scaled: life times coefficient is
constant to rounding.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from wearsim.contact.engagement import FlankContact
from wearsim.contact.resting_engagement import RestingContact
from wearsim.errors import ConvergenceError, WearsimError
from wearsim.geometry.profile_points import Vector
from wearsim.wear.problem import AnyContact, Rows, WearProblem
from wearsim.wear.solve import (
    Problems,
    Solution,
    TooManyStepsError,
    solve_alone,
    solve_together,
    states_at,
    unworn,
)
from wearsim.wear.trajectory import SNAPSHOTS, Trajectory, check_touch, folds

_LOOSEST, _FINEST, _TIGHTEST = 1e-3, 1e-9, 0.9e-11
_PART_OF_TOLERANCE = 0.1
"""A run starts with this part of the tolerance of the life between the first two, and with a tenth of
it again and again, not below the third, until two lives agree."""


@dataclass(frozen=True, eq=False)
class StartAndEnd(Trajectory):
    """A run of which the flanks on the way are not kept."""

    widest: float  # greatest load over relative curvature on the way [N]: that of the widest contact


class _Life:
    """The life of one flank: solved with ever smaller steps until two successive lives agree."""

    def __init__(self, problem: WearProblem[FlankContact], tolerance: float) -> None:
        self.problem, self.enough, self.change = problem, 0.1 * tolerance, math.inf
        self.tolerance = min(_LOOSEST, max(_FINEST, _PART_OF_TOLERANCE * tolerance))  # of the next solve
        self.found: Solution | WearsimError | None = None
        self.before: Solution | WearsimError | None = None

    def take(self, after: Solution | WearsimError) -> None:
        """Compare a solve with the one before it; the next has a tenth of the error per step.

        Loose steps may run past what the flank itself never does; tighter ones decide.
        """
        before, self.before = self.before, after
        if isinstance(after, TooManyStepsError):
            self.found = ConvergenceError(str(after))
        elif isinstance(after, Solution):
            self.before = after.ended()
            if isinstance(before, Solution) and before.met == after.met:
                self.change = after.change(before)
                if self.change <= self.enough:
                    self.found = after
        self.tolerance *= 0.1
        if self.found is None and self.tolerance < _TIGHTEST:
            self.found = self.before if isinstance(self.before, WearsimError) else self._no_agreement()

    def _no_agreement(self) -> ConvergenceError:
        return ConvergenceError(
            f"wear: two solves must agree on the life within {self.enough:.1g}, but differ by "
            f"{self.change:.1g} even at the tightest step tolerance: ask a larger life_tolerance"
        )


def _find(
    lives: Sequence[_Life], solve: Callable[[Problems, list[float]], list[Solution | WearsimError]]
) -> None:
    """Solve flanks, all whose life is not found yet, until none is left."""
    while running := [life for life in lives if life.found is None]:
        solved = solve([life.problem for life in running], [life.tolerance for life in running])
        while running:
            running.pop().take(solved.pop())


def run_advance(problem: WearProblem[AnyContact], life_tolerance: float) -> tuple[Trajectory, float]:
    """Wear bodies with step control until a stop limit is met or the horizon is reached.

    A solve is repeated with a tenth of the error per step until two successive lives
    differ by less than a tenth of the asked tolerance. A contact error counts only where
    the tightest solve meets it too.
    """
    if isinstance(problem.contact, RestingContact):
        # Not imported for contacts that pass.
        from wearsim.wear.settled_run import advance_resting

        return advance_resting(problem, life_tolerance)
    x, y, depth = unworn(problem.contact)
    check_touch(problem.contact, x, y, depth, 0.0)
    life = _Life(problem, life_tolerance)
    _find([life], solve_alone)
    if not isinstance(life.found, Solution):
        assert life.found is not None
        raise life.found
    times = np.linspace(0.0, life.found.end, SNAPSHOTS + 1)
    return _trajectory(
        life, life.found, times, states_at(times, life.found.times, life.found.path)
    ), life.change


def advance_batch(
    problems: Sequence[WearProblem[FlankContact]], life_tolerances: Sequence[float]
) -> list[tuple[StartAndEnd, float] | None]:
    """Wear flanks of one kind together, each down to its depth limit; keep their start and end only.

    None stands for one whose life is not found so.
    """
    lives = [_Life(*pair) for pair in zip(problems, life_tolerances, strict=True)]
    _find(lives, solve_together)
    runs = [_start_and_end(life) for life in lives]
    folded = iter(folds([run for run, _ in filter(None, runs)]))
    return [None if run is None or next(folded) else run for run in runs]


def _start_and_end(life: _Life) -> tuple[StartAndEnd, float] | None:
    found = life.found
    if not isinstance(found, Solution):
        return None
    rows = np.array([unworn(life.problem.contact), found.final])
    run = _trajectory(life, found, np.array([0.0, found.end]), rows)
    return StartAndEnd(**vars(run), widest=found.widest), life.change


def _trajectory(life: _Life, solution: Solution, times: Vector, rows: Rows) -> Trajectory:
    x, y, depth = np.ascontiguousarray(rows.transpose(1, 0, 2))
    return Trajectory(
        cycles=times / life.problem.law.coefficient,
        x=x,
        y=y,
        depth=depth,
        met=solution.met,
        updates=solution.rates,
    )
