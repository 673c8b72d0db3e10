"""Leaps over the lives of many mates, once each wears the bodies nearly as the one before did.

From the end of a mate to that of the next the wear is a slow map of their number. A leap lets many mates do
the work of the last one: a projective Euler step (C. W. Gear, I. G. Kevrekidis 2003, SIAM J. Sci. Comput.
24, 1091). Mates that are run in full between two leaps settle what a leap has left uneven. The coarser run
that tells the error of a run leaps twice as far, so the error is that of the leaps too.

Equation physics.md (W17).
"""

import math
from collections.abc import Callable

from wearsim.kernels.wrap_wear import SPACING
from wearsim.wear.problem import Rows
from wearsim.wear.resting_bodies import WornBodies

_BEFORE = 30
"""Mates run in full before the first leap."""

_BETWEEN = 2
"""Mates run in full between two leaps, and before a limit that a leap must not come nearer to."""

_PART = 0.25
"""Mates of a leap as a part of those so far, at most, at level 0."""

_Start = tuple[Rows, float, float, int]
"""Area worn per unworn length and in all, cycles, and number of the mate."""


class MateLeaps:
    """Leaps from the end of a mate to that of a later one, and the way back.

    Parameters
    ----------
    bodies : WornBodies
        What wears.
    deepest : float
        Depth that a leap may take off, at most [mm]; 0 for no leaps.
    refined : float
        How many times shorter than at level 0 leaps are.
    allowed : callable
        Tells whether the bodies may be worn as they are, within all limits.
    """

    def __init__(
        self, bodies: WornBodies, deepest: float, refined: float, allowed: Callable[[], bool]
    ) -> None:
        self.bodies, self.deepest, self.refined, self.allowed = bodies, deepest, refined, allowed
        self.area, self.first = bodies.area.copy(), bodies.mate
        self.start: _Start = self.area, 0.0, 0.0, self.first  # of the last leap
        self.mates, self.settled, self.most = 0, 0, math.inf

    def take(self) -> None:
        """Leap from a new mate to a later one, where mates have become alike."""
        bodies = self.bodies
        work, self.area = bodies.area - self.area, bodies.area.copy()
        self.settled += 1
        lived = bodies.mate - self.first
        settled = self.settled >= _BETWEEN and lived >= _BEFORE and bodies.mates_are_alike
        if not (settled and self.deepest > 0.0 and work.max() > 0.0):
            return
        mates = int(min(self.deepest / float(work.max()), _PART * lived / self.refined, self.most))
        start = self.area, bodies.removed, bodies.cycles, bodies.mate
        while mates > 0 and not self._is_allowed(start, work, mates + _BETWEEN):
            mates //= 2
        if mates > 0:
            self._land(start, work, mates)
            self.start, self.mates, self.settled = start, mates, 0
            self.area = bodies.area.copy()

    def undo(self) -> bool:
        """Go back on a leap that mates have not settled yet; whether there was one."""
        if self.mates == 0 or self.settled >= _BETWEEN:
            return False
        self._land(self.start, 0.0 * self.area, 0)
        self.area, self.most, self.mates, self.settled = self.start[0], self.mates // 2, 0, 0
        return True

    def _is_allowed(self, start: _Start, work: Rows, mates: int) -> bool:
        """Tell whether the bodies may be worn by so many mates more, and leave them as they are."""
        self._land(start, work, mates)
        allowed = self.bodies.mates_are_alike and self.allowed()
        self._land(start, work, 0)
        return allowed

    def _land(self, start: _Start, work: Rows, mates: int) -> None:
        area, removed, cycles, mate = start
        removed += mates * float((work * self.bodies.unworn[SPACING]).sum())
        cycles += mates * self.bodies.contact.cycles_per_mate
        self.bodies.begin_mate(area + mates * work, removed, cycles, mate + mates)
