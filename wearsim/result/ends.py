"""What ends a part first, by whatever mode: wear, contact fatigue, or a rating of its chain."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from wearsim.chain.power_rating import IMPACT_BAND, NO_MORE_HOURS, RATED_HOURS
from wearsim.chain.rating_findings import RATINGS, Rating, RatingFinding
from wearsim.quantities import grouped
from wearsim.result.lives import Life, LowerBound, hours

CHAIN, SPROCKET = "chain", "sprocket"

JOINT_WEAR, TOOTH_WEAR, PITTING = "joint wear", "tooth wear", "contact fatigue"
WEAR = JOINT_WEAR, TOOTH_WEAR

LifeBand = tuple[Life | LowerBound, Life | LowerBound]
"""A life at the high and at the low end of its coefficient."""


@dataclass(frozen=True)
class PartEnd:
    """What may end a part, and when.

    Examples
    --------
    >>> PartEnd("chain", "joint wear", 9600.0, 3200.0, 25_000.0).reached
    True
    """

    part: str  # `chain`, or the name of a sprocket
    mode: str
    hours: float | None  # running time [h]; None where no slope is published
    low: float | None = None  # ends of its 90 % band [h]
    high: float | None = None
    reached: bool = True  # whether it ends then, or not before
    verdict: str = ""  # how it stands to its rating

    @property
    def life(self) -> Life | LowerBound:
        """The hours as a life whose cycles nobody counts."""
        hours = self.hours or 0.0
        return Life(0.0, hours) if self.reached else LowerBound(0.0, hours)

    @property
    def ends(self) -> bool:
        """Whether hours are known after which the part is at its end."""
        return self.reached and self.hours is not None


def wear_end(part: str, mode: str, life: Life | LowerBound, band: LifeBand | None) -> PartEnd:
    """Return the end of a part by wear."""
    low, high = (None, None) if band is None else (band[0].hours_run, band[1].hours_run)
    return PartEnd(part, mode, life.hours_run, low, high, isinstance(life, Life))


def rating_ends(ratings: Iterable[RatingFinding]) -> list[PartEnd]:
    """Return how plates, rollers and pins of a chain stand to their ratings, and when rollers fail."""
    found = {finding.name: finding for finding in ratings}
    return [
        _rating_end(rating, found[name]) for name, rating in RATINGS.items() if rating.end and name in found
    ]


def _rating_end(rating: Rating, finding: RatingFinding) -> PartEnd:
    """Return how a chain stands to a rating, and when it ends by it where a slope is published."""
    mode, verdict, end = rating.end, _verdict(rating, finding), finding.hours
    if end is None or end > NO_MORE_HOURS:
        return PartEnd(CHAIN, mode, None if end is None else NO_MORE_HOURS, reached=False, verdict=verdict)
    return PartEnd(CHAIN, mode, end, end / IMPACT_BAND, end * IMPACT_BAND, verdict=verdict)


def _verdict(rating: Rating, finding: RatingFinding) -> str:
    side = "within" if finding.ok else "BEYOND"
    limit = "limit of speed" if finding.unit == "rpm" else "limit"
    what = f"rating for {grouped(RATED_HOURS)} h" if rating.rated_hours else limit
    note = ", indicative" if finding.note else ""
    return f"{side} its {what}{note}: {grouped(100.0 * finding.used)} % used"


def part_ends(
    parts: Mapping[str, Life | LowerBound], bands: Mapping[str, LifeBand], ratings: Sequence[RatingFinding]
) -> tuple[PartEnd, ...]:
    """Return everything that may end the parts of a drive, that which comes first at the head.

    Parameters
    ----------
    parts : mapping
        LifeBand by wear of ``chain`` and sprockets, and of names that end in ``_fatigue`` by contact fatigue.
    bands : mapping
        Bands of those that have one.
    ratings : sequence of RatingFinding
        Of the chain.

    Examples
    --------
    >>> parts = {"sprocket": Life(1e9, 5000.0), "chain": Life(1e9, 900.0)}
    >>> [end.mode for end in part_ends(parts, {}, ())]
    ['joint wear', 'tooth wear']
    """
    found = []
    for name, life in parts.items():
        part = name.removesuffix("_fatigue")
        mode = PITTING if part != name else JOINT_WEAR if name == CHAIN else TOOTH_WEAR
        found.append(wear_end(part, mode, life, bands.get(name)))
    found += rating_ends(ratings)
    return tuple(sorted(found, key=_order))


def _order(end: PartEnd) -> tuple[int, float]:
    return (0 if end.ends else 1 if end.hours is not None else 2), end.hours or 0.0


def first_end(ends: Sequence[PartEnd]) -> PartEnd | None:
    """Return what ends first; None where nothing is known to end."""
    return next((end for end in ends if end.ends), None)


def earliest_life(part: str, life: Life | LowerBound, ends: Sequence[PartEnd]) -> Life | LowerBound:
    """Return the life of a part by what ends it first: that by wear where nothing ends it sooner.

    A part that contact fatigue damages from the start has no life to plan with, and keeps that by wear.

    Examples
    --------
    >>> ends = [PartEnd("chain", "roller and bush impact", 3.0), PartEnd("sprocket", "tooth wear", 2.0)]
    >>> earliest_life("chain", LowerBound(800.0, 4.0), ends), earliest_life("sprocket", Life(90.0, 2.0), ends)
    (Life(cycles=600.0, hours=3.0), Life(cycles=90.0, hours=2.0))
    """
    first = min((end.hours for end in ends if end.ends and end.part == part and end.hours), default=math.inf)
    return life if first >= life.hours_run else Life(life.cycles_run * first / life.hours_run, first)


def first_hours(ends: Sequence[PartEnd], life: Life | LowerBound) -> str:
    """Return in words when something ends first; how long all last where nothing is known to end."""
    first = first_end(ends)
    return hours(life if first is None else first.life)


def first_end_keys(ends: Sequence[PartEnd]) -> dict[str, Any]:
    """Return what ends first as keys of JSON, None where nothing is known to end."""
    first = first_end(ends)
    names = ("hours", "mode", "part")
    return {f"first_end_{name}": None if first is None else getattr(first, name) for name in names}


def before_wear(ends: Sequence[PartEnd], part: str = "") -> PartEnd | None:
    """Return what ends a part, or anything, before wear does; None where wear comes first."""
    first = first_end([end for end in ends if part in ("", end.part)])
    return None if first is None or first.mode in WEAR else first


def wear_only(ends: Sequence[PartEnd]) -> bool:
    """Return whether no hours are known of what ends a chain but wear."""
    return all(end.mode in (*WEAR, PITTING) for end in ends if end.ends)


def ends_json(ends: Sequence[PartEnd]) -> list[dict[str, Any]]:
    """Return what may end the parts as JSON."""
    return [
        {
            "part": end.part,
            "mode": end.mode,
            **_end_keys("life_hours", end.hours, end.reached),
            **_end_keys("life_hours_low", end.low, end.reached),
            **_end_keys("life_hours_high", end.high, end.reached),
            "verdict": end.verdict,
        }
        for end in ends
    ]


def _end_keys(name: str, at: float | None, reached: bool) -> dict[str, float | None]:
    return {name: at if reached else None, f"{name}_at_least": None if reached else at}


END_HEAD = ("part", "mode", "hours", "90 % band", "rating")
"""Heads of `end_rows`."""


def end_rows(ends: Sequence[PartEnd]) -> list[tuple[str, str, str, str, str]]:
    """Return part, mode, hours, band and verdict of everything that may end a part, in words."""
    rows = []
    for end in ends:
        told = "-" if end.hours is None else f"{'' if end.reached else '> '}{grouped(end.hours)} h"
        known = end.reached and end.low is not None and end.high is not None
        band = f"{grouped(end.low or 0.0)} to {grouped(end.high or 0.0)} h" if known else "-"
        rows.append((end.part, end.mode, told, band, end.verdict or "-"))
    return rows
