"""The table [uncertainty]: how the values of keys scatter."""

from typing import Annotated, Literal

from pydantic import BeforeValidator, Field

from wearsim.input.schema.dotted import Above0, Finite, dotted
from wearsim.input.schema.table import Table

_KEYS = {
    "lognormal": (("sigma_ln",), ("median", "low", "high")),
    "normal": (("standard_deviation",), ("mean", "low", "high")),
    "uniform": (("low", "high"), ()),
    "triangular": (("low", "high"), ("mode",)),
    "weibull": (("shape", "scale"), ("low", "high")),
}


class Distribution(Table):
    """How the value of one key scatters, in the unit of the key."""

    distribution: Literal["lognormal", "normal", "uniform", "triangular", "weibull"]
    median: Above0 | None = None
    sigma_ln: Annotated[int | float, Field(ge=0.0, le=5.0)] | None = None
    mean: Finite | None = None
    standard_deviation: Above0 | None = None
    mode: Finite | None = None
    shape: Above0 | None = None
    scale: Above0 | None = None
    low: Finite | None = None
    high: Finite | None = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        needed, allowed = _KEYS[self.distribution]
        given = {name for name in type(self).model_fields if getattr(self, name) is not None}
        given -= {"distribution"}
        found = [(key, f"{self.distribution} needs this key") for key in needed if key not in given]
        found += [
            (key, f"does not belong to {self.distribution}: remove it")
            for key in sorted(given - set(needed) - set(allowed))
        ]
        if self.low is not None and self.high is not None and not self.low < self.high:
            found.append(("high", f"must be above low = {self.low:g} (got {self.high:g})"))
        return found


Uncertainty = Annotated[
    dict[str, Distribution], BeforeValidator(lambda value: dotted(value, "distribution")), Field(min_length=1)
]
"""How keys scatter, by their dotted names."""
