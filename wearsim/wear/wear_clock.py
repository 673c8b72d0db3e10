"""The clock of a drive whose wear coefficient changes with the cycles run, the same for all contacts."""

from abc import ABC, abstractmethod

from wearsim.geometry.profile_points import Vector


class WearClock(ABC):
    """Turns the cycles run into cycles of constant coefficient that wear as much, and back.

    A coefficient that changes with the cycles is a factor of the whole wear rate. The engines run on cycles
    of constant coefficient, tau; a clock says which tau belongs to N cycles run.
    """

    @property
    @abstractmethod
    def is_steady(self) -> bool:
        """Whether both kinds of cycles are the same."""

    @property
    @abstractmethod
    def shortest(self) -> float:
        """Cycles below which the coefficient of a new part need not be looked at more closely."""

    @property
    @abstractmethod
    def amplification(self) -> float:
        """Greatest relative error of the cycles run for one of the constant cycles, d(ln N)/d(ln tau)."""

    @abstractmethod
    def steady_cycles(self, cycles: float) -> float:
        """Return the cycles of constant coefficient that wear as much as so many cycles run."""

    @abstractmethod
    def running_cycles(self, constant: Vector) -> Vector:
        """Return the cycles run that wear as much as cycles of constant coefficient."""

    @abstractmethod
    def assumption(self) -> str:
        """Say what is taken for granted."""
