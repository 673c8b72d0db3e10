"""How a case is lubricated, when again, and what that costs."""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

from wearsim.lubrication.dirt import CLEAN, Dirt
from wearsim.quantities import grouped


@dataclass(frozen=True)
class RunningWay:
    """A time that a drive runs, or how far its contacts slide meanwhile; the other is 0."""

    hours: float = 0.0  # [h]
    sliding: float = 0.0  # [mm]

    def times(self, factor: float) -> "RunningWay":
        """Return so many times the way."""
        return RunningWay(factor * self.hours, factor * self.sliding)


ENDLESS = RunningWay(math.inf)
"""For ever."""


@dataclass(frozen=True)
class PhaseInput:
    """A part of a programme."""

    hours: float  # how long it is [h]
    dirt: Dirt
    relubrications: int  # spread evenly, the first at its begin
    contaminations: int  # spread evenly, in the middle of equal parts; none where dirt comes all the time


def lasting_not_known(name: str, schedule: str) -> str:
    """Say that a schedule changes nothing where it is not known how long a lubricant lasts."""
    return (
        f"how long lubricant {name!r} lasts is not known: it is assumed to last from one relubrication to "
        f"the next, so that {schedule} does not change the wear; give lubrication.lasts_hours if you know it"
    )


LASTING, DIRT = "how long the lubricant lasts", "dirt"


class LubricationEnds(NamedTuple):
    """The same lubrication at both ends of something that is not known of it exactly."""

    unsure: str  # what that is
    stated: bool  # whether the case says how unsure it is
    worse: "LubricationInput"
    better: "LubricationInput"


_SURE = (1.0, 1.0)

_BELOW = 0.999
"""Part of what a factor at which contacts are relubricated is above 1 that dirt may add."""


@dataclass(frozen=True)
class LubricationInput:
    """The lubricant of all contacts as it was given."""

    name: str = ""  # row of the catalogue of lubricants, if any
    dry_factor: float = 1.0  # coefficient of dry contacts over that of lubricated ones
    lasts: RunningWay = ENDLESS  # way on which the lubricant keeps its effect
    fades: RunningWay = RunningWay()  # way on which it loses it then
    completeness: float = 1.0  # part of its age that a relubrication takes away
    dirt_removed: float = 1.0  # part of what dirt adds that a relubrication takes away
    dirt: Dirt = CLEAN  # outside phases
    interval: RunningWay | None = None  # between relubrications, after `at_hours` where there are some
    at_hours: tuple[float, ...] = ()  # of relubrications [h]
    first: str = ""  # key and value, as given, that say when contacts are first relubricated
    threshold: float = math.inf  # factor on the wear at which contacts are relubricated
    phases: tuple[PhaseInput, ...] = ()
    application_cost: float | None = None  # of a relubrication, work and lubricant; None where none is given
    supplied: bool = False  # all the time, so that it does not age
    supply_cost: float | None = None  # of what it uses up in an hour of that; None where that is not given
    # lasts_ends, dry_ends: ends of what is known of `lasts` and `dry_factor`, over them
    lasts_ends: tuple[float, float] = _SURE
    dry_ends: tuple[float, float] = _SURE
    stated: tuple[str, ...] = ()  # keys of bands that the case gives

    @property
    def first_hours(self) -> float:
        """Running time before the first relubrication, 0 where it is not given as one [h]."""
        return self.at_hours[0] if self.at_hours else self.interval.hours if self.interval else 0.0

    def never_relubricated(self, end: str, what: str, hours: float, lasts: float, dries: float) -> str:
        """Say that something ends before its first relubrication, and how its lubricant is by then [h]."""
        then = f"; the lubricant is gone from {grouped(dries)} h on"
        if math.isinf(lasts):
            then = ""
        elif lasts >= hours:
            then = "; the lubricant lasts until then"
        elif dries >= hours:
            then = f"; the lubricant fades from {grouped(lasts)} h on"
        word = "comes after" if self.at_hours else "is longer than"
        return f"{self.first} {word} {end}: {what} never relubricated{then}"

    @property
    def ends(self) -> tuple[LubricationEnds, ...]:
        """What is not known exactly and changes the wear: how long it lasts, how fast it wears dry, dirt."""
        lasts = tuple(replace(self, lasts=self.lasts.times(end)) for end in self.lasts_ends)
        dry = tuple(replace(self, dry_factor=max(end * self.dry_factor, 1.0)) for end in self.dry_ends[::-1])
        dirt = self._in_dirt(1), self._in_dirt(0)
        causes = (
            (LASTING, "lasts_band_factor", lasts),
            ("the wear without lubricant", "dry_band_factor", dry),
            (DIRT, "contamination_band_factor", dirt),
        )
        return tuple(
            LubricationEnds(what, key in self.stated, *ends)
            for what, key, ends in causes
            if ends[0] != ends[1] and (key == "contamination_band_factor" or self.lasts is not ENDLESS)
        )

    def _in_dirt(self, end: int) -> "LubricationInput":
        phases = tuple(replace(phase, dirt=phase.dirt.at_end(end)) for phase in self.phases)
        dirt = self.dirt.at_end(end)
        # Dirt alone must not ask for relubrication, which does not help then.
        most = _BELOW * (self.threshold - 1.0)
        return replace(self, dirt=replace(dirt, excess=min(dirt.excess, most)), phases=phases)

    @property
    def is_constant(self) -> bool:
        """Whether the wear coefficients do not change with time, whatever dirt multiplies them by."""
        return self.lasts is ENDLESS and not self.phases

    @property
    def steady(self) -> bool:
        """Whether the wear coefficients stay those of the case."""
        return self.lasts is ENDLESS and not self.dirt.excess and not self.phases
