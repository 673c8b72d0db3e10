"""How a drive stands to the ratings of the handbooks, as a table and as JSON."""

import textwrap
from collections.abc import Sequence
from typing import Any

from wearsim.case.model import Case
from wearsim.chain.rating_findings import RatingFinding, deciding
from wearsim.quantities import grouped
from wearsim.report.answer_table import AnswerTable, Column

_WIDTH = 100


def rating_json(case: Case) -> dict[str, Any]:
    """Return the ratings of a case as ``wearsim check --json`` prints them."""
    ratings = case.drive.ratings(case)
    return {"rating": ratings_table(ratings).records(), "notes": case.drive.notes(case)} if ratings else {}


def ratings_table(ratings: Sequence[RatingFinding]) -> AnswerTable[RatingFinding]:
    """Return a row for each rating; on the screen those outside are marked."""
    judging = deciding(ratings)
    return AnswerTable(
        [
            Column("name", lambda one: one.name, "rating"),
            Column("", lambda one: verdict(one, one in judging), "verdict", side="<"),
            Column("value", lambda one: one.value),
            Column("", lambda one: _in_unit(one, one.value), "value"),
            Column("limit", lambda one: one.limit),
            Column("", lambda one: f"{_side(one)} {_in_unit(one, one.limit)}", "allowed"),
            Column("unit", lambda one: one.unit),
            Column("ok", lambda one: one.ok),
            Column("", lambda one: _in_unit(one, one.margin), "margin"),
            Column("", lambda one: f"{grouped(100.0 * one.used)} %", "used"),
            Column("", rule, "source"),
            Column("source", lambda one: one.source),
            Column("note", lambda one: one.note),
            Column("load", lambda one: one.load),
        ],
        ratings,
    )


def _in_unit(finding: RatingFinding, value: float) -> str:
    """Return a value in the unit of a rating."""
    return f"{grouped(value)} {finding.unit}".rstrip()


def _side(finding: RatingFinding) -> str:
    return "at least" if finding.at_least else "at most"


def rule(finding: RatingFinding) -> str:
    """Return whose rule a rating is, which load it is about, and why it is only indicative."""
    return "; ".join(text for text in (_whose(finding), finding.note) if text)


def _whose(finding: RatingFinding, mark: str = "") -> str:
    return "; ".join(filter(None, (f"{finding.source}{mark}", finding.load)))


def sheet_ratings(ratings: Sequence[RatingFinding]) -> tuple[AnswerTable[RatingFinding], list[str]]:
    """Return the ratings as the sheet of a drive has them, and the notes that their sources point to."""
    notes = _notes(ratings)
    judging = deciding(ratings)
    columns: list[Column[RatingFinding]] = [
        Column("", lambda one: one.name, "rating", side="<"),
        Column("", lambda one: verdict(one, one in judging), "verdict", side="<"),
        Column("", lambda one: _in_unit(one, one.value), "value"),
        Column("", lambda one: f"{'≥' if one.at_least else '≤'} {_in_unit(one, one.limit)}", "allowed"),
        Column("", lambda one: _in_unit(one, one.margin), "margin"),
        Column("", lambda one: f"{grouped(100.0 * one.used, 3)} %", "used"),
        Column("", lambda one: _whose(one) + _mark(one, notes), "source", side="<"),
    ]
    return AnswerTable(columns, ratings), notes


def verdict(finding: RatingFinding, judges: bool) -> str:
    """Return whether a rating is met, and that it only informs where it does not judge.

    Examples
    --------
    >>> pressure = RatingFinding("joint pressure", 27.0, 22.5, "MPa", "GOST practice")
    >>> verdict(pressure, judges=True), verdict(pressure, judges=False)
    ('outside', 'outside (for information)')
    """
    found = "ok" if finding.ok else "outside"
    return found if judges else f"{found} (for information)"


def rating_text(case: Case) -> str:
    """Return the ratings of a case as ``wearsim check`` prints them."""
    found = case.drive.ratings(case)
    if not found:
        return ""
    notes, judging = _notes(found), deciding(found)
    columns: list[Column[RatingFinding]] = [
        Column("", lambda one: one.name, "", side="<24"),
        Column("", lambda one: one.value, "value", grouped, ">7"),
        Column("", lambda one: ">=" if one.at_least else "<=", "", side="^4"),
        Column("", lambda one: one.limit, "limit", grouped, ">7"),
        Column("", lambda one: f"  {one.unit:<5} ", "  unit", side="<8"),
        Column("", lambda one: _state(one, one in judging), "state", side="<9"),
        Column("", lambda one: _whose(one, _mark(one, notes)), "source", side="<"),
    ]
    lines = AnswerTable(columns, found).lines("  rating   ")
    rules = " " * lines[0].index("source")
    told = [_folded(note, f"           [{number}] ", " " * 15) for number, note in enumerate(notes, start=1)]
    return "\n".join([*(_folded(line, "", rules) for line in lines), *told])


def _state(finding: RatingFinding, judges: bool) -> str:
    """Return the verdict as the screen has it, of a rule that only informs that it does."""
    return "ok" if finding.ok else "OUTSIDE" if judges else "informs"


def _notes(ratings: Sequence[RatingFinding]) -> list[str]:
    return list(dict.fromkeys(finding.note for finding in ratings if finding.note))


def _mark(finding: RatingFinding, notes: Sequence[str]) -> str:
    """Return what points to the note of a rating."""
    return f" [{notes.index(finding.note) + 1}]" if finding.note else ""


def notes_text(case: Case) -> str:
    """Return the notes on a drive as ``wearsim check`` prints them."""
    return "\n".join(_folded(text, "  drive    ", " " * 11) for text in case.drive.notes(case))


def _folded(text: str, first: str, other: str) -> str:
    return textwrap.fill(text, _WIDTH, initial_indent=first, subsequent_indent=other, break_on_hyphens=False)
