"""Life and cost against the interval between relubrications.

The state of the lubricant is a clock: one run tells how many hours of well lubricated contacts every
part lives, and each interval only how fast that clock goes.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from wearsim.case.model import Case
from wearsim.errors import CaseError, Fault
from wearsim.result import Life, LowerBound
from wearsim.simulation.lubricant import case_lubricant
from wearsim.wear.lubricant_clock import LubricantClock, LubricantEvent, LubricantLaw, LubricantSchedule

_SHOWN = (0.25, 0.5, 0.75, 1.0, 1.1, 1.25, 1.5, 2.0, 4.0, 10.0)
"""Intervals of the table beside the case's own and the cheapest, over what the lubricant lasts."""

_SEARCHED = 801
"""Intervals among which the cheapest is sought before it is refined."""

_BEFORE = 200
"""Relubrications before one is left out: the lubricant is as old then as in the long run."""

_EDGE = 1.05
"""Interval over the cheapest within which the cost must not have risen much."""

_NEARLY = 1.05
"""Cost over the least up to which an interval is as good as the cheapest."""


CONVENTIONS = (
    "costs in the long run: a new part lives as long as the first one, no interest",
    "bands of lives and costs are those of the wear coefficients; how long the lubricant lasts and what dry "
    "contacts wear is taken as it is",
)
"""What the tables rest on."""


@dataclass(frozen=True)
class WornPart:
    """A part of the drive, and how long it lives while it is well lubricated."""

    name: str  # chain, sprocket, or the name of one
    hours: float  # of well lubricated contacts [h]
    reached: bool  # whether its life ends then, or only the run
    price: float | None  # None where none is given
    # low, high: coefficients at the ends of the band over that of the case
    low: float
    high: float


@dataclass(frozen=True)
class RelubricationPolicy:
    """What an interval between relubrications leads to."""

    interval: float  # [h]
    lives: Mapping[str, float]  # of the parts when new at the begin [h]
    lives_low: Mapping[str, float]  # at the high end of the wear coefficients
    lives_high: Mapping[str, float]  # at the low end
    wear_factor: float  # on the wear of well lubricated contacts in the long run
    # cost, cost_low, cost_high: per 1000 h in the long run, and at the low and the high end of the wear
    # coefficients; None where a price is missing
    cost: float | None
    cost_low: float | None
    cost_high: float | None


@dataclass(frozen=True)
class MissedRelubrication:
    """What it costs to leave out one relubrication of many."""

    interval: float  # between the others [h]
    lost: float  # hours that every part loses of its life [h]
    cost: float | None  # of the parts that wear meanwhile


@dataclass(frozen=True)
class LubricantPlan:
    """One lubricant at all intervals."""

    name: str  # of the lubricant, empty where the case names none
    lasts: float  # [h]
    fades: float  # [h]
    dry_factor: float
    parts: tuple[WornPart, ...]
    policies: tuple[RelubricationPolicy, ...]  # intervals rising
    own: RelubricationPolicy | None  # of the case
    priced: bool  # whether a relubrication has a price
    cheapest: RelubricationPolicy | None
    cheap: tuple[float, float] | None  # intervals whose cost is within 5 % of the least [h]
    missed: MissedRelubrication

    @property
    def at_the_edge(self) -> bool:
        """Whether a slightly longer interval than the cheapest is far dearer."""
        return (
            self.cheapest is not None
            and self.cheap is not None
            and self.cheap[1] < _EDGE * self.cheapest.interval
        )


@dataclass(frozen=True)
class LubricationStudy:
    """Lubricants side by side."""

    case: str
    title: str
    plans: tuple[LubricantPlan, ...]
    km_per_hour: float | None
    assumptions: tuple[str, ...]
    warnings: tuple[str, ...]

    @property
    def cheapest(self) -> LubricantPlan | None:
        """The lubricant of the least cost."""
        priced = [plan for plan in self.plans if plan.cheapest is not None]
        return min(priced, key=lambda plan: plan.cheapest.cost or math.inf, default=None)  # type: ignore[union-attr]


@dataclass(frozen=True)
class LubricatedDrive:
    """A drive that was run: its lubricant, and the lives of its parts in hours run."""

    case: Case  # of one sprocket, or of the driver of a whole drive
    lives: Mapping[str, Life | LowerBound]
    bands: Mapping[str, tuple[float, float]]  # coefficients at the ends of the band over that of the case
    prices: Mapping[str, float | None]
    assumptions: tuple[str, ...]
    warnings: tuple[str, ...]


def check_ages(case: Case) -> None:
    """Raise where relubrication makes no difference to a case, or its schedule is not one of intervals."""
    given = case.lubrication
    if given is None or given.steady:
        text = (
            "must say how long a lubricant lasts: give lubricant = 'wet drip' or another one that is applied "
            "(wearsim list lubricants), or lasts_hours and dry_factor"
        )
        raise CaseError([Fault(text, "lubrication", case.name)])
    if given.phases:
        text = "a programme relubricates by itself: remove it to compare intervals"
        raise CaseError([Fault(text, "lubrication.phase", case.name)])


def lubricant_plan(drive: LubricatedDrive) -> LubricantPlan:
    """Compare intervals for one lubricant."""
    case, given = drive.case, drive.case.lubrication
    assert given is not None
    clock = case_lubricant(case)
    per_hour = case.cycles_per_hour
    law = replace(clock.law, lasts=clock.law.lasts / per_hour, fades=clock.law.fades / per_hour)
    parts = tuple(
        WornPart(
            name,
            clock.steady_cycles(life.hours_run * per_hour) / per_hour,
            isinstance(life, Life),
            drive.prices[name],
            *drive.bands[name],
        )
        for name, life in drive.lives.items()
    )
    intervals = _Intervals(law, given.dirt.excess, given.dirt.ageing, parts, given.application_cost)
    own = None
    if given.interval is not None:
        way = given.interval
        sliding = way.sliding / given.lasts.sliding * law.lasts if way.sliding else 0.0
        own = intervals.policy(way.hours + sliding)
    cheapest, cheap = intervals.cheapest()
    shown = sorted({*intervals.shown(), *(one.interval for one in (own, cheapest) if one is not None)})
    missed = intervals.missed((own or cheapest or intervals.policy(law.lasts or shown[0])).interval)
    policies = tuple(intervals.policy(interval) for interval in shown)
    return LubricantPlan(
        name=given.name,
        lasts=law.lasts,
        fades=law.fades,
        dry_factor=law.dry_factor,
        parts=parts,
        policies=policies,
        own=own,
        priced=given.application_cost is not None,
        cheapest=cheapest,
        cheap=cheap,
        missed=missed,
    )


class _Intervals:
    """The drive at any interval between relubrications; all times in hours."""

    def __init__(
        self,
        law: LubricantLaw,
        excess: float,
        ageing: float,
        parts: Sequence[WornPart],
        application_cost: float | None,
    ) -> None:
        self.law, self.excess, self.ageing = law, excess, ageing
        self.parts = parts
        self.application_cost = application_cost
        prices = [part.price for part in parts]
        self.priced = (
            application_cost is not None and None not in prices and all(one.reached for one in parts)
        )
        # Cost of the parts in an hour of lubricated contacts: as in the case, and at both ends of the band.
        self.hourly = [
            math.fsum((part.price or 0.0) * factor(part) / part.hours for part in parts)
            for factor in (lambda part: 1.0, lambda part: part.low, lambda part: part.high)
        ]

    def clock(self, interval: float) -> LubricantClock:
        """Return the clock of an interval."""
        begin = LubricantEvent(0.0, held=self.excess, ageing=self.ageing)
        events = (begin, LubricantEvent(interval, relubricated=True))
        return LubricantClock(self.law, LubricantSchedule(events, interval))

    def policy(self, interval: float) -> RelubricationPolicy:
        """Return what an interval leads to."""
        clock = self.clock(interval)
        lives = [
            {part.name: self._life(clock, part.hours / factor(part)) for part in self.parts}
            for factor in (lambda part: 1.0, lambda part: part.high, lambda part: part.low)
        ]
        costs = [self._cost(clock, interval, hourly) if self.priced else None for hourly in self.hourly]
        return RelubricationPolicy(interval, *lives, clock.lasting_factor, *costs)

    @staticmethod
    def _life(clock: LubricantClock, lubricated: float) -> float:
        return float(clock.running_cycles(np.array([lubricated]))[0])

    def _cost(self, clock: LubricantClock, interval: float, hourly: float) -> float:
        return 1000.0 * (clock.lasting_factor * hourly + (self.application_cost or 0.0) / interval)

    @property
    def ends(self) -> tuple[float, float]:
        """Intervals between which the answer lies [h]: far below what the lubricant lasts, and a life."""
        longest = self._life(self.clock(1e12), max(part.hours for part in self.parts))
        effect = (self.law.lasts + self.law.fades) / self.ageing
        shortest = 0.1 * effect if 0.0 < effect < longest else 1e-3 * longest
        return shortest, longest

    def shown(self) -> list[float]:
        """Return the intervals of the table, of two digits."""
        shortest, longest = self.ends
        scale = (10.0 * shortest * part for part in _SHOWN)
        return sorted({float(f"{interval:.2g}") for interval in scale if interval < longest})

    def cheapest(self) -> tuple[RelubricationPolicy | None, tuple[float, float] | None]:
        """Return the cheapest interval, and those that cost hardly more."""
        from scipy.optimize import minimize_scalar  # takes 0.2 s

        if not self.priced:
            return None, None
        shortest, longest = self.ends
        tried = np.geomspace(1e-2 * shortest, longest, _SEARCHED)

        def cost(interval: float) -> float:
            return self._cost(self.clock(interval), interval, self.hourly[0])

        costs = np.array([cost(interval) for interval in tried])
        at = int(costs.argmin())
        near = tried[max(at - 1, 0)], tried[min(at + 1, _SEARCHED - 1)]
        best = float(
            minimize_scalar(cost, bounds=near, method="bounded", options={"xatol": 1e-9 * near[1]}).x
        )
        if costs[at] < cost(best):
            best = float(tried[at])
        nearly = np.flatnonzero(costs <= _NEARLY * cost(best))
        first, last = int(nearly[0]), int(nearly[-1])
        # Only those without a dearer one between them and the cheapest.
        dear = np.flatnonzero(costs > _NEARLY * cost(best))
        first = max([first, *(int(one) + 1 for one in dear if one < at)])
        last = min([last, *(int(one) - 1 for one in dear if one > at)])
        cheap = (min(float(tried[min(first, at)]), best), max(float(tried[max(last, at)]), best))
        return self.policy(best), cheap

    def missed(self, interval: float) -> MissedRelubrication:
        """Return what one relubrication left out costs, once the schedule repeats itself."""
        clock = self.clock(interval)
        events = (
            LubricantEvent(0.0, held=self.excess, ageing=self.ageing),
            *(LubricantEvent(number * interval, relubricated=True) for number in range(1, _BEFORE + 1)),
            LubricantEvent((_BEFORE + 2) * interval, relubricated=True),
        )
        left_out = LubricantClock(self.law, LubricantSchedule(events))
        end = (_BEFORE + 2) * interval
        more = left_out.steady_cycles(end) - clock.steady_cycles(end)
        cost = more * self.hourly[0] - (self.application_cost or 0.0) if self.priced else None
        return MissedRelubrication(interval, more / clock.lasting_factor, cost)


def lubrication_study(
    drives: Sequence[LubricatedDrive], km_per_hour: float | None, title: str
) -> LubricationStudy:
    """Return the lubricants of one drive side by side, that of the case first."""
    first = drives[0]
    warnings = dict.fromkeys(text for drive in drives for text in drive.warnings)
    return LubricationStudy(
        first.case.name,
        title,
        tuple(lubricant_plan(drive) for drive in drives),
        km_per_hour,
        (*CONVENTIONS, *first.assumptions),
        tuple(warnings),
    )
