"""Rows of a table of readings, and when they were made: running hours, km or days."""

import csv
import math
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from datetime import date, timedelta
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from wearsim.errors import CaseError, Fault
from wearsim.input.csv_tables import header_faults
from wearsim.input.units import convert

if TYPE_CHECKING:
    import pandas as pd


HOURS, KM, DATE = "time_hours", "distance_km", "date"
TIMES = (HOURS, KM, DATE)

_MOST_HOURS = 1e9


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

    def hours(self, text: str) -> float:
        """Return the running hours of a cell; nan where it holds no time.

        Examples
        --------
        >>> ServiceTime(DATE, 8.0, date(2026, 3, 30)).hours("2026-04-02")
        24.0
        """
        if self.column != DATE:
            return number(text) * self.hours_each
        day = _day(text)
        return math.nan if day is None or self.start is None else (day - self.start).days * self.hours_each

    def shown(self, hours: float) -> str:
        """Return running hours as the column has them; empty where no calendar goes so far."""
        if self.column != DATE or self.start is None:
            return f"{hours / self.hours_each:g}"
        return day_after(self.start, hours / self.hours_each)

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
        if self.column != DATE:
            when = in_unit(text, "km" if self.column == KM else "h")
        return f"must be {self.must} (got {text!r}){when}"

    @property
    def must(self) -> str:
        """What a cell must be."""
        return "a day such as 2026-03-31" if self.column == DATE else "a number of at least 0"


def day_after(start: date, days: float) -> str:
    """Return the day so many days later; empty where no calendar goes so far.

    Examples
    --------
    >>> day_after(date(2026, 3, 30), 2.9)
    '2026-04-01'
    """
    if not days <= (date.max - start).days:
        return ""
    return (start + timedelta(days=int(days))).isoformat()


def number(text: str) -> float:
    """Read a number; nan for anything else, also what only Python takes for one."""
    try:
        return float(text) if "_" not in text else math.nan
    except ValueError:
        return math.nan


def in_unit(text: str, unit: str) -> str:
    """Return what to write in the place of a number with a unit; empty where a text is none.

    Examples
    --------
    >>> in_unit("1000 miles", "km"), in_unit("far", "km")
    (': write 1609.344, in km', '')
    """
    try:
        return f": write {convert(text, unit):.10g}, in {unit}"
    except ValueError:
        return ""


def read_dated_rows(path: Path, required: Sequence[str], optional: Sequence[str]) -> DatedRows:
    """Read the cells of a table with one column of times; lines that begin with ``#`` are left out."""
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            reader = csv.reader(file)
            lines = [
                (reader.line_num, [cell.strip() for cell in line])
                for line in reader
                if line and not line[0].startswith("#")
            ]
    except (OSError, ValueError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise CaseError([Fault(f"must be a readable CSV file: {reason}", "", str(path))]) from None
    head, names = lines[0] if lines else (1, [])
    if len(names) == 1 and any(mark in names[0] for mark in ";\t"):
        text = "cells must be separated by commas, with points in numbers: export it as such"
        raise CaseError([Fault(text, "", str(path), head)])
    times = [name for name in TIMES if name in names]
    wrong = header_faults(names, [*times, *required], optional)
    if not times:
        others = f"{KM} (1.609344 times the miles) or {DATE}"
        wrong.insert(0, f"column {HOURS!r} is missing, or {others} in its place")
    faults = [Fault(text, "", str(path), head) for text in wrong]
    if len(times) > 1:
        text = f"must tell the time in one column, but holds {' and '.join(times)}: keep one"
        faults.append(Fault(text, "", str(path), head))
    rows = [(line, cells) for line, cells in lines[1:] if any(cells)]
    faults += [
        Fault(f"needs {len(names)} values, has {len(cells)}", "", str(path), line)
        for line, cells in rows
        if len(cells) != len(names)
    ]
    if faults:
        raise CaseError(faults)
    whole = tuple((line, dict(zip(names, cells, strict=True))) for line, cells in rows)
    return DatedRows(str(path), times[0], head, whole)


def service_time(table: DatedRows, inputs: Mapping[str, Any]) -> ServiceTime:
    """Return how the times of a table count, by [service] of the case.

    Days count from ``start_date``, without it from the first day of the table.
    """
    service: Mapping[str, Any] = inputs.get("service") or {}
    if table.time == KM:
        return ServiceTime(KM, 1.0 / _key(table, service, "km_per_hour"), None)
    if table.time == HOURS:
        return ServiceTime(HOURS, 1.0, None)
    each = _key(table, service, "hours_per_day")
    days = (_day(cells[DATE]) for _, cells in table.rows)
    first = min((day for day in days if day is not None), default=None)
    start = date.fromisoformat(service["start_date"]) if "start_date" in service else first
    return ServiceTime(DATE, each, start)


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
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / f"{_NAME}.csv"
        _with_whole_paths(table).to_csv(file, index=False)
        try:
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
