"""Wear where mates dwell: implicit steps over many cycles, the chain growing meanwhile.

Every step presses each event of a cycle on the worn outline once and lets it wear as if
it came as often as the step has cycles. The pressure of an event is that after its own
wear, and the next event meets what it left, so a step of any size is stable; its size
is set by the depth it takes off. The answer is first order in that size: runs with half
of it follow until two agree.

With steps of one cycle it is physics.md (10) to (12) on a wrap: points along the normals of the
new outline, their wear summed until the deepest has come to its limit.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wearsim.contact.criteria import Criterion, first_met, jump_criterion
from wearsim.contact.resting_engagement import ChainWear, Dwelling
from wearsim.errors import JumpError
from wearsim.geometry.profile import Vector
from wearsim.kernels.event_rows import EVENT_COUNT, EVENT_LOAD, EVENT_SLIP, EVENT_SPEED
from wearsim.wear.bodies import Bodies, Start, State
from wearsim.wear.law import Law
from wearsim.wear.trajectory import SNAPSHOTS, Trajectory

Rows = NDArray[np.float64]

_FIRST_STEP = 3e-5
"""Depth of the first step after a start or a new chain, as a part of the limit."""

_GROWTH = 1.25
_LONGEST_STEP = 0.01
"""Growth of the depth of a step over the one before, and its most as a part of the limit."""

_ELONGATION_STEPS = 160
"""Least number of steps in the life of a chain."""

Watch = Callable[[float], bool]
"""Told before every step how much of a run is done; whether to go on."""

_MOST_STEPS = 10_000
"""Steps of one run at level 0, those of about 60 chains; a run of more ends there, at no limit."""


@dataclass(frozen=True, eq=False)
class DwellingTrajectory(Trajectory):
    """Several outlines and the chain as they wear; ``x``, ``y``, ``depth`` are those worn most.

    Attributes
    ----------
    all_depth : numpy.ndarray
        Depth of every body [mm], shape (snapshots, bodies, points).
    elongation : numpy.ndarray
        Relative elongation of the chain in use, shape (snapshots,).
    roller_wear : numpy.ndarray
        Depth worn off its rollers [mm], shape (snapshots,).
    chains : numpy.ndarray
        Number of the chain in use from 1, shape (snapshots,).
    peak_pressure, sliding_speed : numpy.ndarray
        Highest pressure [MPa] and sliding speed [mm/s] of the step that led to each snapshot,
        after its wear; 0 at the start; shape (snapshots,).
    area : float
        Worn off all bodies by the events [mm2].
    """

    all_depth: Rows
    elongation: Vector
    roller_wear: Vector
    chains: Vector
    peak_pressure: Vector
    sliding_speed: Vector
    area: float


class _Record:
    """Snapshots, thinned out as they become too many; ends of chains stay."""

    def __init__(self) -> None:
        self.states: list[State] = []
        self.ends: list[State] = []
        self.stride, self.count = 1, 0

    def add(self, bodies: Bodies, last: bool = False) -> None:
        repeated = bool(self.states) and self.states[-1].cycles == bodies.cycles
        if (last or self.count % self.stride == 0) and not repeated:
            self.states.append(bodies.state())
        self.count += 1
        if len(self.states) > 2 * SNAPSHOTS + len(self.ends):
            stay = {id(state) for state in (*self.ends, self.states[-1])}
            self.states = [state for i, state in enumerate(self.states) if i % 2 == 0 or id(state) in stay]
            self.stride *= 2

    def end_chain(self, bodies: Bodies) -> None:
        self.add(bodies, last=True)
        self.ends.append(self.states[-1])

    def trajectory(self, bodies: Bodies, met: Criterion | None) -> DwellingTrajectory:
        states = self.states
        x, y, depth = (np.array([getattr(state, name) for state in states]) for name in ("x", "y", "depth"))
        worst = int(depth[-1].max(axis=1).argmax())
        return DwellingTrajectory(
            cycles=np.array([state.cycles for state in states]),
            x=x[:, worst],
            y=y[:, worst],
            depth=depth[:, worst],
            met=met,
            updates=bodies.updates,
            all_depth=depth,
            elongation=np.array([state.wear.elongation for state in states]),
            roller_wear=np.array([state.wear.roller for state in states]),
            chains=np.array([float(state.chain) for state in states]),
            peak_pressure=np.array([state.pressure for state in states]),
            sliding_speed=np.array([state.speed for state in states]),
            area=bodies.removed,
        )


class _Pace:
    """How many cycles the next step takes: as given, or as many as wear off so much."""

    def __init__(self, depth_limit: float, level: int, cycles_per_step: float) -> None:
        self.limit, self.given = depth_limit, cycles_per_step
        self.refined: float = 2.0**level
        self.rate = 0.0
        self.restart()

    def restart(self) -> None:
        """Begin with the smallest step again."""
        self.depth = _FIRST_STEP * self.limit / self.refined

    def cycles(self, bodies: Bodies, law: Law) -> float:
        """Return the cycles of the next step, not beyond the life of the chain in use."""
        cycles = self.given or self._by_depth(bodies, law)
        limit = bodies.contact.elongation_limit
        if bodies.contact.elongation_per_cycle > 0.0:
            longest = limit / (_ELONGATION_STEPS * self.refined)
            rest = limit - bodies.wear.elongation
            cycles = min(cycles, bodies.cycles_to(min(longest, rest)))
        return cycles

    def is_spent(self, bodies: Bodies) -> bool:
        """Whether the run has taken all of its steps."""
        return not self.given and bodies.updates >= _MOST_STEPS * self.refined

    def _by_depth(self, bodies: Bodies, law: Law) -> float:
        cycles = self.depth / (self.rate or _first_rate(bodies, law))
        longest = _LONGEST_STEP * self.limit / self.refined
        self.depth = min(self.depth * _GROWTH ** (1.0 / self.refined), longest)
        return max(cycles, 1.0 / self.refined)


def _first_rate(bodies: Bodies, law: Law) -> float:
    """Depth per cycle of the worst event under the Hertz pressure on a flat, about."""
    contact = bodies.contact
    table = contact.events(bodies.x, bodies.y, bodies.wear, bodies.memory)
    table = table[:, table[EVENT_LOAD] * table[EVENT_SLIP] * table[EVENT_COUNT] > 0.0]
    if table.shape[1] == 0:
        return math.inf
    hertz = np.sqrt(table[EVENT_LOAD] * contact.modulus / (math.pi * contact.roller_radius))
    worn = hertz**law.pressure_exponent * table[EVENT_SPEED] ** law.speed_exponent
    worn *= law.coefficient * table[EVENT_SLIP] * table[EVENT_COUNT]
    return float(worn.max())


def _margins(criteria: tuple[Criterion, ...], bodies: Bodies) -> float:
    return min(
        criterion.margin(bodies.x[body], bodies.y[body], bodies.depth[body])
        for criterion in criteria
        for body in range(bodies.contact.bodies)
    )


def _done(criteria: tuple[Criterion, ...], bodies: Bodies, horizon: float) -> float:
    return min(1.0, max(float(bodies.depth.max()) / criteria[0].limit, bodies.cycles / horizon))


def reporting(progress: Callable[[float], None]) -> Watch:
    """Return a watch over a run that only tells how much of it is done."""

    def _goes_on(part: float) -> bool:
        progress(part)
        return True

    return _goes_on


def _met(criteria: tuple[Criterion, ...], bodies: Bodies) -> Criterion | None:
    found = [
        first_met(criteria, bodies.x[body], bodies.y[body], bodies.depth[body])
        for body in range(bodies.contact.bodies)
    ]
    return next((criterion for criterion in found if criterion is not None), None)


def run_dwelling(
    contact: Dwelling,
    law: Law,
    criteria: tuple[Criterion, ...],
    horizon: float,
    level: int,
    cycles_per_step: float = 0.0,
    watch: Watch = lambda part: True,
    start: Start | None = None,
) -> DwellingTrajectory:
    """Wear outlines and chain until a criterion is met or the horizon is reached.

    At its elongation limit the chain is replaced by a new one. A run by depth that takes too
    many steps, those of about 60 chains, ends before its horizon.
    """
    bodies, record = Bodies(contact, law, start), _Record()
    pace = _Pace(criteria[0].limit, level, cycles_per_step)
    record.add(bodies)
    met, end = None, horizon * (1.0 - 1e-12)
    while (
        met is None
        and bodies.cycles < end
        and not pace.is_spent(bodies)
        and watch(_done(criteria, bodies, horizon))
    ):
        before = bodies.state()
        cycles = min(pace.cycles(bodies, law), horizon - bodies.cycles)
        try:
            pace.rate = bodies.step(cycles) / cycles
        except JumpError:
            if bodies.cycles == 0.0:
                raise
            record.add(bodies, last=True)
            return record.trajectory(bodies, jump_criterion(contact.slack_tension))
        met = _limit_met(criteria, bodies, before)
        if met is None and bodies.chain_is_worn:
            record.end_chain(bodies)
            bodies.replace_chain()
            pace.restart()
        else:
            record.add(bodies, last=met is not None)
    record.add(bodies, last=True)
    return record.trajectory(bodies, met)


def _limit_met(criteria: tuple[Criterion, ...], bodies: Bodies, before: State) -> Criterion | None:
    """Return the limit that the last step has met, if any, and go back to where it was met."""
    contact, met = bodies.contact, _met(criteria, bodies)
    if met is not None:
        _cut(bodies, before, lambda: _margins(criteria, bodies) > 0.0)
    if not contact.holds(bodies.x, bodies.y, bodies.wear):
        met = jump_criterion(contact.slack_limit)
        _cut(bodies, before, lambda: contact.holds(bodies.x, bodies.y, bodies.wear))
    return met


def _cut(bodies: Bodies, before: State, allowed: Callable[[], bool]) -> None:
    """Go back on the last step to the place up to which it was allowed."""
    after = bodies.state()

    def place(part: float) -> None:
        bodies.x = before.x + part * (after.x - before.x)
        bodies.y = before.y + part * (after.y - before.y)
        bodies.depth = before.depth + part * (after.depth - before.depth)
        bodies.removed = before.removed + part * (after.removed - before.removed)
        bodies.wear = ChainWear(*(b + part * (a - b) for b, a in zip(before.wear, after.wear, strict=True)))
        bodies.cycles = before.cycles + part * (after.cycles - before.cycles)

    low, high = 0.0, 1.0
    while True:
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        place(middle)
        low, high = (middle, high) if allowed() else (low, middle)
    place(high)
