"""The sheet of one result: its history and its last flank, as the CSV files have them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from wearsim.quantities import quantities
from wearsim.report.workbook.workbook_writer import (
    HEADER,
    SECTION,
    WorkbookWriter,
    WorksheetPage,
    number_format,
)
from wearsim.result import WearResult

_FIRST_ROW = 4
_NARROWEST = 11


@dataclass(frozen=True)
class CellRange:
    """Where the columns of a table stand."""

    sheet: str  # name of the sheet
    columns: Mapping[str, int]  # column of each name, from 0
    first: int  # rows of its cells, from 0
    last: int  # rows of its cells, from 0

    def cells(self, name: str, part: tuple[int, int] | None = None) -> list[Any]:
        """Return the cells of a column as a chart takes them."""
        first, last = part or (0, self.last - self.first)
        column = self.columns[name]
        return [self.sheet, self.first + first, column, self.first + last, column]


@dataclass(frozen=True)
class ResultPlaces:
    """Where the tables of a result stand."""

    title: str  # of the result
    history: CellRange  # the tables
    flank: CellRange  # the tables
    # name, first and last row of every gap of the last flank; one without a name where all gaps are
    # alike
    parts: tuple[tuple[str, tuple[int, int]], ...]
    right: int  # first free column


def write_result_page(
    book: WorkbookWriter, name: str, result: WearResult
) -> tuple[WorksheetPage, ResultPlaces]:
    """Write the sheet of a result."""
    page = WorksheetPage(book, name)
    last = last_flank(result)
    history = _write_table(page, 0, "history: the run over time", result.history_columns)
    left = len(history.columns) + 1
    flank = _write_table(page, left, "flank: at the end of the run", last)
    page.put(0, 0, result.title, bold=True, font_size=13)
    right = left + len(flank.columns)
    page.freeze(_FIRST_ROW)
    page.sheet.set_column(left - 1, left - 1, 3)
    page.sheet.print_area(0, 0, max(history.last, flank.last), right - 1)
    return page, ResultPlaces(result.title, history, flank, _gaps(last), right + 1)


def last_flank(result: WearResult) -> dict[str, Any]:
    """Return the columns of the flank at the end of the run."""
    cycles = result.flank_columns["cycles"]
    at_end = cycles == cycles[-1]
    return {name: np.asarray(values)[at_end] for name, values in result.flank_columns.items()}


def _write_table(page: WorksheetPage, left: int, title: str, table: Mapping[str, Any]) -> CellRange:
    """Write columns side by side: what the table is, names, units, numbers."""
    columns: dict[str, int] = {}
    values: Sequence[Any] = ()
    for column, name in enumerate(table, start=left):
        columns[name] = column
        page.sheet.set_column(column, column, max(_NARROWEST, len(name) + 2))
        page.put(1, column, title if column == left else "", **SECTION)
        page.put(2, column, name, **HEADER)
        page.put(3, column, quantities()[name].unit, **HEADER)
        values = np.asarray(table[name]).tolist()
        form = number_format(values)
        for row, value in enumerate(values, start=_FIRST_ROW):
            page.put(row, column, value, num_format=form)
    return CellRange(page.name, columns, _FIRST_ROW, _FIRST_ROW + len(values) - 1)


def _gaps(flank: Mapping[str, Any]) -> tuple[tuple[str, tuple[int, int]], ...]:
    """Rows of the gaps that are told apart."""
    rows = len(flank["cycles"])
    kinds = flank.get("gap_kind", np.ones(rows, dtype=int))
    found = [(int(kind), np.flatnonzero(kinds == kind)) for kind in np.unique(kinds)]
    return tuple(
        (f"gap {kind}" if len(found) > 1 else "", (int(rows[0]), int(rows[-1]))) for kind, rows in found
    )
