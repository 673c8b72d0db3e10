"""What studies read: [service], [optimise] and [uncertainty]."""

import math
from datetime import date
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema, field_validator

from wearsim.input.table import Above0, Choice, Finite, Table, all_differ, dotted, list_or
from wearsim.input.units import Positive, PositiveNumber


def _day(value: object) -> object:
    text = value.isoformat() if type(value) is date else value
    try:
        return date.fromisoformat(text).isoformat() if isinstance(text, str) else text
    except ValueError:
        raise ValueError("must be a day such as 2026-03-31") from None


class ServiceTable(Table):
    """Distance, mass and hours of a day in service, to give the life in these measures too."""

    km_per_hour: Positive | None = None
    tonnes_per_hour: Positive | None = None
    hours_per_day: Annotated[PositiveNumber, Field(le=24.0)] | None = None
    start_date: (
        Annotated[str, BeforeValidator(_day), WithJsonSchema({"type": "string", "format": "date"})] | None
    ) = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.start_date is not None and self.hours_per_day is None:
            return [("start_date", "the day on which a life ends needs hours_per_day too")]
        return []


Measure = Literal["life_hours", "mass_kg", "peak_pressure_MPa"]


class ParameterRange(Table):
    """Range of a key, both ends allowed."""

    low: Finite
    high: Finite

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if not math.isfinite(float(self.high) - float(self.low)):
            return [("high", "low and high must differ by less than 1.8e308: give closer ends")]
        if self.low < self.high:
            return []
        return [("high", f"must be above low = {self.low:g} (got {self.high:g})")]


if TYPE_CHECKING:
    _Parameter = ParameterRange | list[Choice]
else:
    _Parameter = list_or(ParameterRange, Annotated[list[Choice], Field(min_length=2)], "a range {low, high}")


class MeasureLimit(Table):
    """Limits of a quantity of a design."""

    low: Above0 | None = None
    high: Above0 | None = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.low is None and self.high is None:
            return [("high", "a limit needs low, high or both")]
        if self.low is not None and self.high is not None and not self.low < self.high:
            return [("high", f"must be above low = {self.low:g} (got {self.high:g})")]
        return []


class LimitsTable(Table):
    """Limits of a design in addition to those of `check`."""

    life_hours: MeasureLimit | None = None
    mass_kg: MeasureLimit | None = None
    peak_pressure_MPa: MeasureLimit | None = None


def _life() -> list[Measure]:
    return ["life_hours"]


class OptimiseTable(Table):
    """Objectives, parameters by the dotted names of their keys, and limits."""

    objectives: list[Measure] = Field(default_factory=_life, min_length=1)
    parameters: Annotated[dict[str, _Parameter], Field(min_length=1)]
    limits: LimitsTable = LimitsTable()

    @field_validator("parameters", mode="before")
    @classmethod
    def _flat(cls, value: Any) -> Any:
        return dotted(value, "low")

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        found = []
        if len(set(self.objectives)) < len(self.objectives):
            found.append(("objectives", "each objective may appear once, but one is given twice: remove it"))
        found += [
            (f"parameters.{key}", "each value may appear once, but one is given twice: remove it")
            for key, values in self.parameters.items()
            if isinstance(values, list) and not all_differ(values)
        ]
        return found


_KEYS = {
    "lognormal": (("sigma_ln",), ("median", "low", "high")),
    "normal": (("standard_deviation",), ("mean", "low", "high")),
    "uniform": (("low", "high"), ()),
    "triangular": (("low", "high"), ("mode",)),
    "weibull": (("shape", "scale"), ("low", "high")),
}


class Distribution(Table):
    """Distribution of one key, in the unit of the key."""

    distribution: Literal["lognormal", "normal", "uniform", "triangular", "weibull"]
    median: Above0 | None = None
    sigma_ln: Annotated[Finite, Field(ge=0.0, le=5.0)] | None = None
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
