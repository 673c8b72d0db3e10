"""Files that an input names, and the folder that they lie in."""

import os.path
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

FILE_KEYS = (
    ("sprocket", "points_file"),
    ("sprocket", "dxf_file"),
    ("mechanism", "table_file"),
    ("load", "duty_file"),
    ("finite_elements", "axis_file"),
)
"""Tables and keys of the inputs that name a file."""


def file_paths(tables: Mapping[str, Any]) -> list[tuple[str, ...]]:
    """Return where the inputs name files: table and key, between them the number of one of several tables.

    Examples
    --------
    >>> file_paths({"sprocket": [{"teeth": 17}, {"dxf_file": "gap.dxf"}]})
    [('sprocket', '2', 'dxf_file')]
    """
    found: list[tuple[str, ...]] = []
    for table, key in FILE_KEYS:
        given = tables.get(table)
        if isinstance(given, list):
            places = [(table, str(number)) for number in range(1, len(given) + 1)]
            found += [(*place, key) for place, one in zip(places, given, strict=True) if _has(one, key)]
        elif _has(given, key):
            found.append((table, key))
    return found


def _has(table: object, key: str) -> bool:
    return isinstance(table, Mapping) and key in table


_allowed: list[bool] = [False]
"""Whether files may lie anywhere: of the whole process, as the page reads inputs in several threads."""


@contextmanager
def allow_outside() -> Iterator[None]:
    """Let inputs that are read in the block name files anywhere.

    Else a case or a table of readings that is read from a file may name files in its own folder and
    below it only, so that an input from others cannot have other files of yours read. A link counts by
    what it leads to. Tables that a program gives may name any file.

    Examples
    --------
    >>> with allow_outside():
    ...     outside_fault(Path("drives"), "/measured/flank.csv")
    ''
    >>> outside_fault(Path("drives"), "/measured/flank.csv").partition(":")[0]
    'must name a file in the folder of the input or below it'
    >>> outside_fault(Path("drives"), "flank.csv")
    ''
    """
    before, _allowed[0] = _allowed[0], True
    try:
        yield
    finally:
        _allowed[0] = before


def lies_inside(folder: Path, name: str) -> bool:
    """Return whether a file lies in a folder or below it, as far as it must; a link by what it leads to."""
    if _allowed[0] or "\0" in name:
        return True
    return Path(os.path.realpath(folder / name)).is_relative_to(os.path.realpath(folder))


def outside_fault(folder: Path, name: str) -> str:
    """Return what is wrong with a file that an input names out of its folder; empty where nothing is."""
    if lies_inside(folder, name):
        return ""
    return (
        "must name a file in the folder of the input or below it: copy it there, or if you trust the input "
        f"give --allow-outside, in Python `with wearsim.allow_outside():` (got {name!r:.60})"
    )


_HALVES = re.compile("[\ud800-\udfff]")
"""What stands in a name for bytes that are no UTF-8, which no file takes as text."""


def printable(name: str) -> str:
    r"""Return the name of a file as text that can be written anywhere.

    Examples
    --------
    >>> printable("sprocket \udcff")
    'sprocket \ufffd'
    """
    return _HALVES.sub("\ufffd", name)
