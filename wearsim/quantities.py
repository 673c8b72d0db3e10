"""The one table of names: every input key and output column with symbol, unit and meaning; its numbers."""

import csv
import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

DAYS_OF_YEAR = 365.25
"""Mean length of a year."""


@dataclass(frozen=True)
class Quantity:
    """A row of the table."""

    name: str  # input key or column; ends in the unit where there is one
    symbol: str  # as in the equations, empty where there is none
    unit: str  # empty for numbers without a unit and for words
    meaning: str  # what it is


@cache
def quantities() -> dict[str, Quantity]:
    """Return all quantities by name; of a name that is a key and a column, the column."""
    return {row.name: row for row in _rows()}


@cache
def input_quantities() -> dict[str, Quantity]:
    """Return all quantities by name; of a name that is a key and a column, the key, whose row is first."""
    return {row.name: row for row in reversed(_rows())}


def _rows() -> list[Quantity]:
    with Path(__file__).with_suffix(".csv").open(encoding="utf-8", newline="") as file:
        return [Quantity(**row) for row in csv.DictReader(file)]


_PERCENTILE = re.compile(r"p(\d+)_hours")


@cache
def percentile_shares() -> tuple[float, ...]:
    """Shares of all lives that end before each percentile which is reported: a row of the table each.

    Examples
    --------
    >>> percentile_shares()
    (0.1, 0.5, 0.9)
    """
    return tuple(int(found[1]) / 100 for found in map(_PERCENTILE.fullmatch, quantities()) if found)


def percentile_name(share: float) -> str:
    """Name of the percentile of a share: P10 of 0.1."""
    return f"P{100 * share:.0f}"


def percentile_meaning(share: float) -> str:
    """Words for how many lives are longer than the percentile of a share.

    Examples
    --------
    >>> percentile_meaning(0.1), percentile_meaning(0.5), percentile_meaning(0.9)
    ('9 of 10 last longer', 'half last longer', '1 of 10 lasts longer')
    """
    if share == 0.5:
        return "half last longer"
    longer = 100 - round(100 * share)
    common = math.gcd(longer, 100)
    longer, every = longer // common, 100 // common
    return f"{longer} of {every} {'lasts' if longer == 1 else 'last'} longer"


def grouped(value: float, digits: int = 4) -> str:
    """Return a number with few digits and thousands set apart, as one reads it aloud.

    Examples
    --------
    >>> grouped(15149.24)
    '15 150'
    >>> grouped(0.012341)
    '0.01234'
    """
    rounded = float(f"{value:.{digits}g}")
    if abs(rounded) >= 10 ** (digits - 1):
        return f"{rounded:,.0f}".replace(",", " ")
    return f"{rounded:.{digits}g}"


def time_in_words(seconds: float) -> str:
    """Return a time as people say it, of at least a second.

    Examples
    --------
    >>> time_in_words(0.13), time_in_words(8.24), time_in_words(300.0), time_in_words(7.2e4)
    ('1 s', '8 s', '5 min', '20 h')
    """
    if seconds < 99.0:
        return f"{max(1.0, seconds):.0f} s"
    minutes = seconds / 60.0
    return f"{minutes:.2g} min" if minutes < 99.0 else f"{minutes / 60.0:.0f} h"


def either(words: Iterable[str]) -> str:
    """Return words of which one is meant as one reads them aloud.

    Examples
    --------
    >>> either(["dxf", "svg", "csv"])
    'dxf, svg or csv'
    """
    *most, last = words
    return f"{', '.join(most)} or {last}" if most else last


_NUMBER = re.compile(r"(?<![\w.])(?<!\w-)-?\d+(?: \d{3})*(?:\.\d+)?(?:e[-+]?\d+)?(?!\w)")
"""A number as it is printed, with what sets its thousands apart."""


def kind_of_text(text: str) -> str:
    """Return a text without its numbers.

    Examples
    --------
    >>> kind_of_text("08B-1 from -4.5e3 h to 33 320 h")
    '08B-1 from # h to # h'
    """
    return _NUMBER.sub("#", text)


def with_ranges(texts: Sequence[str]) -> str:
    """Return texts of one kind as one, with the range of each number that is not the same in all.

    Examples
    --------
    >>> with_ranges(["error 0.12 exceeds 0.05", "error 0.083 exceeds 0.05", "error 0.1 exceeds 0.05"])
    'error 0.083 to 0.12 exceeds 0.05'
    """
    columns = zip(*(_NUMBER.findall(text) for text in texts), strict=True)
    ranges = (sorted(column, key=lambda number: float(number.replace(" ", ""))) for column in columns)
    shown = iter([" to ".join(dict.fromkeys((each[0], each[-1]))) for each in ranges])
    return _NUMBER.sub(lambda _: next(shown), texts[0])
