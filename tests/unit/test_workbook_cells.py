"""Names of sheets, formats of numbers and what a cell takes."""

import io
import math

import openpyxl
import pytest
import xlsxwriter
from hypothesis import given, settings
from hypothesis import strategies as st

from wearsim.report.workbook.workbook_writer import WorkbookWriter, WorksheetPage, number_format
from wearsim.report.workbook.worksheet_names import without_forbidden, worksheet_names


@pytest.mark.slow
@settings(max_examples=100, deadline=None)
@given(st.lists(st.text(max_size=40), min_size=1, max_size=8))
def test_any_names_make_sheets(names):
    """XlsxWriter itself refuses what Excel does not take."""
    found = worksheet_names(names, taken=["Answer", "Inputs"])
    book = xlsxwriter.Workbook(io.BytesIO(), {"in_memory": True})
    for name in ("Answer", *found, "Inputs"):
        book.add_worksheet(name)
        assert 1 <= len(name.encode("utf-16-le")) // 2 <= 31
    book.close()
    assert "history" not in [name.casefold() for name in found]


def test_many_equal_long_names():
    found = worksheet_names(["x" * 35] * 12)
    assert found[0] == "x" * 31
    assert found[11] == f"{'x' * 26} (12)"
    assert len(set(found)) == 12


def test_name_is_not_cut_within_a_character():
    assert worksheet_names(["a" * 30 + "\U0001f600"]) == ["a" * 30]


@pytest.mark.parametrize("text", ["\x00", "\x1f", "\ud800", "\uffff", "\x0b"])
def test_clean_replaces_what_xml_cannot_hold(text):
    assert without_forbidden(f"a{text}b") == "a\ufffdb"


def test_clean_keeps_the_rest():
    assert without_forbidden("ä\t\nПР \U0001f600") == "ä\t\nПР \U0001f600"


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ([0.0, 0.2], "0.00000"),
        ([math.nan, 994.77], "0.00"),
        ([12345.6], "#,##0"),
        ([1.6e7 + 0.5], "0.0000E+00"),
        ([-3e-5], "0.0000E+00"),
        ([0, 5000], "#,##0"),
        ([], "General"),
        (["a", None, True, math.inf], "General"),
    ],
)
def test_number_format(values, expected):
    assert number_format(values) == expected


def test_cells():
    book = WorkbookWriter(xlsxwriter, "t")
    page = WorksheetPage(book, "s")
    values = [1.5, 3, None, math.nan, math.inf, -math.inf, True, "=1", "", "x" * 40000]
    for row, value in enumerate(values):
        page.put(row, 0, value)
    sheet = openpyxl.load_workbook(io.BytesIO(book.content()))["s"]
    found = [sheet.cell(row + 1, 1) for row in range(len(values))]
    shown = [cell.value for cell in found]
    assert shown[:9] == [1.5, 3, None, None, "inf", "-inf", True, "=1", None]
    assert [cell.data_type for cell in found[4:8]] == ["s", "s", "b", "s"]
    assert len(shown[9]) == 32767 and shown[9].endswith("...")
