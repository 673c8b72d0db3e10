"""The table [stop]."""

from typing import Annotated

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
