"""Costs of a drive at any interval between relubrications, and the interval that costs least."""

import math
import operator
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from wearsim.lubrication.clock import LubricantClock, band_of_causes
from wearsim.lubrication.law import LubricantLaw
from wearsim.lubrication.schedule import LubricantEvent, LubricantSchedule

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

_RENEWED_AT = np.linspace(0.0, 1.0, 101)
"""Parts of an interval after which a new chain is put on."""

_NEARLY = 1.05
"""Cost over the least up to which an interval is as good as the cheapest."""


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
    is_given: bool  # whether the user says these ends of the drive
    on_chain: bool = False  # whether new chains are put on it while it wears


class LubricantState(NamedTuple):
    """How a lubricant ages and what dirt adds."""

    law: LubricantLaw  # over hours
    excess: float  # what dirt adds
    ageing: float  # how many hours an hour makes older

    def clock(self, interval: float) -> LubricantClock:
        """Return the clock of an interval between relubrications [h]."""
        return LubricantClock(self.law, LubricantSchedule.every(interval, self.excess, self.ageing))


class StateEnds(NamedTuple):
    """The lubricant at both ends of something that is not known of it exactly."""

    stated: bool  # whether the case says how unsure it is
    worse: LubricantState
    better: LubricantState


@dataclass(frozen=True)
class RelubricationPolicy:
    """What an interval between relubrications leads to."""

    interval: float  # [h]; infinite where the lubricant is supplied continuously
    lives: Mapping[str, float]  # of the parts when new at the begin [h]
    lives_low: Mapping[str, float]  # at the lower end of the band
    lives_high: Mapping[str, float]  # at the upper end
    wear_factor: float  # on the wear of well lubricated contacts in the long run
    # cost, cost_low, cost_high: per 1000 h in the long run, and at both ends of the band; None where a price
    # is missing
    cost: float | None
    cost_low: float | None
    cost_high: float | None
    moved: float  # part by which lives of teeth may be off, which were run at another interval


@dataclass(frozen=True)
class MissedRelubrication:
    """What it costs to leave out one relubrication of many; None where a part does not outlive that."""

    interval: float  # between the others [h]
    lost: float | None  # hours that every part loses of its life [h]
    cost: float | None  # of the parts that wear meanwhile, less the relubrication


class LubricationIntervals:
    """The drive at any interval between relubrications; all times in hours."""

    def __init__(
        self,
        state: LubricantState,
        parts: Sequence[WornPart],
        application_cost: float | None,
        ends: Sequence[StateEnds] = (),
        own: float | None = None,
    ) -> None:
        self.state, self.ends = state, ends
        self.own = own  # interval at which the parts were run [h]; None where the lubricant never aged
        self.parts = parts
        self.application_cost = application_cost
        self.unknown = self._unknown()
        # Cost of the parts in an hour of lubricated contacts.
        self.hourly = math.fsum((part.price or 0.0) / part.hours for part in parts)

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
        law = self.state.law
        return (law.lasts + law.fades) / self.state.ageing

    def clock(self, interval: float) -> LubricantClock:
        """Return the clock of an interval."""
        return self.state.clock(interval)

    def policy(self, interval: float) -> RelubricationPolicy:
        """Return what an interval leads to."""
        clock = self.clock(interval)
        at_ends = [
            (ends.stated, ends.worse.clock(interval), ends.better.clock(interval)) for ends in self.ends
        ]
        moved = self.renewal_error(interval)
        bands = {part.name: _life_band(part, clock, at_ends, moved) for part in self.parts}
        wear = clock.lasting_factor
        cost = cost_low = cost_high = None
        if not self.unknown:
            ends = [_wear_band(part, wear, at_ends) for part in self.parts]
            rates = ([wear / part.hours for part in self.parts], *zip(*ends, strict=True))
            prices = [part.price or 0.0 for part in self.parts]
            cost, cost_low, cost_high = (
                self._cost(math.fsum(map(operator.mul, prices, each)), interval) for each in rates
            )
        return RelubricationPolicy(
            interval=interval,
            lives={part.name: _life(clock, part.hours) for part in self.parts},
            lives_low={name: low for name, (low, _) in bands.items()},
            lives_high={name: high for name, (_, high) in bands.items()},
            wear_factor=wear,
            cost=cost,
            cost_low=cost_low,
            cost_high=cost_high,
            moved=moved,
        )

    def renewal_error(self, interval: float) -> float:
        """Return by which part lives of teeth may be off that were run at another interval.

        A new chain comes lubricated, at any time p between two relubrications, while the teeth go on with
        the lubricant that they have. In the rest of the interval I they wear like S(I) - S(p) hours of well
        lubricated contacts, and the chain like S(I - p): so much longer they run on a young chain, of all
        that a chain lives.

        Equation physics.md (O5).

        Parameters
        ----------
        interval : float
            Between relubrications [h].

        Returns
        -------
        float
            e(I) + e(I_0), 0 at the interval that was run and where no chains are renewed.
        """
        chains = [part.hours for part in self.parts if not part.on_chain]
        if interval == self.own or not chains or len(chains) == len(self.parts):
            return 0.0
        return (self._ahead(interval) + self._ahead_at_own) / min(chains)

    @cached_property
    def _ahead_at_own(self) -> float:
        return 0.0 if self.own is None else self._ahead(self.own)

    def _ahead(self, interval: float) -> float:
        """Return how much more than a new chain the teeth wear in an interval at most [h]."""
        clock, until = self.clock(interval), min(interval, self.longest)
        at = [*(until * _RENEWED_AT), min(self.state.law.lasts / self.state.ageing, until)]
        whole = clock.steady_cycles(until)
        return max(whole - clock.steady_cycles(one) - clock.steady_cycles(until - one) for one in at)

    def supplied(self, cost_per_hour: float | None) -> RelubricationPolicy:
        """Return what a lubricant leads to that is supplied continuously at a cost, None where unknown."""
        found = self.policy(_NEVER)
        parts = (found.cost, found.cost_low, found.cost_high)
        cost, low, high = (
            None if one is None or cost_per_hour is None else one + 1000.0 * cost_per_hour for one in parts
        )
        return replace(found, interval=math.inf, cost=cost, cost_low=low, cost_high=high)

    def _cost(self, of_parts: float, interval: float) -> float:
        """Return the cost per 1000 h, where parts cost so much in an hour."""
        return 1000.0 * (of_parts + (self.application_cost or 0.0) / interval)

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
            return None, None, "a relubrication costs nothing: the shorter the interval, the better"
        longest = self.longest
        tried = np.geomspace(1e-4 * longest, longest, _SEARCHED)

        def cost(interval: float) -> float:
            return self._cost(self.clock(interval).lasting_factor * self.hourly, interval)

        costs = np.array([cost(interval) for interval in tried])
        at = int(costs.argmin())
        if at == _SEARCHED - 1:
            return None, None, "never within a life: a relubrication costs more than it saves"
        if at == 0:
            return None, None, f"less than {tried[0]:.3g} h: a relubrication costs almost nothing"
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
            LubricantEvent(0.0, held=self.state.excess, ageing=self.state.ageing),
            *(LubricantEvent(number * interval, relubricated=True) for number in range(1, _BEFORE + 1)),
            LubricantEvent((_BEFORE + 2) * interval, relubricated=True),
        )
        left_out = LubricantClock(self.state.law, LubricantSchedule(events))
        end = (_BEFORE + 2) * interval
        more = left_out.steady_cycles(end) - clock.steady_cycles(end)
        more = more if more > _ROUNDING * clock.steady_cycles(interval) else 0.0
        if 2.0 * interval > min(_life(clock, part.hours) for part in self.parts):
            return MissedRelubrication(interval, None, None)
        cost = None if self.unknown else more * self.hourly - (self.application_cost or 0.0)
        return MissedRelubrication(interval, more / clock.lasting_factor, cost)


def _life(clock: LubricantClock, lubricated: float) -> float:
    """Return the hours in which so many of well lubricated contacts wear off."""
    return float(clock.running_cycles(np.array([lubricated]))[0])


_AtEnds = Sequence[tuple[bool, LubricantClock, LubricantClock]]


def _life_band(part: WornPart, clock: LubricantClock, ends: _AtEnds, moved: float) -> tuple[float, float]:
    """Return the ends of a life, by the wear coefficient, by the lubricant and by when chains are renewed."""
    life = _life(clock, part.hours)
    causes = [(_life(clock, part.hours_low), _life(clock, part.hours_high))]
    causes += [
        (_life(worse, part.hours), _life(better, part.hours))
        for stated, worse, better in ends
        if stated or not part.is_given
    ]
    if part.on_chain and moved > 0.0:
        causes.append((life / (1.0 + moved), life * (1.0 + moved)))
    return band_of_causes(life, causes)


def _wear_band(part: WornPart, wear: float, ends: _AtEnds) -> tuple[float, float]:
    """Return the ends of how many of a part wear out in an hour in the long run, in the same way."""
    causes = [(wear / part.hours_high, wear / part.hours_low)]
    causes += [
        (better.lasting_factor / part.hours, worse.lasting_factor / part.hours)
        for stated, worse, better in ends
        if stated or not part.is_given
    ]
    return band_of_causes(wear / part.hours, causes)
