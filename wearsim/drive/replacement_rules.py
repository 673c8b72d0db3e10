"""When to replace which part of a drive, and what that costs in the long run: numbers only.

A new chain and a new sprocket live as long as the first ones. The life of a part that outlived its run is at
least the hours of that run, so what follows from it is a bound: it is replaced so often at most.
"""

import heapq
import itertools
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from wearsim.drive.renewal import SAME, SAVES, Cycle, cheapest_cycle, cycles_in_life, fewest_stops
from wearsim.result.ends import CHAIN

WITH_CHAIN, FEWEST_STOPS = "sprockets with a chain change", "fewest stops"
"""Name of the rule of the fewest stops: where the chain is replaced in all of them, and where it is not."""

LEAST_COST = "grouped for the least cost"

STOPS = 24
"""Stops of a schedule."""

_JUST_BEFORE = 3.0 * SAME
"""Part of the hours of a stop by which a time is certainly before it."""

_MOST_APART, _LONGEST_PERIOD = 100, 10_000
"""Ends of a part of which one falls on a stop of the others, and lives after which all repeats.

Parts with more than these are taken for ones that never end together.
"""


@dataclass(frozen=True)
class Prices:
    """What parts and a stop cost, in one currency."""

    chain: float
    sprockets: Mapping[str, float]  # by name
    stop: float = 0.0  # standstill of one stop

    @property
    def parts(self) -> dict[str, float]:
        """Price of every part by its name."""
        return {**self.sprockets, CHAIN: self.chain}


@dataclass(frozen=True)
class Stop:
    """A stop and what is replaced in it."""

    hours: float  # of running
    parts: tuple[str, ...]


@dataclass(frozen=True)
class ReplacementRule:
    """What follows from a rule by which the parts of a drive are replaced."""

    name: str
    every: Mapping[str, float]  # hours from one replacement of a part to the next, their mean in the long run
    first: Mapping[str, float]  # hours of the first replacement of a part
    stop_rate: float  # stops in an hour
    schedule: tuple[Stop, ...]  # the first `STOPS`, as far as the run of a part that outlived it goes
    at_most: frozenset[str] = frozenset()  # parts that outlived their run: replaced so often at most
    stops_at_most: bool = False  # whether some stops are only for such parts
    cost: float | None = None  # in an hour, at most where a part outlived its run; None without prices
    least_cost: float | None = None  # the same if such parts lasted for ever
    cycle: Cycle | None = (
        None  # that repeats, of parts that were worn out; None where each goes at its own end
    )

    def chain_at(self, hours: float) -> int:
        """Return the number of the chain that is replaced at a time, 0 where none is."""
        if CHAIN in self.at_most:
            return 0
        if self.cycle is None:
            chains = hours / self.every[CHAIN]
            return round(chains) if abs(chains - round(chains)) <= SAME * chains else 0
        number = self.cycle.replaced(CHAIN, hours)
        return number if number > self.cycle.replaced(CHAIN, hours * (1.0 - _JUST_BEFORE)) else 0


def cost_rate(rule: ReplacementRule, prices: Prices) -> float:
    """Return what parts and stops cost in an hour.

    Examples
    --------
    A chain of 40 every 1000 h, a sprocket of 100 every 2500 h, 1.2 stops in 1000 h of 10 each:

    >>> rule = ReplacementRule("own end", {"chain": 1000.0, "roll": 2500.0}, {}, 0.0012, ())
    >>> round(1000 * cost_rate(rule, Prices(40.0, {"roll": 100.0}, 10.0)), 9)
    92.0
    """
    price = prices.parts
    parts = math.fsum(price[name] / hours for name, hours in rule.every.items())
    return parts + rule.stop_rate * prices.stop


def replacement_rules(
    chain: float,
    sprockets: Mapping[str, float],
    prices: Prices | None = None,
    outlived: frozenset[str] = frozenset(),
) -> list[ReplacementRule]:
    """Return the rules by which the parts of a drive can be replaced.

    Each part at its own end; the fewest stops; all sprockets with every m-th chain, for every m that the
    shortest-lived one allows; with prices the cheapest cycle too, where it saves over all of these.

    Parameters
    ----------
    chain : float
        Life of a chain [h], above 0.
    sprockets : mapping
        Life of every sprocket by its name [h], above 0.
    prices : Prices, optional
        Without them no rule has a cost.
    outlived : frozenset of str
        Parts that outlived their run, `CHAIN` among them if it did: their life is that of the run at least.

    Returns
    -------
    list of ReplacementRule
        Only the first one where no part was worn out, or a single sprocket.
    """
    lives = {CHAIN: chain, **sprockets}
    lasting = {name: life for name, life in lives.items() if name not in outlived}
    found, least = _rules(lives, lasting), _rules(lasting, lasting)
    if CHAIN in lasting:
        together = _together(chain, sprockets)
        found, least = [*found, *together], [*least, *together]
    if prices is None:
        return found
    if len(found) > 1:
        cycle = cheapest_cycle(lasting, prices.parts, prices.stop)
        grouped = _in_cycles(LEAST_COST, cycle, lasting)
        if cost_rate(grouped, prices) < (1.0 - SAVES) * min(cost_rate(rule, prices) for rule in least):
            found.append(_in_cycles(LEAST_COST, cycle, lives))
            least.append(grouped)
    return [
        replace(rule, cost=cost_rate(rule, prices), least_cost=cost_rate(if_for_ever, prices))
        for rule, if_for_ever in zip(found, least, strict=True)
    ]


def cheapest(rules: list[ReplacementRule]) -> tuple[int, bool] | None:
    """Return the number of the cheapest rule, and whether no other can be cheaper.

    Parts that outlived their run count nothing in the choice: what they cost is not known. None without
    prices, and where there is only one rule.
    """
    costs = [rule.least_cost for rule in rules if rule.least_cost is not None]
    if len(costs) < 2:
        return None
    most = min(costs) * (1.0 + SAME)
    number = next(number for number, cost in enumerate(costs) if cost <= most)
    return number, all(not rule.at_most for rule in rules)


def _rules(lives: Mapping[str, float], lasting: Mapping[str, float]) -> list[ReplacementRule]:
    """Return the rules that are compared without prices too, for lives some of which may be bounds."""
    rules = [_each_at_its_end(lives, frozenset(lives.keys() - lasting.keys()))]
    if len(lasting) < 2 and CHAIN not in lasting:
        return rules
    few = fewest_stops(lasting)
    name = WITH_CHAIN if few.every.get(CHAIN) == 1 else FEWEST_STOPS
    return [*rules, _in_cycles(name, few, lives)]


def _each_at_its_end(lives: Mapping[str, float], outlived: frozenset[str]) -> ReplacementRule:
    return ReplacementRule(
        "each part at its own end",
        lives,
        lives,
        _stop_rate(lives.values()),
        _schedule(
            (_ends(name, hours) for name, hours in lives.items() if name not in outlived),
            _known(lives, outlived),
        ),
        outlived,
        bool(outlived),
    )


def _in_cycles(name: str, cycle: Cycle, lives: Mapping[str, float]) -> ReplacementRule:
    """Replace parts in cycles, one that outlived its run at the end of the last cycle that it lasts for sure.

    Where it does not last for one cycle for sure, it needs stops of its own at most.
    """
    outlived = frozenset(lives.keys() - cycle.every.keys())
    cycles = {part: cycles_in_life(lives[part], cycle.hours) for part in outlived}
    alone = [lives[part] for part, count in cycles.items() if not count]
    return ReplacementRule(
        name,
        {
            part: (cycles[part] * cycle.hours or life) if part in outlived else cycle.mean_hours(part)
            for part, life in lives.items()
        },
        {part: cycle.first(part) for part in cycle.every},
        cycle.stop_rate + sum(1.0 / life for life in alone),
        _schedule((cycle.ends(part) for part in cycle.every), _known(lives, outlived)),
        outlived,
        bool(alone),
        cycle=cycle,
    )


def _together(chain: float, sprockets: Mapping[str, float]) -> list[ReplacementRule]:
    lives = {CHAIN: chain, **sprockets}
    shortest = min(sprockets.values())
    most = cycles_in_life(shortest, chain)
    if not most:
        name = "all parts with the first sprocket"
        return [_in_cycles(name, Cycle(shortest, (), dict.fromkeys(lives, 1)), lives)]
    return [
        _in_cycles(
            "all sprockets with every chain" if chains == 1 else f"all sprockets every {chains} chains",
            Cycle(chain, (), {**dict.fromkeys(lives, chains), CHAIN: 1}),
            lives,
        )
        for chains in range(1, most + 1)
    ]


def _ends(name: str, hours: float) -> Iterator[tuple[float, str]]:
    """Give the times at which a part is replaced every so many hours."""
    return ((number * hours, name) for number in itertools.count(1))


def _known(lives: Mapping[str, float], outlived: frozenset[str]) -> float:
    """Return the hours up to which it is known when every part is replaced."""
    return min((life for name, life in lives.items() if name in outlived), default=math.inf)


def _schedule(ends: Iterable[Iterator[tuple[float, str]]], known: float = math.inf) -> tuple[Stop, ...]:
    """Return the first stops; parts that end at the same time share one, the chain first of them."""
    found: list[Stop] = []
    for hours, name in heapq.merge(*ends):
        if found and hours - found[-1].hours <= SAME * hours:
            found[-1] = replace(found[-1], parts=(*found[-1].parts, name))
        elif len(found) == STOPS or hours > known:
            break
        else:
            found.append(Stop(hours, (name,)))
    return tuple(
        replace(stop, parts=tuple(sorted(stop.parts, key=lambda name: name != CHAIN))) for stop in found
    )


def _stop_rate(lives: Iterable[float]) -> float:
    """Return the stops in an hour for parts that are each replaced at their own end."""
    different = _distinct(lives)
    if not different:
        return 0.0
    shortest, *others = different
    together, period, alone = [Fraction(1)], Fraction(1), 0.0
    for life in others:
        ratio = Fraction(life / shortest).limit_denominator(_MOST_APART)
        longer = Fraction(
            math.lcm(period.numerator, ratio.numerator), math.gcd(period.denominator, ratio.denominator)
        )
        if abs(ratio * shortest / life - 1.0) <= SAME and longer <= _LONGEST_PERIOD:
            together.append(ratio)
            period = longer
        else:
            alone += 1.0 / life
    ends = {number * ratio for ratio in together for number in range(1, int(period / ratio) + 1)}
    return len(ends) / (float(period) * shortest) + alone


def _distinct(values: Iterable[float]) -> list[float]:
    """Return different values in their order, of those that are one only the least."""
    found: list[float] = []
    for value in sorted(values):
        if not found or value > found[-1] * (1.0 + SAME):
            found.append(value)
    return found
