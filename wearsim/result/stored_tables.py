"""Tables of a stored result, cell by cell."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from wearsim.geometry.profile_points import Vector
from wearsim.quantities import quantities
from wearsim.result.stored_values import WHOLE


def table_columns(
    file: str, text: str, least: tuple[str, ...], check: Callable[[str, Mapping[str, Vector]], None]
) -> dict[str, Vector]:
    """Return columns by the names in the head: those that a table has at least, and any other quantity.

    Raises
    ------
    ValueError
        A column is missing, a cell is no number, or `check` finds something.
    """
    head, *rows = text.splitlines() or [""]
    names = head.split(",")
    whole = set(least) <= set(names) <= quantities().keys() and len(set(names)) == len(names)
    if not rows or not whole:
        raise ValueError(f"{file} must hold rows of {', '.join(least)}")
    table = np.empty((len(names), len(rows)))
    for number, row in enumerate(rows):
        table[:, number] = _cells(f"{file}, line {number + 2}", row, names)
    columns = dict(zip(names, table, strict=True))
    check(file, columns)
    return {name: cells.astype(int) if name in WHOLE else cells for name, cells in columns.items()}


def _cells(place: str, row: str, names: Sequence[str]) -> list[float]:
    """Return the numbers of a row, nan for empty cells."""
    cells = row.split(",")
    if len(cells) != len(names):
        raise ValueError(f"{place}: must have {len(names)} cells, has {len(cells)}")
    try:
        return [float(cell or "nan") for cell in cells]
    except ValueError:
        wrong = next(name for name, cell in zip(names, cells, strict=True) if not _is_number(cell))
        raise ValueError(f"{place}: {wrong} must be a number") from None


def _is_number(cell: str) -> bool:
    try:
        float(cell or "nan")
    except ValueError:
        return False
    return True
