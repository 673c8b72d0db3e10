"""The seam as the engine has it: what wears, by which law, and what ends it.

The state is the depth of every point of one or several bodies and, where mates rest in them, what the mate in
use has lost. A contact turns it into wear: a `FlankContact` by a compiled rate at every point, a
`RestingContact` by the events of a cycle or by implicit stages. Neither says anything of the size of
steps. That is the engine's, which has two ways through a problem: `wearsim.wear.loop`, the source's equations
as they stand, and `wearsim.wear.advance`, long steps of controlled error.
"""

from dataclasses import dataclass, replace
from typing import Generic, Self, TypeVar

import numpy as np
from numpy.typing import NDArray

from wearsim.contact.engagement import FlankContact
from wearsim.contact.resting_engagement import MateWear, RestingContact
from wearsim.contact.stop_limits import StopLimit
from wearsim.geometry.profile_points import Vector
from wearsim.wear.law import WearLaw

Rows = NDArray[np.float64]

AnyContact = TypeVar("AnyContact", FlankContact, RestingContact)


@dataclass(frozen=True, eq=False)
class StartState:
    """Worn outlines and a used mate that a run may begin with."""

    depth: Rows  # depth of every body along the normals of the new outline [mm], shape (bodies, points)
    wear: MateWear  # what the mate has lost
    mate: int  # its number from 1


@dataclass(frozen=True, eq=False)
class WearProblem(Generic[AnyContact]):
    """What wears and until when."""

    contact: AnyContact  # the bodies, and what touches them
    law: WearLaw
    stop_limits: tuple[StopLimit, ...]  # that on the depth first
    horizon: float  # cycles of constant coefficient at which the run ends in any case
    start: StartState | None = None  # what has worn off resting bodies already, on the points of the contact

    @property
    def depth_limit(self) -> float:
        """Greatest depth allowed [mm], by which steps are measured."""
        return self.stop_limits[0].limit

    def on(self, contact: AnyContact) -> Self:
        """Return the same problem with another contact, such as that on other points."""
        return replace(self, contact=contact)

    def met(self, x: Vector, y: Vector, depth: Vector) -> StopLimit | None:
        """Return the limit that a worn body fails by most, if any.

        Equation physics.md (12).

        Parameters
        ----------
        x, y, depth : numpy.ndarray
            The worn body [mm].

        Returns
        -------
        StopLimit or None
            The limit.
        """
        margins = [(stop_limit.margin(x, y, depth), stop_limit) for stop_limit in self.stop_limits]
        worst = min(margins, key=lambda pair: pair[0])
        return worst[1] if worst[0] <= 0.0 else None
