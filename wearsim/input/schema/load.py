"""The table [load], and tables of [[duty]]."""

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema

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


LOAD_KEYS = ("tension_N", "power_kW", "torque_N_m")
"""Keys of which exactly one gives a load."""

_MOST_BINS = 100


def _bins(value: object) -> object:
    pair = value if isinstance(value, list) and len(value) == 2 else [None]
    if not all(type(entry) is int and 1 <= entry <= _MOST_BINS for entry in pair):
        raise ValueError(
            f"must be two whole numbers from 1 to {_MOST_BINS}, bins of the tension and of the speed, "
            "such as [20, 8]"
        )
    return value


def _named(value: object) -> object:
    """Take the number 0 for the name: that is what --set load.regime=0 gives."""
    return "0" if type(value) is int and value == 0 else value


Regime = Annotated[Literal["0", "I", "II", "III", "IV", "V"], BeforeValidator(_named)]
"""A typical regime of loading, from constant to very light."""

_BINS: dict[str, Any] = {
    "type": "array",
    "items": {"type": "integer", "minimum": 1, "maximum": _MOST_BINS},
    "minItems": 2,
    "maxItems": 2,
}


class LoadTable(Table):
    """Load and speed of this sprocket: constant, by a typical regime, or by a log."""

    tension_N: Positive | None = None
    power_kW: Positive | None = None
    torque_N_m: Positive | None = None
    speed_rpm: Speed | None = None
    regime: Regime | None = None
    duty_file: str | None = None
    duty_bins: Annotated[list[int], BeforeValidator(_bins), WithJsonSchema(_BINS)] | None = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.duty_file is not None:
            keys = (*LOAD_KEYS, "speed_rpm", "regime")
            return [
                (key, "duty_file gives load and speed: remove one of both")
                for key in keys
                if getattr(self, key) is not None
            ]
        found = []
        if self.duty_bins is not None:
            found.append(("duty_bins", "belongs to duty_file: remove it"))
        given = [key for key in LOAD_KEYS if getattr(self, key) is not None]
        if len(given) > 1:
            message = f"give exactly one of {', '.join(LOAD_KEYS)} (got {', '.join(given)})"
            found.append((given[1], message))
        return found
