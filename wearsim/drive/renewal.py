"""Renewal cycles of a drive: which parts are replaced together, and the cheapest cycle.

All parts are new at the beginning of a cycle, and there is a stop whenever a part is worn out. A part that
would last longer is replaced in that stop too if the time it has left, or what that is worth, is at most a
limit. All parts so replaced are new again at the end of the cycle; a part that outlives several cycles is
replaced at the end of the last of them that it lasts.

A limit of 0 leaves every part to its own end. With the life of the shortest-lived part as limit, whatever
would not last to the next stop is replaced: the fewest stops. A larger limit only adds parts to these stops.
In between a policy changes only where the limit passes what a part has left in one of its stops. Every such
limit (in steps of 1 % at least) is priced, with every stop as the end of its cycle.

Such cycles are not all schedules, but no other saves much: against the optimum of all schedules (dynamic
programming on whole hours, 350 random drives of 2 to 4 parts) the cheapest one, or each part at its own end,
cost 0.2 % more in the mean and 2.1 % more at most.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

SAME = 1e-9
"""Relative difference below which two times are one."""

SAVES = 1e-3
"""Part of the cost that a policy must save over a simpler one to be preferred to it."""

_STOPS = 60
"""Most stops of a cycle."""

_STEP = 0.01
"""Least step from one limit to the next, over the largest."""


@dataclass(frozen=True)
class Cycle:
    """Stops that repeat."""

    hours: float  # from its beginning to its end
    within: tuple[tuple[float, tuple[str, ...]], ...]  # stops before its end, with hours from its beginning
    every: Mapping[str, int]  # parts replaced at its end, each in every so many cycles

    @property
    def stop_rate(self) -> float:
        """Stops in an hour."""
        return (len(self.within) + 1) / self.hours

    def count(self, name: str) -> int:
        """Return how often a part is replaced within a cycle, before its end."""
        return sum(name in parts for _, parts in self.within)

    def mean_hours(self, name: str) -> float:
        """Return the mean hours from one replacement of a part to the next."""
        return self.hours * self.every[name] / (1 + self.every[name] * self.count(name))

    def first(self, name: str) -> float:
        """Return the hours of the first replacement of a part."""
        within = (hours for hours, parts in self.within if name in parts)
        return next(within, self.hours * self.every[name])

    def replaced(self, name: str, hours: float) -> int:
        """Return how many of a part have been replaced up to some hours, those of a stop then among them."""
        until = hours * (1.0 + SAME)
        cycles = math.floor(until / self.hours)
        rest = until - cycles * self.hours
        begun = sum(at <= rest and name in parts for at, parts in self.within)
        return cycles * self.count(name) + cycles // self.every[name] + begun

    def ends(self, name: str) -> Iterator[tuple[float, str]]:
        """Give the times at which a part is replaced."""
        within = [hours for hours, parts in self.within if name in parts]
        number = 0
        while True:
            yield from ((number * self.hours + hours, name) for hours in within)
            number += 1
            if number % self.every[name] == 0:
                yield number * self.hours, name


def cycles_in_life(life: float, hours: float) -> int:
    """Return how many cycles a part lasts, 0 where it does not last for one.

    Examples
    --------
    >>> cycles_in_life(2500.0, 1000.0), cycles_in_life(3000.0, 1000.0), cycles_in_life(900.0, 1000.0)
    (2, 3, 0)
    """
    return math.floor(life / hours * (1.0 + SAME))


def fewest_stops(lives: Mapping[str, float]) -> Cycle:
    """Return the cycle of the fewest stops, and with them of the fewest parts.

    Stops cannot be further apart than the shortest life; each part lasts for as many of them as fit into its
    own life.
    """
    hours = min(lives.values())
    return Cycle(hours, (), {name: cycles_in_life(life, hours) for name, life in lives.items()})


def least_cost_rate(lives: Mapping[str, float], prices: Mapping[str, float], stop: float) -> float:
    """Return what no schedule can fall below in an hour: every part used up, stops as far apart as can be.

    Examples
    --------
    40/1000 + 100/2500 + 60/1000:

    >>> least_cost_rate({"chain": 1000.0, "roll": 2500.0}, {"chain": 40.0, "roll": 100.0}, 60.0)
    0.14
    """
    parts = math.fsum(prices[name] / life for name, life in lives.items())
    return parts + stop / min(lives.values())


def cheapest_cycle(lives: Mapping[str, float], prices: Mapping[str, float], stop: float) -> Cycle:
    """Return the cycle that costs least in the long run.

    Parameters
    ----------
    lives, prices : mapping
        Life of every part by its name [h], above 0, and what it costs.
    stop : float
        What a stop costs, whatever is replaced in it.
    """
    names = list(lives)
    parts = [(lives[name], prices[name]) for name in names]
    by_hours = [1.0] * len(parts)
    by_worth = [price / life for life, price in parts]
    runs = [run for rates in (by_hours, by_worth) for run in _runs([life for life, _ in parts], rates)]
    costs = [(cost, end, number) for number, run in enumerate(runs) for end, cost in _costs(run, parts, stop)]
    most = min(costs)[0] * (1.0 + SAVES)
    end, number = min((end, number) for cost, end, number in costs if cost <= most)
    stops = runs[number][: end + 1]
    hours = stops[-1][0]
    inner = tuple((at, tuple(names[i] for i in replaced)) for at, replaced in stops[:-1])
    once = {name for _, replaced in inner for name in replaced}
    every = {name: 1 if name in once else cycles_in_life(lives[name], hours) for name in names}
    return Cycle(hours, inner, every)


_Run = list[tuple[float, list[int]]]
"""Hours of each stop, and the numbers of the parts replaced in it."""


def _runs(lives: Sequence[float], rates: Sequence[float]) -> Iterator[_Run]:
    """Give the stops for every limit of what parts would still last, weighted by a rate each."""
    largest = max(rate * min(lives) for rate in rates)
    limit = 0.0
    while math.isfinite(limit):
        run, limit = _run(lives, rates, limit, limit + _STEP * largest)
        yield run


def _run(lives: Sequence[float], rates: Sequence[float], limit: float, least: float) -> tuple[_Run, float]:
    """Return the stops for one limit, and the next limit that changes them and is not below the least."""
    shortest = min(lives) * (1.0 + SAME)
    limit *= 1.0 + SAME
    left, hours, following = list(lives), 0.0, math.inf
    run: _Run = []
    for _ in range(_STOPS):
        step = min(left)
        hours += step
        replaced = []
        for part, life in enumerate(lives):
            rest = left[part] - step
            value = rest * rates[part]
            if rest <= SAME * life or (rest <= shortest and value <= limit):
                replaced.append(part)
                rest = life
            elif rest <= shortest and least <= value < following:
                following = value
            left[part] = rest
        run.append((hours, replaced))
    return run, following


def _costs(run: _Run, parts: Sequence[tuple[float, float]], stop: float) -> Iterator[tuple[int, float]]:
    """Give the cost in an hour of the cycle that ends with each stop."""
    spent = 0.0
    once: set[int] = set()
    for end, (hours, replaced) in enumerate(run):
        last = stop
        for part, (life, price) in enumerate(parts):
            last += price if part in once else price / cycles_in_life(life, hours)
        yield end, (spent + last) / hours
        spent += stop + sum(parts[part][1] for part in replaced)
        once.update(replaced)
