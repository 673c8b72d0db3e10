"""How a case is lubricated, when again, and what that costs."""

import math
from dataclasses import dataclass

from wearsim.lubrication.dirt import CLEAN, Dirt
from wearsim.quantities import grouped


@dataclass(frozen=True)
class RunningWay:
    """A time that a drive runs, or how far its contacts slide meanwhile; the other is 0."""

    hours: float = 0.0  # [h]
    sliding: float = 0.0  # [mm]


ENDLESS = RunningWay(math.inf)
"""For ever."""


@dataclass(frozen=True)
class PhaseInput:
    """A part of a programme."""

    hours: float  # how long it is [h]
    dirt: Dirt
    relubrications: int  # spread evenly, the first at its begin
    contaminations: int  # spread evenly, in the middle of equal parts; none where dirt comes all the time


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
            then = "; the lubricant lasts so long"
        elif dries >= hours:
            then = f"; the lubricant fades from {grouped(lasts)} h on"
        word = "comes after" if self.at_hours else "is longer than"
        return f"{self.first} {word} {end}: {what} never relubricated{then}"

    @property
    def steady(self) -> bool:
        """Whether the wear coefficients stay those of the case."""
        return self.lasts is ENDLESS and not self.dirt.excess and not self.phases
