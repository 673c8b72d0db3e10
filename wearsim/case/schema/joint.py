"""The table [joint]."""

from typing import Literal

from wearsim.case.schema.table import Table
from wearsim.case.units import Positive


class JointTable(Table):
    """Wear of pin and bush, which makes the chain grow."""

    specific_wear_rate_mm2_per_N: Positive | None = None
    pitch: Literal["alternating", "uniform"] | None = None
