"""The last sheet: every input, given or taken, and where it comes from."""

from collections.abc import Sequence
from typing import Any

from wearsim.case.input_origins import InputRow, input_rows
from wearsim.report.workbook.workbook_writer import HEADER, WorkbookWriter, WorksheetPage, number_format
from wearsim.result import WearResult

_COLUMNS = {"case": 20, "key": 40, "value": 22, "unit": 12, "origin": 10, "why or source": 60, "meaning": 60}
_UNIT = list(_COLUMNS).index("unit")


def write_inputs_page(
    book: WorkbookWriter, name: str, results: Sequence[WearResult], labels: Sequence[str]
) -> None:
    """Write the sheet of inputs, a row for every key of every case."""
    page = WorksheetPage(book, name)
    for column, (title, width) in enumerate(_COLUMNS.items()):
        page.sheet.set_column(column, column, width)
        page.put(0, column, title, **HEADER)
    page.freeze(1)
    row = 0
    for result, label in zip(results, labels, strict=True):
        for found in input_rows(result.inputs, result.assumptions):
            row += 1
            _write_row(page, row, label, found)
    page.sheet.autofilter(0, 0, row, len(_COLUMNS) - 1)


def _write_row(page: WorksheetPage, row: int, label: str, found: InputRow) -> None:
    value = _cell(found.value)
    style: dict[str, Any] = {"valign": "top", "text_wrap": True}
    cells = (label, found.key, value, found.unit, found.origin, found.why, found.meaning)
    for column, cell in enumerate(cells):
        indent = {"align": "left", "indent": 1} if column == _UNIT else {}
        page.put(row, column, cell, num_format=number_format([cell]), **indent, **style)
    texts = zip(cells, _COLUMNS.values(), strict=True)
    page.fit_height(row, [(cell, width) for cell, width in texts if isinstance(cell, str)])


def _cell(value: Any) -> Any:
    """Value for a cell; numbers of a list in one text."""
    if isinstance(value, list | tuple):
        return ", ".join(str(entry) for entry in value)
    return value
