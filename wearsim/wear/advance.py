"""The production run: physics.md (10) as d(state)/dN = f(state), in long steps.

The state is the cycle loop's: the way of every point along its current normal, and the
depth summed on that way. It obeys a parabolic equation, so explicit jumps over many
cycles are either wrong or slow; the steps of ``kernels.rosenbrock`` are linearly implicit,
stable on any grid and as long as the tolerance allows. The wear coefficient is a factor of
the cycle count, so the run is made with coefficient 1 and scaled: life times coefficient is
constant to rounding.
"""

import math
from dataclasses import dataclass, replace
from functools import partial
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from wearsim.contact.engagement import FlankContact
from wearsim.contact.resting_engagement import RestingContact
from wearsim.contact.stop_limits import StopLimit
from wearsim.errors import ContactError, ConvergenceError, WearsimError
from wearsim.geometry.profile_points import Vector
from wearsim.kernels.controlled_steps import (
    CLOCK,
    END,
    FINEST,
    LOOSEST,
    PART_OF_TOLERANCE,
    RATES,
    STATE_ROWS,
    TIGHTEST,
    WRITTEN,
    states_between,
    wear_in_steps,
)
from wearsim.kernels.hertz_wear import DEPTH_REACHED, HORIZON, RATE, RUNNING, SAWTOOTH, VANISHED, WORN
from wearsim.kernels.rosenbrock import STAGES, WORK_ROWS, rosenbrock_step
from wearsim.wear.law import WearLaw
from wearsim.wear.trajectory import SNAPSHOTS, Trajectory, check_sawtooth, check_touch, no_sliding

_CONFORMS = 1e-5
"""Relative curvature over that of the mate at which a run that does not get on has come to a flank
that conforms: the width of the contact is then several radii of the mate."""

_CHUNK, MAX_STEPS = 64, 10_000
"""States of a compiled call, and steps of one solve; a life takes some dozens."""

_MOST_BYTES = 2e9
"""Memory that the states of one solve may take: fewer steps on very many points."""

Table = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class _Problem:
    """A flank with its law of coefficient 1, its limits and the end in cycles times coefficient."""

    contact: FlankContact
    law: WearLaw
    stop_limits: tuple[StopLimit, ...]
    horizon: float

    @property
    def diffusion(self) -> float:
        return self.law.diffusion(self.contact.kind, self.contact.slip_curvature_exponent)

    def start(self) -> Table:
        profile = self.contact.profile
        return np.array([profile.x, profile.y, np.zeros(profile.x.size)])

    def cycles(self, time: float) -> float:
        """Return the cycles run, for messages."""
        constant = np.array([time / self.law.coefficient])
        return float(self.law.running_in.running_cycles(constant)[0])


@dataclass(frozen=True, eq=False)
class _Solution:
    """States of one solve at their times, and where between the last two it ends."""

    times: Vector
    path: Table
    end: float
    met: StopLimit | None
    rates: int

    def states(self, times: Vector) -> Table:
        """Return x, y and depth at increasing times, shape (times, 3, points)."""
        found = np.empty((times.size, 3, self.path.shape[2]))
        states_between(self.times, self.path, times, found)
        return found

    def state(self, time: float) -> Table:
        """Return x, y and depth at a time, shape (3, points)."""
        found: Table = self.states(np.array([time]))[0]
        return found

    def ended(self) -> "_Solution":
        """Return the last step alone, without the memory that all of them take."""
        return replace(self, times=self.times[-2:].copy(), path=self.path[-2:].copy())

    def change(self, before: "_Solution") -> float:
        """Return the relative difference from a solve that met the same limit.

        It is that of the lives; at the horizon the greatest of all depths there, over the
        greatest depth: that of one point alone may be small by accident.
        """
        if self.met:
            return abs(self.end / before.end - 1.0)
        depth, other = self.state(self.end)[2], before.state(before.end)[2]
        return float(np.abs(depth - other).max() / depth.max())


class _TooManyStepsError(ConvergenceError):
    """A solve that does not end; a tighter one would take even more steps."""


class _Solve:
    """One solve on its way: the compiled steps and the states that they have written."""

    def __init__(self, problem: _Problem, tolerance: float) -> None:
        self.problem = problem
        self.tolerance, points = tolerance, problem.contact.profile.x.size
        self.state, self.clock = problem.start(), np.zeros(CLOCK)
        self.work = np.zeros((WORK_ROWS, points))
        self.increments = np.zeros((STAGES, 3 * points))
        self.chunks: list[tuple[Vector, Table]] = []
        self.most = min(MAX_STEPS, int(_MOST_BYTES / (8 * STATE_ROWS * points)))

    def run(self) -> _Solution:
        """Go on until a limit or the horizon ends it; raise what else does."""
        status, failing = RUNNING, None
        while status == RUNNING and failing is None and self._states() <= self.most:
            status = self._go_on()
            failing = self._first_failing()
        if failing is None and status not in (DEPTH_REACHED, HORIZON):
            self._refuse(status)
        met = self.problem.stop_limits[0] if status == DEPTH_REACHED else None
        end, rates = float(self.clock[END]), int(self.clock[RATES])
        if failing is not None:
            times, path = self.chunks[-1]
            if failing + 1 < times.size:
                end, met = float(times[failing]), None
            self.chunks[-1] = times[: failing + 1], path[: failing + 1]
        all_times, all_paths = zip(*self.chunks, strict=True)
        solution = _Solution(np.concatenate(all_times), np.concatenate(all_paths), end, met, rates)
        return solution if failing is None else self._cut(solution)

    def _states(self) -> int:
        return sum(times.size for times, _ in self.chunks)

    def _go_on(self) -> int:
        problem, contact = self.problem, self.problem.contact
        times, path = np.empty(_CHUNK), np.empty((_CHUNK, STATE_ROWS, self.state.shape[1]))
        self.clock[WRITTEN] = 0.0
        status = wear_in_steps(
            rosenbrock_step,
            contact.kernel,
            self.state,
            contact.constants,
            contact.columns,
            contact.modulus,
            problem.law.unit_numbers(contact.kind),
            problem.diffusion,
            int(not contact.offset_form),
            problem.stop_limits[0].limit,
            self.tolerance,
            problem.horizon,
            _CHUNK,
            self.work,
            self.increments,
            self.clock,
            times,
            path,
        )
        written = int(self.clock[WRITTEN])
        # The last state of a call is the first of the next.
        new = 1 if self.chunks else 0
        if written > new:
            self.chunks.append((times[new:written], path[new:written]))
        return int(status)

    def _first_failing(self) -> int | None:
        """Return the first state of the last chunk at which a limit other than the depth fails."""
        others = self.problem.stop_limits[1:]
        for place, (x, y, depth) in enumerate(self.chunks[-1][1][:, :3]):
            if any(stop_limit.margin(x, y, depth) <= 0.0 for stop_limit in others):
                return place
        return None

    def _cut(self, solution: _Solution) -> _Solution:
        """End a solution where the first of the limits that fail at its last state is met."""
        from scipy.optimize import brentq  # takes 0.1 s, and most runs end on the depth

        low, high = solution.times[-2:] if solution.times.size > 1 else (0.0, 0.0)
        # What brentq is given refers to itself from then on, and stays until Python collects garbage.
        last_step = solution.ended()
        for stop_limit in self.problem.stop_limits[1:]:
            if stop_limit.margin(*solution.path[-1, :3]) > 0.0:
                continue
            margin = partial(_margin, last_step, stop_limit)
            time = brentq(margin, low, high, rtol=1e-14, xtol=1e-300) if margin(low) > 0.0 else low
            if time < solution.end or (time == solution.end and solution.met is None):
                solution = replace(solution, end=float(time), met=stop_limit)
        return solution

    def _refuse(self, status: int) -> NoReturn:
        contact, (times, path) = self.problem.contact, self.chunks[-1]
        cycles = self.problem.cycles(float(times[-1]))
        x, y, depth = self.state
        if np.isfinite(self.state).all():
            check_touch(contact, x, y, depth, cycles, _CONFORMS / contact.mate_radius)
        if status == VANISHED:
            raise no_sliding(cycles)
        if status == SAWTOOTH:
            check_sawtooth(contact, depth, cycles, self.problem.stop_limits[0].limit)
        broken = ~np.isfinite(self.work[WORN])
        place = contact.arc_length[int((broken if broken.any() else path[-1, RATE]).argmax())]
        if status == RUNNING:
            raise _TooManyStepsError(
                f"wear at cycle {cycles:.6g}: the solver must come to an end within {self.most} steps, but "
                "has not: ask a larger run.life_tolerance, or fewer nodes"
            )
        raise ConvergenceError(
            f"wear at cycle {cycles:.6g}, {place:.4g} mm from the root: the solver must be able to go "
            'on, but stopped: use method = "per_cycle" or more nodes'
        )


def _margin(solution: _Solution, stop_limit: StopLimit, time: float) -> float:
    return stop_limit.margin(*solution.state(time))


def run_advance(
    contact: FlankContact | RestingContact,
    law: WearLaw,
    stop_limits: tuple[StopLimit, ...],
    horizon: float,
    life_tolerance: float,
) -> tuple[Trajectory, float]:
    """Wear a flank with step control until a stop limit is met or the horizon is reached.

    The solve is repeated with a tenth of the error per step until two successive lives
    differ by less than a tenth of the asked tolerance. A contact error counts only where
    the tightest solve meets it too.
    """
    if not isinstance(contact, FlankContact):
        # Not imported for contacts that pass.
        from wearsim.wear.settled_run import advance_resting

        return advance_resting(contact, law, stop_limits, horizon, life_tolerance)
    problem = _Problem(contact, law, stop_limits, horizon * law.coefficient)
    x, y, depth = problem.start()
    check_touch(contact, x, y, depth, 0.0)
    tolerance = float(np.clip(PART_OF_TOLERANCE * life_tolerance, FINEST, LOOSEST))
    change = math.inf
    before: _Solution | None = None
    failure: WearsimError | None = None
    while tolerance >= TIGHTEST:
        try:
            after = _Solve(problem, tolerance).run()
        except _TooManyStepsError as error:
            raise ConvergenceError(str(error)) from None
        except (ContactError, ConvergenceError) as error:
            # Loose steps may run past what the flank itself never does; tighter ones decide.
            # Without the frames that hold all states of that solve.
            before, failure = None, error.with_traceback(None)
        else:
            if before is not None and before.met == after.met:
                change = after.change(before)
                if change <= 0.1 * life_tolerance:
                    return _trajectory(problem, after), change
            before = after.ended()
            del after
        tolerance *= 0.1
    if before is None and failure is not None:
        raise failure
    raise ConvergenceError(
        f"wear: two solves must agree on the life within {0.1 * life_tolerance:.1g}, but differ by "
        f"{change:.1g} even at the tightest step tolerance: ask a larger life_tolerance"
    )


def _trajectory(problem: _Problem, solution: _Solution) -> Trajectory:
    times = np.linspace(0.0, solution.end, SNAPSHOTS + 1)
    x, y, depth = np.ascontiguousarray(solution.states(times).transpose(1, 0, 2))
    return Trajectory(
        cycles=times / problem.law.coefficient,
        x=x,
        y=y,
        depth=depth,
        met=solution.met,
        updates=solution.rates,
    )
