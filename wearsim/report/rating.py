"""How a drive stands to the ratings of the handbooks, as a table and as JSON."""

import textwrap
from collections.abc import Sequence
from typing import Any

from wearsim.case.model import Case
from wearsim.chain.selection import RatingFinding
from wearsim.quantities import grouped

_WIDTH = 100


def rating_json(case: Case) -> dict[str, Any]:
    """Return the ratings of a case as ``wearsim check --json`` prints them."""
    ratings = case.drive.ratings(case)
    if not ratings:
        return {}
    keys = ("name", "value", "limit", "unit", "ok", "source", "note", "load")
    return {
        "rating": [{key: getattr(finding, key) for key in keys} for finding in ratings],
        "notes": case.drive.notes(case),
    }


RATING_HEAD = ["rating", "value", "allowed", "margin", "used", "whose rule"]
"""Heads of the columns of `rating_cells`."""


def rating_cells(ratings: Sequence[RatingFinding]) -> list[list[str]]:
    """Return the ratings of a result in words, those outside marked."""
    rows = []
    for finding in ratings:
        unit = f" {finding.unit}" if finding.unit else ""
        side = "at least" if finding.at_least else "at most"
        state = "" if finding.ok else ", outside"
        rows.append(
            [
                finding.name,
                f"{grouped(finding.value)}{unit}",
                f"{side} {grouped(finding.limit)}{unit}",
                f"{grouped(finding.margin)}{unit}",
                f"{grouped(100.0 * finding.used)} %{state}",
                rule(finding),
            ]
        )
    return rows


def rule(finding: RatingFinding) -> str:
    """Return whose rule a rating is, which load it is about, and why it is only indicative."""
    return "; ".join(text for text in (finding.source, finding.load, finding.note) if text)


def rating_table(case: Case) -> str:
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
