"""The seam between a mechanism whose contacts dwell and the wear engine."""

from dataclasses import dataclass
from typing import Protocol

from numpy.typing import NDArray

import numpy as np

from wearsim.contact.engagement import Kind
from wearsim.geometry.profile import Profile, Vector

Rows = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Events:
    """What the worn bodies meet in one cycle, a column an event.

    Attributes
    ----------
    table : numpy.ndarray
        Rows as ``kernels.dwelling`` orders them: centre x, y of the mate and the unit normal
        out of the outline [mm], place touched [points], load per width [N/mm], path slid
        [mm] and its speed [mm/s], how often in a cycle, number of the body.
    """

    table: Rows


class Dwelling(Protocol):
    """Contacts that dwell on one or several worn bodies that were alike when new.

    Attributes
    ----------
    kind : Kind
        DWELLING.
    profile : Profile
        Outline of a new body.
    arc_length : numpy.ndarray
        Along it [mm].
    bodies : int
        Worn bodies that are told apart.
    roller_radius : float
        Radius of the mate [mm].
    modulus : float
        Contact modulus E* [MPa].
    elongation_per_cycle : float
        Growth of the chain in a cycle.
    """

    @property
    def kind(self) -> Kind: ...
    @property
    def profile(self) -> Profile: ...
    @property
    def arc_length(self) -> Vector: ...
    @property
    def bodies(self) -> int: ...
    @property
    def roller_radius(self) -> float: ...
    @property
    def modulus(self) -> float: ...
    @property
    def elongation_per_cycle(self) -> float: ...
    def coarsened(self) -> "Dwelling": ...
    def events(self, x: Rows, y: Rows, elongation: float) -> Events: ...
