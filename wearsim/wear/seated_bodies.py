"""Worn outlines and a mate in implicit steps of second order: wear and places found together.

Two stages of Alexander's method (SDIRK2, gamma = 1 - 1/sqrt(2); R. Alexander 1977, SIAM J. Numer.
Anal. 14, 1006): L-stable, its second stage is the result. The mates are not part of the state, they
are where the worn outlines let them rest at the end of a stage; both are extrapolated for a start.

Equation physics.md (W16).
"""

import math

import numpy as np

from wearsim.contact.resting_engagement import MateWear, RestingContact
from wearsim.errors import ContactError, ConvergenceError, JumpError
from wearsim.kernels.wrap_wear import AREA, HARD_AREA, SPACING, UNWORN_CURVATURE
from wearsim.wear.problem import Rows, WearProblem
from wearsim.wear.resting_bodies import WornBodies

_GAMMA = 1.0 - math.sqrt(0.5)

# The wear of the first stage, at gamma of the step, counts for its first part 1 - gamma, that of the second
# for the rest: the mates sweep over what they wear meanwhile.
_FIRST_SWEPT, _SECOND_SWEPT = (_GAMMA, 1.0 - 2.0 * _GAMMA), (_GAMMA, 0.0)

_HALVINGS = 10
"""Times that a step is halved whose stages are not found."""

_FARTHEST = 0.02
"""Way that a mate is moved ahead at most for a start, in its radii."""


class SeatedBodies(WornBodies):
    """Worn outlines, the mate, and a step of their wear by implicit stages.

    Parameters
    ----------
    problem : WearProblem
        The outlines, their contacts and the wear law.
    """

    def __init__(self, problem: WearProblem[RestingContact]) -> None:
        super().__init__(problem)
        contact, law = problem.contact, problem.law
        self.law = law
        numbers = law.pressure_exponent, law.speed_exponent, law.case_depth, law.core_factor
        self.seating = contact.seating(np.array([law.coefficient, *numbers]), self.unworn)
        self.hard = self._hard_area()
        soft = np.maximum(self.area - self.hard, 0.0)
        self.works = np.where(soft > 0.0, self.hard + soft / law.core_factor, self.area)
        self.hard_rate = 0.0
        self.growth: Rows | None = None
        self.drift = np.zeros_like(self.seating.places)
        self.seated = False

    def _hard_area(self) -> Rows:
        """Area per unworn length down to the end of the hard layer [mm]."""
        depth, curvature = self.law.case_depth, self.unworn[UNWORN_CURVATURE]
        if depth == math.inf:
            return np.full(curvature.size, math.inf)
        area: Rows = depth * (1.0 - 0.5 * curvature * depth)
        return area

    def first_rate(self) -> float:
        """Return how fast the outlines wear at first [mm per cycle]."""
        self._seat()
        return self.seating.rate

    def _seat(self) -> None:
        if self.seated:
            return
        self.seating.seat(self.works, self.x, self.y, self.wear)
        if not (self.seating.slides and self.seating.rate > 0.0):
            raise ContactError(self.no_wear())
        self.growth, self.seated = None, True

    def renew_mate(self) -> None:
        """Put on a new mate, which rests elsewhere."""
        super().renew_mate()
        self.seated = False

    def begin_mate(self, area: Rows, removed: float, cycles: float, mate: int) -> None:
        """Put a new mate on bodies whose hard layer has lost so much area by then."""
        super().begin_mate(area, removed, cycles, mate)
        self.works, self.seated = self.area.copy(), False

    def step(self, cycles: float) -> float:
        """Wear for so many cycles, or for a part of them where the mates are not found after all."""
        self._seat()
        kept, before = self.seating.kept(), self.depth.copy()
        for halving in range(_HALVINGS):
            works = self._stages(cycles)
            if works is not None:
                self._accept(works, cycles)
                return float((self.depth - before).max())
            if halving > 0 or not self._seated_anew():
                self.seating.restore(kept)
                cycles *= 0.5
            kept, self.growth = self.seating.kept(), None
        if self.seating.jumps(self.x, self.y, self._mate_after(cycles)):
            raise JumpError(f"contact at cycle {self.cycles:.6g}: {self.contact.lets_go}")
        raise ConvergenceError(
            f"wear at cycle {self.cycles:.6g}: the place and pressure of every {self.contact.mate} must be "
            "found, but is not: use other nodes or phases"
        )

    def _seated_anew(self) -> bool:
        """Seat the mates where they rest, which may be far from where they rested; whether they are found."""
        try:
            self.seating.seat(self.works, self.x, self.y, self.wear)
        except ConvergenceError:
            return False
        return True

    def _mate_after(self, cycles: float, hard_area: float | None = None) -> MateWear:
        """Return what the mate will have lost, by default to gaps that wear as fast as in the last step."""
        of_mate = self.mate_cycles(self.cycles + cycles) - self.mate_cycles(self.cycles)
        worn = self.hard_rate * cycles if hard_area is None else hard_area
        return self.contact.mate_after(self.wear, of_mate, worn)

    def _stages(self, cycles: float) -> Rows | None:
        """Return the work done after a step, None where a stage is not found."""
        begin, places = self.works, self.seating.places
        inner, outer = _GAMMA * cycles, (1.0 - _GAMMA) * cycles
        works = begin.copy()
        if self.growth is not None:
            works += inner * self.growth
            self._move(self.drift * inner)
        before = places.copy()
        self.seating.drift[:] = self.drift * cycles if self.growth is not None else 0.0
        if not self.seating.stage(begin, inner, works, self._mate_after(inner), _FIRST_SWEPT):
            return None
        growth, middle = (works - begin) / inner, places.copy()
        if self.growth is not None:
            self._move((middle - before + self.drift * inner) * (outer / inner))
        base = begin + outer * growth
        works = begin + cycles * growth
        if not self.seating.stage(base, inner, works, self._mate_after(cycles), _SECOND_SWEPT):
            return None
        self.growth, self.drift = (works - base) / inner, (places - middle) / outer
        return np.maximum(works, begin)

    def _move(self, way: Rows) -> None:
        """Move the mates ahead of a stage."""
        farthest = _FARTHEST * self.contact.mate_radius
        self.seating.places[:] += np.clip(way, -farthest, farthest)

    def _accept(self, works: Rows, cycles: float) -> None:
        spacing = self.unworn[SPACING]
        area = np.minimum(works, self.hard) + self.law.core_factor * np.maximum(works - self.hard, 0.0)
        worn = float(((area - self.area) * spacing).sum())
        hard_area = float(((works - self.works) * spacing).sum()) / self.contact.bodies
        self.wear = self._mate_after(cycles, hard_area)
        self.hard_rate = hard_area / cycles
        self.works, self.area = works, area
        self.recede()
        self.removed += worn
        self.cycles += cycles
        self.updates += 1
        self.press(self.seating.hardest_pressed(), 0.0)
        self.speed = self.seating.speed
        self.findings[AREA], self.findings[HARD_AREA] = worn, hard_area
