"""Columns that a program gives in the place of a CSV file: they become a file for as long as it runs."""

import atexit
import hashlib
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any

from wearsim.errors import CaseError, Fault

COLUMN_KEYS = ("sprocket.points_file", "mechanism.table_file", "load.duty_file")
"""Keys that name a CSV file, without the number of a sprocket."""


def is_columns(value: object) -> bool:
    """Tell whether a value has columns by their names: a mapping, or a table of pandas."""
    return isinstance(value, Mapping) or hasattr(value, "columns")


def with_column_files(tables: Mapping[str, Any]) -> dict[str, Any]:
    """Return tables in which the path of a file stands where columns stood."""
    found = dict(tables)
    for dotted in COLUMN_KEYS:
        table, _, key = dotted.partition(".")
        given = found.get(table)
        if isinstance(given, list):
            found[table] = [_with_file(one, key, f"{table}.{i}") for i, one in enumerate(given, start=1)]
        elif given is not None:
            found[table] = _with_file(given, key, table)
    return found


def _with_file(table: Any, key: str, place: str) -> Any:
    if not isinstance(table, Mapping) or not is_columns(table.get(key)):
        return table
    return {**table, key: column_file(table[key], f"{place}.{key}")}


def column_file(columns: Any, key: str) -> str:
    """Write columns to a CSV file, every number to its last digit, and return its path.

    Raises `CaseError` where they are no numbers, or of several lengths.
    """
    values = {str(column): list(_cells(columns[column], f"{key}.{column}")) for column in columns}
    lengths = {column: len(cells) for column, cells in values.items()}
    if len(set(lengths.values())) != 1:
        shown = ", ".join(f"{column} {length}" for column, length in lengths.items()) or "none"
        raise CaseError([Fault(f"all columns must hold the same number of values (got {shown})", key)])
    rows = [",".join(values), *(",".join(row) for row in zip(*values.values(), strict=True))]
    text = "".join(f"{row}\n" for row in rows)
    name = f"{key.removesuffix('_file').replace('.', '_')}.csv"
    path = _folder() / hashlib.sha256(text.encode()).hexdigest()[:16] / name
    path.parent.mkdir(exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return str(path)


def _cells(column: Any, key: str) -> Iterator[str]:
    try:
        yield from (repr(float(value)) for value in column)
    except (TypeError, ValueError):
        raise CaseError([Fault(f"must be a row of numbers (got {column!r:.60})", key)]) from None


@cache
def _folder() -> Path:
    """Return the folder of these files, which is removed when the process ends."""
    folder = tempfile.mkdtemp(prefix="wearsim-columns-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return Path(folder)
