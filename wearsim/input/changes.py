"""Other values for keys of an input: each takes the place of what says the same in another way."""

import copy
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from wearsim.errors import CaseError, Fault
from wearsim.input.column_files import COLUMN_KEYS, column_file, is_columns
from wearsim.input.document import GivenInput
from wearsim.input.giving_way import entry_of, giving_way, remove
from wearsim.input.table import Table, without_numbers
from wearsim.input.units import plain_value

_CHANGED = ", changed by with_"


def changed(given: GivenInput, changes: Mapping[str, Any]) -> GivenInput:
    """Return an input with other values; None removes a key.

    What a value takes the place of is removed, unless it is among the changes too.
    """
    values = dict(_flat(changes))
    tables = copy.deepcopy(dict(given.tables))
    for key, value in values.items():
        for other in giving_way(tables, key, partial(_of_value, value=value)):
            if other not in values:
                remove(tables, other)
    for key, value in values.items():
        if value is None:
            remove(tables, key)
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


def _of_value(model: type[Table], key: str, value: Any) -> tuple[str, ...]:
    return model.gives_way(key, value)


def _table(tables: dict[str, Any], path: list[str], key: str) -> dict[str, Any]:
    """Return the table that holds a key, made where it is missing."""
    place: Any = tables
    for part in path:
        place = place.setdefault(part, {}) if isinstance(place, dict) else entry_of(place, part, key)
    if not isinstance(place, dict):
        raise CaseError([Fault("must be the key of a table: give the number of one of several", key)])
    return place
