"""Wear where mates rest: implicit steps over many cycles, the mate growing meanwhile.

`run_seated` takes steps of second order that place the mates and wear the bodies together
(`wearsim.wear.seated_bodies`). `run_resting` is the reference, event by event: a step presses each
event of a cycle on the worn outline once and lets it wear as if it came as often as the step has
cycles. The pressure of an event is that after its own wear, and the next event meets what it left,
so a step of any size is stable; its size is set by the depth it takes off. Its answer is first
order in that size.

With steps of one cycle it is physics.md (10) to (12) on a wrap: points along the normals of the
new outline, their wear summed until the deepest has come to its limit.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from wearsim.contact.resting_engagement import MateWear, RestingContact
from wearsim.contact.stop_limits import StopLimit, jump_limit
from wearsim.errors import ConvergenceError, JumpError
from wearsim.geometry.profile_points import Vector
from wearsim.wear.limit_in_step import go_back_to_limit, limit_of_bodies
from wearsim.wear.mate_leaps import MateLeaps
from wearsim.wear.problem import Rows, WearProblem
from wearsim.wear.resting_bodies import WornBodies, WornState
from wearsim.wear.trajectory import SNAPSHOTS, Trajectory


@dataclass(frozen=True)
class Pace:
    """How steps grow: depths as parts of the limit, at level 0."""

    first: float  # depth of the first step
    again: float  # depth of the first step after a new mate
    growth: float  # of the depth of a step over the one before
    longest: float  # the most depth of a step
    steps_per_mate: int  # least number of steps in the life of a mate
    leap: float  # the most depth of a leap over mates; 0 for no leaps


BY_EVENTS = Pace(3e-5, 3e-5, 1.25, 0.01, 160, 0.0)
"""Steps of which each presses every event once."""

BY_STAGES = Pace(1e-3, 1e-3, 2.0, 0.03, 16, 0.06)
"""Steps of implicit stages."""

_PART_OF_AGE = 0.1
"""Longest way between two snapshots as a part of the age of the mate, where parts run in."""

_SHOWN = 10
"""Ends of mates that are kept of a leap, at most."""

Watch = Callable[[float], bool]
"""Called before every step with the fraction done; returns whether to go on."""

_MAX_STEPS = 10_000
"""Steps of one run at level 0, those of about 600 mates in full; a run of more ends there, at no limit."""


@dataclass(frozen=True, eq=False)
class RestingTrajectory(Trajectory):
    """Several outlines and their mate as they wear; ``x``, ``y``, ``depth`` are those worn most."""

    all_depth: Rows  # depth of every body [mm], shape (snapshots, bodies, points)
    elongation: Vector  # relative elongation of the mate in use, shape (snapshots,)
    mate_depth: Vector  # depth worn off it [mm], shape (snapshots,)
    mates: Vector  # number of the mate in use from 1, shape (snapshots,)
    # peak_pressure, sliding_speed: highest pressure [MPa] and sliding speed [mm/s] of the step that led to
    # each snapshot, after its wear; 0 at the start; shape (snapshots,)
    peak_pressure: Vector
    sliding_speed: Vector
    area: float  # worn off all bodies by the events [mm2]
    lost: str = ""  # why the run ends before its limit and its horizon, where its mates were not found

    @property
    def every_depth(self) -> Vector:
        """Depth of every body that wears [mm], shape (snapshots, bodies, points)."""
        return self.all_depth


class _Snapshots:
    """Snapshots, thinned out as they become too many; ends of mates stay."""

    def __init__(self) -> None:
        self.states: list[WornState] = []
        self.ends: list[WornState] = []
        self.stride, self.count = 1, 0

    def add_between(self, bodies: WornBodies, before: WornState) -> None:
        """Add states of a step on whose cycles the parts run in, so that a history shows it."""
        clocks = bodies.running_in, bodies.mates.mate
        if all(clock.is_steady for clock in clocks):
            return
        whole, after = bodies.cycles - before.cycles, bodies.state()
        age = before.cycles - bodies.mate_in_use.new_at
        shortest = min(clock.shortest for clock in clocks if not clock.is_steady)
        count = min(int(whole / (_PART_OF_AGE * max(age, shortest))), SNAPSHOTS // 4)
        for place in range(1, count + 1):
            self._add(bodies.on_the_way(before, after, place / (count + 1)))

    def add(self, bodies: WornBodies, last: bool = False) -> None:
        self._add(bodies.state(), last)

    def _add(self, state: WornState, last: bool = False) -> None:
        repeated = bool(self.states) and self.states[-1].cycles == state.cycles
        if (last or self.count % self.stride == 0) and not repeated:
            self.states.append(state)
        self.count += 1
        if len(self.states) > 2 * SNAPSHOTS + len(self.ends):
            stay = {id(state) for state in (*self.ends, self.states[-1])}
            self.states = [state for i, state in enumerate(self.states) if i % 2 == 0 or id(state) in stay]
            self.stride *= 2

    def end_mate(self, bodies: WornBodies) -> None:
        self.add(bodies, last=True)
        self.ends.append(self.states[-1])

    def leap(self, bodies: WornBodies) -> None:
        """Add ends of the mates that a leap has passed since the last end, on a straight line."""
        end, mates = self.ends[-1], bodies.mate - 1 - self.ends[-1].mate
        after = replace(
            end, x=bodies.x, y=bodies.y, depth=bodies.depth, removed=bodies.removed, cycles=bodies.cycles
        )
        shown = min(mates, _SHOWN)
        for passed in (mates * place // shown for place in range(1, shown + 1)):
            state = replace(end.on_the_way_to(after, passed / mates), mate=end.mate + passed)
            self._add(state, last=True)
            self.ends.append(state)

    def go_back(self, cycles: float) -> None:
        """Forget all that came after so many cycles."""
        self.states = [state for state in self.states if state.cycles <= cycles]
        self.ends = [state for state in self.ends if state.cycles <= cycles]

    def trajectory(self, bodies: WornBodies, met: StopLimit | None) -> RestingTrajectory:
        states = self.states
        x, y, depth = (np.array([getattr(state, name) for state in states]) for name in ("x", "y", "depth"))
        worst = int(depth[-1].max(axis=1).argmax())
        return RestingTrajectory(
            cycles=np.array([state.cycles for state in states]),
            x=x[:, worst],
            y=y[:, worst],
            depth=depth[:, worst],
            met=met,
            updates=bodies.updates,
            all_depth=depth,
            elongation=np.array([state.wear.elongation for state in states]),
            mate_depth=np.array([state.wear.depth for state in states]),
            mates=np.array([float(state.mate) for state in states]),
            peak_pressure=np.array([state.pressure for state in states]),
            sliding_speed=np.array([state.speed for state in states]),
            area=bodies.removed,
        )


class _StepSize:
    """How many cycles the next step takes: as given, or as many as wear off so much."""

    def __init__(self, pace: Pace, depth_limit: float, level: int, cycles_per_step: float) -> None:
        self.pace, self.limit, self.cycles_per_step = pace, depth_limit, cycles_per_step
        self.refined: float = 2.0**level
        self.rate = 0.0
        self.depth = pace.first * self.limit / self.refined
        self.leap = pace.leap * self.limit / self.refined

    def restart(self) -> None:
        """Begin with a small step again."""
        self.depth = self.pace.again * self.limit / self.refined

    def cycles(self, bodies: WornBodies) -> float:
        """Return the cycles of the next step, not beyond the life of the mate in use."""
        cycles = self.cycles_per_step or self._by_depth(bodies)
        limit = bodies.contact.elongation_limit
        if bodies.contact.elongation_per_cycle > 0.0:
            longest = limit / (self.pace.steps_per_mate * self.refined)
            rest = limit - bodies.wear.elongation
            cycles = min(cycles, bodies.cycles_to(min(longest, rest)))
        return cycles

    def is_spent(self, bodies: WornBodies) -> bool:
        """Whether the run has taken all of its steps."""
        return not self.cycles_per_step and bodies.updates >= _MAX_STEPS * self.refined

    def _by_depth(self, bodies: WornBodies) -> float:
        cycles = self.depth / (self.rate or bodies.first_rate())
        longest = self.pace.longest * self.limit / self.refined
        self.depth = min(self.depth * self.pace.growth ** (1.0 / self.refined), longest)
        return max(cycles, 1.0 / self.refined)


def part_of(progress: Callable[[float], None], begin: float, end: float) -> Callable[[float], None]:
    """Return what is told the progress of a run that is only a part of the whole.

    Examples
    --------
    A tenth of a run that stands for the third quarter:

    >>> part_of(print, 0.5, 0.75)(0.1)
    0.525
    """
    return lambda part: progress(begin + (end - begin) * part)


def reported_progress(progress: Callable[[float], None]) -> Watch:
    """Return a watch over a run that only tells how much of it is done."""

    def _goes_on(part: float) -> bool:
        progress(part)
        return True

    return _goes_on


def run_resting(
    problem: WearProblem[RestingContact],
    level: int,
    cycles_per_step: float = 0.0,
    watch: Watch = lambda part: True,
) -> RestingTrajectory:
    """Wear outlines and mate event by event until a stop limit is met or the horizon is reached.

    At its elongation limit the mate is replaced by a new one. A run by depth that takes too
    many steps ends before its horizon.
    """
    pace = _StepSize(BY_EVENTS, problem.depth_limit, level, cycles_per_step)
    return _run(problem, WornBodies(problem), pace, watch)


def run_seated(
    problem: WearProblem[RestingContact], level: int, watch: Watch = lambda part: True
) -> RestingTrajectory:
    """Wear outlines and mate by implicit stages until a stop limit is met or the horizon is reached.

    At its elongation limit the mate is replaced by a new one. A run that takes too many steps
    ends before its horizon.
    """
    # A run event by event does without.
    from wearsim.wear.seated_bodies import SeatedBodies

    return _run(problem, SeatedBodies(problem), _StepSize(BY_STAGES, problem.depth_limit, level, 0.0), watch)


def _run(
    problem: WearProblem[RestingContact], bodies: WornBodies, pace: _StepSize, watch: Watch
) -> RestingTrajectory:
    record, end = _Snapshots(), problem.horizon * (1.0 - 1e-12)
    leaps = MateLeaps(bodies, pace.leap, pace.refined, lambda: _holds_on(problem, bodies, end, record))
    record.add(bodies)
    met, done = None, 0.0
    while (
        met is None
        and bodies.cycles < end
        and not pace.is_spent(bodies)
        and watch(done := max(done, _done(problem, bodies)))
    ):
        before = bodies.state()
        cycles = min(pace.cycles(bodies), problem.horizon - bodies.cycles)
        try:
            worn = bodies.step(cycles)
            pace.rate = worn / (bodies.cycles - before.cycles)
        except (JumpError, ConvergenceError) as error:
            if bodies.cycles == 0.0:
                raise
            if _taken_back(leaps, bodies, record, pace):
                continue
            return _stopped(bodies, before, record, error)
        met = go_back_to_limit(problem, bodies, before)
        if met is not None and _taken_back(leaps, bodies, record, pace):
            met = None
            continue
        record.add_between(bodies, before)
        if met is None and bodies.mate_is_worn:
            record.end_mate(bodies)
            bodies.renew_mate()
            pace.restart()
            leaps.take()
            record.leap(bodies)
        else:
            record.add(bodies, last=met is not None)
    record.add(bodies, last=True)
    return record.trajectory(bodies, met)


def _done(problem: WearProblem[RestingContact], bodies: WornBodies) -> float:
    return min(1.0, max(float(bodies.depth.max()) / problem.depth_limit, bodies.cycles / problem.horizon))


def _taken_back(leaps: MateLeaps, bodies: WornBodies, record: _Snapshots, pace: _StepSize) -> bool:
    """Go back on a leap that is not settled, in all that knows of it; whether there was one."""
    if not leaps.undo():
        return False
    record.go_back(bodies.cycles)
    pace.restart()
    return True


def _holds_on(
    problem: WearProblem[RestingContact], bodies: WornBodies, end: float, record: _Snapshots
) -> bool:
    """Tell whether a mate may come to its end on the bodies within all limits."""
    worn = MateWear(problem.contact.elongation_limit, record.ends[-1].wear.depth)
    within = bodies.cycles < end and limit_of_bodies(problem, bodies) is None
    return within and problem.contact.holds(bodies.x, bodies.y, worn)


def _stopped(
    bodies: WornBodies, before: WornState, record: _Snapshots, error: JumpError | ConvergenceError
) -> RestingTrajectory:
    """Return what is worn before a step whose mates are not found: it holds, the life is longer."""
    bodies.go_back(before)
    record.add(bodies, last=True)
    if isinstance(error, JumpError):
        return record.trajectory(bodies, jump_limit(bodies.contact.slack_tension))
    return replace(record.trajectory(bodies, None), lost=str(error))
