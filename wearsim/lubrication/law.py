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
