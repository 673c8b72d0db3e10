"""The table [run]."""

from typing import Annotated, Literal

from pydantic import Field

from wearsim.input.schema.table import Table
from wearsim.input.units import Positive, PositiveNumber


class RunTable(Table):
    """How the life is calculated."""

    method: Literal["advance", "per_cycle"] = "advance"
    cycles_per_update: Annotated[int, Field(ge=1)] | None = None
    life_tolerance: Annotated[PositiveNumber, Field(ge=1e-6, le=0.1)] | None = None
    horizon_hours: Annotated[Positive, Field(ge=1e-6)] = 1e6
    """At least some milliseconds, in which no tooth wears."""

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.cycles_per_update is None or self.method == "per_cycle":
            return []
        message = "belongs to method = 'per_cycle': remove it or change the method"
        return [("cycles_per_update", message)]
