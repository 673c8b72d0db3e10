"""A workbook while it is written: its pages, its styles, and what may stand in a cell."""

import io
import math
from collections.abc import Iterable
from datetime import UTC, datetime
from typing import Any

from wearsim._version import __version__
from wearsim.report.workbook.worksheet_names import without_forbidden

_LONGEST_TEXT = 32767
_LANDSCAPE_A4 = 9
_CHARACTERS_PER_LINE = 1.15
"""Characters of usual text that go into the width of one column unit."""

_LINE_POINTS = 15.0
_MAX_LINES = 27
"""Excel takes no row higher than 409 points."""


def number_format(values: Iterable[Any]) -> str:
    """Return the format of Excel that shows the numbers of a column with five digits.

    Examples
    --------
    >>> number_format([0.0, 2712.99]), number_format([0.2]), number_format([1, 2, 3])
    ('#,##0.0', '0.00000', '#,##0')
    >>> number_format([5e-11])
    '0.0000E+00'
    """
    numbers = [abs(value) for value in values if _is_number(value) and math.isfinite(value)]
    largest = max(numbers, default=0.0)
    if not numbers:
        return "General"
    if largest != 0.0 and not 1e-3 <= largest < 1e7:
        return "0.0000E+00"
    if all(float(value).is_integer() for value in numbers):
        return "#,##0"
    decimals = max(0, 4 - math.floor(math.log10(largest)))
    whole = "#,##0" if largest >= 1000.0 else "0"
    return f"{whole}.{'0' * decimals}" if decimals else whole


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


class WorksheetPage:
    """A sheet."""

    def __init__(self, book: "WorkbookWriter", name: str) -> None:
        self.book = book
        self.name = name
        self.sheet = book.file.add_worksheet(name)
        self.sheet.set_landscape()
        self.sheet.set_paper(_LANDSCAPE_A4)
        self.sheet.fit_to_pages(1, 0)
        self.sheet.set_footer("&L&F: &A&RPage &P of &N")

    def put(self, row: int, column: int, value: Any, **style: Any) -> None:
        """Write a cell: a number as a number, a text as a text whatever it looks like."""
        form = self.book.style(**style)
        if value is None or value != value or value == "":
            self.sheet.write_blank(row, column, None, form)
        elif isinstance(value, bool):
            # LibreOffice shows a truth value as 1 in any other format.
            form = self.book.style(**{**style, "num_format": '"TRUE";"TRUE";"FALSE"'})
            self.sheet.write_boolean(row, column, value, form)
        elif _is_number(value) and math.isfinite(value):
            self.sheet.write_number(row, column, value, form)
        else:
            text = without_forbidden(str(value))
            shown = text if len(text) <= _LONGEST_TEXT else f"{text[: _LONGEST_TEXT - 3]}..."
            self.sheet.write_string(row, column, shown, form)

    def paragraph(self, row: int, columns: tuple[int, int], text: str, width: float) -> None:
        """Write a text over several columns, the row as high as it needs."""
        form = self.book.style(text_wrap=True, valign="top")
        self.sheet.merge_range(row, columns[0], row, columns[1], "", form)
        self.put(row, columns[0], text, text_wrap=True, valign="top")
        self.fit_height(row, [(text, width)])

    def fit_height(self, row: int, texts: Iterable[tuple[str, float]]) -> None:
        """Make a row as high as the texts in it need when they are folded."""
        lines = [math.ceil(len(text) / (_CHARACTERS_PER_LINE * width)) for text, width in texts]
        self.sheet.set_row(row, _LINE_POINTS * min(max([1, *lines]), _MAX_LINES))

    def freeze(self, rows: int, columns: int = 0) -> None:
        """Keep the header in sight, on the screen and on every printed page."""
        self.sheet.freeze_panes(rows, columns)
        self.sheet.repeat_rows(0, rows - 1)


class WorkbookWriter:
    """A workbook in memory."""

    def __init__(self, library: Any, title: str) -> None:
        self._memory = io.BytesIO()
        options = {"in_memory": True, "strings_to_formulas": False, "strings_to_urls": False}
        self.file = library.Workbook(self._memory, options)
        self.file.set_properties(
            {
                "title": without_forbidden(title)[:255],
                "subject": "Life by wear",
                "author": f"wearsim {__version__}",
                "comments": "Inputs and assumptions are on their own sheet.",
                "created": datetime.now(UTC).replace(tzinfo=None),
            }
        )
        self._styles: dict[tuple[tuple[str, Any], ...], Any] = {}

    def style(self, **properties: Any) -> Any:
        """Return a format of cells, the same object for the same properties."""
        key = tuple(sorted(properties.items()))
        if key not in self._styles:
            self._styles[key] = self.file.add_format(properties)
        return self._styles[key]

    def content(self) -> bytes:
        """Close the workbook."""
        self.file.close()
        return self._memory.getvalue()


HEADER: dict[str, Any] = {
    "bold": True,
    "bg_color": "#DCE6F1",
    "bottom": 1,
    "text_wrap": True,
    "valign": "top",
}
"""Style of the cells that stay in sight."""

SECTION: dict[str, Any] = {"bold": True, "bg_color": "#F2F2F2"}
"""Style of the line above a part of a sheet."""
