"""The tables [run] and [stop]: how a life is calculated, and what ends it."""

from typing import Annotated, Literal

from pydantic import Field

from wearsim.input.schema.table import Table
from wearsim.input.units import Positive, PositiveNumber

Depth = Annotated[Positive, Field(ge=1e-9)]
"""Worn off: far below an atom is a slip of the pen."""


class StopTable(Table):
    """Limits; the first one met ends the life."""

    critical_depth_mm: Depth | None = None
    min_tip_land_mm: Positive | None = None
    case_depth_mm: Depth | None = None
    min_tooth_thickness_mm: Positive | None = None
    over_pins_change_mm: Positive | None = None
    min_slack_tension_N: Positive | None = None
    elongation_percent: Annotated[PositiveNumber, Field(le=10.0)] | None = None


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
