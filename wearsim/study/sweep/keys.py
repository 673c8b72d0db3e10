"""The input file of a sweep."""

from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BeforeValidator, Field, PositiveInt, field_validator

from wearsim.input.table import CalculationTables, Choice, Finite, Table, all_differ, choice, dotted, list_or


def _value(value: object) -> object:
    return [choice(entry) for entry in value] if isinstance(value, list) else choice(value)


Value = Annotated[bool | Finite | str | list[Choice], BeforeValidator(_value)]
Values = Annotated[list[Value], Field(min_length=1)]

_MAX = 1_000_000


class Range(Table):
    """Values between two ends, both included."""

    first: Annotated[Finite, Field(alias="from")]
    last: Annotated[Finite, Field(alias="to")]
    count: Annotated[PositiveInt, Field(ge=2, le=_MAX)]
    spacing: Literal["linear", "log"] = "linear"

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.first == self.last:
            return [("to", f"must differ from from = {self.first:g}")]
        if self.spacing == "log" and not (self.first > 0.0 and self.last > 0.0):
            return [("spacing", "log needs both ends above 0: take linear")]
        return []


if TYPE_CHECKING:
    _Axis = Range | list[Value]
else:
    _Axis = list_or(Range, Values, "a range {from, to, count}")


class SweepTables(CalculationTables):
    """A sweep: a case, and values for its keys by dotted names."""

    case: str
    grid: dict[str, _Axis] = Field(default_factory=dict)
    zip: list[dict[str, Values]] = Field(default_factory=list)
    design: list[dict[str, Value]] = Field(default_factory=list)

    @field_validator("grid", mode="before")
    @classmethod
    def _one(cls, value: Any) -> Any:
        return dotted(value, "from")

    @field_validator("zip", "design", mode="before")
    @classmethod
    def _many(cls, value: Any) -> Any:
        return [dotted(entry) for entry in value] if isinstance(value, list) else value

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the tables."""
        found = []
        if not (self.grid or self.zip or self.design):
            found.append(("grid", "a sweep needs values for a key in [grid], [[zip]] or [[design]]"))
        found += [
            (f"grid.{key}", "each value may appear once, but one is given twice: remove it")
            for key, values in self.grid.items()
            if isinstance(values, list) and not all_differ(values)
        ]
        for number, group in enumerate(self.zip, start=1):
            counts = {key: len(values) for key, values in group.items()}
            if len(set(counts.values())) > 1:
                shown = ", ".join(f"{key} {count}" for key, count in counts.items())
                found.append((f"zip.{number}", f"keys that go together need as many values: {shown}"))
        if len({frozenset(entry) for entry in self.design}) > 1:
            found.append(("design", "every [[design]] must give the same keys"))
        keys = [*self.grid, *(key for group in self.zip for key in group)]
        keys += list(self.design[0]) if self.design else []
        found += [
            ("grid", f"{key} stands in two places: give its values once")
            for key in sorted({key for key in keys if keys.count(key) > 1})
        ]
        return found
