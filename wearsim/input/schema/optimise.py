"""The table [optimise]: what may change of a case, what is sought, and within what limits."""

import math
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import Field, field_validator

from wearsim.input.schema.dotted import Above0, Finite, all_differ, dotted, list_or
from wearsim.input.schema.table import Table

Measure = Literal["life_hours", "mass_kg", "peak_pressure_MPa"]


class ParameterRange(Table):
    """Ends between which a key may lie, both allowed."""

    low: Finite
    high: Finite

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if not math.isfinite(float(self.high) - float(self.low)):
            return [("high", "low and high must lie less than 1.8e308 apart: give nearer ends")]
        if self.low < self.high:
            return []
        return [("high", f"must be above low = {self.low:g} (got {self.high:g})")]


Choice = bool | Finite | str
Choices = Annotated[list[Choice], Field(min_length=2)]


if TYPE_CHECKING:
    _Parameter = ParameterRange | list[Choice]
else:
    _Parameter = list_or(ParameterRange, Choices, "a range {low, high}")


class MeasureLimit(Table):
    """Ends that a design must keep to."""

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
    """What a design must keep to beside what `check` finds."""

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
            found.append(("objectives", "every objective once, but one is given twice: remove it"))
        found += [
            (f"parameters.{key}", "every value once, but one is given twice: remove it")
            for key, values in self.parameters.items()
            if isinstance(values, list) and not all_differ(values)
        ]
        return found
