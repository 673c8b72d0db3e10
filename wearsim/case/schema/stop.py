"""The table [stop]."""

from wearsim.case.schema.table import Table
from wearsim.case.units import Positive


class StopTable(Table):
    """Limits; the first one met ends the life."""

    critical_depth_mm: Positive | None = None
    min_tip_land_mm: Positive | None = None
