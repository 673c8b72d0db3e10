"""Readings that exclude each other, and coefficients that the band of their case excludes."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from scipy.stats import norm

from wearsim.case.model import WearBand
from wearsim.geometry.profile_points import Vector
from wearsim.quantities import grouped

_ERRORS = 3.0
"""Standard errors beyond which two readings exclude each other."""

_SHOWN = 3
"""Contradictions that are told one by one."""


@dataclass(frozen=True)
class WearReading:
    """What one reading says of the wear, beside what a fit says of it."""

    line: int  # in its file
    hours: float  # running time [h]
    kind: str  # readings of one kind are of one length, which does not shrink
    # low, high: ends between which the value lies, in the unit of the quantity; alike where it was measured
    low: float
    high: float
    error: float  # standard deviation
    predicted: float  # by the fit; in proportion to the coefficient
    words: str  # what was read

    @property
    def miss(self) -> float:
        """By how many errors the fit lies beyond the reading."""
        return max(self.predicted - self.high, self.low - self.predicted, 0.0) / self.error


@dataclass(frozen=True)
class Contradiction:
    """Two readings that no coefficient brings together."""

    earlier: WearReading
    later: WearReading
    errors: float  # by which they exclude each other
    shrinks: bool  # whether a length became less by more than the errors, or a gauge comes out again

    def __str__(self) -> str:
        first, then = self.earlier, self.later
        before = f"{first.words} in line {first.line}"
        why, at_one_rate = "", ""
        todo = "measure again, and remove the wrong one"
        if then.hours > first.hours:
            before += f", {grouped(then.hours - first.hours)} h before"
            grows = (
                "chains do not become shorter" if first.kind.startswith(CHAIN) else "wear does not grow back"
            )
            why = f"{grows}; " if self.shrinks else ""
            at_one_rate = "" if self.shrinks else " at one rate of wear"
            todo = "check both" if self.shrinks else "check both, the load and the lubrication"
        return (
            f"line {then.line}: {then.words} contradicts {before}: {why}they exclude each other by "
            f"{self.errors:.3g} standard errors{at_one_rate}, and the fit misses them by {then.miss:.3g} and "
            f"{first.miss:.3g}: {todo}"
        )


CHAIN = "chain"
"""Kind of all readings of the elongation of a chain; of several in rotation with the name behind."""


def contradictions(readings: Sequence[WearReading]) -> list[Contradiction]:
    """Return the pairs of readings that exclude each other, the worst ones first.

    Each reading asks for a range of factors on what the fit says, from low/predicted to high/predicted.
    Two of them exclude each other by the distance of these ranges over the root of the sum of squares of
    error/predicted. What counts is `_ERRORS` for two readings; for more, the value that any of their pairs
    exceeds by chance as rarely as that. A gauge that fell in and comes out again counts at any distance.

    Parameters
    ----------
    readings : sequence of WearReading
        Of one coefficient, in any order.

    Examples
    --------
    1.4 and 1.0 at one time, with errors of 0.04 and 0.03, are 0.4/0.05 = 8 errors apart:

    >>> ruler = WearReading(2, 100.0, CHAIN, 1.4, 1.4, 0.04, 1.0, "1.4 %")
    >>> gauge = WearReading(3, 100.0, CHAIN, -math.inf, 1.0, 0.03, 1.0, "go at 1 %")
    >>> [round(one.errors, 12) for one in contradictions([ruler, gauge])]
    [8.0]
    """
    known = sorted((one for one in readings if one.predicted > 0.0), key=lambda one: (one.hours, one.line))
    pairs = list(combinations(known, 2))
    least = norm.isf(norm.sf(_ERRORS) / max(len(pairs), 1))
    found = [Contradiction(one, other, _apart(one, other), _shrinks(one, other)) for one, other in pairs]
    kept = [pair for pair in found if pair.errors > least or (pair.shrinks and pair.errors > 0.0)]
    return sorted(kept, key=lambda pair: -pair.errors)


def _apart(one: WearReading, other: WearReading) -> float:
    """Return by how many errors the factors that two readings imply lie apart; 0 where they overlap."""
    gap = max(one.low / one.predicted - other.high / other.predicted, 0.0) + max(
        other.low / other.predicted - one.high / one.predicted, 0.0
    )
    return gap / math.hypot(one.error / one.predicted, other.error / other.predicted)


def _shrinks(earlier: WearReading, later: WearReading) -> bool:
    """Whether the later reading of a length is less by more than the errors, or a gauge comes out again."""
    fall = earlier.low - later.high
    gauges = math.isinf(earlier.high) and math.isinf(later.low)
    least = 0.0 if gauges else _ERRORS * math.hypot(earlier.error, later.error)
    return earlier.kind == later.kind and fall >= least


def contradiction_warnings(found: Sequence[Contradiction]) -> Iterator[str]:
    """Give the worst contradictions, and how many there are besides."""
    yield from map(str, found[:_SHOWN])
    more = found[_SHOWN:]
    if more:
        lines = sorted({one.line for pair in more for one in (pair.earlier, pair.later)})
        named = ", ".join(map(str, lines))
        yield (
            f"{len(more)} more pairs of readings exclude each other, by {more[-1].errors:.3g} to "
            f"{more[0].errors:.3g} standard errors, in lines {named}"
        )


TEETH, JOINTS = "the wear coefficient of the case", "the joints' wear coefficient of the case"
"""What `band_warning` tells of."""


def band_warning(factor: float, band: WearBand, coefficient: str) -> Iterator[str]:
    """Say where readings imply a coefficient outside of the band of the case."""
    if not band.low <= factor <= band.high:
        yield (
            f"the readings imply {factor:.3g} times {coefficient}, outside its band of {band.low:.3g} to "
            f"{band.high:.3g}: check the readings and the load"
        )


def ambiguous_reading(over_pins: Vector, error: float) -> str:
    """Return why a reading over pins may belong to several times of a life.

    Examples
    --------
    >>> ambiguous_reading(np.array([80.0, 79.9, 79.95]), 0.1)
    ''
    """
    again = float((over_pins - np.minimum.accumulate(over_pins)).max())
    if again <= error:
        return ""
    return (
        f"must belong to one time only, but the measurement over pins increases again by {again:.3g} mm "
        "during the life: measure the depth"
    )
