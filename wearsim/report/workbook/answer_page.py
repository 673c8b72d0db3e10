"""The first sheet: the answer of every result side by side, its limits, warnings, assumptions."""

from collections.abc import Mapping, Sequence
from typing import Any

from wearsim.chain.rating_findings import RatingFinding, deciding
from wearsim.quantities import quantities
from wearsim.report.answer import (
    JUMPING,
    governing_text,
    limit_name,
    limit_state,
    overload_text,
    service_text,
)
from wearsim.report.comparison import comparison_table, differing_limits
from wearsim.report.rating import rule, verdict
from wearsim.report.workbook.workbook_writer import (
    HEADER,
    SECTION,
    WorkbookWriter,
    WorksheetPage,
    number_format,
)
from wearsim.result import Life, WearResult
from wearsim.result.lives import hours

_NOT_SHOWN = (
    "schema_version",
    "title",
    "limits",
    "overloaded",
    "ratings",
    "ends",
    "practice",
    "assumptions",
    "warnings",
)
_LABEL, _UNIT, _VALUE, _MEANING = 32, 12, 24, 60
_FIRST_VALUE = 2
_BOLD = ("life", "overloaded", "life_hours")
_AT_LEAST = "_at_least"
_MEANINGS = {
    "life": (
        "life in words; on a wrap that of chain or sprocket, whichever ends first; > if neither has ended"
    ),
    "governs": "which of wear and contact fatigue ends the life first, with the life of each",
    "in service": "life in the measures of the machine in service",
    "case": "name of the case file without .toml; of a whole drive that of the sprocket",
    "cycles": "loading cycles of one gap or tooth in this life; empty where no limit was met",
    "max_depth_mm": "depth worn off at the deepest point at the end of the run",
    **{
        f"{name}{end}": f"{text}{note}"
        for name, text in {
            "km": "distance that the machine covers in this life, km",
            "tonnes": "mass that the machine moves in this life, t",
            "days": "days of service in this life",
            "date": "day on which this life ends",
        }.items()
        for end, note in (("", ""), (_AT_LEAST, ": at least this, no limit was met"))
    },
}
"""Meanings of rows that are no key of the answer, or mean less here than everywhere."""


def write_answer_page(
    book: WorkbookWriter,
    name: str,
    results: Sequence[WearResult],
    labels: Sequence[str],
    said: Mapping[str, Sequence[tuple[str, str]]],
) -> tuple[WorksheetPage, int]:
    """Write the first sheet: what is said of several results, a row for every quantity, a column for each."""
    page = WorksheetPage(book, name)
    meaning = _FIRST_VALUE + len(results)
    for column, width in enumerate([_LABEL, _UNIT, *[_VALUE] * len(results), _MEANING]):
        page.sheet.set_column(column, column, width)
    titles = ["quantity", "unit", *(result.title for result in results), "meaning"]
    for column, title in enumerate(titles):
        page.put(0, column, title, **HEADER)
    page.fit_height(0, [(title, _VALUE) for title in titles])
    page.freeze(1, _FIRST_VALUE)
    row = 1
    for title, texts in said.items():
        row = _write_texts(page, row, title, texts, meaning)
    if said:
        _write_section(page, row, "each sprocket with the chains that run on it", meaning)
        row += 1
    row = _write_rows(page, row, _answers(results))
    row = _write_limits(page, row, results)
    row = _write_ratings(page, row, results)
    row = _write_texts(page, row, "warnings", _warnings(results, labels), meaning)
    assumptions = _pairs(labels, [result.assumptions for result in results])
    _write_texts(page, row, "assumptions", assumptions, meaning)
    return page, meaning + 2


def _answers(results: Sequence[WearResult]) -> dict[str, list[Any]]:
    """Values of every quantity, one for each result."""
    answers = [_flat(result.summary()) for result in results]
    rows: dict[str, list[Any]] = {"life": [_in_words(result) for result in results]}
    service = [service_text(result.inputs, result.life) for result in results]
    if any(service):
        rows["in service"] = service
    if any(result.fatigue for result in results):
        rows["governs"] = [governing_text(result) if result.fatigue else None for result in results]
    if any(result.overloaded for result in results):
        rows["overloaded"] = [overload_text(result) for result in results]
    for name in dict.fromkeys(name for answer in answers for name in answer):
        values = [answer.get(name) for answer in answers]
        if not name.endswith(_AT_LEAST) or any(value is not None for value in values):
            rows[name] = values
    if len(results) > 1:
        rows["ratio_to_first"] = [row["ratio_to_first"] for row in comparison_table(results).records()]
    return rows


def _flat(answer: Mapping[str, Any]) -> dict[str, Any]:
    shown = {name: value for name, value in answer.items() if name not in _NOT_SHOWN}
    measures = shown.pop("service", {})
    bounds = shown.pop("service_at_least", {})
    return {**shown, **measures, **{f"{name}{_AT_LEAST}": value for name, value in bounds.items()}}


def _in_words(result: WearResult) -> str:
    reached = isinstance(result.life, Life)
    return hours(result.life) if reached else f"{hours(result.life)} (limit not reached)"


def _write_rows(page: WorksheetPage, row: int, rows: Mapping[str, list[Any]]) -> int:
    for name, values in rows.items():
        _write_row(page, row, name, _unit(name), values, _meaning(name))
        row += 1
    return row


def _write_row(
    page: WorksheetPage, row: int, label: str, unit: str, values: Sequence[Any], meaning: str
) -> None:
    style: dict[str, Any] = {"valign": "top", "text_wrap": True}
    page.put(row, 0, label, **style)
    page.put(row, 1, unit, **style)
    for column, value in enumerate(values, start=_FIRST_VALUE):
        form = number_format([value])
        page.put(row, column, value, num_format=form, bold=label in _BOLD, **style)
    page.put(row, _FIRST_VALUE + len(values), meaning, align="left", indent=1, **style)
    texts = [(value, _VALUE) for value in values if isinstance(value, str)]
    page.fit_height(row, [*texts, (meaning, _MEANING)])


def _unit(name: str) -> str:
    if name.removesuffix(_AT_LEAST).endswith("_percent"):
        return "%"
    return quantities()[name].unit if name in quantities() else ""


def _meaning(name: str) -> str:
    if name in _MEANINGS:
        return _MEANINGS[name]
    return quantities()[name].meaning if name in quantities() else ""


def _write_limits(page: WorksheetPage, row: int, results: Sequence[WearResult]) -> int:
    """Write each limit, what its quantity has come to, and what is left between both."""
    _write_section(
        page,
        row,
        "limits, with values and margins at the end of the life or the run",
        _FIRST_VALUE + len(results),
    )
    states = [{state.name: state for state in result.limits} for result in results]
    for name in dict.fromkeys(name for found in states for name in found):
        chosen = [found.get(name) for found in states]
        limits = [state.limit if state else None for state in chosen]
        values = [state.value if state else None for state in chosen]
        margins = [state.left if state else None for state in chosen]
        words, unit = limit_name(name)[0], _unit(name)
        come, left = f"{words}: value at the end", f"{words}: margin to the limit"
        _write_row(page, row + 1, name, unit, limits, f"limit: {_meaning(name)}")
        _write_row(page, row + 2, f"{name}, value", unit, values, come)
        _write_row(page, row + 3, f"{name}, margin", unit, margins, left)
        row += 3
        if name == JUMPING:
            note = [
                limit_state(state, result.inputs) if state else None
                for state, result in zip(chosen, results, strict=True)
            ]
            _write_row(page, row + 1, f"{name}, in words", "", note, "margin against jumping")
            row += 1
    return row + 1


def _write_ratings(page: WorksheetPage, row: int, results: Sequence[WearResult]) -> int:
    """Write what each rule of the handbooks allows, what the drive has, and the margin between both."""
    found = [{finding.name: finding for finding in result.ratings} for result in results]
    names = dict.fromkeys(name for ratings in found for name in ratings)
    if not names:
        return row
    _write_section(page, row, "ratings of the drive", _FIRST_VALUE + len(results))
    for name in names:
        chosen = [ratings.get(name) for ratings in found]
        first = next(finding for finding in chosen if finding)
        rules = dict.fromkeys(rule(finding) for finding in chosen if finding)
        values = [finding.value if finding else None for finding in chosen]
        limits = [finding.limit if finding else None for finding in chosen]
        margins = [finding.margin if finding else None for finding in chosen]
        side = "least" if first.at_least else "most"
        _write_row(page, row + 1, name, first.unit, values, f"{name} by {'; '.join(rules)}")
        judged = [_verdict(finding, result) for finding, result in zip(chosen, results, strict=True)]
        allowed, left = f"{name}: the {side} that the rule allows", f"{name}: margin, below 0 outside"
        _write_row(page, row + 2, f"{name}, allowed", first.unit, limits, allowed)
        _write_row(page, row + 3, f"{name}, margin", first.unit, margins, left)
        _write_row(page, row + 4, f"{name}, verdict", "", judged, f"{name}: {_VERDICT}")
        row += 4
    return row + 1


_VERDICT = "whether the rule is met; a rule for information does not judge this drive"


def _verdict(finding: RatingFinding | None, result: WearResult) -> str | None:
    return None if finding is None else verdict(finding, finding in deciding(result.ratings))


def _write_section(page: WorksheetPage, row: int, title: str, last_column: int) -> None:
    for column in range(last_column + 1):
        page.put(row, column, "" if column else title, **SECTION)


def _warnings(results: Sequence[WearResult], labels: Sequence[str]) -> list[tuple[str, str]]:
    limits = differing_limits(list(results))
    found = [("all", limits)] if limits else []
    return found + _pairs(labels, [result.warnings for result in results])


def _pairs(labels: Sequence[str], texts: Sequence[Sequence[str]]) -> list[tuple[str, str]]:
    """Give each sentence with the name of its result."""
    return [(label, text) for label, found in zip(labels, texts, strict=True) for text in found or ("none",)]


def _write_texts(
    page: WorksheetPage, row: int, title: str, texts: Sequence[tuple[str, str]], last_column: int
) -> int:
    """Write sentences under each other, each beside the case that it belongs to."""
    _write_section(page, row, title, last_column)
    width = _UNIT + _VALUE * (last_column - _FIRST_VALUE) + _MEANING
    for label, text in texts:
        row += 1
        page.put(row, 0, label, valign="top")
        page.paragraph(row, (1, last_column), text, width)
    return row + 1
