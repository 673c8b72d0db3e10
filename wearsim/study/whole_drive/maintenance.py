"""The plan of a drive: which part is replaced when, from its lives and the prices of [maintenance]."""

from collections.abc import Mapping
from dataclasses import dataclass

from wearsim.input.document import CaseSource, read_document
from wearsim.input.schema import MaintenanceTable
from wearsim.result import Life, LowerBound
from wearsim.study.whole_drive.keys import DriveCase
from wearsim.study.whole_drive.model import CHAIN, DriveLife
from wearsim.study.whole_drive.plan import Prices, ReplacementRule, cheapest, replacement_rules

CONVENTIONS = (
    "a new chain and a new sprocket live as long as the first ones",
    "parts that end at the same time share a stop; a stop costs the same whatever is replaced in it",
    "in the long run: no interest, and what is left of a part that is replaced early is lost",
)
OF_A_CASSETTE = "a cassette is one part: it is replaced when its first cog is worn"

_OF_ONE_SPROCKET = {
    "turn_sprocket": "is for the case of one sprocket: a drive is planned without turning: remove it",
    "replace_at_percent": "is for the case of one sprocket: the chain of a drive goes at "
    "stop.elongation_percent: remove it",
}


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
    def conventions(self) -> tuple[str, ...]:
        """How parts, stops and cost are counted."""
        cassette = any(wheel.cogs for wheel in self.drive.wheels)
        return (*CONVENTIONS, *((OF_A_CASSETTE,) if cassette else ()))


def check_plan_keys(source: CaseSource, settings: tuple[str, ...]) -> None:
    """Refuse the keys of [maintenance] that a whole drive has no use for."""
    document = read_document(source, settings)
    table = document.data.get("maintenance")
    for key, message in _OF_ONE_SPROCKET.items():
        if isinstance(table, dict) and table.get(key):
            document.faults.add(f"maintenance.{key}", message)
    document.faults.check()


def drive_plan(found: DriveLife) -> DrivePlan:
    """Return the rules by which the parts of a drive can be replaced, and their cost if prices are given."""
    lives = part_lives(found)
    rules = replacement_rules(
        lives[CHAIN].hours_run,
        {name: life.hours_run for name, life in lives.items() if name != CHAIN},
        _prices(found.drive),
        frozenset(name for name, life in lives.items() if isinstance(life, LowerBound)),
    )
    return DrivePlan(found, lives, tuple(rules))


def part_lives(found: DriveLife) -> dict[str, Life | LowerBound]:
    """Return the lives of chain and sprockets; a cassette lives as long as the cog that dies first."""
    lives = {CHAIN: found.chain}
    for wheel in found.drive.wheels:
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
