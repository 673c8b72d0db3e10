"""Dated readings of a chain as people have them: lengths, percent, gauges that fall in or not."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from wearsim.errors import CaseError, Fault
from wearsim.readings.dated_rows import NEW, DatedRows, ServiceTime, read_dated_rows, service_time
from wearsim.readings.kept_tables import DATE, number
from wearsim.readings.relubrications import (
    EVENTS,
    RELUBRICATION,
    RelubricationLog,
    event_faults,
    relubrication_log,
)

LENGTH, ELONGATION, GAUGE = "chain_length_mm", "elongation_percent", "gauge_percent"
READINGS = (LENGTH, ELONGATION, GAUGE)
_WORDS = (NEW, *READINGS, RELUBRICATION)
GO, NO_GO = "go", "no-go"

_SPROCKET = "sprocket"
"""Column that names the sprocket of a row, empty where it is of the chain."""

_OF_TEETH = ("max_depth_mm", "depth_mm", "over_pins_mm", "profile")

_MOST_PERCENT = 10.0
_BELOW_NEW = 3.0
"""Errors by which a reading may lie below 0."""

_FROM_NOMINAL = 1.0
"""Percent by which a new chain may differ from its pitch; ISO 606 allows 0.15 % under its measuring load."""

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


@dataclass(frozen=True)
class NewLength:
    """The length of the new chain, from which elongations count."""

    pitch: float  # mean of its links [mm]
    nominal: float  # pitch of the case [mm]
    error: float = 0.0  # standard deviation of a pitch that was measured, nan if not stated [%]

    @property
    def measured(self) -> bool:
        """Whether it was read, not taken from the case."""
        return self.error != 0.0

    @property
    def longer(self) -> float:
        """How much longer than its pitch the new chain was [%]."""
        return 100.0 * (self.pitch / self.nominal - 1.0)

    def error_with(self, error: float) -> float:
        """Return the error of an elongation over it; a length of the new chain without one has the same."""
        if not self.measured:
            return error
        return math.hypot(error, error if math.isnan(self.error) else self.error)


@dataclass(frozen=True)
class ChainLog:
    """What was read and done since a chain was new."""

    file: str
    time: ServiceTime
    new: NewLength
    readings: tuple[ChainReading, ...]
    relubrications: RelubricationLog
    sprockets: Mapping[str, float]  # when sprockets that rows name were new, by the hours of the chain [h]

    @property
    def odd_links(self) -> bool:
        """Whether some readings are over an odd number of links."""
        return any(one.links % 2 for one in self.readings)


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


def new_length(table: DatedRows, pitch: float) -> NewLength:
    """Return the length of the new chain by a first row ``new``, without it that of the pitch.

    Raises
    ------
    CaseError
        What is wrong with that row.
    """
    line, cells = table.rows[0] if table.rows else (0, {})
    given = {name: cells.get(name, "") for name in ("value", "links", "error")}
    if cells.get("quantity") != NEW or not any(given.values()):
        return NewLength(pitch, pitch)
    rules = {
        **{name: rule for name, rule in chain_cells(LENGTH).items() if name != "result"},
        "error": (lambda text: text == "" or 0.0 < number(text) <= 1e6, "must be a number above 0, or empty"),
    }
    faults = [
        Fault(f"{must} (got {given[name]!r})", name, table.file, line)
        for name, (holds, must) in rules.items()
        if not holds(given[name])
    ]
    if faults:
        raise CaseError(faults)
    length, links = number(given["value"]), int(number(given["links"]))
    found = NewLength(length / links, pitch, 100.0 * number(given["error"]) / length)
    if abs(found.longer) > _FROM_NOMINAL:
        text = (
            f"{length:g} mm over {links} new links differ by {found.longer:.3g} % from a pitch of {pitch:g} "
            f"mm, must be {_FROM_NOMINAL:g} % at most: check value, links and chain.pitch_mm"
        )
        raise CaseError([Fault(text, "value", table.file, line)])
    return found


def read_chain_log(path: Path, inputs: Mapping[str, Any], pitch: float, usual_error: float) -> ChainLog:
    """Read a table of readings and relubrications of one chain.

    Parameters
    ----------
    path : Path
        CSV file.
    inputs : mapping
        Of the case, whose [service] turns km and days into hours.
    pitch : float
        Of the new chain [mm].
    usual_error : float
        Standard deviation of a reading that states none [%].

    Raises
    ------
    CaseError
        What is wrong with the table, every cell of it in one pass.
    """
    whole = read_dated_rows(path, ("quantity",), ("value", "error", "links", "result", _SPROCKET))
    of_sprockets = [row for row in whole.rows if row[1].get(_SPROCKET)]
    table = replace(whole, rows=tuple(row for row in whole.rows if not row[1].get(_SPROCKET)))
    time = service_time(table, inputs)
    faults = [*_bad_cells(table, time), *event_faults(table, time), *_backwards(table, time)]
    faults += _bad_sprockets(of_sprockets, table, time)
    if faults:
        raise CaseError(sorted(faults, key=lambda fault: fault.line))
    rows = [(line, time.hours(cells[table.time]), cells) for line, cells in table.rows]
    new = new_length(table, pitch)
    readings = tuple(
        _reading(line, hours, cells, new, usual_error)
        for line, hours, cells in rows
        if cells["quantity"] in READINGS
    )
    if not readings:
        text = f"must hold at least one reading of the chain: {', '.join(READINGS)}"
        raise CaseError([Fault(text, "quantity", table.file)])
    log = ChainLog(
        file=table.file,
        time=time,
        new=new,
        readings=readings,
        relubrications=relubrication_log(table, time),
        sprockets={cells[_SPROCKET]: time.hours(cells[table.time]) for _, cells in of_sprockets},
    )
    _check_times(log)
    return log


def _bad_cells(table: DatedRows, time: ServiceTime) -> Iterator[Fault]:
    """Give every cell that cannot be in a row that is a reading."""
    rules: Rules = {
        "quantity": (lambda text: text in _WORDS, f"must be one of {', '.join(_WORDS)}"),
        "error": (
            lambda text: text == "" or 0.0 < number(text) <= 1e6,
            "must be a number above 0, the standard deviation of the value in its unit, or empty",
        ),
    }
    for line, cells in table.rows:
        quantity = cells["quantity"]
        if quantity in EVENTS:
            continue
        wrong = time.fault(cells[table.time])
        if wrong:
            yield Fault(wrong, table.time, table.file, line)
        more = chain_cells(quantity) if quantity in READINGS else {}
        for name, (holds, must) in {**rules, **more}.items():
            text = cells.get(name, "")
            if not holds(text):
                hint = ": wearsim calibrate takes readings of the teeth" if text in _OF_TEETH else ""
                yield Fault(f"{must} (got {text!r}){hint}", name, table.file, line)


def _bad_sprockets(
    rows: Sequence[tuple[int, Mapping[str, str]]], table: DatedRows, time: ServiceTime
) -> Iterator[Fault]:
    """Give what is wrong in rows that say when a sprocket was new."""
    for line, cells in rows:
        if cells["quantity"] != NEW:
            text = f"must be {NEW} where a sprocket is named, as readings are of the chain"
            yield Fault(text, "quantity", table.file, line)
        if not math.isfinite(time.hours(cells[table.time])):
            yield Fault(f"must be {time.must} (got {cells[table.time]!r})", table.time, table.file, line)


def _backwards(table: DatedRows, time: ServiceTime) -> Iterator[Fault]:
    """Give every row that comes before the one above it."""
    last, above = 0.0, ""
    for line, cells in table.rows:
        text = cells[table.time]
        hours = time.hours(text)
        if hours < last:
            message = f"must not go backwards: {text} comes after {above}; sort the rows, one chain a file"
            yield Fault(message, table.time, table.file, line)
        last, above = (hours, text) if hours >= last else (last, above)


def _reading(
    line: int, hours: float, cells: Mapping[str, str], new: NewLength, usual_error: float
) -> ChainReading:
    quantity, value = cells["quantity"], number(cells["value"])
    error = number(cells.get("error", ""))
    if quantity == GAUGE:
        return side_of_mark(line, hours, value, cells["result"], usual_error if math.isnan(error) else error)
    links = int(number(cells["links"])) if cells.get("links") else 0
    if quantity == LENGTH:
        value = elongation_over(value, links, new.pitch)
        error *= 100.0 / (links * new.pitch)
    error = usual_error if math.isnan(error) else error
    if quantity == LENGTH:
        error = new.error_with(error)
    error = math.hypot(error, odd_error(value, links))
    return ChainReading(line, hours, quantity, value, value, error, links)


def side_of_mark(line: int, hours: float, mark: float, result: str, error: float) -> ChainReading:
    """Return what a gauge says that fell in (no-go) or did not (go).

    Examples
    --------
    >>> side_of_mark(2, 100.0, 0.75, "no-go", 0.05).high
    inf
    """
    low, high = (-math.inf, mark) if result == GO else (mark, math.inf)
    return ChainReading(line, hours, GAUGE, low, high, error)


def _check_times(log: ChainLog) -> None:
    """Raise for readings of a new chain, and for those of a chain shorter than new."""
    faults = []
    for one in log.readings:
        if not one.hours > 0.0:
            text = f"must be later than 0, when the chain was new: give that time in a first row {NEW!r}" + (
                " or as service.start_date" if log.time.column == DATE else ""
            )
            faults.append(Fault(text, log.time.column, log.file, one.line))
        if one.measured and one.low < -_BELOW_NEW * one.error:
            text = (
                f"must not be more than {_BELOW_NEW:g} errors shorter than new, is {one.low:.3g} % with an "
                f"error of {one.error:.2g} %: check value, links and chain.pitch_mm"
            )
            faults.append(Fault(text, "value", log.file, one.line))
    if faults:
        raise CaseError(faults)
