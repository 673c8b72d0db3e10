"""Wear coefficients that change with the cycles run: running-in, and wear that slows down for ever."""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from wearsim.geometry.profile_points import Vector

_MAX_STEPS = 1000
"""Steps of Newton's method; it takes about the logarithm of the factor."""

_GRID = np.geomspace(0.1, 1e4, 1000)
"""Values of N/N_r among which the greatest amplification of an error is sought."""


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


@dataclass(frozen=True)
class RunningIn(WearClock):
    """K(N) = K (1 + (f - 1) exp(-N/N_r)), of one part of a drive.

    As it is a factor of the whole wear rate, a part that runs in wears as one of constant
    K does, only faster at first: N cycles wear as much as tau cycles of constant K,

        tau(N) = N + (f - 1) N_r (1 - exp(-N/N_r)).

    Equation physics.md (R1).

    Examples
    --------
    After many times N_r cycles the excess has cost (f - 1) N_r of them:

    >>> RunningIn(3.0, 100.0).steady_cycles(1e6)
    1000200.0
    """

    factor: float  # f, first coefficient over the lasting one, at least 1
    cycles: float  # N_r, over which the excess falls to 1/e

    @property
    def is_steady(self) -> bool:
        """Whether there is no running-in."""
        return self.factor == 1.0

    @property
    def shortest(self) -> float:
        """Cycles below which the coefficient of a new part hardly falls."""
        return self.cycles

    @property
    def amplification(self) -> float:
        """Greatest relative error of the cycles run for one of the constant cycles, d(ln N)/d(ln tau).

        With n = N/N_r it is (n + (f - 1) (1 - exp(-n))) / (n (1 + (f - 1) exp(-n))), here on a
        grid of n, to about 1e-4.

        Equation physics.md (R3).

        Examples
        --------
        >>> RunningIn(1.0, 100.0).amplification
        1.0
        >>> round(RunningIn(10.0, 100.0).amplification, 2)
        2.76
        """
        if self.factor == 1.0:
            return 1.0
        n, excess = _GRID, self.factor - 1.0
        rate = n * (1.0 + excess * np.exp(-n))
        return float(((n - excess * np.expm1(-n)) / rate).max())

    def assumption(self) -> str:
        """Say what is taken for granted."""
        return (
            f"running-in: the coefficient of a new part is {self.factor:g} times as high at first, the "
            f"excess falls to 1/e in {self.cycles:.3g} cycles"
        )

    def steady_cycles(self, cycles: float) -> float:
        """Return the cycles of constant coefficient that wear as much.

        Equation physics.md (R2).

        Parameters
        ----------
        cycles : float
            N, cycles run.

        Returns
        -------
        float
            Tau.
        """
        if self.factor == 1.0:
            return cycles
        return cycles - (self.factor - 1.0) * self.cycles * math.expm1(-cycles / self.cycles)

    def running_cycles(self, constant: Vector) -> Vector:
        """Return the cycles after which a drive that runs in has worn as much.

        Equation physics.md (R2), solved for N.

        Parameters
        ----------
        constant : numpy.ndarray
            Tau, cycles of constant coefficient.

        Returns
        -------
        numpy.ndarray
            N, by Newton's method from tau/f, from where it rises to the answer: tau is concave.
        """
        tau = np.asarray(constant, dtype=float)
        if self.factor == 1.0:
            return tau
        excess = self.factor - 1.0
        cycles = tau / self.factor
        for _ in range(_MAX_STEPS):
            rest = np.exp(-cycles / self.cycles)
            worn = cycles - excess * self.cycles * np.expm1(-cycles / self.cycles)
            step = (tau - worn) / (1.0 + excess * rest)
            cycles += np.maximum(step, 0.0)
            if (step <= 1e-15 * cycles).all():
                break
        return cycles


NO_RUNNING_IN = RunningIn(1.0, 1.0)
"""No running-in."""


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
