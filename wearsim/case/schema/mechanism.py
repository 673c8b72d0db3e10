"""The table [mechanism]."""

from typing import Annotated, Literal

from pydantic import Field

from wearsim.case.schema.table import Table
from wearsim.case.units import PositiveNumber


class MechanismTable(Table):
    """The picture of what touches the flank."""

    kind: Literal["strand", "prescribed"] = "strand"
    table_file: str | None = None
    roller_slip_fraction: Annotated[PositiveNumber, Field(le=1.0)] = 1.0
