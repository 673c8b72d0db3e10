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


class ChainWear(NamedTuple):
    """What a chain in use has lost."""

    elongation: float = 0.0  # relative elongation by wear of its joints
    roller: float = 0.0  # depth worn off its rollers all round [mm]


NEW_CHAIN = ChainWear()


class RestingContact(ABC):
    """Contacts that rest on one or several worn bodies that were alike when new."""

    kind = ContactKind.RESTING

    elongation_per_cycle: float
    """Growth of the chain in a cycle."""

    elongation_limit: float
    """Relative elongation at which a new chain is put on."""

    modulus: float
    """Contact modulus E* [MPa]."""

    slack_tension: float
    """Tension of the slack strand [N]; 0 where there is none."""

    roller_area_ratio: float = 0.0
    """Area of its section that a roller loses over that a gap would lose to it in the same cycles."""

    thinnest_roller: float = 0.0
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
    def roller_radius(self) -> float:
        """Radius of the mate [mm]."""

    @property
    def cycles_per_chain(self) -> float:
        """Cycles until a new chain has grown to its limit, apart from running-in."""
        return self.elongation_limit / self.elongation_per_cycle

    @property
    def arc_length(self) -> Vector:
        """Along the outline of a new body [mm]."""
        return self.profile.arc_length

    def chain_after(self, wear: ChainWear, cycles: float, area: float) -> ChainWear:
        """Return what a chain has lost after some more cycles.

        Every roller gives off its share of area evenly round its circumference.

        Equation physics.md (W13).

        Parameters
        ----------
        wear : ChainWear
            What it has lost before.
        cycles : float
            How many.
        area : float
            Worn off a gap in these cycles if all of it is as hard as its surface [mm2].

        Returns
        -------
        ChainWear
            What it has lost then.

        Raises
        ------
        ContactError
            The rollers are worn through.
        """
        rest = (self.roller_radius - wear.roller) ** 2 - self.roller_area_ratio * area / math.pi
        if rest < self.thinnest_roller**2:
            raise ContactError(
                "roller: must keep a wall around its bush of radius "
                f"{self.thinnest_roller:.4g} mm, but is worn through at an elongation of "
                f"{100 * wear.elongation:.3g} %: lower stop.elongation_percent or wear.roller_wear_ratio"
            )
        return ChainWear(
            wear.elongation + cycles * self.elongation_per_cycle,
            self.roller_radius - math.sqrt(rest) if self.roller_area_ratio else 0.0,
        )

    def holds(self, x: Rows, y: Rows, wear: ChainWear) -> bool:
        """Tell whether worn bodies hold the chain with the least slack tension allowed."""
        return True

    @abstractmethod
    def coarsened(self) -> "RestingContact":
        """Return the same contacts on about every second point."""

    @abstractmethod
    def memory(self) -> Rows:
        """Return what ``events`` is to remember from call to call, as it is before the first."""

    def at(self, step: int) -> float:
        """Return which phases of the cycle a step of the wear takes."""
        return 0.5

    @abstractmethod
    def events(self, x: Rows, y: Rows, wear: ChainWear, memory: Rows, at: float = 0.5) -> Rows:
        """Return what the worn bodies meet in one cycle, a column an event."""

    def engage(self, x: Vector, y: Vector, depth: Vector) -> Engagement:
        """Return the engagement of a worn outline, all bodies worn alike."""
        frame = np.empty((4, depth.size))
        flank_frame(x, y, *frame)
        outlines = np.tile(x, (self.bodies, 1)), np.tile(y, (self.bodies, 1))
        table = self.events(*outlines, NEW_CHAIN, self.memory())
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
            relative_curvature=1.0 / self.roller_radius + frame[2],
        )
