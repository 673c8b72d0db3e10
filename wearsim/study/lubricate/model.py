"""Life and cost against the interval between relubrications.

The state of the lubricant is a clock: one run tells how many hours of well lubricated contacts every
part lives, and each interval only how fast that clock goes.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from wearsim.case.lubrication_input import ENDLESS
from wearsim.case.model import Case
from wearsim.errors import CaseError, Fault
from wearsim.result import Life, LowerBound
from wearsim.simulation import case_clock
from wearsim.wear.lubricant_clock import (
    LubricantClock,
    LubricantEvent,
    LubricantLaw,
    LubricantSchedule,
    LubricatedClock,
)

_SHOWN = (0.25, 0.5, 0.75, 1.0, 1.1, 1.25, 1.5, 2.0, 4.0, 10.0)
"""Intervals of the table beside the case's own and the cheapest, over what the lubricant lasts."""

_SEARCHED = 801
"""Intervals among which the cheapest is sought before it is refined."""

_BEFORE = 200
"""Relubrications before one is left out: the lubricant is as old then as in the long run."""

_EDGE = 1.05
"""Interval over the cheapest within which the mean wear must not rise as much."""

_NEVER = 1e15
"""An interval that nothing outlives [h]."""

_ROUNDING = 1e-9
"""Part of what wears in an interval below which it is nothing."""

_NEARLY = 1.05
"""Cost over the least up to which an interval is as good as the cheapest."""


CONVENTIONS = (
    "lives are of parts that are new when they are lubricated; costs are in the long run, where parts are "
    "replaced at any time between two relubrications, without interest",
    "bands of lives and costs are those of the wear coefficients, of a chain those of its joints; how long "
    "the lubricant lasts and what dry contacts wear is taken as it is",
)
"""What the tables rest on."""


@dataclass(frozen=True)
class WornPart:
    """A part of the drive, and how long it lives while it is well lubricated."""

    name: str  # chain, sprocket, or the name of one
    hours: float  # of well lubricated contacts [h]
    reached: bool  # whether its life ends then, or only the run
    price: float | None  # None where none is given
    # hours_low, hours_high: the same at the high and at the low end of the wear coefficients
    hours_low: float
    hours_high: float


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
    """What it costs to leave out one relubrication of many; None where a part does not outlive that."""

    interval: float  # between the others [h]
    lost: float | None  # hours that every part loses of its life [h]
    cost: float | None  # of the parts that wear meanwhile, less the relubrication


@dataclass(frozen=True)
class LubricantPlan:
    """One lubricant at all intervals."""

    name: str  # of the lubricant, empty where the case names none
    # lasts, fades: in the environment of the case [h]
    lasts: float
    fades: float
    dry_factor: float
    parts: tuple[WornPart, ...]
    policies: tuple[RelubricationPolicy, ...]  # intervals rising
    own: RelubricationPolicy | None  # of the case
    cheapest: RelubricationPolicy | None
    cheap: tuple[float, float] | None  # intervals whose cost is within 5 % of the least [h]
    unknown: str  # why there is no cheapest interval; empty where there is one
    gives_out: bool  # whether the lubricant gives out just beyond the cheapest interval
    missed: MissedRelubrication


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


def check_ages(case: Case, key: str = "lubrication") -> None:
    """Raise where relubrication makes no difference to a case, or its schedule is not one of intervals."""
    given = case.lubrication
    if given is None or given.lasts is ENDLESS:
        text = (
            "must say how long a lubricant lasts: give lubricant = 'wet drip' or another one that is applied "
            "(wearsim list lubricants), or lasts_hours and dry_factor"
        )
        raise CaseError([Fault(text, key, case.name)])
    if given.phases:
        text = "a programme relubricates by itself: remove it to compare intervals"
        raise CaseError([Fault(text, "lubrication.phase", case.name)])


def lubricant_plan(drive: LubricatedDrive) -> LubricantPlan:
    """Compare intervals for one lubricant."""
    case, given = drive.case, drive.case.lubrication
    assert given is not None
    clock, per_hour = case_clock(case), case.cycles_per_hour
    law = clock.lubricant.law
    law = replace(law, lasts=law.lasts / per_hour, fades=law.fades / per_hour)
    parts = tuple(_part(drive, clock, name) for name in drive.lives)
    intervals = _Intervals(law, given.dirt.excess, given.dirt.ageing, parts, given.application_cost)
    own = None if given.interval is None else intervals.policy(clock.lubricant.repeats / per_hour)
    cheapest, cheap, unknown = intervals.cheapest()
    shown = {*intervals.shown(), *(one.interval for one in (own, cheapest) if one is not None)}
    of_missed = own or cheapest
    missed = intervals.missed(intervals.effect if of_missed is None else of_missed.interval)
    return LubricantPlan(
        name=given.name,
        lasts=law.lasts / given.dirt.ageing,
        fades=law.fades / given.dirt.ageing,
        dry_factor=law.dry_factor,
        parts=parts,
        policies=tuple(intervals.policy(interval) for interval in sorted(shown)),
        own=own,
        cheapest=cheapest,
        cheap=cheap,
        unknown=unknown,
        gives_out=cheapest is not None and intervals.gives_out_beyond(cheapest),
        missed=missed,
    )


def _part(drive: LubricatedDrive, clock: LubricatedClock, name: str) -> WornPart:
    """Return a part with its hours of well lubricated contacts, in the middle and at the ends of the band."""
    life, per_hour = drive.lives[name], drive.case.cycles_per_hour
    lubricated = clock.lubricant.steady_cycles(life.hours_run * per_hour)
    # Running-in and powers of the cycles: constant cycles times coefficient stay the same.
    constant = clock.part.steady_cycles(lubricated)
    low, high = drive.bands[name]
    ends = clock.part.running_cycles(np.array([constant / high, constant / low])) / per_hour
    return WornPart(
        name=name,
        hours=lubricated / per_hour,
        reached=isinstance(life, Life),
        price=drive.prices[name],
        hours_low=float(ends[0]),
        hours_high=float(ends[1]),
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
        self.unknown = self._unknown()
        # Cost of the parts in an hour of lubricated contacts: as in the case, and at both ends of the band.
        self.hourly = [
            math.fsum((part.price or 0.0) / getattr(part, hours) for part in parts)
            for hours in ("hours", "hours_high", "hours_low")
        ]

    def _unknown(self) -> str:
        """Return why no cost is known; empty where it is."""
        if not all(part.reached for part in self.parts):
            return "the life of a part is not reached (raise run.horizon_hours)"
        missing = [f"a price of {part.name}" for part in self.parts if part.price is None]
        if self.application_cost is None:
            missing.append("price_per_application or minutes_per_application")
        return f"it takes {', '.join(missing)}" if missing else ""

    @property
    def effect(self) -> float:
        """Hours until the lubricant is gone."""
        return (self.law.lasts + self.law.fades) / self.ageing

    def clock(self, interval: float) -> LubricantClock:
        """Return the clock of an interval."""
        return LubricantClock(self.law, LubricantSchedule.every(interval, self.excess, self.ageing))

    def policy(self, interval: float) -> RelubricationPolicy:
        """Return what an interval leads to."""
        clock = self.clock(interval)

        def lives(hours: Callable[[WornPart], float]) -> dict[str, float]:
            return {part.name: _life(clock, hours(part)) for part in self.parts}

        cost, low, high = (
            None if self.unknown else self._cost(clock, interval, hourly) for hourly in self.hourly
        )
        return RelubricationPolicy(
            interval=interval,
            lives=lives(lambda part: part.hours),
            lives_low=lives(lambda part: part.hours_low),
            lives_high=lives(lambda part: part.hours_high),
            wear_factor=clock.lasting_factor,
            cost=cost,
            cost_low=low,
            cost_high=high,
        )

    def _cost(self, clock: LubricantClock, interval: float, hourly: float) -> float:
        return 1000.0 * (clock.lasting_factor * hourly + (self.application_cost or 0.0) / interval)

    @property
    def longest(self) -> float:
        """Longest life of a part without any relubrication [h]."""
        return _life(self.clock(_NEVER), max(part.hours for part in self.parts))

    def shown(self) -> list[float]:
        """Return the intervals of the table, of two digits."""
        scale = self.effect if 0.0 < self.effect < self.longest else 0.01 * self.longest
        return sorted(
            {float(f"{scale * part:.2g}") for part in _SHOWN if scale * part < max(self.longest, scale)}
        )

    def cheapest(self) -> tuple[RelubricationPolicy | None, tuple[float, float] | None, str]:
        """Return the cheapest interval and those that cost hardly more, or why there is none."""
        from scipy.optimize import minimize_scalar  # takes 0.2 s

        if self.unknown:
            return None, None, self.unknown
        if not self.application_cost:
            return None, None, "a relubrication costs nothing: the more often, the better"
        longest = self.longest
        tried = np.geomspace(1e-4 * longest, longest, _SEARCHED)

        def cost(interval: float) -> float:
            return self._cost(self.clock(interval), interval, self.hourly[0])

        costs = np.array([cost(interval) for interval in tried])
        at = int(costs.argmin())
        if at == _SEARCHED - 1:
            return None, None, "never within a life: a relubrication costs more than it saves"
        if at == 0:
            return None, None, f"less than {tried[0]:.3g} h: hardly anything to pay for a relubrication"
        near = tried[at - 1], tried[at + 1]
        best = float(
            minimize_scalar(cost, bounds=near, method="bounded", options={"xatol": 1e-9 * near[1]}).x
        )
        if costs[at] < cost(best):
            best = float(tried[at])
        dear = np.flatnonzero(costs > _NEARLY * cost(best))
        # Only those without a dearer one between them and the cheapest.
        first = max((int(one) + 1 for one in dear if one < at), default=0)
        last = min((int(one) - 1 for one in dear if one > at), default=_SEARCHED - 1)
        cheap = (min(float(tried[min(first, at)]), best), max(float(tried[max(last, at)]), best))
        return self.policy(best), cheap, ""

    def gives_out_beyond(self, policy: RelubricationPolicy) -> bool:
        """Return whether the mean wear rises fast just beyond an interval."""
        beyond = self.clock(_EDGE * policy.interval).lasting_factor
        return beyond > _EDGE * policy.wear_factor

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
        more = more if more > _ROUNDING * clock.steady_cycles(interval) else 0.0
        if 2.0 * interval > min(_life(clock, part.hours) for part in self.parts):
            return MissedRelubrication(interval, None, None)
        cost = None if self.unknown else more * self.hourly[0] - (self.application_cost or 0.0)
        return MissedRelubrication(interval, more / clock.lasting_factor, cost)


def _life(clock: LubricantClock, lubricated: float) -> float:
    """Return the hours in which so many of well lubricated contacts wear off."""
    return float(clock.running_cycles(np.array([lubricated]))[0])


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
