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

CHAIN = "chain"

STOPS = 24
"""Stops of a schedule."""

SAME = 1e-9
"""Relative difference below which two times are one."""

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
    least_cost: float | None = None  # the same if such parts lived for ever


def cost_rate(rule: ReplacementRule, prices: Prices) -> float:
    """Return what parts and stops cost in an hour.

    Examples
    --------
    A chain of 40 every 1000 h, a sprocket of 100 every 2500 h, 1.2 stops in 1000 h of 10 each:

    >>> rule = ReplacementRule("own end", {"chain": 1000.0, "roll": 2500.0}, {}, 0.0012, ())
    >>> round(1000 * cost_rate(rule, Prices(40.0, {"roll": 100.0}, 10.0)), 9)
    92.0
    """
    price = {**prices.sprockets, CHAIN: prices.chain}
    parts = math.fsum(price[name] / hours for name, hours in rule.every.items())
    return parts + rule.stop_rate * prices.stop


def replacement_rules(
    chain: float,
    sprockets: Mapping[str, float],
    prices: Prices | None = None,
    outlived: frozenset[str] = frozenset(),
) -> list[ReplacementRule]:
    """Return the rules by which the parts of a drive can be replaced.

    Each part at its own end; each sprocket with the last chain change before its end; all sprockets with
    every m-th chain, for every m that the shortest-lived one allows.

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
        Only the first one where the chain outlived its run.
    """
    found = [_each_at_its_end(chain, sprockets, outlived)]
    if CHAIN not in outlived:
        found += [_with_chains(chain, sprockets, outlived), *_together(chain, sprockets)]
    if prices is None:
        return found
    lasting = {name: life for name, life in sprockets.items() if name not in outlived}
    for_ever = [_each_at_its_end(chain, lasting, outlived), _with_chains(chain, lasting, outlived)]
    return [
        replace(rule, cost=cost_rate(rule, prices), least_cost=cost_rate(least, prices))
        for rule, least in zip(found, [*for_ever, *found[2:]], strict=False)
    ]


def cheapest(rules: list[ReplacementRule]) -> tuple[int, bool] | None:
    """Return the number of the cheapest rule, and whether no other can be cheaper.

    None without prices, and where there is only one rule.
    """
    costs = [(rule.cost, number) for number, rule in enumerate(rules) if rule.cost is not None]
    if len(costs) < 2:
        return None
    cost, number = min(costs)
    least = [rule.least_cost for i, rule in enumerate(rules) if i != number]
    return number, all(other is not None and other >= cost * (1.0 - SAME) for other in least)


def chains_in_life(life: float, chain: float) -> int:
    """Return how many chains a sprocket wears out in its life, 0 where it does not outlive the first.

    Examples
    --------
    >>> chains_in_life(2500.0, 1000.0), chains_in_life(3000.0, 1000.0), chains_in_life(900.0, 1000.0)
    (2, 3, 0)
    """
    return math.floor(life / chain * (1.0 + SAME))


def _each_at_its_end(
    chain: float, sprockets: Mapping[str, float], outlived: frozenset[str]
) -> ReplacementRule:
    every = {CHAIN: chain, **sprockets}
    return ReplacementRule(
        "each part at its own end",
        every,
        every,
        _stop_rate(every.values()),
        _schedule(
            (_ends(name, hours) for name, hours in every.items() if name not in outlived),
            _known(every, outlived),
        ),
        outlived,
        bool(outlived),
    )


def _with_chains(chain: float, sprockets: Mapping[str, float], outlived: frozenset[str]) -> ReplacementRule:
    """Replace sprockets with chains; one that does not live as long as a chain also in between."""
    every, between = {CHAIN: chain}, {}
    for name, life in sprockets.items():
        chains = chains_in_life(life, chain)
        if chains:
            every[name] = chains * chain
        else:
            between[name] = life
            every[name] = chain / math.ceil(chain / life * (1.0 - SAME))
    within = [
        hours
        for name, life in between.items()
        for hours, _ in itertools.takewhile(lambda end: end[0] < chain * (1.0 - SAME), _ends(name, life))
    ]
    return ReplacementRule(
        "sprockets with a chain change",
        every,
        {**every, **between},
        (1.0 + len(_distinct(within))) / chain,
        _schedule(
            (
                _ends_within(name, between[name], chain) if name in between else _ends(name, hours)
                for name, hours in every.items()
                if name not in outlived
            ),
            _known(sprockets, outlived),
        ),
        outlived & every.keys(),
        bool(outlived & between.keys()),
    )


def _together(chain: float, sprockets: Mapping[str, float]) -> list[ReplacementRule]:
    shortest = min(sprockets.values())
    most = chains_in_life(shortest, chain)
    if not most:
        return [_all_every("all parts with the first sprocket", shortest, shortest, sprockets)]
    return [
        _all_every(
            "all sprockets with every chain" if chains == 1 else f"all sprockets every {chains} chains",
            chain,
            chains * chain,
            sprockets,
        )
        for chains in range(1, most + 1)
    ]


def _all_every(name: str, chain: float, hours: float, sprockets: Mapping[str, float]) -> ReplacementRule:
    every = {CHAIN: chain, **dict.fromkeys(sprockets, hours)}
    return ReplacementRule(
        name, every, every, 1.0 / chain, _schedule(_ends(part, one) for part, one in every.items())
    )


def _ends(name: str, hours: float) -> Iterator[tuple[float, str]]:
    """Give the times at which a part is replaced every so many hours."""
    return ((number * hours, name) for number in itertools.count(1))


def _ends_within(name: str, life: float, chain: float) -> Iterator[tuple[float, str]]:
    """Give the times at which a part is replaced that ends before its chain, and goes with it too."""
    for number in itertools.count():
        end = life
        while end < chain * (1.0 - SAME):
            yield number * chain + end, name
            end += life
        yield (number + 1) * chain, name


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
    shortest, *others = _distinct(lives)
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
