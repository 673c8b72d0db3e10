"""Fatigue of gear teeth: endurance limits, life factors, allowable stresses, hours endured.

Source 001 ("Determination of allowable stresses"), formulas (21) to (27) and tables 2.2 and 2.3,
a digest of the Russian textbooks on GOST 21354. What it has lost, and what stands in its place
here, is said where it matters: "textbook" marks a value that is not in the source.
"""

import math
from dataclasses import dataclass
from typing import Literal

CONTACT_EXPONENT = 6.0
"""Of the contact stress in the curve of fatigue."""

_LARGEST_BASE = 12e7


def service_hours(years: float, year_share: float = 1.0, day_share: float = 1.0) -> float:
    """Return the hours that a gear runs in its years, L_h = 365*24 years K_year K_day.

    Equation strength.md (21).

    Parameters
    ----------
    years : float
        From the first day to the last.
    year_share, day_share : float
        Shares of the year and of the day in which it runs.

    Returns
    -------
    float
        Running time [h] (textbook: the source lost its formula).

    Examples
    --------
    >>> round(service_hours(8, 0.6, 0.25), 9)
    10512.0
    """
    return 365.0 * 24.0 * years * year_share * day_share


def cycles_per_hour(speed: float, meshings: int = 1) -> float:
    """Return the load cycles of a tooth in an hour, 60 n n_z, strength.md (21)."""
    return 60.0 * speed * meshings


def contact_base_cycles(brinell: float, reading: Literal["gost", "source"] = "gost") -> float:
    """Return the base number of cycles of contact, N_HG = 30 HB^2.4 up to 12e7.

    The source's sentence on it has lost its middle. By GOST 21354 N_HG is 1e7 up to 200 HB,
    where 30 HB^2.4 comes to it of itself; as the words that are left read, it is 1e7 below 350 HB
    and jumps there to 3.8e7.

    Parameters
    ----------
    brinell : float
        Hardness HB.
    reading : str
        ``gost`` or ``source``.

    Returns
    -------
    float
        Load cycles.

    Examples
    --------
    >>> round(contact_base_cycles(285.5)), contact_base_cycles(285.5, "source")
    (23473396, 10000000.0)
    """
    constant = brinell <= 200.0 if reading == "gost" else brinell < 350.0
    return 1e7 if constant else min(30.0 * brinell**2.4, _LARGEST_BASE)


@dataclass(frozen=True)
class FatigueCurve:
    """The stress that a tooth endures for a number of cycles, with its safety."""

    # stress endured for the base number of cycles [MPa]: endurance limit times the factors of the surface
    # over the safety, strength.md (26) and (27) without the life factor
    limit: float
    base_cycles: float  # N_G
    exponent: float  # of the stress, up to the base number
    greatest_factor: float  # most that the life factor may be
    # of the stress beyond the base number; infinite where the curve is flat there
    tail_exponent: float = math.inf
    least_factor: float = 1.0  # least that the life factor may be

    @property
    def flat_from(self) -> float:
        """Number of cycles from which on the curve is flat."""
        return self.base_cycles * float(self.least_factor**-self.tail_exponent)

    def raw_factor(self, cycles: float) -> float:
        """Return the life factor without its limits, strength.md (25), (N_G/N_E)^(1/m)."""
        return float((self.base_cycles / cycles) ** (1.0 / self.exponent))

    def factor(self, cycles: float) -> float:
        """Return the life factor K_HL or K_FL within its limits.

        Examples
        --------
        >>> curve = FatigueCurve(582.7, 1e7, 6.0, 2.6)
        >>> [round(curve.factor(cycles), 6) for cycles in (1e3, 4.5e6, 1e9)]
        [2.6, 1.142347, 1.0]
        """
        if cycles <= self.base_cycles:
            return min(self.raw_factor(cycles), self.greatest_factor)
        tail = (self.base_cycles / cycles) ** (1.0 / self.tail_exponent)
        return float(max(tail, self.least_factor))

    def allowable(self, cycles: float) -> float:
        """Return the allowable stress [sigma]_H or [sigma]_F, strength.md (26) and (27)."""
        return self.limit * self.factor(cycles)

    def endured_cycles(self, stress: float) -> float:
        """Return the equivalent cycles after which a stress is just allowed, N_G K^-m.

        Equation strength.md (105).

        Parameters
        ----------
        stress : float
            Above 0 [MPa]; K is this over the limit.

        Returns
        -------
        float
            Cycles; 0 where the greatest life factor does not reach the stress, infinite where
            the least one already does.

        Examples
        --------
        >>> curve = FatigueCurve(500.0, 1e7, 6.0, 2.6)
        >>> [round(curve.endured_cycles(stress), -3) for stress in (1301.0, 550.0, 500.0)]
        [0.0, 5645000.0, inf]
        """
        factor = stress / self.limit
        if factor > self.greatest_factor:
            return 0.0
        if factor <= self.least_factor:
            return math.inf
        exponent = self.exponent if factor >= 1.0 else self.tail_exponent
        return self.base_cycles * float(factor**-exponent)


@dataclass(frozen=True)
class EnduredHours:
    """Life by fatigue."""

    hours: float  # running time [h] at which the stress is just allowed; 0 where it never is
    bound: bool  # the stress is endured at all times; `hours` is how far that has been looked at


@dataclass(frozen=True)
class Endurance:
    """What the teeth of a gear endure in contact or in bending, at its hours and loads."""

    endurance_limit: float  # sigma_Hlim or sigma_Flim [MPa]
    curve: FatigueCurve  # with factors and safety
    equivalence: float  # mu of the load spectrum
    cycles_per_hour: float  # load cycles of a tooth in an hour
    hours: float  # running time asked for [h]
    greatest: float  # greatest stress allowed in an overload [MPa]; nan where it is not known

    @property
    def equivalent_cycles(self) -> float:
        """N_HE or N_FE at the hours asked for, strength.md (23) and (24)."""
        return self.equivalent_cycles_at(self.hours)

    def equivalent_cycles_at(self, hours: float) -> float:
        """Return mu N of other hours.

        Equations strength.md (23) and (24).

        Parameters
        ----------
        hours : float
            Running time [h].

        Returns
        -------
        float
            Equivalent cycles.
        """
        return self.equivalence * self.cycles_per_hour * hours

    @property
    def raw_factor(self) -> float:
        """Life factor without its limits."""
        return self.curve.raw_factor(self.equivalent_cycles)

    @property
    def factor(self) -> float:
        """Life factor within its limits."""
        return self.curve.factor(self.equivalent_cycles)

    @property
    def allowable(self) -> float:
        """Allowable stress [MPa]."""
        return self.curve.allowable(self.equivalent_cycles)

    def allowable_at(self, hours: float) -> float:
        """Return the allowable stress of other hours."""
        return self.curve.allowable(self.equivalent_cycles_at(hours))

    def life(self, stress: float) -> EnduredHours:
        """Return the hours for which a stress is allowed.

        L = N_G (limit/stress)^m / (60 mu n n_z), within the limits of the life factor.

        Equation strength.md (105).

        Parameters
        ----------
        stress : float
            By the largest long-acting torque [MPa].

        Returns
        -------
        EnduredHours
            Where the stress is always allowed: the hours at which the curve becomes flat, or
            those asked for if they are more.
        """
        per_hour = self.equivalence * self.cycles_per_hour
        hours = self.curve.endured_cycles(stress) / per_hour
        if math.isfinite(hours):
            return EnduredHours(hours, bound=False)
        return EnduredHours(max(self.hours, self.curve.flat_from / per_hour), bound=True)
