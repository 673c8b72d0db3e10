"""Wear that slows down for ever: a power of the accumulated cycles."""

from dataclasses import dataclass

import numpy as np

from wearsim.geometry.profile_points import Vector
from wearsim.wear.wear_clock import WearClock


@dataclass(frozen=True)
class CyclesPower(WearClock):
    """Wear goes with the cycles to the power b, the same for all contacts of a drive.

    N cycles wear as much as tau cycles of the constant coefficient K,

        tau(N) = N_ref (N/N_ref)^b,

    so that K is the mean coefficient over the first N_ref cycles. It is a running-in that never ends: the
    coefficient itself goes on falling, as b K (N/N_ref)^(b-1).

    Equation physics.md (R5).

    Examples
    --------
    With b = 1/2 four times the cycles wear twice as much:

    >>> clock = CyclesPower(0.5, 100.0)
    >>> clock.steady_cycles(100.0), clock.steady_cycles(400.0)
    (100.0, 200.0)
    """

    exponent: float  # b, above 0 up to 1, which is Archard's law
    reference_cycles: float  # N_ref

    @property
    def is_steady(self) -> bool:
        """Whether the wear is that of Archard's law."""
        return self.exponent == 1.0

    @property
    def shortest(self) -> float:
        """One cycle: the coefficient falls from the first one on."""
        return 1.0

    @property
    def amplification(self) -> float:
        """Relative error of the cycles run for one of the constant cycles, 1/b.

        Equation physics.md (R5).

        Examples
        --------
        >>> CyclesPower(0.2, 100.0).amplification
        5.0
        """
        return 1.0 / self.exponent

    def assumption(self) -> str:
        """Say what is taken for granted."""
        return (
            f"wear goes with the cycles to the power {self.exponent:g}; the coefficient "
            f"is the mean over the first {self.reference_cycles:.3g} cycles; what is renewed begins anew"
        )

    def steady_cycles(self, cycles: float) -> float:
        """Return the cycles of constant coefficient that wear as much.

        Equation physics.md (R5).

        Parameters
        ----------
        cycles : float
            N, cycles run.

        Returns
        -------
        float
            Tau.
        """
        if self.is_steady:
            return cycles
        return float(self.reference_cycles * (cycles / self.reference_cycles) ** self.exponent)

    def running_cycles(self, constant: Vector) -> Vector:
        """Return the cycles after which as much has worn.

        Equation physics.md (R5), solved for N.

        Parameters
        ----------
        constant : numpy.ndarray
            Tau, cycles of constant coefficient.

        Returns
        -------
        numpy.ndarray
            N.
        """
        tau = np.asarray(constant, dtype=float)
        if self.is_steady:
            return tau
        return np.asarray(self.reference_cycles * (tau / self.reference_cycles) ** self.amplification)
