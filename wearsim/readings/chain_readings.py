"""Dated readings of a chain as people have them: lengths, percent, gauges that fall in or not."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from wearsim.readings.kept_tables import number

LENGTH, ELONGATION, GAUGE = "chain_length_mm", "elongation_percent", "gauge_percent"
READINGS = (LENGTH, ELONGATION, GAUGE)
GO, NO_GO = "go", "no-go"

_MOST_PERCENT = 10.0
Holds = Callable[[str], bool]
Rules = Mapping[str, tuple[Holds, str]]


@dataclass(frozen=True)
class ChainReading:
    """What a row says about the elongation of the chain."""

    line: int  # in its file
    hours: float  # running time since the chain was new [h]
    quantity: str  # one of `READINGS`
    # low, high: ends between which the gauge saw the elongation [%]; alike where it was measured
    low: float
    high: float
    error: float  # standard deviation [%]
    links: int = 0  # that it was read over; 0 where nobody says
    chain: str = ""  # name of the chain, of several in rotation

    @property
    def measured(self) -> bool:
        """Whether there is a value, not only a side of a mark."""
        return self.low == self.high

    @property
    def mark(self) -> float:
        """The value, or the mark of the gauge [%]."""
        return self.low if math.isfinite(self.low) else self.high

    @property
    def result(self) -> str:
        """What a gauge says: go or no-go; empty where it was measured."""
        if self.measured:
            return ""
        return GO if self.high == self.mark else NO_GO


def elongation_over(length: float, links: int, pitch: float) -> float:
    """Return the elongation of a chain from its length, pin to pin over a number of links [%].

    Examples
    --------
    100 links of 12.7 mm are 1270 mm long when new:

    >>> round(elongation_over(1276.35, 100, 12.7), 9)
    0.5
    """
    return 100.0 * (length / (links * pitch) - 1.0)


def chain_cells(quantity: str) -> Rules:
    """Return what the cells of a quantity must be, by their columns."""
    empty = (lambda text: text == "", f"must be empty for {quantity}")
    value = {
        LENGTH: (lambda text: 0.0 < number(text) <= 1e6, "must be a length in mm, above 0 and at most 1e6"),
        GAUGE: (
            lambda text: 0.0 < number(text) <= _MOST_PERCENT,
            f"must be the mark of the gauge, above 0 and at most {_MOST_PERCENT:g} %",
        ),
        ELONGATION: (
            lambda text: abs(number(text)) <= _MOST_PERCENT,
            f"must be a number of at most {_MOST_PERCENT:g}",
        ),
    }
    links = (_is_count, "must be the number of links from pin to pin, a whole number")
    perhaps = (lambda text: text == "" or _is_count(text), f"{links[1]}, or empty")
    result = (
        lambda text: text in (GO, NO_GO),
        f"must be {GO} (the gauge does not fall in) or {NO_GO} (it falls in)",
    )
    return {
        "value": value.get(quantity, empty),
        "links": {LENGTH: links, ELONGATION: perhaps}.get(quantity, empty),
        "result": result if quantity == GAUGE else empty,
    }


def _is_count(text: str) -> bool:
    return 0.0 < number(text) <= 1e5 and number(text) % 1.0 == 0.0


def odd_error(elongation: float, links: int) -> float:
    """Return the standard deviation of an elongation because of an odd number of links [%].

    Only outer links grow by joint wear, twice as much as the mean. An odd number of links holds one more or
    one fewer of them than inner ones: the reading is 1/links too high or too low.

    Examples
    --------
    >>> odd_error(0.5, 5), odd_error(0.5, 6)
    (0.1, 0.0)
    """
    return abs(elongation) / links if links % 2 else 0.0


def side_of_mark(line: int, hours: float, mark: float, result: str, error: float) -> ChainReading:
    """Return what a gauge says that fell in (no-go) or did not (go).

    Examples
    --------
    >>> side_of_mark(2, 100.0, 0.75, "no-go", 0.05).high
    inf
    """
    low, high = (-math.inf, mark) if result == GO else (mark, math.inf)
    return ChainReading(line, hours, GAUGE, low, high, error)
