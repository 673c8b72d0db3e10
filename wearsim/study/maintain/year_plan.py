"""A plan for the next twelve months of a drive whose chain was read: numbers only."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from wearsim.drive.renewal import SAME
from wearsim.drive.replacement_rules import Prices
from wearsim.quantities import DAYS_OF_YEAR

REPLACE, RELUBRICATE, KEEP = "replace", "relubricate", "keep"


@dataclass(frozen=True)
class PartNow:
    """A part on the day of the last row of the log."""

    name: str
    life: float  # of one from new [h]; where it outlived its run that of the run
    used: float  # hours that it has run
    worn_out: bool = True  # whether it was worn out in its run
    low: float = math.nan  # ends of the hours that are left, 90 % of them between; nan where not known
    high: float = math.nan

    @property
    def left(self) -> float:
        """Hours that are left."""
        return max(self.life - self.used, 0.0)


@dataclass(frozen=True)
class Job:
    """Something to do, or a part that is kept."""

    hours: float  # from now; of a part that is kept those until it is worn out
    job: str  # `REPLACE`, `RELUBRICATE` or `KEEP`
    parts: tuple[str, ...]
    cost: float | None  # None where no price is known
    # low, high: ends of these hours, 90 % of them between, until the first end of a part; nan where not known
    low: float = math.nan
    high: float = math.nan
    at_least: bool = False  # whether a part that is kept lasts so long at least


def year_of_hours(hours_per_day: float) -> float:
    """Return the running hours of twelve months."""
    return DAYS_OF_YEAR * hours_per_day


def replacements(parts: Sequence[PartNow], until: float, prices: Prices | None) -> list[Job]:
    """Return the stops until some hours from now, and what is replaced in each.

    A part is replaced when it is worn out. In that stop every part goes too that has at most the shortest
    life of all left, where its unused life is worth at most a stop; without prices wherever it has so much
    left, which makes the fewest stops.

    Examples
    --------
    A chain with 100 h left of 1000 and a sprocket with 300 h of 2500, whose unused 200 h are worth 8:

    >>> parts = [PartNow("chain", 1000.0, 900.0), PartNow("roll", 2500.0, 2200.0)]
    >>> (job,) = replacements(parts, 1000.0, Prices(40.0, {"roll": 100.0}, 10.0))
    >>> job.hours, job.parts, job.cost
    (100.0, ('chain', 'roll'), 150.0)
    """
    known = {one.name: one for one in parts if one.worn_out}
    left = {name: one.left for name, one in known.items()}
    shortest = min((one.life for one in known.values()), default=math.inf)
    now, jobs, renewed = 0.0, list[Job](), set[str]()
    while left and (step := min(left.values())) + now <= until:
        now += step
        worn = min(left, key=left.__getitem__)
        left = {name: rest - step for name, rest in left.items()}
        due = tuple(name for name, rest in left.items() if _goes(known[name], rest, shortest, prices))
        ends = (math.nan, math.nan) if worn in renewed else (known[worn].low, known[worn].high)
        jobs.append(Job(now, REPLACE, due, _cost(due, prices), *ends))
        renewed.update(due)
        left |= {name: known[name].life for name in due}
    return jobs


def _goes(part: PartNow, rest: float, shortest: float, prices: Prices | None) -> bool:
    """Whether a part is replaced in a stop that leaves it so many hours."""
    if rest <= SAME * part.life:
        return True
    if rest > shortest * (1.0 + SAME):
        return False
    return prices is None or prices.parts[part.name] * rest / part.life <= prices.stop


def _cost(parts: Sequence[str], prices: Prices | None) -> float | None:
    if prices is None:
        return None
    return prices.stop + math.fsum(prices.parts[name] for name in parts)


def kept_parts(parts: Sequence[PartNow], jobs: Sequence[Job]) -> Iterator[Job]:
    """Give the parts that no job replaces, with the hours until they are worn out."""
    gone = {name for job in jobs for name in job.parts}
    for one in sorted(parts, key=lambda part: part.left):
        if one.name not in gone:
            yield Job(one.left, KEEP, (one.name,), 0.0, one.low, one.high, at_least=not one.worn_out)


def relubrications(first: float, interval: float, until: float, cost: float | None) -> list[Job]:
    """Return the relubrications until some hours from now.

    Examples
    --------
    >>> [job.hours for job in relubrications(50.0, 100.0, 260.0, None)]
    [50.0, 150.0, 250.0]
    """
    count = math.floor((until - first) / interval) + 1 if first <= until else 0
    return [Job(first + number * interval, RELUBRICATE, ("drive",), cost) for number in range(count)]


def total(jobs: Sequence[Job]) -> float | None:
    """Return what all jobs cost; None where one of them has no price."""
    costs = [job.cost for job in jobs]
    return None if None in costs else math.fsum(cost or 0.0 for cost in costs)


def used_percent(parts: Sequence[PartNow]) -> Mapping[str, float]:
    """Return how much of its life each part has used [%]."""
    return {one.name: 100.0 * one.used / one.life for one in parts}
