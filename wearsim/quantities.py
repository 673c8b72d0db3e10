"""The one table of names: every input key and output column with symbol, unit and meaning; its numbers."""

import csv
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
    """Return all quantities by name."""
    with Path(__file__).with_suffix(".csv").open(encoding="utf-8", newline="") as file:
        return {row["name"]: Quantity(**row) for row in csv.DictReader(file)}


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
