"""The table [joint]."""

from typing import Literal

from wearsim.input.schema.table import Table
from wearsim.input.units import Positive


class JointTable(Table):
    """Wear of pin and bush, which makes the chain grow."""

    specific_wear_rate_mm2_per_N: Positive | None = None
    pitch: Literal["alternating", "uniform"] | None = None
