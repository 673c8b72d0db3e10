"""The rollers of a wrap in gaps that wear: the stages that the wear engine asks for."""

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from wearsim.contact.resting_engagement import FORCE_TOLERANCE, REACH_IN_RADII, MateWear, PressedPlaces
from wearsim.errors import ConvergenceError
from wearsim.geometry.profile_points import Vector
from wearsim.kernels.event_rows import (
    EVENT_BODY,
    EVENT_CENTRE_X,
    EVENT_CENTRE_Y,
    EVENT_COUNT,
    EVENT_LOAD,
    EVENT_NORMAL_X,
    EVENT_NORMAL_Y,
    EVENT_ROWS,
    EVENT_SLIP,
    EVENT_SPEED,
    EVENT_TOUCHED,
)
from wearsim.kernels.wrap_equilibrium import CONSTANTS, SEATED
from wearsim.kernels.wrap_stage import (
    AHEAD,
    ARTICULATION_SLIP,
    BEHIND,
    BLOCK_ROWS,
    COUNT,
    EXPONENT,
    FACE_WIDTH,
    HARD_DEPTH,
    MODULUS,
    OUTLINES,
    PATH_SLIP,
    PITCH_TIME,
    RATE_FACTOR,
    REACH,
    ROLLER_RADIUS,
    SOFTNESS,
    SPEED_POWER,
    STAGE_NUMBERS,
    TOLERANCE,
    WORK_BEFORE,
    WRAP_ANGLE,
    implicit_stage,
)
from wearsim.kernels.wrap_yielding_seats import (
    CELL_ROWS,
    DRIFT_X,
    DRIFT_Y,
    HALF_WIDTH,
    LOAD_X,
    LOAD_Y,
    NEAREST,
    PLACE,
    SEAT_ROWS,
    SEAT_WORK_ROWS,
    SEAT_X,
    SEAT_Y,
    SLIP,
    SPEED,
)
from wearsim.mechanisms.wrap.wrap_mechanism import stuck

if TYPE_CHECKING:
    from wearsim.mechanisms.wrap.contact import WrapContact

Rows = NDArray[np.float64]

_PASSES = 6
"""Times that the rollers are seated in a stage at most."""


def phases_of_pitch(wrap_angle: float, pitch_angle: float, count: int) -> Rows:
    """Return places and weights of phases of a pitch, both sides of where a roller leaves the wrap.

    Examples
    --------
    The wrap of 2.5 pitches holds one roller less from the middle of the pitch on:

    >>> phases_of_pitch(2.5, 1.0, 4)
    array([[0.125, 0.375, 0.625, 0.875],
           [0.25 , 0.25 , 0.25 , 0.25 ]])
    """
    leaves = (wrap_angle / pitch_angle + 1.0) % 1.0
    first = round(count * leaves)
    if count < 2 or not 1e-6 < leaves < 1.0 - 1e-6:
        return np.array([(np.arange(count) + 0.5) / count, np.full(count, 1.0 / count)])
    first = min(max(first, 1), count - 1)
    rest = count - first
    place = np.concatenate(
        [(np.arange(first) + 0.5) / first * leaves, leaves + (np.arange(rest) + 0.5) / rest * (1.0 - leaves)]
    )
    return np.array([place, np.repeat([leaves / first, (1.0 - leaves) / rest], [first, rest])])


class WrapSeating(PressedPlaces):
    """Rollers of all blocks, kinds of links and phases on gaps that yield like an elastic foundation.

    Parameters
    ----------
    contact : WrapContact
        The wrap.
    law : numpy.ndarray
        Coefficient, exponents of pressure and speed, depth of the hard layer [mm], and what the
        coefficient is multiplied by below it.
    unworn : numpy.ndarray
        Rows of the unworn outline as `WornBodies` has them.
    """

    def __init__(self, contact: "WrapContact", law: Vector, unworn: Rows) -> None:
        self.contact, self.unworn = contact, unworn
        mechanism, points = contact.mechanism, unworn.shape[1]
        self.kinds, most = (2 if mechanism.chain.alternating else 1), contact.most_rollers
        self.phases = phases_of_pitch(mechanism.wrap_angle, mechanism.pitch_angle, contact.phases)
        events = len(contact.blocks) * self.kinds * contact.phases * most
        self.most, self.seats = most, np.zeros((SEAT_ROWS, events))
        # Pressures of all events, and behind them the parts of the cells that press.
        self.pressed = np.zeros((2 * events, points))
        self.outlines = np.zeros((OUTLINES * contact.bodies, points))
        self.compliance, self.raised = np.ones((most, points)), np.zeros((most, points))
        self.work = np.zeros((SEAT_WORK_ROWS, most))
        self.cells = np.zeros((CELL_ROWS + 2 * most, max(points + 2, 8)))
        self.sums = np.zeros((WORK_BEFORE + contact.bodies + 2 * most, points + 1))
        self.blocks = np.zeros((len(contact.blocks), BLOCK_ROWS))
        self.numbers = self._numbers(law)

    def _numbers(self, law: Vector) -> Vector:
        contact, numbers = self.contact, np.zeros(STAGE_NUMBERS)
        step = float(contact.arc_length[-1]) / (self.unworn.shape[1] - 1)
        numbers[WRAP_ANGLE], numbers[FACE_WIDTH] = contact.mechanism.wrap_angle, contact.face_width
        numbers[PATH_SLIP], numbers[MODULUS] = contact.sliding.path_fraction, contact.modulus
        numbers[REACH] = math.ceil(REACH_IN_RADII * contact.mate_radius / step)
        numbers[TOLERANCE] = FORCE_TOLERANCE
        self.coefficient = float(law[0])
        numbers[[EXPONENT, SPEED_POWER, HARD_DEPTH, SOFTNESS]] = law[1:]
        return numbers

    @property
    def places(self) -> Rows:
        """Centres of all rollers in their gaps [mm], shape (2, rollers); may be moved."""
        return self.seats[SEAT_X : SEAT_Y + 1]

    @property
    def pressures(self) -> Rows:
        """Mean pressure of every roller on every cell [MPa], shape (rollers, points)."""
        return self.pressed[: self.seats.shape[1]]

    @property
    def drift(self) -> Rows:
        """Way of all centres in the step under way [mm], shape (2, rollers); to be set."""
        return self.seats[DRIFT_X : DRIFT_Y + 1]

    def kept(self) -> tuple[Rows, Rows]:
        """Return a copy of what a stage starts from."""
        return self.seats.copy(), self.pressed.copy()

    def restore(self, kept: tuple[Rows, Rows]) -> None:
        """Go back to a copy."""
        self.seats[:], self.pressed[:] = kept

    def _set(self, cycles: float, wear: MateWear) -> None:
        contact, numbers = self.contact, self.numbers
        radius = contact.mate_radius - wear.depth
        numbers[ROLLER_RADIUS], numbers[RATE_FACTOR] = radius, self.coefficient * cycles
        numbers[ARTICULATION_SLIP] = contact.sliding.fraction * radius * contact.mechanism.pitch_angle
        for row, block in zip(self.blocks, contact.blocks, strict=True):
            row[:CONSTANTS] = block.mechanism.constants(wear.elongation)
            row[COUNT] = block.share * block.wear_factor * contact.bodies / self.kinds
            row[PITCH_TIME] = block.pitch_time

    def _solve(self, base: Rows, works: Rows, passes: int) -> bool:
        status = implicit_stage(
            base,
            works,
            passes,
            self.kinds,
            self.blocks,
            self.phases,
            self.seats,
            self.numbers,
            self.unworn,
            self.pressed,
            self.outlines,
            self.compliance,
            self.raised,
            self.work,
            self.cells,
            self.sums,
        )
        return status == SEATED and bool(np.isfinite(works).all())

    def seat(self, works: Rows, x: Rows, y: Rows, wear: MateWear) -> None:
        """Seat the rollers anew, beginning from where they rest on rigid outlines."""
        contact = self.contact
        worn = contact.worn_paths(x, y, wear)
        self._set(0.0, wear)
        self.seats[:] = 0.0
        self.seats[PLACE] = -1.0
        self.seats[HALF_WIDTH] = 0.05 * contact.mate_radius
        self.pressed[:] = 0.0
        event, most = 0, self.most
        for block in contact.blocks:
            for kind in range(self.kinds):
                for phase in self.phases[0]:
                    if block.mechanism.pull.tight > 0.0:
                        centre = block.mechanism.seats(float(phase), wear.elongation, kind, worn)
                        self.seats[SEAT_X : SEAT_Y + 1, event : event + len(centre)] = centre.T
                    event += most
        for body in range(contact.bodies):
            mine = self._body() == body
            away = np.hypot(
                self.seats[SEAT_X, mine, None] - x[body], self.seats[SEAT_Y, mine, None] - y[body]
            )
            self.seats[NEAREST, mine] = away.argmin(axis=1)
        if not self._solve(works, works.copy(), 2):
            raise ConvergenceError(stuck(wear.elongation))

    def _body(self) -> NDArray[np.int64]:
        """Return the outline that every roller presses."""
        event = np.arange(self.seats.shape[1])
        kind = event // (self.most * self.phases.shape[1]) % self.kinds
        body: NDArray[np.int64] = (event % self.most + kind) % self.contact.bodies
        return body

    def stage(
        self, base: Rows, cycles: float, works: Rows, wear: MateWear, swept: tuple[float, float]
    ) -> bool:
        """Replace a guess by the base and the work of so many cycles at the pressures in the end."""
        self._set(cycles, wear)
        self.numbers[[BEHIND, AHEAD]] = swept
        return self._solve(base, works, _PASSES)

    def jumps(self, x: Rows, y: Rows, wear: MateWear) -> bool:
        """Tell whether the chain jumps on rigid outlines."""
        worn = self.contact.worn_paths(x, y, wear)
        return not self.contact.heaviest_rollers.holds(wear.elongation, worn)

    @property
    def slides(self) -> bool:
        """Whether any loaded roller slides."""
        return bool((self.seats[SLIP] > 0.0).any())

    @property
    def rate(self) -> float:
        """Highest growth of the area per unworn length at the present pressures [mm per cycle]."""
        numbers, grown = self.numbers, np.zeros((self.contact.bodies, self.unworn.shape[1]))
        count = np.repeat(self.blocks[:, COUNT], self.seats.shape[1] // len(self.blocks))
        worn = self.coefficient * count * self.seats[SLIP]
        if numbers[SPEED_POWER] != 0.0:
            slides = self.seats[SPEED] > 0.0
            worn[slides] *= self.seats[SPEED, slides] ** numbers[SPEED_POWER]
        np.add.at(grown, self._body(), worn[:, None] * self.pressures ** numbers[EXPONENT])
        return float(grown.max())

    @property
    def speed(self) -> float:
        """Highest sliding speed [mm/s]."""
        return float(self.seats[SPEED].max())

    def hardest_pressed(self) -> Rows:
        """Return the event with the highest pressure on the foundation, as a table of one column."""
        event = int(self.pressures.max(axis=1).argmax())
        seat, table = self.seats[:, event], np.zeros((EVENT_ROWS, 1))
        load = math.hypot(seat[LOAD_X], seat[LOAD_Y])
        table[EVENT_CENTRE_X], table[EVENT_CENTRE_Y] = seat[SEAT_X], seat[SEAT_Y]
        table[EVENT_LOAD], table[EVENT_BODY] = load, self._body()[event]
        if load > 0.0:
            table[EVENT_NORMAL_X], table[EVENT_NORMAL_Y] = seat[LOAD_X] / load, seat[LOAD_Y] / load
        table[EVENT_TOUCHED] = max(seat[PLACE], 0.0)
        table[EVENT_COUNT], table[EVENT_SLIP], table[EVENT_SPEED] = 1.0, seat[SLIP], seat[SPEED]
        return table
