"""[maintenance]: what parts and a stop cost, and when a chain is replaced."""

from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, WithJsonSchema

from wearsim.input.table import Table
from wearsim.input.texts import SEEN
from wearsim.input.units import Positive, PositiveNumber

_MAX_PERCENT = 10.0


def _elongations(value: object) -> object:
    if not isinstance(value, list) or not value:
        raise ValueError("must be a list of numbers such as [1, 2, 3]")
    for entry in value:
        number = isinstance(entry, int | float) and not isinstance(entry, bool)
        if not (number and 0.0 < entry <= _MAX_PERCENT):
            raise ValueError(f"every entry must be a number above 0 and up to {_MAX_PERCENT:g}")
    numbers = [float(entry) for entry in value]
    if len(set(numbers)) < len(numbers):
        raise ValueError("each entry must be given only once")
    return sorted(numbers)


_SCHEMA: dict[str, Any] = {
    "type": "array",
    "items": {"type": "number", "exclusiveMinimum": 0.0, "maximum": _MAX_PERCENT},
    "minItems": 1,
    "uniqueItems": True,
}


class MaintenanceTable(Table):
    """Prices of chain, sprocket and a stop, and elongations at which to replace the chain."""

    replace_at_percent: (
        Annotated[list[float], BeforeValidator(_elongations), WithJsonSchema(_SCHEMA)] | None
    ) = None
    turn_sprocket: bool = False
    chain_price: PositiveNumber | None = None
    sprocket_price: PositiveNumber | None = None
    downtime_hours: Positive | None = None
    downtime_cost_per_hour: PositiveNumber | None = None
    currency: Annotated[str, Field(min_length=1, max_length=8), SEEN] | None = None

    @property
    def stop_cost(self) -> float:
        """Cost of one stop: hours of standstill times their cost, 0 where neither is given."""
        return (self.downtime_hours or 0.0) * (self.downtime_cost_per_hour or 0.0)

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        needs = (
            ("sprocket_price", "chain_price"),
            ("downtime_hours", "downtime_cost_per_hour"),
            ("downtime_cost_per_hour", "downtime_hours"),
            ("downtime_cost_per_hour", "chain_price"),
        )
        return [
            (key, f"the cost needs {other} too: give both or neither")
            for key, other in needs
            if getattr(self, key) is not None and getattr(self, other) is None
        ]


def maintenance_of(inputs: Mapping[str, Any]) -> MaintenanceTable:
    """Return [maintenance] of the complete tables of a case, with nothing in it where there is none."""
    return MaintenanceTable(**inputs.get("maintenance", {}))
