"""The factor on the wear of every contact, from the age of its lubricant and from dirt."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class LubricantLaw:
    """The factor on the coefficient of every contact, from the age of the lubricant and from dirt.

    g = (1 + (R - 1) F((s - s_L)/w)) (1 + C), with F(u) = u between 0 and 1. s is the way since the last
    relubrication, C what dirt adds.

    Equation physics.md (O1).

    Examples
    --------
    Half of the way from lubricated to four times that, with half as much again by dirt:

    >>> LubricantLaw(4.0, 100.0, 50.0).factor(125.0, 0.5)
    3.75
    """

    dry_factor: float = 1.0  # R, coefficient of dry contacts over that of lubricated ones, at least 1
    lasts: float = math.inf  # s_L, way on which a lubricant keeps its effect [cycles]
    fades: float = 0.0  # w, way on which it loses it then [cycles]
    completeness: float = 1.0  # part of the age that a relubrication takes away
    dirt_removed: float = 1.0  # part of C that a relubrication takes away

    def factor(self, age: float, dirt: float) -> float:
        """Return g at an age [cycles] and with what dirt adds."""
        return (1.0 + (self.dry_factor - 1.0) * self._dried(age)) * (1.0 + dirt)

    def _dried(self, age: float) -> float:
        if age <= self.lasts:
            return 0.0
        return min((age - self.lasts) / self.fades, 1.0) if self.fades > 0.0 else 1.0

    def worn(self, age: float, cycles: float, dirt: float, ageing: float = 1.0) -> float:
        """Return the integral of g over cycles that begin at an age and each make older by ``ageing``.

        Examples
        --------
        100 cycles lubricated, 50 at 2.5 times that in the mean, 10 at four times:

        >>> LubricantLaw(4.0, 100.0, 50.0).worn(0.0, 160.0, 0.0)
        265.0
        """
        excess = (self._dry_way(age + ageing * cycles) - self._dry_way(age)) / ageing
        return (cycles + (self.dry_factor - 1.0) * excess) * (1.0 + dirt)

    def _dry_way(self, age: float) -> float:
        """Integral of F up to an age."""
        beyond = age - self.lasts
        if not beyond > 0.0:
            return 0.0
        if beyond < self.fades:
            return 0.5 * beyond * beyond / self.fades
        return beyond - 0.5 * self.fades

    def cycles_for(self, age: float, worn: float, dirt: float, ageing: float = 1.0) -> float:
        """Return the cycles in which so much wears from an age on, the inverse of ``worn``."""
        return self._way_for(age, worn * ageing, dirt) / ageing

    def _way_for(self, age: float, worn: float, dirt: float) -> float:
        left, excess = worn / (1.0 + dirt), self.dry_factor - 1.0
        fresh = max(self.lasts - age, 0.0)
        if left <= fresh or excess == 0.0:
            return left
        if math.isinf(fresh):
            return left
        left, begun = left - fresh, max(age - self.lasts, 0.0)
        if begun < self.fades:
            # left = n + excess (begun n + n^2/2)/w, solved for n without a difference of near numbers.
            slope, rate = excess / self.fades, 1.0 + excess * begun / self.fades
            fading = 2.0 * left / (rate + math.sqrt(rate * rate + 2.0 * slope * left))
            if begun + fading <= self.fades:
                return fresh + fading
            fading = self.fades - begun
            left -= fading * (1.0 + excess * 0.5 * (begun + self.fades) / self.fades)
        else:
            fading = 0.0
        return fresh + fading + left / self.dry_factor

    def age_of(self, factor: float, dirt: float) -> float:
        """Return the age at which g comes to a factor; infinite where it never does.

        Examples
        --------
        >>> LubricantLaw(4.0, 100.0, 50.0).age_of(2.5, 0.0)
        125.0
        """
        dry = factor / (1.0 + dirt)
        if dry <= 1.0:
            return 0.0
        if dry > self.dry_factor or math.isinf(self.lasts):
            return math.inf
        return self.lasts + self.fades * (dry - 1.0) / (self.dry_factor - 1.0)


HARDNESS_RATIO = 1.2
"""Hardness of an abrasive over that of a surface below which it does not scratch (Hutchings)."""


def abrasion_share(abrasive_hardness: float, surface_hardness: float) -> float:
    """Return which part of the abrasion by contaminants a surface suffers: all or none.

    Abrasion needs particles at least 1.2 times as hard as the surface: below that they yield before the
    surface does (I. M. Hutchings, Tribology, 1992; Proc. IMechE J 216 (2002) 55; reviewed by Pintaude,
    J. Tribol. 132 (2010) 034502). Measured wear falls over some width about that ratio, which is not told
    here.

    Equation physics.md (L9).

    Parameters
    ----------
    abrasive_hardness : float
        Of the particles [HV], above 0.
    surface_hardness : float
        Of the surface, on the same scale [HV], above 0.

    Returns
    -------
    float
        1 from the ratio 1.2 on, 0 below it.

    Raises
    ------
    ValueError
        A hardness is not above 0.

    Examples
    --------
    Quartz of 1100 HV scratches a hardened tooth of 700 HV, chalk of 140 HV does not:

    >>> abrasion_share(1100.0, 700.0), abrasion_share(140.0, 700.0)
    (1.0, 0.0)
    """
    if not min(abrasive_hardness, surface_hardness) > 0.0:
        raise ValueError(f"both must be above 0 (got {abrasive_hardness:g} and {surface_hardness:g} HV)")
    return 1.0 if abrasive_hardness >= HARDNESS_RATIO * surface_hardness else 0.0
