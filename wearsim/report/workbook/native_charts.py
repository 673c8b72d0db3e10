"""Charts that Excel draws itself, so that they follow the cells."""

from collections.abc import Sequence
from typing import Any

from wearsim.report.workbook.result_page import CellRange, ResultPlaces
from wearsim.report.workbook.workbook_writer import WorkbookWriter, WorksheetPage
from wearsim.report.workbook.worksheet_names import without_forbidden

_SIZE = {"width": 620, "height": 340}
_LONGEST_NAME, _HEAD, _TAIL = 60, 30, 25

_STEP = 360
"""Pixels from the top of a chart to that of the next."""


def add_charts(
    book: WorkbookWriter, page: WorksheetPage, places: Sequence[ResultPlaces], at: tuple[int, int]
) -> None:
    """Put the charts of results under each other."""
    for number, chart in enumerate(_charts(book, places)):
        page.sheet.insert_chart(*at, chart, {"object_position": 2, "y_offset": number * _STEP})


def _charts(book: WorkbookWriter, places: Sequence[ResultPlaces]) -> list[Any]:
    found = [
        _chart(
            book,
            ("Depth of the deepest point", "running time, h", "depth, mm"),
            [_line(one, one.history, "time_hours", "max_depth_mm") for one in places],
        ),
        _chart(
            book,
            ("Depth along the flank at the end of the run", "length along the unworn flank, mm", "depth, mm"),
            [line for one in places for line in _along_flank(one)],
        ),
    ]
    longer = [one for one in places if "elongation_percent" in one.history.columns]
    if longer:
        titles = ("Elongation of the chain in use", "running time, h", "elongation, %")
        lines = [_line(one, one.history, "time_hours", "elongation_percent") for one in longer]
        found.append(_chart(book, titles, lines))
    return found


def _along_flank(one: ResultPlaces) -> list[dict[str, Any]]:
    """Depth of every gap told apart, and of the wheel of a pair of gears."""
    depths = {"depth_mm": "", "wheel_depth_mm": "wheel"}
    return [
        _line(one, one.flank, "arc_length_mm", depth, ", ".join(filter(None, (body, gap))), rows)
        for depth, body in depths.items()
        if depth in one.flank.columns
        for gap, rows in one.parts
    ]


def _line(
    one: ResultPlaces, place: CellRange, x: str, y: str, part: str = "", rows: tuple[int, int] | None = None
) -> dict[str, Any]:
    return {
        "name": _legend(one.title, part),
        "categories": place.cells(x, rows),
        "values": place.cells(y, rows),
        "line": {"width": 1.75},
    }


def _legend(title: str, part: str) -> str:
    """Name of a line; XlsxWriter takes ``Sheet!A1`` for a reference, but not ``Sheet! A1``."""
    text = without_forbidden(title).replace("!", "! ")
    short = text if len(text) <= _LONGEST_NAME else f"{text[:_HEAD]} ... {text[-_TAIL:]}"
    return f"{short}, {part}" if part else short


def _chart(book: WorkbookWriter, titles: tuple[str, str, str], lines: list[dict[str, Any]]) -> Any:
    title, x, y = titles
    chart = book.file.add_chart({"type": "scatter", "subtype": "straight"})
    for line in lines:
        chart.add_series(line)
    grid = {"visible": True, "line": {"color": "#D9D9D9", "width": 0.75}}
    plain = {"bold": False, "size": 10}
    chart.set_title({"name": title, "name_font": {"size": 12}})
    chart.set_x_axis({"name": x, "name_font": plain, "min": 0, "major_gridlines": grid})
    chart.set_y_axis({"name": y, "name_font": plain, "min": 0, "major_gridlines": grid})
    chart.set_legend({"position": "bottom"})
    chart.set_size(_SIZE)
    return chart
