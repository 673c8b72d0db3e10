"""The seam between a mechanism whose contacts dwell and the wear engine."""

from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import NDArray

from wearsim.contact.engagement import Kind
from wearsim.geometry.profile import Profile, Vector

Rows = NDArray[np.float64]


class Dwelling(ABC):
    """Contacts that dwell on one or several worn bodies that were alike when new."""

    kind = Kind.DWELLING

    elongation_per_cycle: float
    """Growth of the chain in a cycle."""

    elongation_limit: float
    """Relative elongation at which a new chain is put on."""

    modulus: float
    """Contact modulus E* [MPa]."""

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
    def arc_length(self) -> Vector:
        """Along the outline of a new body [mm]."""
        return self.profile.arc_length

    @abstractmethod
    def coarsened(self) -> "Dwelling":
        """Return the same contacts on about every second point.

        Returns
        -------
        Dwelling
            Both ends are kept.
        """

    @abstractmethod
    def memory(self) -> Rows:
        """Return what ``events`` is to remember from call to call, as it is before the first.

        Returns
        -------
        numpy.ndarray
            Numbers of the mechanism's own.
        """

    @abstractmethod
    def events(self, x: Rows, y: Rows, elongation: float, memory: Rows) -> Rows:
        """Return what the worn bodies meet in one cycle, a column an event.

        Parameters
        ----------
        x, y : numpy.ndarray
            Worn outlines [mm], shape (bodies, points).
        elongation : float
            Relative elongation of the chain.
        memory : numpy.ndarray
            Of this run; changed in place.

        Returns
        -------
        numpy.ndarray
            Rows as ``kernels.dwelling`` orders them: centre x, y of the mate and the unit
            normal out of the outline [mm], place touched [points], load per width
            [N/mm], path slid [mm] and its speed [mm/s], how often in a cycle, number of
            the body.
        """
