"""One solve: flanks of one kind in compiled steps of a given error, until something ends each of them."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import NoReturn

import numpy as np

from wearsim.contact.engagement import FlankContact
from wearsim.contact.stop_limits import StopLimit
from wearsim.errors import ContactError, ConvergenceError, WearsimError
from wearsim.geometry.profile_points import Vector
from wearsim.kernels.controlled_steps import (
    CLOCK,
    END,
    RATES,
    STATE_ROWS,
    STATUS,
    WIDEST,
    WRITTEN,
    states_between,
    wear_flanks,
)
from wearsim.kernels.hertz_wear import DEPTH_REACHED, HORIZON, RATE, RUNNING, SAWTOOTH, VANISHED, WORN
from wearsim.kernels.rosenbrock import STAGES, WORK_ROWS, rosenbrock_step
from wearsim.wear.limit_in_step import first_limit_on_path
from wearsim.wear.problem import Rows, WearProblem
from wearsim.wear.python_contact import PythonContact
from wearsim.wear.trajectory import check_sawtooth, check_touch, no_sliding

_CONFORMS = 1e-5
"""Relative curvature over that of the mate at which a run that does not get on has come to a flank
that conforms: the width of the contact is then several radii of the mate."""

_CHUNK, _MAX_STEPS = 64, 10_000
"""States of a compiled call, and steps of one solve; a life takes some dozens."""

_MOST_BYTES = 2e9
"""Memory that the states of one solve may take: fewer steps on very many points."""

Problems = Sequence[WearProblem[FlankContact]]


@dataclass(frozen=True, eq=False)
class Solution:
    """Where one solve ends, and its states on the way there as far as they are kept."""

    end: float  # in cycles times coefficient
    met: StopLimit | None
    rates: int
    final: Rows  # x, y and depth at the end
    widest: float  # greatest load over relative curvature [N] of the steps taken, the last left out
    # states at their times, the end between the last two
    times: Vector = field(default_factory=lambda: np.empty(0))
    path: Rows = field(default_factory=lambda: np.empty((0, STATE_ROWS, 0)))

    def ended(self) -> "Solution":
        """Return the end alone, without the memory that the states take."""
        return Solution(self.end, self.met, self.rates, self.final, self.widest)

    def change(self, before: "Solution") -> float:
        """Return the relative difference from a solve that met the same limit.

        It is that of the lives; at the horizon the greatest of all depths there, over the
        greatest depth: that of one point alone may be small by accident.
        """
        if self.met:
            return abs(self.end / before.end - 1.0)
        depth, other = self.final[2], before.final[2]
        return float(np.abs(depth - other).max() / depth.max())


def states_at(wanted: Vector, times: Vector, path: Rows) -> Rows:
    """Return x, y and depth at increasing times within those of states, shape (times, 3, points)."""
    found = np.empty((wanted.size, 3, path.shape[2]))
    states_between(times, path, wanted, found)
    return found


def _state_at(times: Vector, path: Rows, time: float) -> Rows:
    state: Rows = states_at(np.array([time]), times, path)[0]
    return state


class TooManyStepsError(ConvergenceError):
    """A solve that does not end; a tighter one would take even more steps."""


def unworn(contact: FlankContact) -> Rows:
    """Return x, y and depth of a new flank."""
    return np.array([contact.profile.x, contact.profile.y, np.zeros(contact.profile.x.size)])


def _numbers(problem: WearProblem[FlankContact], tolerance: float) -> tuple[float, ...]:
    """Return the numbers of a flank in the order in which the kernel names them."""
    contact, law = problem.contact, problem.law
    diffusion = law.diffusion(contact.kind, contact.slip_curvature_exponent)
    return contact.modulus, diffusion, problem.depth_limit, tolerance, problem.horizon * law.coefficient


class _Flanks:
    """The arrays of flanks of one kind on their way through compiled steps."""

    def __init__(self, problems: Problems, tolerances: Sequence[float], states: int) -> None:
        contacts = [problem.contact for problem in problems]
        self.one, points = contacts[0], contacts[0].profile.x.size
        self.states = np.array([unworn(contact) for contact in contacts])
        self.constants = np.array([contact.constants for contact in contacts])
        self.columns = np.array([contact.columns for contact in contacts])
        self.numbers = np.array([_numbers(*pair) for pair in zip(problems, tolerances, strict=True)])
        self.laws = np.array([problem.law.unit_numbers(problem.contact.kind) for problem in problems])
        self.work, self.increments = np.zeros((WORK_ROWS, points)), np.zeros((STAGES, 3 * points))
        self.clocks = np.zeros((len(problems), CLOCK))
        self.times = np.empty((len(problems), states))
        self.path = np.empty((len(problems) * states, STATE_ROWS, points))

    def go_on(self, most_states: int) -> None:
        """Wear all until they end, or until so many states of each are on its path."""
        wear_flanks(
            rosenbrock_step,
            self.one.kernel,
            self.states,
            self.constants,
            self.columns,
            self.numbers,
            self.laws,
            int(not self.one.offset_form),
            most_states,
            self.work,
            self.increments,
            self.clocks,
            self.times,
            self.path,
        )

    def solution(self, place: int, problem: WearProblem[FlankContact]) -> Solution | WearsimError:
        """Return where a flank ends, or an error without words."""
        clock, status = self.clocks[place], self.clocks[place, STATUS]
        if status not in (DEPTH_REACHED, HORIZON):
            return TooManyStepsError() if status == RUNNING else ConvergenceError()
        met = problem.stop_limits[0] if status == DEPTH_REACHED else None
        end, rates, widest = float(clock[END]), int(clock[RATES]), float(clock[WIDEST])
        return Solution(end, met, rates, self.states[place], widest)


class _Solve:
    """One solve on its way: the compiled steps and the states that they have written."""

    def __init__(self, problems: Problems, tolerances: Sequence[float]) -> None:
        [self.problem], self.flank = problems, _Flanks(problems, tolerances, _CHUNK)
        self.clock, self.state = self.flank.clocks[0], self.flank.states[0]
        self.chunks: list[tuple[Vector, Rows]] = []
        self.most = min(_MAX_STEPS, int(_MOST_BYTES / (8 * STATE_ROWS * self.state.shape[1])))

    def run(self) -> Solution:
        """Go on until a limit or the horizon ends it; raise what else does."""
        status, failing = RUNNING, None
        while status == RUNNING and failing is None and self._states() <= self.most:
            status = self._go_on()
            failing = self._first_failing()
        if failing is None and status not in (DEPTH_REACHED, HORIZON):
            self._refuse(status)
        met = self.problem.stop_limits[0] if status == DEPTH_REACHED else None
        end, rates, widest = float(self.clock[END]), int(self.clock[RATES]), float(self.clock[WIDEST])
        if failing is not None:
            times, path = self.chunks[-1]
            if failing + 1 < times.size:
                end, met = float(times[failing]), None
            self.chunks[-1] = times[: failing + 1], path[: failing + 1]
        times, path = (np.concatenate(parts) for parts in zip(*self.chunks, strict=True))
        if failing is not None:
            end, met = self._limit_in_last_step(times[-2:].copy(), path[-2:].copy(), end, met)
        final = states_at(np.array([end]), times, path)[0]
        return Solution(end, met, rates, final, widest, times, path)

    def _states(self) -> int:
        return sum(times.size for times, _ in self.chunks)

    def _go_on(self) -> int:
        self.clock[WRITTEN] = 0.0
        self.flank.go_on(_CHUNK)
        written = int(self.clock[WRITTEN])
        # The last state of a call is the first of the next.
        new = 1 if self.chunks else 0
        if written > new:
            self.chunks.append((self.flank.times[0, new:written].copy(), self.flank.path[new:written].copy()))
        return int(self.clock[STATUS])

    def _first_failing(self) -> int | None:
        """Return the first state of the last chunk at which a limit other than the depth fails."""
        others = self.problem.stop_limits[1:]
        for place, (x, y, depth) in enumerate(self.chunks[-1][1][:, :3]):
            if any(stop_limit.margin(x, y, depth) <= 0.0 for stop_limit in others):
                return place
        return None

    def _limit_in_last_step(
        self, times: Vector, path: Rows, end: float, met: StopLimit | None
    ) -> tuple[float, StopLimit | None]:
        """Return where in the last step the first of the limits that fail after it is met."""
        others, state = self.problem.stop_limits[1:], partial(_state_at, times, path)
        return first_limit_on_path(others, state, (times[0], times[-1]), path[-1, :3], (end, met))

    def _cycles_run(self, time: float) -> float:
        law = self.problem.law
        return float(law.running_in.running_cycles(np.array([time / law.coefficient]))[0])

    def _refuse(self, status: int) -> NoReturn:
        if isinstance(self.problem.contact.kernel, PythonContact) and self.problem.contact.kernel.failed:
            raise self.problem.contact.kernel.failed
        contact, (times, path) = self.problem.contact, self.chunks[-1]
        cycles = self._cycles_run(float(times[-1]))
        x, y, depth = self.state
        if np.isfinite(self.state).all():
            check_touch(contact, x, y, depth, cycles, _CONFORMS / contact.mate_radius)
        if status == VANISHED:
            raise no_sliding(cycles)
        if status == SAWTOOTH:
            check_sawtooth(contact, depth, cycles, self.problem.depth_limit)
        broken = ~np.isfinite(self.flank.work[WORN])
        place = contact.arc_length[int((broken if broken.any() else path[-1, RATE]).argmax())]
        if status == RUNNING:
            raise TooManyStepsError(
                f"wear at cycle {cycles:.6g}: the solver must come to an end within {self.most} steps, but "
                "has not: ask a larger run.life_tolerance, or fewer nodes"
            )
        raise ConvergenceError(
            f"wear at cycle {cycles:.6g}, {place:.4g} mm from the root: the solver must be able to go "
            'on, but stopped: use method = "per_cycle" or more nodes'
        )


def solve_together(problems: Problems, tolerances: Sequence[float]) -> list[Solution | WearsimError]:
    """Wear flanks down to their depths in one compiled call that holds no lock; keep where they end."""
    flanks = _Flanks(problems, tolerances, 2)
    flanks.go_on(_MAX_STEPS)
    return [flanks.solution(place, problem) for place, problem in enumerate(problems)]


def solve_alone(problems: Problems, tolerances: Sequence[float]) -> list[Solution | WearsimError]:
    """Wear one flank; keep all states, and end where the first of all its limits is met."""
    try:
        return [_Solve(problems, tolerances).run()]
    except (ContactError, ConvergenceError) as error:
        # Without the frames that hold all states of that solve.
        return [error.with_traceback(None)]
