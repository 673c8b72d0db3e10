"""Tables as people keep them: separators, decimal commas, units and fractions of an inch in their cells."""

import csv
import io
import math
import re
from collections.abc import Iterator, Mapping, Sequence

from wearsim.errors import quoted
from wearsim.input.units import convert

Line = tuple[int, list[str]]
"""Number of a line in its file, and its cells."""

HOURS, KM, DATE, MILES = "time_hours", "distance_km", "date", "distance_miles"

_UNITS = {HOURS: ("h", "h"), KM: ("km", "km"), MILES: ("mile", "km")}
"""Unit that a number without one has in a column of times, and the one in which it is read."""

_NAMES = {"chain_length_inch": ("chain_length_mm", "inch")}
"""Quantities of another unit: what they are read as, and the unit that a number without one has."""

_OF_ENDING = {"mm": "mm", "percent": "percent"}
"""Units of values by the ending of their quantity."""

_COMMA = re.compile(r"[+-]?\d*,\d+(?:\s*[^\d\s,;.].*)?")
_POINT = re.compile(r"[+-]?\d*\.\d+(?:\s*[^\d\s,;.].*)?")
_THOUSANDS = re.compile(r"\d{1,3}\.\d{3}")
_FRACTION = re.compile(r"(\d+)[ -](\d+)/([1-9]\d*)(.*)")


def number(text: str) -> float:
    """Read a number; nan for anything else, also what only Python takes for one."""
    try:
        return float(text) if "_" not in text else math.nan
    except ValueError:
        return math.nan


def split_lines(text: str) -> list[Line]:
    r"""Return the cells of every line, separated as in the first one, without those that begin with ``#``.

    Examples
    --------
    >>> split_lines("time_hours;quantity;value\n500;elongation_percent;0,6\n")[1]
    (2, ['500', 'elongation_percent', '0.6'])
    """
    head = next((line for line in text.splitlines() if line.strip() and not line.startswith("#")), "")
    separator = next((mark for mark in ";\t" if mark in head), ",")
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
    lines = [
        (reader.line_num, [cell.strip() for cell in line])
        for line in reader
        if line and not line[0].startswith("#")
    ]
    if separator == ",":
        return lines
    return [(line, [_with_point(cell) for cell in cells]) for line, cells in lines]


def _with_point(cell: str) -> str:
    return cell.replace(",", ".") if _COMMA.fullmatch(cell) else cell


def decimal_faults(text: str, lines: Sequence[Line]) -> Iterator[tuple[int, str, str]]:
    """Give line, column and what is wrong of numbers whose decimal mark cannot be told."""
    if not lines or (";" not in text and "\t" not in text):
        return
    names = lines[0][1]
    given = [
        (line, cell.strip())
        for line, row in enumerate(text.splitlines(), start=1)
        if not row.startswith("#")
        for cell in re.split("[;\t]", row)
    ]
    commas, points = ([one for one in given if mark.fullmatch(one[1])] for mark in (_COMMA, _POINT))
    if commas and points:
        odd, mark = (commas, "points") if len(commas) < len(points) else (points, "commas")
        for line, cell in odd:
            yield (
                line,
                "",
                "numbers must have decimal points or decimal commas, but this table has both: others have "
                f"{mark} (got {quoted(cell)})",
            )
    for line, cells in lines[1:]:
        for name, cell in zip(names, cells, strict=False):
            if name in _UNITS and not commas and _THOUSANDS.fullmatch(cell):
                whole = cell.replace(".", "")
                yield line, name, f"may be {whole} or {cell}0: write one of these (got {quoted(cell)})"


def in_units_read(cells: Mapping[str, str]) -> dict[str, str]:
    """Return the cells of a row under the names and in the units that are read; what is no number as it is.

    Examples
    --------
    >>> in_units_read({"distance_miles": "1000", "quantity": "chain_length_inch", "value": "12 1/16"})
    {'distance_km': '1609.344', 'quantity': 'chain_length_mm', 'value': '306.3875'}
    """
    given = cells.get("quantity", "")
    quantity, own = _NAMES.get(given, (given, ""))
    unit = "mm" if quantity == "new" else _OF_ENDING.get(quantity.rpartition("_")[2], "")
    found = {}
    for name, text in cells.items():
        if name in _UNITS:
            found[KM if name == MILES else name] = _in_unit(text, *_UNITS[name])
        elif name in ("value", "error") and unit:
            found[name] = _in_unit(text, own or unit, unit)
        else:
            found[name] = quantity if name == "quantity" else text
    return found


def _in_unit(text: str, own: str, unit: str) -> str:
    """Return a number with its unit, or with its own one where none is written, as one in the unit read."""
    text = re.sub(r"(\d)\s*(?:\"|″)$", r"\1 inch", text)
    mixed = _FRACTION.fullmatch(text)
    if mixed:
        whole, above, below, rest = mixed.groups()
        text = f"{int(whole) + int(above) / int(below):.15g}{rest}"
    plain = not math.isnan(number(text))
    if plain and own == unit:
        return text
    try:
        return f"{convert(f'{text} {own}' if plain else text, unit):.15g}"
    except ValueError:
        return text
