"""How a drive stands to the ratings of the handbooks, as a table and as JSON."""

import textwrap
from collections.abc import Sequence
from typing import Any

from wearsim.case.model import Case
from wearsim.chain.selection import RatingFinding
from wearsim.quantities import grouped
from wearsim.report.table import Column, Table

_WIDTH = 100


def rating_json(case: Case) -> dict[str, Any]:
    """Return the ratings of a case as ``wearsim check --json`` prints them."""
    ratings = case.drive.ratings(case)
    return {"rating": ratings_table(ratings).records(), "notes": case.drive.notes(case)} if ratings else {}


def ratings_table(ratings: Sequence[RatingFinding]) -> Table[RatingFinding]:
    """Return a row for each rating; on the screen those outside are marked."""
    return Table(
        [
            Column("name", lambda one: one.name, "rating"),
            Column("value", lambda one: one.value),
            Column("", lambda one: in_unit(one, one.value), "value"),
            Column("limit", lambda one: one.limit),
            Column("", lambda one: f"{_side(one)} {in_unit(one, one.limit)}", "allowed"),
            Column("unit", lambda one: one.unit),
            Column("ok", lambda one: one.ok),
            Column("", lambda one: in_unit(one, one.margin), "margin"),
            Column("", lambda one: f"{grouped(100.0 * one.used)} %{'' if one.ok else ', outside'}", "used"),
            Column("", rule, "whose rule"),
            Column("source", lambda one: one.source),
            Column("note", lambda one: one.note),
            Column("load", lambda one: one.load),
        ],
        ratings,
    )


def in_unit(finding: RatingFinding, value: float) -> str:
    """Return a value in the unit of a rating."""
    return f"{grouped(value)} {finding.unit}".rstrip()


def _side(finding: RatingFinding) -> str:
    return "at least" if finding.at_least else "at most"


def rule(finding: RatingFinding) -> str:
    """Return whose rule a rating is, which load it is about, and why it is only indicative."""
    return "; ".join(text for text in (finding.source, finding.load, finding.note) if text)


def rating_text(case: Case) -> str:
    """Return the ratings of a case as ``wearsim check`` prints them."""
    found = case.drive.ratings(case)
    if not found:
        return ""
    notes = list(dict.fromkeys(finding.note for finding in found if finding.note))
    lines = [f"  rating   {'':<23} {'value':>7}    {'limit':>7}  unit  state    whose rule"]
    for finding in found:
        sign = ">=" if finding.at_least else "<="
        state = "ok" if finding.ok else "OUTSIDE"
        lead = (
            f"  rating   {finding.name:<23} {grouped(finding.value):>7} {sign} "
            f"{grouped(finding.limit):>7}  {finding.unit:<5} {state:<8} "
        )
        mark = f" [{notes.index(finding.note) + 1}]" if finding.note else ""
        of = f"; {finding.load}" if finding.load else ""
        lines.append(_folded(f"{finding.source}{mark}{of}", lead, " " * len(lead)))
    return "\n".join(
        [
            *lines,
            *(
                _folded(note, f"           [{number}] ", " " * 15)
                for number, note in enumerate(notes, start=1)
            ),
        ]
    )


def notes_text(case: Case) -> str:
    """Return the notes on a drive as ``wearsim check`` prints them."""
    return "\n".join(_folded(text, "  drive    ", " " * 11) for text in case.drive.notes(case))


def _folded(text: str, first: str, other: str) -> str:
    return textwrap.fill(text, _WIDTH, initial_indent=first, subsequent_indent=other, break_on_hyphens=False)
