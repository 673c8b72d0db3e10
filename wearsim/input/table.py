"""What every table of the input file has in common."""

import math
import sys
from collections.abc import Sequence
from typing import Annotated, Any, ClassVar, Literal, Protocol, Self, TypeVar

from pydantic import BaseModel, BeforeValidator, ConfigDict, Discriminator, Field, Tag, model_validator
from pydantic_core import PydanticCustomError

from wearsim.catalogue.catalogues import nearest
from wearsim.input.texts import Title, check_characters
from wearsim.quantities import input_quantities


def describe(schema: dict[str, Any]) -> None:
    """Add to the schema of a table what its keys mean; a key that is a table is described by that table."""
    for name, entry in schema.get("properties", {}).items():
        entry.pop("title", None)
        _without_null(entry)
        if name in input_quantities() and not _is_table(entry):
            entry["description"] = input_quantities()[name].meaning


def _is_table(entry: dict[str, Any]) -> bool:
    """Whether a key holds a table, or tables alone."""
    choices = entry.get("anyOf", entry.get("allOf", (entry.get("items", entry),)))
    return all("$ref" in choice for choice in choices)


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


class _DataClass(Protocol):
    __dataclass_fields__: ClassVar[dict[str, Any]]


_Plain = TypeVar("_Plain", bound=_DataClass)

_SCALES = {"_mm": 1.0, "_MPa": 1.0, "_N_m": 1e3, "_deg": math.pi / 180.0, "_rpm": 1.0, "_N": 1.0}
"""Ends of keys with a unit, and what makes their values plain."""


def _without_unit(key: str) -> tuple[str, float]:
    """Return the name of a key without its unit, and the scale of its values.

    Examples
    --------
    >>> _without_unit("pinion_torque_N_m"), _without_unit("gear_ratio")
    (('pinion_torque', 1000.0), ('gear_ratio', 1.0))
    """
    for end, scale in _SCALES.items():
        if key.endswith(end):
            return key.removesuffix(end), scale
    return key, 1.0


class Table(BaseModel):
    """A table of the input file; closed to unknown keys, strict in its types."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, json_schema_extra=describe)

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        return []

    @classmethod
    def one_of(cls) -> tuple[tuple[str, ...], ...]:
        """Return groups of keys that exclude each other, as they give the same quantity."""
        return ()

    @classmethod
    def gives_way(cls, key: str, value: Any) -> tuple[str, ...]:
        """Return the keys of this table, and of those in it, whose place a new value of a key takes."""
        return others_of(key, *cls.one_of())

    def plain(self, target: type[_Plain], **others: Any) -> _Plain:
        """Return the values as an object of plain numbers in mm, N, MPa, rpm and rad.

        Its fields have the names of the keys without their units; what is left out keeps its default.
        """
        values = dict(others)
        for key in type(self).model_fields:
            value, (name, scale) = getattr(self, key), _without_unit(key)
            if value is None or name in others or name not in target.__dataclass_fields__:
                continue
            values[name] = value if scale == 1.0 else scale * value
        return target(**values)

    @model_validator(mode="after")
    def _check_conflicts(self) -> Self:
        found = self.conflicts()
        if found:
            raise PydanticCustomError("conflicts", "keys do not fit together", {"faults": found})
        return self


def others_of(key: str, *groups: tuple[str, ...]) -> tuple[str, ...]:
    """Return what gives way to a key of groups of which one key can be given.

    Examples
    --------
    >>> others_of("b", ("a", "b", "c"), ("d", "e"))
    ('a', 'c')
    """
    return tuple(other for group in groups if key in group for other in group if other != key)


def whole(value: object) -> object:
    """Return a version, or raise where it is no whole number."""
    if type(value) is not int:
        raise ValueError("must be 1")
    return value


FormatVersion = Annotated[Literal[1], BeforeValidator(whole)]


class CalculationTables(Table):
    """The tables of an input file that is about no drive."""

    format_version: FormatVersion
    title: Title = ""


def _finite(value: object) -> object:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError("must be a number")
    if not abs(value) <= sys.float_info.max:
        raise ValueError("must be a finite number")
    return value


Finite = Annotated[int | float, BeforeValidator(_finite)]
"""A number in the unit of the key that it is for."""

Above0 = Annotated[int | float, BeforeValidator(_finite), Field(gt=0.0)]
"""The same above 0."""


def choice(value: object) -> object:
    """Return a value that is no list, or raise."""
    if isinstance(value, str):
        return check_characters(value)
    if isinstance(value, bool):
        return value
    try:
        return _finite(value)
    except ValueError:
        raise ValueError("must be a finite number, a word, true or false") from None


Choice = Annotated[bool | Finite | str, BeforeValidator(choice)]
"""A value of any key but a list."""


def is_number(part: str) -> bool:
    """Return whether a part of a dotted name counts the entries of a list.

    Examples
    --------
    >>> is_number("2"), is_number("\u00b2"), is_number("teeth")
    (True, False, False)
    """
    return part.isascii() and part.isdecimal() and len(part) < _LONGEST


_LONGEST = 10
"""Digits from which on no list has so many entries."""


def without_numbers(key: str) -> str:
    """Return a dotted name without the numbers of entries of lists.

    Examples
    --------
    >>> without_numbers("duty.2.speed_rpm")
    'duty.speed_rpm'
    """
    return ".".join(part for part in key.split(".") if not is_number(part))


def all_differ(values: Sequence[Any]) -> bool:
    """Return whether no value of a list stands there twice.

    Examples
    --------
    >>> all_differ([20, 20.0]), all_differ([1, True])
    (False, True)
    """
    return len({_told_apart(value) for value in values}) == len(values)


def _told_apart(value: Any) -> Any:
    if isinstance(value, list):
        return tuple(_told_apart(entry) for entry in value)
    return isinstance(value, bool), value


def dotted(value: Any, leaf: str | None = None) -> Any:
    """Return nested tables as one with dotted keys, so that both ways to write them are one.

    Examples
    --------
    >>> dotted({"wear": {"coefficient": {"from": 1, "to": 2}}}, "from")
    {'wear.coefficient': {'from': 1, 'to': 2}}
    """
    if not isinstance(value, dict):
        return value
    flat: dict[str, Any] = {}
    for key, below in value.items():
        nested = isinstance(below, dict) and not (leaf is not None and _is_value(below, leaf))
        inner = dotted(below, leaf) if nested else {"": below}
        for name, entry in inner.items():
            whole = _counted(f"{key}.{name}" if name else key)
            if whole in flat:
                raise ValueError(
                    f"{whole} is given twice, with and without quotes or zeros before a number: remove one"
                )
            flat[whole] = entry
    return flat


def _counted(key: str) -> str:
    parts = key.split(".")
    return ".".join(str(int(part)) if is_number(part) else part for part in parts)


def _is_value(table: dict[str, Any], leaf: str) -> bool:
    return leaf in table or not any(isinstance(entry, dict | list) for entry in table.values())


def list_or(table: type[BaseModel], values: Any, words: str) -> Any:
    """Return the type of a key that takes a table or a list, faulted as what was meant."""
    return Annotated[
        Annotated[table, Tag(_TABLE)] | Annotated[values, Tag(_LIST)],
        Discriminator(
            _chosen,
            custom_error_type="table_or_list",
            custom_error_message=f"must be {words} or a list of values",
        ),
    ]


def _chosen(value: Any) -> str | None:
    if isinstance(value, list):
        return _LIST
    return _TABLE if isinstance(value, dict | BaseModel) else None


_TABLE, _LIST = "(table)", "(list)"
CHOSEN = (_TABLE, _LIST)
"""What pydantic adds to the place of a fault by `list_or`."""
