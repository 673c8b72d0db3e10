"""The plan of a drive, the only one: which part is replaced when, from its lives and the prices given."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from wearsim.case.keys import maintenance_of
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.drive_result import DriveLife
from wearsim.drive.renewal import SAME, least_cost_rate
from wearsim.drive.replacement_rules import STOPS, Prices, ReplacementRule, Stop, cheapest, replacement_rules
from wearsim.quantities import DAYS_OF_YEAR
from wearsim.result import Life, LowerBound
from wearsim.result.ends import CHAIN
from wearsim.result.events import Event, drive_events

CONVENTIONS = (
    "replacement parts last as long as the originals",
    "parts that are worn out at the same time share a stop; a stop costs the same whatever is replaced in it",
    "long-run average, undiscounted; unused life of a part has no value",
)
OF_A_CASSETTE = "a cassette is one part: it is replaced when its first cog is worn"

WITHOUT_PRICES = "without prices the plan shown is the one with the fewest stops, then the fewest parts"

CHAINS, YEARS = 3, 10.0
"""The stops that are shown end with this chain or after these years in service, whichever is sooner."""


@dataclass(frozen=True)
class DrivePlan:
    """Rules by which the parts of a drive can be replaced, side by side."""

    found: DriveLife
    lives: Mapping[str, Life | LowerBound]  # of the chain and every sprocket; a cassette is one part
    rules: tuple[ReplacementRule, ...]
    no_less: float | None  # cost in an hour below which no schedule can fall; None without prices

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
        """The cheapest rule; without prices that of the fewest stops, if there is one."""
        found = self.cheapest
        return self.rules[min(1, len(self.rules) - 1) if found is None else found[0]]

    @property
    def ends(self) -> dict[str, float]:
        """Hours in which the stops that are shown can end, by what they are."""
        ends = {}
        if isinstance(self.lives[CHAIN], Life):
            ends[f"{CHAINS} chains"] = CHAINS * self.best.every[CHAIN]
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

    @property
    def conventions(self) -> tuple[str, ...]:
        """How parts, stops and cost are counted."""
        cassette = any(wheel.cogs for wheel in self.drive.wheels)
        unpriced = len(self.rules) > 1 and self.cheapest is None
        more = [text for text, holds in ((OF_A_CASSETTE, cassette), (WITHOUT_PRICES, unpriced)) if holds]
        return (*CONVENTIONS, *more)


def drive_plan(found: DriveLife) -> DrivePlan:
    """Return the rules by which the parts of a drive can be replaced, and their cost if prices are given."""
    lives, prices = part_lives(found), None if found.failed else drive_prices(found.drive)
    hours = {name: life.hours_run for name, life in lives.items()}
    worn_out = {name: life.hours for name, life in lives.items() if isinstance(life, Life)}
    chain = hours.pop(CHAIN)
    rules = replacement_rules(chain, hours, prices, frozenset(lives.keys() - worn_out.keys()))
    no_less = least_cost_rate(worn_out, prices.parts, prices.stop) if prices and worn_out else None
    return DrivePlan(found, lives, tuple(rules), no_less)


def planned_events(plan: DrivePlan) -> tuple[Event, ...]:
    """Return what happens to chain and sprockets when, in the order of time, replaced as planned."""
    found, driver = plan.found, plan.drive.driver
    wheels = {name: wheel.name for wheel in found.drive.wheels for name in wheel.parts}
    ends = [replace(end, part=wheels.get(end.part, end.part)) for end in found.ends]
    replaced = {name: stop.hours for stop in plan.first_stops for name in stop.parts}
    limit = 100.0 * driver.drive.joint.elongation_limit
    return drive_events(driver.case.inputs, found.reference.history_columns, limit, ends, replaced)


def part_lives(found: DriveLife) -> dict[str, Life | LowerBound]:
    """Return the lives of chain and sprockets by what ends each first; a cassette's is that of its first cog.

    One whose run has failed is left out, with its cassette.
    """
    earliest = found.earliest_lives
    lives = {CHAIN: earliest[CHAIN]}
    for wheel in found.drive.worn_wheels:
        if not found.failed.keys().isdisjoint(wheel.parts):
            continue
        cogs = [earliest[name] for name in wheel.parts]
        lives[wheel.name] = min(cogs, key=lambda life: (life.hours_run, isinstance(life, LowerBound)))
    return lives


def drive_prices(drive: DriveCase) -> Prices | None:
    """Return the prices of the parts of a drive; None where one is not given."""
    tables = {one.name: maintenance_of(one.case.inputs) for one in drive.sprockets}
    first = tables[drive.sprockets[0].name]
    worn = drive.worn_wheels
    prices = {
        wheel.name: price for wheel in worn if (price := tables[wheel.parts[0]].sprocket_price) is not None
    }
    if first.chain_price is None or len(prices) < len(worn):
        return None
    return Prices(first.chain_price, prices, first.stop_cost)
