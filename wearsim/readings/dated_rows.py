"""Rows of a table of readings, and when they were made: running hours, km or days."""

import csv
import io
import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from datetime import date
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from wearsim.errors import CaseError, Fault
from wearsim.files import given_text, temporary_folder
from wearsim.input.csv_tables import header_faults
from wearsim.input.named_files import allow_outside
from wearsim.input.texts import line_fault
from wearsim.quantities import grouped
from wearsim.readings.day_format import iso_days
from wearsim.readings.kept_tables import (
    DATE,
    HOURS,
    KM,
    MILES,
    Line,
    decimal_faults,
    in_units_read,
    number,
    split_lines,
)

if TYPE_CHECKING:
    import pandas as pd


TIMES = (HOURS, KM, DATE)
"""Columns that may tell the time, distance_miles read as km."""

NEW = "new"
"""Row of the time at which a part was new."""

CHAINS, SPROCKETS = "chain", "sprocket"
"""Columns that name the chain of a row, of several in rotation, or the sprocket that a row is of."""

_MOST_HOURS = 1e9

_MOST_ROWS = 1000
"""Of a table: more than any log has, and few enough that every command answers within seconds."""


@dataclass(frozen=True)
class DatedRows:
    """The cells of a table as text."""

    file: str
    time: str  # the one of `TIMES` that is there
    head: int  # line of the names
    rows: tuple[tuple[int, Mapping[str, str]], ...]  # line of each row, and its cells by their columns


@dataclass(frozen=True)
class ServiceTime:
    """What a column of times says in running hours."""

    column: str  # one of `TIMES`
    hours_each: float  # running hours of a km or a day; 1 for hours
    start: date | None  # day on which the part that was measured was new; None where none is known
    # what an odometer or hour meter showed when the part was new [h]; None where no row says it
    zero: float | None = None

    def hours(self, text: str) -> float:
        """Return the running hours of a cell; nan where it holds no time.

        Examples
        --------
        >>> ServiceTime(DATE, 8.0, date(2026, 3, 30)).hours("2026-04-02")
        24.0
        """
        if self.column != DATE:
            return number(text) * self.hours_each - (self.zero or 0.0)
        day = _day(text)
        return math.nan if day is None or self.start is None else (day - self.start).days * self.hours_each

    def fault(self, text: str) -> str:
        """Return what is wrong with a cell; empty where nothing is.

        Examples
        --------
        >>> ServiceTime(HOURS, 1.0, None).fault("-5")
        "must be a number of at least 0 (got '-5')"
        """
        hours = self.hours(text)
        if 0.0 <= hours <= _MOST_HOURS:
            return ""
        when = ""
        if self.column == DATE and self.start is not None and hours < 0.0:
            when = f", not before service.start_date = {self.start}, when it was new"
        return f"must be {self.must} (got {text!r}){when}"

    @property
    def must(self) -> str:
        """What a cell must be."""
        if self.column == DATE:
            return "a day such as 2026-03-31"
        since = f", as in the row {NEW!r}" if self.zero else ""
        return f"a number of at least {(self.zero or 0.0) / self.hours_each:g}{since}"

    def warnings(self, first: float) -> Iterator[str]:
        """Say of how many hours at the first reading a meter is believed that no row begins.

        Examples
        --------
        >>> [text[:69] for text in ServiceTime(KM, 1 / 30, None).warnings(500.0)]
        ["no row 'new' says what distance_km was when the part was new, so that"]
        >>> list(ServiceTime(KM, 1 / 30, None, zero=0.0).warnings(500.0))
        []
        """
        if self.column != DATE and self.zero is None:
            yield (
                f"no row {NEW!r} says what {self.column} was when the part was new, so that it counts from "
                f"0: the part is taken to have run {grouped(first)} h at the first reading. Where the meter "
                f"showed more when it was new, put a row {NEW!r} with that above"
            )


def read_dated_rows(path: Path, required: Sequence[str], optional: Sequence[str]) -> DatedRows:
    """Read the cells of a table with one column of times; lines that begin with ``#`` are left out."""
    lines = _lines(path)
    head, names = lines[0] if lines else (1, [])
    times = [name for name in (*TIMES, MILES) if name in names]
    wrong = header_faults(names, [*times, *required], optional)
    if not times:
        others = f"{KM}, {MILES} or {DATE}"
        wrong.insert(0, f"column {HOURS!r} is missing, or {others} in its place")
    faults = [Fault(text, "", str(path), head) for text in wrong]
    if len(times) > 1:
        text = f"must give the time in one column, but holds {' and '.join(times)}: keep one"
        faults.append(Fault(text, "", str(path), head))
    rows = [(line, cells) for line, cells in lines[1:] if any(cells)]
    faults += [
        Fault(text, "", str(path), line) for line, cells in rows for text in _row_faults(cells, len(names))
    ]
    if faults:
        raise CaseError(faults)
    named = [(line, in_units_read(dict(zip(names, cells, strict=True)))) for line, cells in rows]
    time = KM if times[0] == MILES else times[0]
    return DatedRows(str(path), time, head, tuple(_with_days(named, str(path)) if time == DATE else named))


def _row_faults(cells: Sequence[str], count: int) -> Iterator[str]:
    """Give what is wrong with a row, whatever its columns are."""
    if len(cells) != count:
        yield f"needs {count} values, has {len(cells)}"
    yield from filter(None, map(line_fault, cells))


def _lines(path: Path) -> list[Line]:
    """Return the cells of every line of a file."""
    try:
        text = given_text(path)
        _check_rows(text)
        lines = split_lines(text)
    except (OSError, ValueError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise CaseError([Fault(f"must be a readable CSV file: {reason}", "", str(path))]) from None
    faults = [Fault(wrong, name, str(path), line) for line, name, wrong in decimal_faults(text, lines)]
    if faults:
        raise CaseError(faults)
    return lines


def _check_rows(text: str) -> None:
    """Raise for a table that is too long to be taken apart, let alone to be calculated with."""
    lines = (line for line in io.StringIO(text) if not line.startswith("#") and line.strip("\t\n ,;"))
    rows = sum(1 for _ in lines) - 1
    if rows > _MOST_ROWS:
        raise ValueError(
            f"it has {rows} rows, {_MOST_ROWS} are the most: give one mean for readings of a day"
        )


def _with_days(rows: Sequence[tuple[int, dict[str, str]]], file: str) -> list[tuple[int, dict[str, str]]]:
    """Return rows with their days as year-month-day."""
    days, wrong = iso_days([cells[DATE] for _, cells in rows])
    if wrong:
        named = [(why, *rows[place]) for place, why in sorted(wrong.items())]
        raise CaseError(
            [Fault(f"{why} (got {cells[DATE]!r})", DATE, file, line) for why, line, cells in named]
        )
    return [(line, {**cells, DATE: day}) for (line, cells), day in zip(rows, days, strict=True)]


def service_time(table: DatedRows, inputs: Mapping[str, Any]) -> ServiceTime:
    """Return how the times of a table count, by [service] of the case.

    The time of a first row ``new`` is where it begins. Days count from ``start_date`` without such a
    row, and without it from the first day of the table.
    """
    service: Mapping[str, Any] = inputs.get("service") or {}
    first = table.rows[0][1] if table.rows else {}
    begun = first.get(table.time, "") if first.get("quantity") == NEW else ""
    if table.time != DATE:
        each = 1.0 / _key(table, service, "km_per_hour") if table.time == KM else 1.0
        zero = number(begun) * each
        return ServiceTime(table.time, each, None, zero if 0.0 <= zero <= _MOST_HOURS else None)
    each = _key(table, service, "hours_per_day")
    days = (_day(cells[DATE]) for _, cells in table.rows)
    given = date.fromisoformat(service["start_date"]) if "start_date" in service else None
    earliest = min((day for day in days if day is not None), default=None)
    return ServiceTime(DATE, each, _day(begun) or given or earliest)


def _key(table: DatedRows, service: Mapping[str, Any], key: str) -> float:
    if key not in service:
        text = f"needs service.{key} in the case, or --set service.{key}=VALUE; or give {HOURS}"
        raise CaseError([Fault(text, table.time, table.file, table.head)])
    return float(service[key])


def _day(text: str) -> date | None:
    try:
        day = date.fromisoformat(text)
    except ValueError:
        return None
    return day if day.isoformat() == text else None


_NAME = "readings"
"""What faults call readings that are in no file."""


@contextmanager
def readings_file(
    readings: "str | PathLike[str] | pd.DataFrame | Sequence[Mapping[str, Any]]",
) -> Iterator[Path]:
    """Give the file of readings: theirs, or one of their rows for as long as it is read."""
    if isinstance(readings, str | PathLike):
        yield Path(readings)
        return
    import pandas as pd

    table = readings if isinstance(readings, pd.DataFrame) else pd.DataFrame(list(readings))
    with temporary_folder() as folder:
        file = folder / f"{_NAME}.csv"
        _with_whole_paths(table).to_csv(file, index=False)
        try:
            with allow_outside():
                yield file
        except CaseError as error:
            faults = [replace(one, file=one.file.replace(str(file), _NAME)) for one in error.faults]
            raise CaseError(faults) from None


def _with_whole_paths(table: "pd.DataFrame") -> "pd.DataFrame":
    if "points_file" not in table:
        return table
    files = table["points_file"]
    return table.assign(
        points_file=[str(Path(name).resolve()) if isinstance(name, str) and name else "" for name in files]
    )
