"""What every table of the input file has in common."""

from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, model_validator
from pydantic_core import PydanticCustomError

from wearsim.catalogue.catalogues import nearest
from wearsim.quantities import quantities


def _describe(schema: dict[str, Any]) -> None:
    for name, entry in schema.get("properties", {}).items():
        entry.pop("title", None)
        _without_null(entry)
        if name in quantities():
            entry["description"] = quantities()[name].meaning


def _without_null(entry: dict[str, Any]) -> None:
    """Drop the choice of null: TOML has none, and an editor's messages stay to the point."""
    if entry.get("default", "") is None:
        del entry["default"]
    choices = [choice for choice in entry.pop("anyOf", ()) if choice != {"type": "null"}]
    if len(choices) == 1:
        entry.update(choices[0])
    elif choices:
        entry["anyOf"] = choices


def known(value: str | None, names: dict[str, object], what: str, command: str) -> str | None:
    """Return a name of a table, or raise with the nearest ones."""
    if value is None or value in names:
        return value
    raise ValueError(f"no such {what}{nearest(value, names)} ({command} shows them all)")


class Table(BaseModel):
    """A table of the input file; closed to unknown keys, strict in its types."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, json_schema_extra=_describe)

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        return []

    @model_validator(mode="after")
    def _check_conflicts(self) -> Self:
        found = self.conflicts()
        if found:
            raise PydanticCustomError("conflicts", "keys do not fit together", {"faults": found})
        return self


def whole(value: object) -> object:
    """Return a version, or raise where it is no whole number."""
    if type(value) is not int:
        raise ValueError("must be 1")
    return value


FormatVersion = Annotated[Literal[1], BeforeValidator(whole)]


class CalculationTables(Table):
    """The tables of an input file that is about no drive."""

    format_version: FormatVersion
    title: str = ""
