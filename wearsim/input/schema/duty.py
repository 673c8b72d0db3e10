"""A table of [[duty]]."""

from typing import Annotated, Literal

from pydantic import Field

from wearsim.input.schema.load import LOAD_KEYS
from wearsim.input.schema.table import Table
from wearsim.input.units import Positive, PositiveNumber, Speed

Share = Annotated[PositiveNumber, Field(le=1.0)]


class DutyBlock(Table):
    """A part of the duty in which load and speed are constant."""

    share_of_time: Share | None = None
    share_of_cycles: Share | None = None
    tension_N: Positive | None = None
    power_kW: Positive | None = None
    torque_N_m: Positive | None = None
    speed_rpm: Speed
    wear_factor: PositiveNumber = 1.0
    applies_to: Literal["all", "teeth", "joints"] = "all"

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        found = []
        for keys in (("share_of_time", "share_of_cycles"), LOAD_KEYS):
            given = [key for key in keys if getattr(self, key) is not None]
            if len(given) != 1:
                names = f"{', '.join(keys[:-1])} and {keys[-1]}"
                message = f"give exactly one of {names} (got {', '.join(given) or 'none'})"
                found.append((given[1] if given else keys[0], message))
        return found
