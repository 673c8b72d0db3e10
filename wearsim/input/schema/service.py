"""The table [service]."""

from datetime import date
from typing import Annotated

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
        Annotated[str, BeforeValidator(_day), WithJsonSchema({"type": "string", "format": "date"})]
        | None
    ) = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.start_date is not None and self.hours_per_day is None:
            return [("start_date", "the day on which a life ends needs hours_per_day too")]
        return []
