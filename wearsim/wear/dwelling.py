"""Wear where mates dwell: implicit steps over many cycles, the chain growing meanwhile.

Every step presses each event of a cycle on the worn outline once and lets it wear as if
it came as often as the step has cycles. The pressure of an event is that after its own
wear, and the next event meets what it left, so a step of any size is stable; its size
is set by the depth it takes off. The answer is first order in that size: runs with half
of it follow until two agree.
"""

import math
import os
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wearsim.contact.dwelling import NEW_CHAIN, ChainWear, Dwelling
from wearsim.errors import ContactError, ConvergenceError, JumpError
from wearsim.geometry.profile import Profile, Vector
from wearsim.kernels.dwelling import (
    AREA,
    CASE_DEPTH,
    COEFFICIENT,
    CORE_FACTOR,
    CYCLES,
    FINDINGS,
    HARD_AREA,
    MATE_RADIUS,
    NUMBERS,
    PEAK_PRESSURE,
    PRESSURE_EXPONENT,
    REACH,
    SPEED_EXPONENT,
    TOLERANCE,
    UNBALANCED,
    wear_events,
)
from wearsim.kernels.event_rows import EVENT_COUNT, EVENT_LOAD, EVENT_SLIP, EVENT_SPEED
from wearsim.kernels.half_space import WORK_ROWS, influence_coefficients
from wearsim.wear.criteria import Criterion, first_met, jump_criterion
from wearsim.wear.law import Law
from wearsim.wear.trajectory import SNAPSHOTS, Trajectory, difference

Rows = NDArray[np.float64]

_FIRST_STEP = 3e-5
"""Depth of the first step after a start or a new chain, as a part of the limit."""

_GROWTH = 1.25
_LONGEST_STEP = 0.01
"""Growth of the depth of a step over the one before, and its most as a part of the limit."""

_ELONGATION_STEPS = 40
"""Least number of steps in the life of a chain."""

_REACH = 1.2
"""Half of the stretch of outline that an event may touch, in radii of the mate."""

_MOST_LEVELS = 3

Watch = Callable[[float], bool]
"""Told before every step how much of a run is done; whether to go on."""

_MOST_STEPS = 10_000
"""Steps of one run at level 0; a sprocket of some chains takes some hundreds."""


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
        Highest pressure [MPa] and sliding speed [mm/s] at each snapshot, shape (snapshots,).
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


@dataclass(frozen=True, eq=False)
class Start:
    """Worn outlines and a used chain that a run may begin with.

    Attributes
    ----------
    depth : numpy.ndarray
        Depth of every body along the normals of the new outline [mm], shape (bodies, points).
    wear : ChainWear
        What the chain has lost.
    chain : int
        Its number from 1.
    """

    depth: Rows
    wear: ChainWear
    chain: int


@dataclass(frozen=True, eq=False)
class _State:
    """Outlines, depth, area, chain and cycles at one time; pressure and speed of the last step."""

    x: Rows
    y: Rows
    depth: Rows
    removed: float
    wear: ChainWear
    cycles: float
    chain: int
    pressure: float
    speed: float


class _Bodies:
    """Worn outlines, the chain, and one step of their wear."""

    def __init__(self, contact: Dwelling, law: Law, start: Start | None) -> None:
        self.contact = contact
        profile, bodies = contact.profile, contact.bodies
        points = profile.x.size
        arc = contact.arc_length
        spacing = np.zeros(points)
        spacing[1:] += 0.5 * np.diff(arc)
        spacing[:-1] += 0.5 * np.diff(arc)
        self.unworn = np.array(
            [profile.x, profile.y, profile.normal_x, profile.normal_y, profile.curvature, spacing]
        )
        self.x, self.y = np.tile(profile.x, (bodies, 1)), np.tile(profile.y, (bodies, 1))
        self.area, self.depth = np.zeros((bodies, points)), np.zeros((bodies, points))
        step = float(arc[-1]) / (points - 1)
        # Coefficients of a line of unit cells times the size of a cell.
        self.coefficients = np.empty(2 * points - 1)
        influence_coefficients(contact.modulus, self.coefficients)
        self.numbers = np.zeros(NUMBERS)
        self.numbers[COEFFICIENT] = law.coefficient
        self.numbers[PRESSURE_EXPONENT] = law.pressure_exponent
        self.numbers[SPEED_EXPONENT] = law.speed_exponent
        self.numbers[CASE_DEPTH], self.numbers[CORE_FACTOR] = law.case_depth, law.core_factor
        self.numbers[REACH] = math.ceil(_REACH * contact.roller_radius / step)
        self.numbers[TOLERANCE] = 1e-6
        self.work = np.zeros((3 + WORK_ROWS, points))
        self.findings = np.zeros(FINDINGS)
        self.pressures = np.zeros((0, points))
        self.memory = contact.memory()
        self.wear, self.cycles, self.chain = NEW_CHAIN, 0.0, 1
        self.updates, self.removed, self.speed = 0, 0.0, 0.0
        if start is not None:
            self._begin(profile, start)

    def _begin(self, profile: Profile, start: Start) -> None:
        self.depth = start.depth.copy()
        self.area = self.depth * (1.0 - 0.5 * profile.curvature * self.depth)
        self.x, self.y = profile.receded(self.depth)
        self.wear, self.chain = start.wear, start.chain

    def state(self) -> "_State":
        """Return a copy of all that changes."""
        return _State(
            self.x.copy(), self.y.copy(), self.depth.copy(), self.removed, self.wear,
            self.cycles, self.chain, float(self.findings[PEAK_PRESSURE]), self.speed,
        )  # fmt: skip

    def step(self, cycles: float) -> float:
        """Wear for so many cycles at once; return the most that any point receded."""
        table = self.contact.events(self.x, self.y, self.wear, self.memory)
        if self.pressures.shape[0] != table.shape[1]:
            self.pressures = np.zeros((table.shape[1], self.x.shape[1]))
        if not (table[EVENT_LOAD] * table[EVENT_SLIP] * table[EVENT_COUNT]).max() > 0.0:
            raise ContactError(
                f"contact at cycle {self.cycles:.6g}: loaded rollers must slide, but none does: without "
                "load and sliding there is no wear and no life"
            )
        self.numbers[CYCLES] = cycles
        self.numbers[MATE_RADIUS] = self.contact.roller_radius - self.wear.roller
        before = self.depth.copy()
        wear_events(
            table, self.updates % 2, self.x, self.y, self.area, self.depth, self.unworn,
            self.coefficients, self.numbers, self.pressures, self.work, self.findings,
        )  # fmt: skip
        if self.findings[UNBALANCED] > 0.0 or not np.isfinite(self.depth).all():
            raise ConvergenceError(
                f"wear at cycle {self.cycles:.6g}: the pressure of every roller must be found, but "
                f"{int(self.findings[UNBALANCED])} of {table.shape[1]} were not: use more nodes"
            )
        self.speed = float(table[EVENT_SPEED][table[EVENT_LOAD] > 0.0].max())
        self.removed += float(self.findings[AREA])
        hard_area = float(self.findings[HARD_AREA]) / self.contact.bodies
        self.wear = self.contact.chain_after(self.wear, cycles, hard_area)
        self.cycles += cycles
        self.updates += 1
        return float((self.depth - before).max())


class _Record:
    """Snapshots, thinned out as they become too many; ends of chains stay."""

    def __init__(self) -> None:
        self.states: list[_State] = []
        self.ends: list[_State] = []
        self.stride, self.count = 1, 0

    def add(self, bodies: _Bodies, last: bool = False) -> None:
        repeated = bool(self.states) and self.states[-1].cycles == bodies.cycles
        if (last or self.count % self.stride == 0) and not repeated:
            self.states.append(bodies.state())
        self.count += 1
        if len(self.states) > 2 * SNAPSHOTS + len(self.ends):
            stay = {id(state) for state in (*self.ends, self.states[-1])}
            self.states = [
                state for i, state in enumerate(self.states) if i % 2 == 0 or id(state) in stay
            ]
            self.stride *= 2

    def end_chain(self, bodies: _Bodies) -> None:
        self.add(bodies, last=True)
        self.ends.append(self.states[-1])

    def trajectory(self, bodies: _Bodies, met: Criterion | None) -> DwellingTrajectory:
        states = self.states
        x, y, depth = (
            np.array([getattr(state, name) for state in states]) for name in ("x", "y", "depth")
        )
        worst = int(depth[-1].max(axis=1).argmax())
        pressure = np.array([state.pressure for state in states])
        speed = np.array([state.speed for state in states])
        pressure[0], speed[0] = pressure[1], speed[1]
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
            peak_pressure=pressure,
            sliding_speed=speed,
            area=bodies.removed,
        )


def _step_sizes(depth_limit: float, level: int) -> Iterator[float]:
    """Depths of successive steps after a start, smaller by half on every level."""
    depth = _FIRST_STEP * depth_limit / 2**level
    while True:
        yield depth
        depth = min(depth * _GROWTH ** (1.0 / 2**level), _LONGEST_STEP * depth_limit / 2**level)


def _margins(criteria: tuple[Criterion, ...], bodies: _Bodies) -> float:
    return min(
        criterion.margin(bodies.x[body], bodies.y[body], bodies.depth[body])
        for criterion in criteria
        for body in range(bodies.contact.bodies)
    )


def _done(criteria: tuple[Criterion, ...], bodies: _Bodies, horizon: float) -> float:
    return min(1.0, max(float(bodies.depth.max()) / criteria[0].limit, bodies.cycles / horizon))


def reporting(progress: Callable[[float], None]) -> Watch:
    """Return a watch over a run that only tells how much of it is done.

    Parameters
    ----------
    progress : callable
        Told a part from 0 to 1.

    Returns
    -------
    callable
        For ``run_dwelling``.
    """

    def _goes_on(part: float) -> bool:
        progress(part)
        return True

    return _goes_on


def _met(criteria: tuple[Criterion, ...], bodies: _Bodies) -> Criterion | None:
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

    At its elongation limit the chain is replaced by a new one.

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
    level : int
        Steps are smaller by half for each level above 0.
    cycles_per_step : float
        Cycles of every step; 0 for steps by the depth that they take off.
    watch : callable, optional
        Told before every step how much of the run is done, from 0 to 1. Where it returns
        False the run ends early; what comes back then is not complete.
    start : Start, optional
        Worn outlines and a used chain to begin with; new ones otherwise.

    Returns
    -------
    DwellingTrajectory
        The run.

    Raises
    ------
    ContactError
        The chain jumps, or nothing slides under load.
    ConvergenceError
        A pressure cannot be found.
    """
    bodies, record = _Bodies(contact, law, start), _Record()
    record.add(bodies)
    limit, growth = criteria[0].limit, contact.elongation_per_cycle
    elongation_limit = contact.elongation_limit
    sizes = _step_sizes(limit, level)
    rate, met = 0.0, None
    while met is None and bodies.cycles < horizon and watch(_done(criteria, bodies, horizon)):
        before = bodies.state()
        if not cycles_per_step and bodies.updates > _MOST_STEPS * 2**level:
            raise ConvergenceError(
                f"wear at cycle {bodies.cycles:.6g}: the run must end within {_MOST_STEPS} steps, but "
                f"is at chain {bodies.chain} and {bodies.depth.max():.3g} mm: lower run.horizon_hours"
            )
        cycles = cycles_per_step
        if not cycles_per_step:
            cycles = (
                next(sizes) / rate if rate else _first_cycles(contact, bodies, law, next(sizes))
            )
            cycles = max(cycles, min(1.0, 1.0 / 2**level))
        if growth > 0.0:
            longest = elongation_limit / growth / (_ELONGATION_STEPS * 2**level)
            cycles = min(cycles, longest, (elongation_limit - bodies.wear.elongation) / growth)
        cycles = min(cycles, horizon - bodies.cycles)
        try:
            rate = bodies.step(cycles) / cycles
        except JumpError:
            if bodies.cycles == 0.0:
                raise
            record.add(bodies, last=True)
            met = jump_criterion(contact.slack_tension)
            break
        met = _limit_met(criteria, bodies, before)
        if (
            met is None
            and growth > 0.0
            and bodies.wear.elongation >= elongation_limit * (1.0 - 1e-9)
        ):
            record.end_chain(bodies)
            bodies.wear, bodies.chain = NEW_CHAIN, bodies.chain + 1
            sizes = _step_sizes(limit, level)
        else:
            record.add(bodies, last=met is not None or not bodies.cycles < horizon)
    return record.trajectory(bodies, met)


def _limit_met(
    criteria: tuple[Criterion, ...], bodies: _Bodies, before: _State
) -> Criterion | None:
    """Return the limit that the last step has met, if any, and go back to where it was met."""
    contact, met = bodies.contact, _met(criteria, bodies)
    if met is not None:
        _cut(bodies, before, lambda: _margins(criteria, bodies) > 0.0)
    if not contact.holds(bodies.x, bodies.y, bodies.wear):
        met = jump_criterion(contact.slack_limit)
        _cut(bodies, before, lambda: contact.holds(bodies.x, bodies.y, bodies.wear))
    return met


def _first_cycles(contact: Dwelling, bodies: _Bodies, law: Law, depth: float) -> float:
    """Cycles that wear about so deep: the worst event under the Hertz pressure on a flat."""
    table = contact.events(bodies.x, bodies.y, bodies.wear, bodies.memory)
    table = table[:, table[EVENT_LOAD] * table[EVENT_SLIP] * table[EVENT_COUNT] > 0.0]
    if table.shape[1] == 0:
        return 1.0
    hertz = np.sqrt(table[EVENT_LOAD] * contact.modulus / (math.pi * contact.roller_radius))
    worn = hertz**law.pressure_exponent * table[EVENT_SPEED] ** law.speed_exponent
    worn *= law.coefficient * table[EVENT_SLIP] * table[EVENT_COUNT]
    return depth / float(worn.max())


def _cut(bodies: _Bodies, before: _State, allowed: Callable[[], bool]) -> None:
    """Go back on the last step to the place up to which it was allowed."""
    after = bodies.state()

    def place(part: float) -> None:
        bodies.x = before.x + part * (after.x - before.x)
        bodies.y = before.y + part * (after.y - before.y)
        bodies.depth = before.depth + part * (after.depth - before.depth)
        bodies.removed = before.removed + part * (after.removed - before.removed)
        bodies.wear = ChainWear(
            *(b + part * (a - b) for b, a in zip(before.wear, after.wear, strict=True))
        )
        bodies.cycles = before.cycles + part * (after.cycles - before.cycles)

    low, high = 0.0, 1.0
    while True:
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        place(middle)
        low, high = (middle, high) if allowed() else (low, middle)
    place(high)


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
