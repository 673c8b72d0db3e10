"""The seam between a mechanism whose contacts rest and the wear engine."""

import math
from abc import ABC, abstractmethod
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from wearsim.contact.engagement import ContactKind, Engagement
from wearsim.errors import ContactError
from wearsim.geometry.profile_points import Profile, Vector
from wearsim.kernels.event_rows import (
    EVENT_BODY,
    EVENT_COUNT,
    EVENT_LOAD,
    EVENT_SLIP,
    EVENT_SPEED,
    EVENT_TOUCHED,
)
from wearsim.kernels.flank_geometry import flank_frame

Rows = NDArray[np.float64]


REACH_IN_RADII = 1.2
"""Half of the stretch of outline that an event may touch, in radii of the mate."""

FORCE_TOLERANCE = 1e-6
"""Force that may be left unbalanced, as a part of the load."""


class MateWear(NamedTuple):
    """What a mate in use has lost, such as a chain."""

    elongation: float = 0.0  # relative elongation, of a chain by wear of its joints
    depth: float = 0.0  # worn off it where it rests, of a chain off its rollers all round [mm]


NEW_MATE = MateWear()


class PressedPlaces(ABC):
    """Mates in all phases of a cycle, placed and pressed on worn bodies by implicit stages of wear."""

    @property
    @abstractmethod
    def places(self) -> Rows:
        """Centres of all mates in the frames of their bodies [mm], shape (2, mates); may be moved."""

    @property
    @abstractmethod
    def slides(self) -> bool:
        """Whether any loaded mate slides."""

    @property
    @abstractmethod
    def speed(self) -> float:
        """Highest sliding speed [mm/s]."""

    @property
    @abstractmethod
    def rate(self) -> float:
        """Highest growth of the area per unworn length at the present pressures [mm per cycle]."""

    @property
    @abstractmethod
    def drift(self) -> Rows:
        """Way of all centres in the step under way [mm], shape (2, mates); to be set."""

    @abstractmethod
    def kept(self) -> tuple[Rows, Rows]:
        """Return a copy of what a stage starts from."""

    @abstractmethod
    def restore(self, kept: tuple[Rows, Rows]) -> None:
        """Go back to a copy."""

    @abstractmethod
    def seat(self, works: Rows, x: Rows, y: Rows, wear: MateWear) -> None:
        """Place the mates on worn bodies without any knowledge of where they were.

        Parameters
        ----------
        works : numpy.ndarray
            Work done on the bodies, per unworn length, as if all were as hard as the surface
            [mm], shape (bodies, points).
        x, y : numpy.ndarray
            The worn outlines [mm], of the same shape.
        wear : MateWear
            What the chain has lost.

        Raises
        ------
        JumpError
            The chain jumps.
        ConvergenceError
            No equilibrium is found.
        """

    @abstractmethod
    def stage(
        self, base: Rows, cycles: float, works: Rows, wear: MateWear, swept: tuple[float, float]
    ) -> bool:
        """Replace a guess by the base and the work of so many cycles at the pressures in the end.

        Parameters
        ----------
        base : numpy.ndarray
            Work done before.
        cycles : float
            How many.
        works : numpy.ndarray
            A guess of the result, and the result.
        wear : MateWear
            What the chain has lost in the end.
        swept : tuple of float
            Parts of the drift over which the wear of this stage spreads, behind and ahead of its end.

        Returns
        -------
        bool
            Whether it was found.
        """

    @abstractmethod
    def jumps(self, x: Rows, y: Rows, wear: MateWear) -> bool:
        """Tell whether the chain jumps on worn bodies."""

    @abstractmethod
    def hardest_pressed(self) -> Rows:
        """Return the event with the highest pressure, as a table of one column."""


class RestingContact(ABC):
    """Contacts that rest on one or several worn bodies that were alike when new."""

    kind = ContactKind.RESTING

    mate = "mate"
    """What rests on a body, in words."""

    lets_go = "the mates leave the worn bodies"
    """What happens where worn bodies no longer hold them, in words."""

    elongation_per_cycle: float
    """Growth of the chain in a cycle."""

    elongation_limit: float
    """Relative elongation at which a new chain is put on."""

    modulus: float
    """Contact modulus E* [MPa]."""

    slack_tension: float
    """Tension of the slack strand [N]; 0 where there is none."""

    mate_area_ratio: float = 0.0
    """Area of its section that a roller loses over that a gap would lose to it in the same cycles."""

    thinnest_mate: float = 0.0
    """Radius below which a roller is worn through [mm]."""

    slack_limit: float = 0.0
    """Least slack tension at which the life ends once it is needed [N]; 0 for no such limit."""

    @property
    @abstractmethod
    def profile(self) -> Profile:
        """Outline of a new body."""

    @property
    @abstractmethod
    def bodies(self) -> int:
        """Worn bodies that are told apart."""

    @property
    @abstractmethod
    def mate_radius(self) -> float:
        """Radius of the mate [mm]."""

    @property
    def cycles_per_mate(self) -> float:
        """Cycles until a new chain has grown to its limit, apart from running-in."""
        return self.elongation_limit / self.elongation_per_cycle

    @property
    def arc_length(self) -> Vector:
        """Along the outline of a new body [mm]."""
        return self.profile.arc_length

    def mate_after(self, wear: MateWear, cycles: float, area: float) -> MateWear:
        """Return what a chain has lost after some more cycles.

        Every roller gives off its share of area evenly round its circumference.

        Equation physics.md (W13).

        Parameters
        ----------
        wear : MateWear
            What it has lost before.
        cycles : float
            How many.
        area : float
            Worn off a gap in these cycles if all of it is as hard as its surface [mm2].

        Returns
        -------
        MateWear
            What it has lost then.

        Raises
        ------
        ContactError
            The rollers are worn through.
        """
        rest = (self.mate_radius - wear.depth) ** 2 - self.mate_area_ratio * area / math.pi
        if rest < self.thinnest_mate**2:
            raise ContactError(
                "roller: must keep a wall around its bush of radius "
                f"{self.thinnest_mate:.4g} mm, but is worn through at an elongation of "
                f"{100 * wear.elongation:.3g} %: lower stop.elongation_percent or wear.roller_wear_ratio"
            )
        return MateWear(
            wear.elongation + cycles * self.elongation_per_cycle,
            self.mate_radius - math.sqrt(rest) if self.mate_area_ratio else 0.0,
        )

    def holds(self, x: Rows, y: Rows, wear: MateWear) -> bool:
        """Tell whether worn bodies hold the chain with the least slack tension allowed."""
        return True

    @abstractmethod
    def coarsened(self) -> "RestingContact":
        """Return the same contacts on about every second point."""

    def refined(self) -> "RestingContact | None":
        """Return the same contacts, looked at in more phases of a cycle; None where there are no more."""
        return None

    @abstractmethod
    def memory(self) -> Rows:
        """Return what ``events`` is to remember from call to call, as it is before the first."""

    @abstractmethod
    def events(self, x: Rows, y: Rows, wear: MateWear, memory: Rows) -> Rows:
        """Return what the worn bodies meet in one cycle, a column an event."""

    def seating(self, law: Vector, unworn: Rows) -> PressedPlaces:
        """Return the same contacts for implicit stages.

        Parameters
        ----------
        law : numpy.ndarray
            Coefficient, exponents of pressure and speed, depth of the hard layer [mm], and what
            the coefficient is multiplied by below it.
        unworn : numpy.ndarray
            Rows of the unworn outline as `wearsim.kernels.wrap_wear` has them.
        """
        raise NotImplementedError(f"{type(self).__name__} can only be worn event by event")

    def engage(self, x: Vector, y: Vector, depth: Vector) -> Engagement:
        """Return the engagement of a worn outline, all bodies worn alike."""
        frame = np.empty((4, depth.size))
        flank_frame(x, y, *frame)
        outlines = np.tile(x, (self.bodies, 1)), np.tile(y, (self.bodies, 1))
        table = self.events(*outlines, NEW_MATE, self.memory())
        table = table[:, (table[EVENT_LOAD] > 0.0) & (table[EVENT_BODY] == 0.0)]
        touched = table[EVENT_TOUCHED].round().astype(int)
        often, load, worn, speed = np.zeros((4, depth.size))
        np.add.at(often, touched, table[EVENT_COUNT])
        np.add.at(load, touched, table[EVENT_COUNT] * table[EVENT_LOAD])
        np.add.at(worn, touched, table[EVENT_COUNT] * table[EVENT_LOAD] * table[EVENT_SLIP])
        np.maximum.at(speed, touched, table[EVENT_SPEED])
        return Engagement(
            kind=self.kind,
            arc_length=self.arc_length,
            load_per_width=load / np.where(often > 0.0, often, 1.0),
            per_cycle=often,
            slip=worn / np.where(load > 0.0, load, 1.0),
            sliding_speed=np.where(often > 0.0, speed, np.nan),
            relative_curvature=1.0 / self.mate_radius + frame[2],
        )
