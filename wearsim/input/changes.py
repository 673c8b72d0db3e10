"""Other values for keys of an input: each takes the place of what says the same in another way."""

import copy
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from wearsim.errors import CaseError, Fault
from wearsim.input.column_files import COLUMN_KEYS, column_file, is_columns
from wearsim.input.document import GivenInput
from wearsim.input.keys import schema_of, tables_in
from wearsim.input.table import Table, is_number, without_numbers
from wearsim.input.units import plain_value

_CHANGED = ", changed by with_"


def changed(given: GivenInput, changes: Mapping[str, Any]) -> GivenInput:
    """Return an input with other values; None removes a key.

    What a value takes the place of is removed, unless it is among the changes too.
    """
    values = dict(_flat(changes))
    tables = copy.deepcopy(dict(given.tables))
    for key, value in values.items():
        for other in _gives_way(tables, key, value):
            if other not in values:
                _remove(tables, other)
    for key, value in values.items():
        if value is None:
            _remove(tables, key)
        else:
            *path, name = key.split(".")
            _table(tables, path, key)[name] = value
    file = given.file.removesuffix(_CHANGED) + _CHANGED
    # Lines of the file no longer tell where a value stands.
    return replace(given, file=file, text="", tables=tables)


def _flat(changes: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Give dotted keys and plain values of changes, which may be nested tables too."""
    for key, value in changes.items():
        whole = f"{prefix}{key}"
        if without_numbers(whole) in COLUMN_KEYS and is_columns(value):
            yield whole, column_file(value, whole)
        elif isinstance(value, Mapping):
            yield from _flat(value, f"{whole}.")
        else:
            yield whole, plain_value(value)


def _gives_way(tables: Mapping[str, Any], key: str, value: Any) -> Iterator[str]:
    """Give the keys whose place a value takes, as each table on the way to it tells."""
    model: type[Table] | None = schema_of(tables)
    parts, place = key.split("."), ""
    while model is not None and parts:
        yield from (f"{place}{other}" for other in model.gives_way(".".join(parts), value))
        name, *parts = parts
        numbered = bool(parts) and is_number(parts[0])
        place += f"{name}.{parts.pop(0)}." if numbered else f"{name}."
        field = model.model_fields.get(name)
        model = None if field is None else next(tables_in(field.annotation), None)


def _remove(tables: dict[str, Any], key: str) -> None:
    """Remove a key, and the table that then holds nothing."""
    head, _, rest = key.partition(".")
    below = tables.get(head)
    if not rest:
        tables.pop(head, None)
    elif isinstance(below, dict):
        _remove(below, rest)
        if not below:
            del tables[head]
    elif isinstance(below, list):
        number, _, rest = rest.partition(".")
        _remove(_entry(below, number, key), rest)


def _table(tables: dict[str, Any], path: list[str], key: str) -> dict[str, Any]:
    """Return the table that holds a key, made where it is missing."""
    place: Any = tables
    for part in path:
        place = place.setdefault(part, {}) if isinstance(place, dict) else _entry(place, part, key)
    if not isinstance(place, dict):
        raise CaseError([Fault("must be the key of a table: give the number of one of several", key)])
    return place


def _entry(place: Any, number: str, key: str) -> Any:
    if not isinstance(place, list):
        raise CaseError([Fault("must be a key of a table, but what holds it is a value: correct it", key)])
    if not is_number(number) or not 1 <= int(number) <= len(place):
        text = f"must name one of {len(place)} tables by its number from 1, such as 1 (got {number!r})"
        raise CaseError([Fault(text, key)])
    return place[int(number) - 1]
