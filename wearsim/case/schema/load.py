"""The table [load]."""

from wearsim.case.schema.table import Table
from wearsim.case.units import Positive


class LoadTable(Table):
    """Load and speed of this sprocket; one of tension, power and torque."""

    tension_N: Positive | None = None
    power_kW: Positive | None = None
    torque_N_m: Positive | None = None
    speed_rpm: Positive

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        keys = ("tension_N", "power_kW", "torque_N_m")
        given = [key for key in keys if getattr(self, key) is not None]
        if len(given) < 2:
            return []
        return [(given[1], f"give exactly one of {', '.join(keys)} (got {', '.join(given)})")]
