"""The table [mechanism]."""

from typing import Annotated, Literal

from pydantic import Field

from wearsim.input.schema.table import Table
from wearsim.input.units import NotNegative, PositiveNumber


class MechanismTable(Table):
    """The picture of what touches the flank."""

    kind: Literal["strand", "prescribed", "wrap"] | None = None
    table_file: str | None = None
    phases: Annotated[int, Field(ge=1, le=720)] | None = None
    roller_slip_fraction: Annotated[PositiveNumber, Field(ge=1e-6, le=1.0)] | None = None
    """Below the least what slides is lost in the rounding of the flank's points."""
    friction_roller_tooth: Annotated[NotNegative, Field(le=1.0)] | None = None
    friction_roller_bush: Annotated[NotNegative, Field(le=1.0)] | None = None
