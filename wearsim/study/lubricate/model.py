"""Life and cost against the interval between relubrications.

The state of the lubricant is a clock: one run tells how many hours of well lubricated contacts every
part lives, and each interval only how fast that clock goes.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from wearsim.case.model import Case, WearBand
from wearsim.drive.part_life import case_clock
from wearsim.errors import CaseError, Fault
from wearsim.lubrication.clock import LubricantClock
from wearsim.lubrication.model import ENDLESS, LubricationInput
from wearsim.result import Life, LowerBound
from wearsim.result.ends import CHAIN
from wearsim.study.lubricate.intervals import (
    LubricantState,
    LubricationIntervals,
    MissedRelubrication,
    RelubricationPolicy,
    StateEnds,
    WornPart,
)
from wearsim.wear.running_in import WearClock

CONVENTIONS = (
    "lives start with new, freshly lubricated parts; costs are long-run averages, where parts are "
    "replaced at any time between two relubrications, without interest",
    "bands of lives and costs are those of the wear coefficients, of a chain those of its joints, of how "
    "long the lubricant lasts, of what dry contacts wear and of what dirt does",
)
"""What the tables rest on."""

RENEWED = (
    "lives of teeth are run at the interval of the case; at the others new chains come at other times "
    "between relubrications, which may move them by up to {:.0f} % (in their band): run wearsim life with "
    "that interval for its own"
)
"""What they rest on where chains are renewed."""

SUPPLIED = (
    "a lubricant that is supplied continuously does not age; that its supply may fail is not in the costs"
)
"""What they rest on where there is such a lubricant."""


_TOLD = 0.005
"""Part of a life above which it is told that it may be off."""


@dataclass(frozen=True)
class LubricantPlan:
    """One lubricant at all intervals, or supplied continuously."""

    name: str  # of the lubricant, empty where the case names none
    supplied: bool  # all the time: the one policy has no interval then
    # lasts, fades: in the environment of the case [h]
    lasts: float
    fades: float
    dry_factor: float  # nan where nothing dries
    parts: tuple[WornPart, ...]
    policies: tuple[RelubricationPolicy, ...]  # intervals rising
    own: RelubricationPolicy | None  # of the case
    cheapest: RelubricationPolicy | None
    cheap: tuple[float, float] | None  # intervals whose cost is within 5 % of the least [h]
    unknown: str  # why there is no cheapest interval, or no cost of a supply; empty where there is one
    gives_out: bool  # whether the lubricant gives out just beyond the cheapest interval
    missed: MissedRelubrication | None  # None where none is due
    cost_without_oil: float | None = None  # per 1000 h, of a supply whose price alone is unknown

    @property
    def moved(self) -> float:
        """Part by which lives of teeth at other intervals may be off."""
        return 0.0 if self.supplied else max(policy.moved for policy in self.policies)


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
        """The lubricant of the least cost; none while that of another is unknown, but for its oil."""
        if self.untold:
            return None
        priced = [plan for plan in self.plans if plan.cheapest is not None]
        return min(priced, key=lambda plan: plan.cheapest.cost or math.inf, default=None)  # type: ignore[union-attr]

    @property
    def untold(self) -> tuple[LubricantPlan, ...]:
        """The lubricants of unknown cost, which may be the cheapest."""
        return tuple(plan for plan in self.plans if plan.unknown and plan.cost_without_oil is None)


@dataclass(frozen=True)
class LubricatedDrive:
    """A drive that was run: its lubricant, and the lives of its parts in hours run."""

    case: Case  # of one sprocket, or of the driver of a whole drive
    clocks: Mapping[str, tuple[WearClock, float]]  # how each part runs in, and its cycles in an hour
    lives: Mapping[str, Life | LowerBound]
    bands: Mapping[str, WearBand]  # of the wear coefficients
    prices: Mapping[str, float | None]
    assumptions: tuple[str, ...]
    warnings: tuple[str, ...]


def check_ages(case: Case, key: str = "lubrication", alone: bool = True) -> None:
    """Raise where a lubricant has no intervals to compare, nor others beside which it is supplied."""
    given = case.lubrication
    if given is None or (given.lasts is ENDLESS and (alone or not given.supplied)):
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
    state = _state(clock.lubricant, given, per_hour)
    law = state.law
    ends = [
        StateEnds(at.stated, _state(at.worse, of.worse, per_hour), _state(at.better, of.better, per_hour))
        for at, of in zip(clock.ends, given.ends, strict=True)
    ]
    parts = tuple(_part(drive, clock.lubricant, name) for name in drive.lives)
    price = 0.0 if given.supplied else given.application_cost
    at = None if given.interval is None else clock.lubricant.repeats / per_hour
    intervals = LubricationIntervals(state, parts, price, ends, at)
    if given.supplied:
        return _supplied_plan(given, intervals)
    own = None if at is None else intervals.policy(at)
    cheapest, cheap, unknown = intervals.cheapest()
    shown = {*intervals.shown(), *(one.interval for one in (own, cheapest) if one is not None)}
    of_missed = own or cheapest
    missed = intervals.missed(intervals.effect if of_missed is None else of_missed.interval)
    return LubricantPlan(
        name=given.name,
        supplied=False,
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


def _state(clock: LubricantClock, given: LubricationInput, per_hour: float) -> LubricantState:
    """Return how a lubricant ages over hours, and what dirt adds outside phases."""
    law = replace(clock.law, lasts=clock.law.lasts / per_hour, fades=clock.law.fades / per_hour)
    return LubricantState(law, given.dirt.excess, given.dirt.ageing)


def _supplied_plan(given: LubricationInput, intervals: LubricationIntervals) -> LubricantPlan:
    """Return the plan of a lubricant that is supplied continuously, with no price at that of the parts."""
    policy, unknown, without_oil = intervals.supplied(given.supply_cost), intervals.unknown, None
    if not unknown and given.supply_cost is None:
        unknown = "without its oil: give consumption_ml_per_hour and price_per_litre"
        without_oil = intervals.supplied(0.0).cost
    return LubricantPlan(
        name=given.name,
        supplied=True,
        lasts=math.inf,
        fades=0.0,
        dry_factor=math.nan,
        parts=tuple(intervals.parts),
        policies=(policy,),
        own=None,
        cheapest=None if unknown else policy,
        cheap=None,
        unknown=unknown,
        gives_out=False,
        missed=None,
        cost_without_oil=without_oil,
    )


def _part(drive: LubricatedDrive, lubricant: LubricantClock, name: str) -> WornPart:
    """Return a part with its hours of well lubricated contacts, in the middle and at the ends of the band."""
    life, per_hour = drive.lives[name], drive.case.cycles_per_hour
    lubricated = lubricant.steady_cycles(life.hours_run * per_hour) / per_hour
    clock, own_per_hour = drive.clocks[name]
    # Running-in and powers of the cycles: constant cycles times coefficient stay the same.
    constant = clock.steady_cycles(lubricated * own_per_hour)
    low, high, _, is_given = drive.bands[name]
    ends = clock.running_cycles(np.array([constant / high, constant / low])) / own_per_hour
    return WornPart(
        name=name,
        hours=lubricated,
        reached=isinstance(life, Life),
        price=drive.prices[name],
        hours_low=float(ends[0]),
        hours_high=float(ends[1]),
        is_given=is_given,
        on_chain=drive.case.drive.rests and name != CHAIN,
    )


def lubrication_study(
    drives: Sequence[LubricatedDrive], km_per_hour: float | None, title: str
) -> LubricationStudy:
    """Return the lubricants of one drive side by side, that of the case first."""
    first, plans = drives[0], tuple(lubricant_plan(drive) for drive in drives)
    moved = max(plan.moved for plan in plans)
    conventions = (
        *CONVENTIONS,
        *([RENEWED.format(100.0 * moved)] if moved > _TOLD else []),
        *([SUPPLIED] if any(plan.supplied for plan in plans) else []),
    )
    return LubricationStudy(
        first.case.name,
        title,
        plans,
        km_per_hour,
        (*conventions, *first.assumptions),
        tuple(_warnings(drives)),
    )


def _warnings(drives: Sequence[LubricatedDrive]) -> Iterator[str]:
    """Give the warnings of the case, then what is said of one of its other lubricants only, by its name."""
    first = drives[0].warnings
    yield from first
    for drive in drives[1:]:
        name = drive.case.lubrication.name if drive.case.lubrication else ""
        yield from (f"{name}: {text}" for text in drive.warnings if text not in first)
