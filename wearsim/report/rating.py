"""How a drive stands to the ratings of the handbooks, as a table and as JSON."""

import math
import textwrap
from collections.abc import Sequence
from typing import Any

from wearsim.case.model import Case, WrapDrive
from wearsim.chain.drive_layout import Meetings, polygon_effect
from wearsim.chain.selection import Finding
from wearsim.quantities import grouped
from wearsim.simulation.chain_rating import rated_drive, rating, rules_without_limit

_WIDTH = 100


def rating_json(case: Case) -> dict[str, Any]:
    """Return the ratings of a case as ``wearsim check --json`` prints them."""
    if not isinstance(case.drive, WrapDrive):
        return {}
    keys = ("name", "value", "limit", "unit", "ok", "source", "note", "load")
    return {
        "rating": [{key: getattr(finding, key) for key in keys} for finding in rating(case)],
        "notes": drive_notes(case),
    }


RATING_HEAD = ["rating", "value", "allowed", "margin", "used", "whose rule"]
"""Heads of the columns of `rating_cells`."""


def rating_cells(ratings: Sequence[Finding]) -> list[list[str]]:
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


def rule(finding: Finding) -> str:
    """Return whose rule a rating is, which load it is about, and why it is only indicative."""
    return "; ".join(text for text in (finding.source, finding.load, finding.note) if text)


def rating_table(case: Case) -> str:
    """Return the ratings of a case as ``wearsim check`` prints them."""
    found = rating(case)
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
    """Return `drive_notes` as ``wearsim check`` prints them."""
    return "\n".join(_folded(text, "  drive    ", " " * 11) for text in drive_notes(case))


def drive_notes(case: Case) -> list[str]:
    """Return what a designer asks of a chain drive that no rule limits."""
    drive = case.drive
    if not isinstance(drive, WrapDrive):
        return []
    layout, rated = drive.layout, rated_drive(case, drive, drive.heaviest)
    silent = rules_without_limit(case)
    small = min(layout.teeth_1, layout.teeth_2)
    speed = rated.teeth * rated.pitch * rated.speed / 6e4
    return [
        f"{layout.links} links, centre distance {layout.centre_distance:.2f} mm = "
        f"{layout.centre_distance / layout.pitch:.4f} pitches (taut), wrap "
        f"{math.degrees(layout.wrap_1):.1f} degrees on the driver and "
        f"{math.degrees(layout.wrap_2):.1f} on the driven sprocket",
        f"{rated.power:.4g} kW at {speed:.4g} m/s: pull {rated.pull:.5g} N; small sprocket "
        f"{rated.teeth:g} teeth at {rated.speed:.5g} rpm, ratio "
        f"{max(layout.teeth_1, layout.teeth_2) / small:.4g}",
        f"polygon effect: the speed of the chain varies by {100.0 * polygon_effect(small):.2f} % "
        f"over a tooth of the small sprocket",
        _meetings(case, drive),
        *([f"no limit known, so not judged: {', '.join(silent)}"] if silent else []),
    ]


def _meetings(case: Case, drive: WrapDrive) -> str:
    loaded = drive.gaps // math.gcd(drive.gaps, case.engaged_every)
    meetings = Meetings(loaded, drive.layout.links)
    if meetings.hunts:
        return "every tooth meets every roller: teeth and rollers wear evenly"
    text = (
        f"{loaded} teeth and {drive.layout.links} links have the common divisor {meetings.classes}: "
        f"a tooth meets {meetings.rollers_per_tooth} of the rollers"
    )
    if not (meetings.same_link_kind and drive.joint.alternating):
        return text
    return f"{text}, only inner or only outer links for life: teeth wear unevenly"


def _folded(text: str, first: str, other: str) -> str:
    return textwrap.fill(text, _WIDTH, initial_indent=first, subsequent_indent=other, break_on_hyphens=False)
