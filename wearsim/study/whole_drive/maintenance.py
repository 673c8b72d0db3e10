"""The plan of a drive, the only one: which part is replaced when, from its lives and the prices given."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from wearsim.input.schema import MaintenanceTable
from wearsim.quantities import DAYS_OF_YEAR
from wearsim.result import Life, LowerBound
from wearsim.study.whole_drive.keys import DriveCase
from wearsim.study.whole_drive.model import CHAIN, DriveLife
from wearsim.study.whole_drive.plan import (
    SAME,
    STOPS,
    Prices,
    ReplacementRule,
    Stop,
    cheapest,
    replacement_rules,
)

CONVENTIONS = (
    "a new chain and a new sprocket live as long as the first ones",
    "parts that end at the same time share a stop; a stop costs the same whatever is replaced in it",
    "in the long run: no interest, and what is left of a part that is replaced early is lost",
)
OF_A_CASSETTE = "a cassette is one part: it is replaced when its first cog is worn"

CHAINS, YEARS = 3, 10.0
"""The stops that are shown end with this chain or after these years in service, whichever is sooner."""


@dataclass(frozen=True)
class DrivePlan:
    """Rules by which the parts of a drive can be replaced, side by side."""

    found: DriveLife
    lives: Mapping[str, Life | LowerBound]  # of the chain and every sprocket; a cassette is one part
    rules: tuple[ReplacementRule, ...]

    @property
    def drive(self) -> DriveCase:
        """The drive that is planned."""
        return self.found.drive

    @property
    def cheapest(self) -> tuple[int, bool] | None:
        """Number of the cheapest rule, and whether no other can be cheaper; None where that is not known."""
        return cheapest(list(self.rules))

    @property
    def best(self) -> ReplacementRule:
        """The cheapest rule; without prices that of sprockets with a chain change, if the chain ends."""
        found = self.cheapest
        return self.rules[min(1, len(self.rules) - 1) if found is None else found[0]]

    @property
    def ends(self) -> dict[str, float]:
        """Hours in which the stops that are shown can end, by what they are."""
        ends, chain = {}, self.lives[CHAIN]
        if isinstance(chain, Life):
            ends[f"{CHAINS} chains"] = CHAINS * chain.hours
        service = self.drive.driver.case.inputs.get("service") or {}
        if "hours_per_day" in service:
            ends[f"{YEARS:g} years"] = YEARS * DAYS_OF_YEAR * service["hours_per_day"]
        if self.best.at_most:
            ends["all that the runs cover"] = self._outlived
        return ends

    @property
    def until(self) -> float:
        """Hours in which the stops that are shown end."""
        return min(self.ends.values())

    @property
    def _outlived(self) -> float:
        """Hours of the shortest run that did not wear out its part."""
        return min((self.lives[name].hours_run for name in self.best.at_most), default=math.inf)

    @property
    def known(self) -> float:
        """Hours up to which all stops of the best rule are known."""
        schedule = self.best.schedule
        return min(self._outlived, schedule[-1].hours if len(schedule) == STOPS else math.inf)

    @property
    def first_stops(self) -> list[Stop]:
        """Stops in which a part is replaced for the first time."""
        stops: dict[float, list[str]] = {}
        for name, hours in sorted(self.best.first.items(), key=lambda item: item[1]):
            if name not in self.best.at_most:
                stops.setdefault(hours, []).append(name)
        return [Stop(hours, tuple(names)) for hours, names in stops.items()]

    @property
    def stops(self) -> tuple[Stop, ...]:
        """Stops of the best rule until then, of many the first ones."""
        return tuple(stop for stop in self.best.schedule if stop.hours <= self.until * (1.0 + SAME))

    @property
    def goes_on(self) -> bool:
        """Whether there are more of them until then."""
        return len(self.stops) == STOPS and self.stops[-1].hours < self.until * (1.0 - SAME)

    def chain_at(self, hours: float) -> int:
        """Return the number of the chain that is replaced at a time, 0 where none is."""
        chains = hours / self.best.every[CHAIN]
        ends = CHAIN not in self.best.at_most and abs(chains - round(chains)) <= SAME * chains
        return round(chains) if ends else 0

    @property
    def conventions(self) -> tuple[str, ...]:
        """How parts, stops and cost are counted."""
        cassette = any(wheel.cogs for wheel in self.drive.wheels)
        return (*CONVENTIONS, *((OF_A_CASSETTE,) if cassette else ()))


def drive_plan(found: DriveLife) -> DrivePlan:
    """Return the rules by which the parts of a drive can be replaced, and their cost if prices are given."""
    lives = part_lives(found)
    rules = replacement_rules(
        lives[CHAIN].hours_run,
        {name: life.hours_run for name, life in lives.items() if name != CHAIN},
        None if found.failed else _prices(found.drive),
        frozenset(name for name, life in lives.items() if isinstance(life, LowerBound)),
    )
    return DrivePlan(found, lives, tuple(rules))


def part_lives(found: DriveLife) -> dict[str, Life | LowerBound]:
    """Return the lives of chain and sprockets; a cassette lives as long as the cog that dies first.

    One whose run has failed is left out, with its cassette.
    """
    lives = {CHAIN: found.chain}
    for wheel in found.drive.wheels:
        if not found.failed.keys().isdisjoint(wheel.parts):
            continue
        cogs = [found.sprockets[name] for name in wheel.parts]
        lives[wheel.name] = min(cogs, key=lambda life: (life.hours_run, isinstance(life, LowerBound)))
    return lives


def _prices(drive: DriveCase) -> Prices | None:
    tables = {one.name: MaintenanceTable(**one.case.inputs.get("maintenance", {})) for one in drive.sprockets}
    first = tables[drive.sprockets[0].name]
    prices = {
        wheel.name: price
        for wheel in drive.wheels
        if (price := tables[wheel.parts[0]].sprocket_price) is not None
    }
    if first.chain_price is None or len(prices) < len(drive.wheels):
        return None
    stop = (first.downtime_hours or 0.0) * (first.downtime_cost_per_hour or 0.0)
    return Prices(first.chain_price, prices, stop)
