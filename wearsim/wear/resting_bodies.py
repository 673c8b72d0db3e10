"""Worn outlines and a mate, and one step of their wear."""

import math
from dataclasses import dataclass, replace

import numpy as np

from wearsim.contact.resting_engagement import (
    FORCE_TOLERANCE,
    NEW_MATE,
    REACH_IN_RADII,
    MateWear,
    RestingContact,
)
from wearsim.errors import ContactError, ConvergenceError
from wearsim.geometry.profile_points import Profile
from wearsim.kernels.event_rows import EVENT_COUNT, EVENT_LOAD, EVENT_SLIP, EVENT_SPEED
from wearsim.kernels.half_space import WORK_ROWS, influence_coefficients
from wearsim.kernels.wrap_wear import (
    AREA,
    CASE_DEPTH,
    COEFFICIENT,
    CORE_FACTOR,
    CYCLES,
    EVENT_NUMBERS,
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
    recede,
    wear_events,
)
from wearsim.wear.law import WearLaw
from wearsim.wear.problem import Rows, StartState, WearProblem

_LEAST = 1e-12
"""Part of the cycles of a run that a step takes at least: a new mate whose coefficient falls fast is longer
by much after cycles that are too few to be told apart."""


@dataclass(frozen=True, eq=False)
class WornState:
    """Outlines, depth, area, mate and cycles at one time; pressure and speed of the last step."""

    x: Rows
    y: Rows
    depth: Rows
    removed: float
    wear: MateWear
    cycles: float
    mate: int
    pressure: float
    speed: float

    def on_the_way_to(self, after: "WornState", part: float) -> "WornState":
        """Return where a part of a step leads from here, in a straight line."""

        def between(first: Rows, last: Rows) -> Rows:
            return first + part * (last - first)

        return replace(
            after,
            x=between(self.x, after.x),
            y=between(self.y, after.y),
            depth=between(self.depth, after.depth),
            removed=self.removed + part * (after.removed - self.removed),
            wear=MateWear(
                *(old + part * (new - old) for old, new in zip(self.wear, after.wear, strict=True))
            ),
            cycles=self.cycles + part * (after.cycles - self.cycles),
        )


class WornBodies:
    """Worn outlines, the mate, and one step of their wear.

    Parameters
    ----------
    problem : WearProblem
        The outlines, their contacts and the wear law.
    """

    def __init__(self, problem: WearProblem[RestingContact]) -> None:
        contact, law = problem.contact, problem.law
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
        self.numbers[REACH] = math.ceil(REACH_IN_RADII * contact.mate_radius / step)
        self.numbers[TOLERANCE] = FORCE_TOLERANCE
        self.work = np.zeros((3 + WORK_ROWS, max(points, EVENT_NUMBERS)))
        self.findings = np.zeros(FINDINGS)
        self.pressures = np.zeros((0, points))
        self.memory = contact.memory()
        self.wear, self.cycles, self.mate = NEW_MATE, 0.0, 1
        self.running_in, self.mates = law.running_in, law.mates
        self.mate_in_use = self.mates.put_on(0.0)
        self.updates, self.removed, self.speed = 0, 0.0, 0.0
        if problem.start is not None:
            self._begin(profile, problem.start)

    def _begin(self, profile: Profile, start: StartState) -> None:
        self.depth = start.depth.copy()
        self.area = self.depth * (1.0 - 0.5 * profile.curvature * self.depth)
        self.x, self.y = profile.receded(self.depth)
        self.wear, self.mate = start.wear, start.mate

    def state(self) -> "WornState":
        """Return a copy of all that changes."""
        return WornState(
            self.x.copy(),
            self.y.copy(),
            self.depth.copy(),
            self.removed,
            self.wear,
            self.cycles,
            self.mate,
            float(self.findings[PEAK_PRESSURE]),
            self.speed,
        )

    def go_back(self, state: WornState) -> None:
        """Go to a state of the last step."""
        self.x, self.y, self.depth, self.removed = state.x, state.y, state.depth, state.removed
        self.wear, self.cycles = state.wear, state.cycles

    def step(self, cycles: float) -> float:
        """Wear for so many cycles at once."""
        table = self.contact.events(self.x, self.y, self.wear, self.memory)
        if not (table[EVENT_LOAD] * table[EVENT_SLIP] * table[EVENT_COUNT]).max() > 0.0:
            raise ContactError(self.no_wear())
        before = self.depth.copy()
        self.press(table, cycles)
        self.speed = highest_speed(table)
        self.removed += float(self.findings[AREA])
        hard_area = float(self.findings[HARD_AREA]) / self.contact.bodies
        of_mate = self.mate_cycles(self.cycles + cycles) - self.mate_cycles(self.cycles)
        self.wear = self.contact.mate_after(self.wear, of_mate, hard_area)
        self.cycles += cycles
        self.updates += 1
        return float((self.depth - before).max())

    def no_wear(self) -> str:
        """Say that nothing wears."""
        return (
            f"contact at cycle {self.cycles:.6g}: a loaded {self.contact.mate} must slide, but none does: "
            "without load and sliding there is no wear and no life"
        )

    def first_rate(self) -> float:
        """Return the depth per cycle of the worst event under the Hertz pressure on a flat, about."""
        contact, numbers = self.contact, self.numbers
        table = contact.events(self.x, self.y, self.wear, self.memory)
        table = table[:, table[EVENT_LOAD] * table[EVENT_SLIP] * table[EVENT_COUNT] > 0.0]
        if table.shape[1] == 0:
            return math.inf
        hertz = np.sqrt(table[EVENT_LOAD] * contact.modulus / (math.pi * contact.mate_radius))
        worn = hertz ** numbers[PRESSURE_EXPONENT] * table[EVENT_SPEED] ** numbers[SPEED_EXPONENT]
        worn *= numbers[COEFFICIENT] * table[EVENT_SLIP] * table[EVENT_COUNT]
        return float(worn.max())

    def mate_cycles(self, until: float) -> float:
        """Return for how many cycles of constant coefficient the mate in use has worn."""
        return self.mate_in_use.worn(until)

    def cycles_to(self, elongation: float) -> float:
        """Return the cycles from now until the mate in use is longer by so much."""
        worn = self.mate_cycles(self.cycles) + elongation / self.contact.elongation_per_cycle
        cycles = self.mate_in_use.until(worn) - self.cycles
        return max(cycles, _LEAST * self.cycles)

    @property
    def mate_is_worn(self) -> bool:
        """Whether the mate in use has grown to its limit."""
        contact = self.contact
        worn = self.wear.elongation >= contact.elongation_limit * (1.0 - 1e-9)
        return worn and contact.elongation_per_cycle > 0.0

    def on_the_way(self, before: WornState, after: WornState, part: float) -> WornState:
        """Return where a part of a step leads, in a straight line; the mate in use grows by its own clock."""
        state = before.on_the_way_to(after, part)
        of_mate = self.mate_cycles(state.cycles) - self.mate_cycles(before.cycles)
        grown = self.contact.mate_after(before.wear, of_mate, 0.0)
        return replace(state, wear=MateWear(grown.elongation, state.wear.depth))

    def renew_mate(self) -> None:
        """Put on a new mate."""
        self.wear, self.mate = NEW_MATE, self.mate + 1
        self.mate_in_use = self.mates.put_on(self.cycles)

    @property
    def mates_are_alike(self) -> bool:
        """Whether clocks are steady and the hard layer whole: each mate does what the last one did."""
        steady = self.running_in.is_steady and self.mates.bodies.is_steady and self.mates.mate.is_steady
        return steady and float(self.depth.max()) < self.numbers[CASE_DEPTH]

    def begin_mate(self, area: Rows, removed: float, cycles: float, mate: int) -> None:
        """Put a new mate on bodies that have lost so much area, per unworn length and in all, by then."""
        self.area, self.removed = area, removed
        self.recede()
        self.wear, self.cycles, self.mate = NEW_MATE, cycles, mate
        self.mate_in_use = self.mates.put_on(cycles)

    def recede(self) -> None:
        """Move outlines and depth to the area that is worn."""
        for area, depth, x, y in zip(self.area, self.depth, self.x, self.y, strict=True):
            recede(area, depth, x, y, self.unworn, 0, area.size)

    def press(self, table: Rows, cycles: float) -> None:
        """Let events wear the bodies."""
        if self.pressures.shape[0] != table.shape[1]:
            self.pressures = np.zeros((table.shape[1], self.x.shape[1]))
        self.numbers[CYCLES] = cycles
        self.numbers[MATE_RADIUS] = self.contact.mate_radius - self.wear.depth
        wear_events(
            table,
            self.updates % 2,
            self.x,
            self.y,
            self.area,
            self.depth,
            self.unworn,
            self.coefficients,
            self.numbers,
            self.pressures,
            self.work,
            self.findings,
        )
        if self.findings[UNBALANCED] > 0.0 or not np.isfinite(self.depth).all():
            raise ConvergenceError(
                f"wear at cycle {self.cycles:.6g}: the pressure of every {self.contact.mate} must be found, "
                f"but {int(self.findings[UNBALANCED])} of {table.shape[1]} were not: use more nodes"
            )


def highest_load(
    contact: RestingContact, law: WearLaw, start: StartState | None, load_factor: float = 1.0
) -> tuple[float, float]:
    """Return the highest pressure and sliding speed of all events of a cycle."""
    bodies = WornBodies(WearProblem(contact, law, (), 0.0, start))
    table = contact.events(bodies.x, bodies.y, bodies.wear, bodies.memory)
    table[EVENT_LOAD] *= load_factor
    bodies.press(table, 0.0)
    return float(bodies.findings[PEAK_PRESSURE]), highest_speed(table)


def highest_speed(table: Rows) -> float:
    """Return the highest sliding speed of loaded events."""
    return float(table[EVENT_SPEED][table[EVENT_LOAD] > 0.0].max(initial=0.0))
