"""The reference run: the source's equations physics.md (10) to (12), cycle by cycle.

(10) and the sum of (11) stand in the compiled loop, `wearsim.kernels.per_cycle_loop`; here it runs until the
deepest point has come to the limit, (12). `wearsim.result.lives` turns the cycles into hours, (13).
"""

import contextlib
import logging
import math
import signal
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from types import FrameType

import numpy as np

from wearsim.contact.engagement import FlankContact
from wearsim.contact.resting_engagement import RestingContact
from wearsim.contact.stop_limits import StopLimit
from wearsim.errors import ConvergenceError
from wearsim.geometry.profile_points import Vector
from wearsim.kernels.hertz_wear import (
    BROKEN,
    CONFORMING,
    NORMAL_X,
    NORMAL_Y,
    RELATIVE,
    RUNNING,
    SPACING_SQUARED,
    UNSTABLE,
    VANISHED,
    WORN,
)
from wearsim.quantities import time_in_words
from wearsim.wear.limit_in_step import first_place
from wearsim.wear.problem import AnyContact, WearProblem
from wearsim.wear.trajectory import SNAPSHOTS, Trajectory, check_sawtooth, check_touch, no_sliding

_BLOCK = 50_000
"""Updates between two looks at the keyboard: compiled code does not see an interrupt."""

_MAX_POINTS = 1e11
"""Updates of a run times points, each of some nanoseconds: some ten minutes."""

_MAX_RESTING = 200_000
"""Updates of a run where mates rest in the outline, each of some milliseconds."""


_FEW, _LONG = 10, 3.0
"""Trials whose updates take no time worth a word, and seconds above which a run is announced."""

_LOG = logging.getLogger(__name__)


@contextlib.contextmanager
def _interrupts_held() -> Iterator[None]:
    """Hold Ctrl-C back until compiled code has returned: numba may swallow it on the way in."""
    held: list[tuple[int, FrameType | None]] = []
    before = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(before):
        yield
        return
    signal.signal(signal.SIGINT, lambda number, frame: held.append((number, frame)))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
    if held:
        before(*held[0])


def _compiled_loop(contact: FlankContact) -> tuple[int, Callable[..., int]]:
    """Return the rows to work in and the loop."""
    if contact.offset_form:
        from wearsim.kernels.offset import OFFSET_ROWS, run_offset_cycles

        return OFFSET_ROWS, run_offset_cycles
    from wearsim.kernels.per_cycle_loop import CYCLES_ROWS, run_cycles

    return CYCLES_ROWS, partial(run_cycles, contact.kernel)


class _CycleRun:
    """State of the flank between blocks of compiled updates."""

    def __init__(
        self,
        problem: WearProblem[FlankContact],
        cycles_per_update: int,
        progress: Callable[[float], None] = lambda part: None,
    ) -> None:
        self.progress, self.done = progress, 0.0
        contact, law = problem.contact, problem.law
        self.problem, self.contact, self.depth_limit = problem, contact, problem.depth_limit
        self.cycles_per_update = float(cycles_per_update)
        self.law, self.running_in = law.numbers(contact.kind), law.running_in
        self.diffusion = law.diffusion(contact.kind, contact.slip_curvature_exponent)
        self.x, self.y = contact.profile.x.copy(), contact.profile.y.copy()
        self.depth = np.zeros(self.x.size)
        rows, self.run = _compiled_loop(contact)
        self.work = np.zeros((rows, self.x.size))
        self.updates = 0

    @property
    def cycles(self) -> float:
        return self.updates * self.cycles_per_update

    @property
    def ran(self) -> float:
        """Cycles run, for messages."""
        return float(self.running_in.running_cycles(np.array([self.cycles]))[0])

    @property
    def last_step(self) -> Vector:
        return np.asarray(self.work[WORN])

    def wear(self, depth: float, updates: int) -> None:
        """Update until a depth is reached, at most so often; raise what the kernel found."""
        status, last = RUNNING, self.updates + updates
        while status == RUNNING and self.updates < last:
            status = self._block(depth, min(_BLOCK, last - self.updates))
            self._tell()
        if status in (CONFORMING, VANISHED):
            check_touch(self.contact, self.x, self.y, self.depth, self.ran)
            raise no_sliding(self.ran)
        if status == UNSTABLE:
            self._refuse()
        if status == BROKEN:
            place = self.contact.arc_length[int(np.isfinite(self.last_step).argmin())]
            raise ConvergenceError(
                f"wear at cycle {self.ran:.6g}, {place:.4g} mm from the root: the depth per cycle must "
                "be a number, but is not: check load and sliding there"
            )
        check_sawtooth(self.contact, self.depth, self.ran, self.depth_limit)

    def _tell(self) -> None:
        """Call `progress` with the fraction of the depth or of the horizon that is done; it only rises."""
        part = max(float(self.depth.max()) / self.depth_limit, self.cycles / self.problem.horizon)
        self.done = max(self.done, min(1.0, part))
        self.progress(self.done)

    def replay(self, snapshot: tuple[float, Vector, Vector, Vector], start: int, updates: int) -> None:
        """Update so often from a snapshot, taken after the first ones."""
        self.x[:], self.y[:], self.depth[:] = snapshot[1:]
        self.updates = start
        self.wear(np.inf, updates)

    def _block(self, depth: float, updates: int) -> int:
        done = np.zeros(1)
        with _interrupts_held():
            status = self.run(
                self.x,
                self.y,
                self.depth,
                self.contact.constants,
                self.contact.columns,
                self.work,
                self.contact.modulus,
                self.law,
                self.diffusion,
                self.cycles_per_update,
                depth,
                updates,
                done,
            )
        self.updates += int(done[0])
        return int(status)

    def _refuse(self) -> None:
        spacing_squared, relative = self.work[SPACING_SQUARED], self.work[RELATIVE]
        limits = spacing_squared * relative / (2.0 * self.diffusion)
        point = int(np.argmax(self.last_step / limits))
        step, limit = self.last_step[point], limits[point]
        allowed_cycles = int(self.cycles_per_update * limit / step)
        remedy = f"cycles_per_update = {allowed_cycles}" if allowed_cycles else "fewer nodes"
        raise ConvergenceError(
            f"wear at cycle {self.ran:.6g}, {self.contact.arc_length[point]:.4g} mm from the root: "
            f"the depth per update must stay below spacing^2/(2 e rho_H) = {limit:.3g} mm, is "
            f"{step:.3g} mm: the life would be wrong without notice; take {remedy} or method = "
            '"advance"'
        )


def check_length(problem: WearProblem[AnyContact], expected: float, cycles_per_update: int) -> None:
    """Refuse a run of too many updates before it starts, and log how long a long one will take.

    So many cycles are expected in all.
    """
    run: Callable[[], object]
    if isinstance(problem.contact, RestingContact):
        from wearsim.wear.implicit_steps import run_resting

        most_updates, tried = _MAX_RESTING, 10
        step = float(cycles_per_update)
        run = partial(run_resting, replace(problem, horizon=tried * step), 0, step)
    else:
        most_updates, tried = int(_MAX_POINTS / problem.contact.profile.x.size), 1000
        run = partial(_CycleRun(problem, cycles_per_update).wear, math.inf, tried)
    updates = expected / cycles_per_update
    if updates < _FEW * tried:
        return
    run()  # loads the loop, which takes longer than these updates
    begin = time.perf_counter()
    run()
    seconds = updates / tried * (time.perf_counter() - begin)
    if updates > most_updates:
        raise ConvergenceError(
            f"wear: a cycle-by-cycle run must stay below {most_updates} updates, takes {updates:.3g}, about "
            f"{time_in_words(seconds)}: take cycles_per_update = {math.ceil(expected / most_updates)} or "
            'method = "advance"'
        )
    if seconds > _LONG:
        _LOG.info("cycle by cycle: %s updates, about %s", f"{updates:.3g}", time_in_words(seconds))


def run_per_cycle(
    problem: WearProblem[AnyContact],
    cycles_per_update: int,
    progress: Callable[[float], None] = lambda part: None,
) -> Trajectory:
    """Wear a flank update by update until a stop limit is met or the horizon is reached.

    For a contact that passes, `progress` is called with the fraction done.
    """
    if isinstance(problem.contact, RestingContact):
        # Not imported for contacts that pass.
        from wearsim.wear.implicit_steps import run_resting

        return run_resting(problem, 0, float(cycles_per_update))
    horizon, run = problem.horizon, _CycleRun(problem, cycles_per_update, progress)
    check_touch(problem.contact, run.x, run.y, run.depth, 0.0)
    kept = [(0.0, run.x.copy(), run.y.copy(), run.depth.copy())]
    most_updates = int(horizon / cycles_per_update)
    if most_updates == 0:
        raise ConvergenceError(
            f"wear: the horizon of {horizon:.6g} cycles must hold at least one update of "
            f"{cycles_per_update} cycles: take fewer cycles_per_update or more horizon_hours"
        )
    met, interval = None, 0.0
    while met is None and run.updates < most_updates:
        before = kept[-1], run.updates
        target = run.depth.max() + interval if interval else 0.0
        run.wear(target, most_updates - run.updates)
        if not interval:
            interval = float(min(run.depth_limit, run.depth.max() * most_updates)) / SNAPSHOTS
        met = problem.met(run.x, run.y, run.depth)
        if met is not None and run.updates - before[1] > 1:
            _retreat(run, *before)
        kept.append((run.cycles, run.x.copy(), run.y.copy(), run.depth.copy()))
    if met is not None:
        kept[-1] = _on_limit(run, met)
    cycles, x, y, depth = (np.array(values) for values in zip(*kept, strict=True))
    return Trajectory(cycles, x, y, depth, met, run.updates)


def _retreat(run: _CycleRun, snapshot: tuple[float, Vector, Vector, Vector], start: int) -> None:
    """Go back to the last snapshot and stop right after the first update that meets a limit."""

    def fails(updates: int) -> bool:
        run.replay(snapshot, start, updates)
        return run.problem.met(run.x, run.y, run.depth) is not None

    run.replay(snapshot, start, first_place(fails, 0, run.updates - start))


def _on_limit(run: _CycleRun, met: StopLimit) -> tuple[float, Vector, Vector, Vector]:
    """Interpolate the last update to the place where the margin vanishes."""
    step = run.last_step
    x, y = run.x + step * run.work[NORMAL_X], run.y + step * run.work[NORMAL_Y]
    depth = run.depth - step
    before, after = met.margin(x, y, depth), met.margin(run.x, run.y, run.depth)
    part = before / (before - after) if before > after else 1.0
    cycles = run.cycles - (1.0 - part) * run.cycles_per_update
    return (cycles, run.x + (x - run.x) * (1 - part), run.y + (y - run.y) * (1 - part), depth + part * step)
