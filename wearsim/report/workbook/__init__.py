"""Results as a workbook of Excel: answer, a sheet for each result, inputs, native charts."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

from wearsim.errors import OutputError
from wearsim.extras import library
from wearsim.files import check_free, write_file
from wearsim.report.workbook.answer_page import write_answer_page
from wearsim.report.workbook.inputs_page import write_inputs_page
from wearsim.report.workbook.native_charts import add_charts
from wearsim.report.workbook.result_page import write_result_page
from wearsim.report.workbook.workbook_writer import WorkbookWriter
from wearsim.report.workbook.worksheet_names import worksheet_names
from wearsim.result import WearResult

_FIRST_CHART_ROW = 1


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
    write_inputs_page(book, inputs, results, names)
    return book.content()


def save_workbook(
    results: Sequence[WearResult], path: Path, force: bool, said: Said = MappingProxyType({})
) -> None:
    """Write results into a workbook, all of it or nothing."""
    check_workbook(path, force)
    write_file(path, workbook(results, said), force)
