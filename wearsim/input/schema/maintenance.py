"""The tables [maintenance] and [service]."""

from datetime import date
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, WithJsonSchema

from wearsim.input.schema.table import Table
from wearsim.input.units import Positive, PositiveNumber


def _day(value: object) -> object:
    text = value.isoformat() if type(value) is date else value
    try:
        return date.fromisoformat(text).isoformat() if isinstance(text, str) else text
    except ValueError:
        raise ValueError("must be a day such as 2026-03-31") from None


class ServiceTable(Table):
    """What an hour of running means in service, to give a life also in other measures."""

    km_per_hour: Positive | None = None
    tonnes_per_hour: Positive | None = None
    hours_per_day: Annotated[PositiveNumber, Field(le=24.0)] | None = None
    start_date: (
        Annotated[str, BeforeValidator(_day), WithJsonSchema({"type": "string", "format": "date"})] | None
    ) = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.start_date is not None and self.hours_per_day is None:
            return [("start_date", "the day on which a life ends needs hours_per_day too")]
        return []


_MOST_PERCENT = 10.0


def _elongations(value: object) -> object:
    if not isinstance(value, list) or not value:
        raise ValueError("must be a list of numbers such as [1, 2, 3]")
    for entry in value:
        number = isinstance(entry, int | float) and not isinstance(entry, bool)
        if not (number and 0.0 < entry <= _MOST_PERCENT):
            raise ValueError(f"every entry must be a number above 0 and up to {_MOST_PERCENT:g}")
    numbers = [float(entry) for entry in value]
    if len(set(numbers)) < len(numbers):
        raise ValueError("every entry must come once")
    return sorted(numbers)


_SCHEMA: dict[str, Any] = {
    "type": "array",
    "items": {"type": "number", "exclusiveMinimum": 0.0, "maximum": _MOST_PERCENT},
    "minItems": 1,
    "uniqueItems": True,
}


class MaintenanceTable(Table):
    """What chain, sprocket and a stop cost, and at which elongations to replace the chain."""

    replace_at_percent: (
        Annotated[list[float], BeforeValidator(_elongations), WithJsonSchema(_SCHEMA)] | None
    ) = None
    turn_sprocket: bool = False
    chain_price: PositiveNumber | None = None
    sprocket_price: PositiveNumber | None = None
    downtime_hours: Positive | None = None
    downtime_cost_per_hour: PositiveNumber | None = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        needs = (
            ("chain_price", "sprocket_price"),
            ("sprocket_price", "chain_price"),
            ("downtime_hours", "downtime_cost_per_hour"),
            ("downtime_cost_per_hour", "downtime_hours"),
            ("downtime_cost_per_hour", "chain_price"),
        )
        return [
            (key, f"the cost needs {other} too: give both or none")
            for key, other in needs
            if getattr(self, key) is not None and getattr(self, other) is None
        ]
