"""Results as a workbook of Excel: answer, a sheet for each result, inputs, native charts."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

from wearsim.errors import OutputError
from wearsim.extras import library
from wearsim.files import check_free, write_file
from wearsim.input.input_origins import InputRow, input_rows
from wearsim.report.workbook.answer_page import write_answer_page
from wearsim.report.workbook.native_charts import add_charts
from wearsim.report.workbook.result_page import write_result_page
from wearsim.report.workbook.workbook_writer import HEADER, WorkbookWriter, WorksheetPage, number_format
from wearsim.report.workbook.worksheet_names import worksheet_names
from wearsim.result import WearResult

_FIRST_CHART_ROW = 1
_INPUT_COLUMNS = {
    "case": 20,
    "key": 40,
    "value": 22,
    "unit": 12,
    "origin": 10,
    "why or source": 60,
    "meaning": 60,
}
_UNIT = list(_INPUT_COLUMNS).index("unit")


def check_workbook(path: Path, force: bool) -> None:
    """Raise where a workbook could not be written, before anything is calculated."""
    if path.suffix.lower() != ".xlsx":
        raise OutputError(f"{path}: must end in .xlsx, or no program opens it: give such a name")
    check_free(path, force)
    library("xlsxwriter", "report", "--xlsx")


Said = Mapping[str, Sequence[tuple[str, str]]]
"""Sentences about several results, each with its label, under a title."""


def workbook(results: Sequence[WearResult], said: Said = MappingProxyType({})) -> bytes:
    """Return results as a workbook, with what is said of several of them on the first sheet."""
    title = "; ".join(result.title for result in results)
    book = WorkbookWriter(library("xlsxwriter", "report", "--xlsx"), title)
    first, inputs = "Answer" if len(results) == 1 else "Comparison", "Inputs"
    names = worksheet_names([result.case for result in results], taken=(first, inputs))
    page, free_column = write_answer_page(book, first, results, names, said)
    places = []
    for name, result in zip(names, results, strict=True):
        own, place = write_result_page(book, name, result)
        add_charts(book, own, [place], (_FIRST_CHART_ROW, place.right))
        places.append(place)
    add_charts(book, page, places, (_FIRST_CHART_ROW, free_column))
    _write_inputs(book, inputs, results, names)
    return book.content()


def save_workbook(
    results: Sequence[WearResult], path: Path, force: bool, said: Said = MappingProxyType({})
) -> None:
    """Write results into a workbook, all of it or nothing."""
    check_workbook(path, force)
    write_file(path, workbook(results, said), force)


def _write_inputs(
    book: WorkbookWriter, name: str, results: Sequence[WearResult], labels: Sequence[str]
) -> None:
    """Write the sheet of inputs, a row for every key of every case."""
    page = WorksheetPage(book, name)
    for column, (title, width) in enumerate(_INPUT_COLUMNS.items()):
        page.sheet.set_column(column, column, width)
        page.put(0, column, title, **HEADER)
    page.freeze(1)
    row = 0
    for result, label in zip(results, labels, strict=True):
        for found in input_rows(result.inputs, result.assumptions):
            row += 1
            _write_input(page, row, label, found)
    page.sheet.autofilter(0, 0, row, len(_INPUT_COLUMNS) - 1)


def _write_input(page: WorksheetPage, row: int, label: str, found: InputRow) -> None:
    value = _cell(found.value)
    style: dict[str, Any] = {"valign": "top", "text_wrap": True}
    cells = (label, found.key, value, found.unit, found.origin, found.why, found.meaning)
    for column, cell in enumerate(cells):
        indent = {"align": "left", "indent": 1} if column == _UNIT else {}
        page.put(row, column, cell, num_format=number_format([cell]), **indent, **style)
    texts = zip(cells, _INPUT_COLUMNS.values(), strict=True)
    page.fit_height(row, [(cell, width) for cell, width in texts if isinstance(cell, str)])


def _cell(value: Any) -> Any:
    """Value for a cell; numbers of a list in one text."""
    if isinstance(value, list | tuple):
        return ", ".join(str(entry) for entry in value)
    return value
