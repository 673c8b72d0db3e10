"""Clocks of lubricated bodies, and of mates that are renewed while the bodies go on wearing."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from wearsim.geometry.profile_points import Vector
from wearsim.lubrication.clock import FRESH, ClockEnds, LubricantClock, band_of_causes
from wearsim.wear.running_in import NO_RUNNING_IN, WearClock


@dataclass(frozen=True, eq=False)
class LubricatedClock(WearClock):
    """Between cycles run and the cycles of constant coefficient, where the lubricant changes too.

    Contacts run in by what they wear, so the clock of a part counts the cycles of lubricated contacts.

    Equation physics.md (O3).
    """

    part: WearClock
    lubricant: LubricantClock = FRESH
    unsure: Callable[[], tuple[ClockEnds, ...]] = tuple  # what is not known of the lubricant exactly

    @cached_property
    def ends(self) -> tuple[ClockEnds, ...]:
        """Clocks of the lubricant at the ends of what is not known of it exactly."""
        return self.unsure()

    @property
    def is_steady(self) -> bool:
        """Whether both kinds of cycles are the same."""
        return self.part.is_steady and self.lubricant is FRESH

    @property
    def shortest(self) -> float:
        """As of a part."""
        return self.part.shortest

    @property
    def amplification(self) -> float:
        """Greatest relative error of the cycles run for one of the constant cycles, at most."""
        return self.part.amplification * self.lubricant.amplification

    def assumption(self) -> str:
        """Say what is taken for granted of a part; the case says what is of the lubricant."""
        return self.part.assumption()

    def steady_cycles(self, cycles: float) -> float:
        """Return the cycles of constant coefficient that wear as much as those run."""
        return self.part.steady_cycles(self.lubricant.steady_cycles(cycles))

    def running_cycles(self, constant: Vector) -> Vector:
        """Return the cycles run that wear as much as those of constant coefficient."""
        lubricated = self.part.running_cycles(constant)
        return lubricated if self.lubricant is FRESH else self.lubricant.running_cycles(lubricated)

    def ends_beside(self, is_given: bool) -> tuple[ClockEnds, ...]:
        """Return what a band of the coefficient leaves out.

        One that the user gives for the drive holds all but what the case says of the lubricant itself.
        """
        return tuple(ends for ends in self.ends if not is_given or ends.stated)

    def factors(self, constant: float, low: float, high: float, is_given: bool) -> tuple[float, float]:
        """Return the ends of a band of the coefficient, wider by what is not known of the lubricant.

        Each end is the factor on the wear that leads to the end of a life: causes are independent, so the
        logarithms of the lives add as squares.

        Equation physics.md (O4).

        Parameters
        ----------
        constant : float
            Cycles of constant coefficient that the life takes.
        low, high : float
            Ends of the coefficient over that of the case.
        is_given : bool
            Whether the user says these ends of this drive, so that they hold what is not known of its
            lubricant.

        Returns
        -------
        tuple of float
            Ends of the factor on the wear.
        """
        beside = self.ends_beside(is_given)
        if not beside or not 0.0 < constant < math.inf:
            return low, high
        causes = [(self.run_by(ends.worse, constant), self.run_by(ends.better, constant)) for ends in beside]
        of_rate = self.run_by(self.lubricant, constant / high), self.run_by(self.lubricant, constant / low)
        first, last = band_of_causes(self.run_by(self.lubricant, constant), [of_rate, *causes])
        return constant / self.steady_cycles(last), constant / self.steady_cycles(first)

    def run_by(self, lubricant: LubricantClock, constant: float) -> float:
        """Return the cycles run by the clock of a lubricant that wear as much as constant ones."""
        lubricated = self.part.running_cycles(np.array([constant]))
        return float(lubricant.running_cycles(lubricated)[0])

    def band_source(self, of_coefficient: str, is_given: bool) -> str:
        """Return in words what a band comes from, that of the coefficient and that of the lubricant."""
        return "; ".join([of_coefficient, *(ends.unsure for ends in self.ends_beside(is_given))])


@dataclass(frozen=True, eq=False)
class MateInUse:
    """Between the constant cycles of bodies and those of a mate that was put on at one of them.

    A new mate runs in by its own sliding, and comes lubricated and clean.

    Equation physics.md (R6).
    """

    bodies: LubricatedClock
    mate: WearClock  # how a new one runs in
    new_at: float  # when it was put on [constant cycles of the bodies]

    @cached_property
    def _alike(self) -> bool:
        """Whether both count the same cycles."""
        bodies = self.bodies
        if self.new_at == 0.0:
            return self.mate == bodies.part
        return bodies.is_steady and self.mate.is_steady

    @cached_property
    def _run_before(self) -> float:
        """Cycles run before it was put on."""
        return float(self.bodies.running_cycles(np.array([self.new_at]))[0])

    @cached_property
    def _own(self) -> LubricatedClock:
        """Its own clock, from when it was put on."""
        lubricant = self.bodies.lubricant
        return LubricatedClock(self.mate, lubricant.renewed(self._run_before) if self.new_at else lubricant)

    def worn(self, until: float) -> float:
        """Return the constant cycles that it has worn up to those of the bodies."""
        if self._alike:
            return until - self.new_at
        run = float(self.bodies.running_cycles(np.array([until]))[0])
        return self._own.steady_cycles(max(run - self._run_before, 0.0))

    def until(self, worn: float) -> float:
        """Return the constant cycles of the bodies at which it has worn so much, the inverse of ``worn``."""
        if self._alike:
            return self.new_at + worn
        run = float(self._own.running_cycles(np.array([worn]))[0])
        return self.bodies.steady_cycles(self._run_before + run)

    def knees(self, until: float, most: int) -> Vector:
        """Return the cycles run up to those constant ones between which its wear is nearly straight."""
        run = float(self.bodies.running_cycles(np.array([until]))[0])
        return self._run_before + self._own.lubricant.knees(run - self._run_before, max(most, 1))


@dataclass(frozen=True, eq=False)
class MateClock:
    """How bodies and the mates that run on them, one after the other, wear over the same time."""

    bodies: LubricatedClock
    mate: WearClock  # how a new one runs in

    def put_on(self, at: float) -> MateInUse:
        """Return the clock of a mate that is put on at constant cycles of the bodies."""
        return MateInUse(self.bodies, self.mate, at)


STEADY = MateClock(LubricatedClock(NO_RUNNING_IN), NO_RUNNING_IN)
"""Bodies and mates of constant coefficient."""
