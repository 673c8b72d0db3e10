"""Several whole drives side by side: a table in words, one of numbers, a folder."""

from collections.abc import Sequence
from pathlib import Path

from wearsim.drive.drive_result import DriveLife
from wearsim.drive.maintenance import DrivePlan, drive_plan
from wearsim.files import new_folder
from wearsim.quantities import grouped
from wearsim.report.answer_table import AnswerTable, Column, life_columns
from wearsim.report.drive.drive_words import first_text, ratings_text
from wearsim.result.ends import CHAIN
from wearsim.result.lives import hours


def drives_table(drives: Sequence[DriveLife]) -> AnswerTable[DrivePlan]:
    """Return a row for each drive, as it is compared."""
    return AnswerTable(
        [
            Column("", lambda one: f"{one.drive.name}: {one.drive.title}", "drive"),
            Column("", lambda one: hours(one.found.chain), "chain"),
            Column("", _sprockets, "sprockets"),
            Column("", first_text, "first"),
            Column("", lambda one: ratings_text(one.found), "ratings"),
            Column("", _cost, "cost in 1000 h"),
        ],
        [drive_plan(found) for found in drives],
    )


def _sprockets(plan: DrivePlan) -> str:
    return ", ".join(f"{name} {hours(life)}" for name, life in plan.lives.items() if name != CHAIN)


def _cost(plan: DrivePlan) -> str:
    cost = plan.best.cost
    return "-" if cost is None else f"{'at most ' if plan.best.at_most else ''}{grouped(1000.0 * cost)}"


def parts_table(drives: Sequence[DriveLife]) -> AnswerTable[tuple[DriveLife, str]]:
    """Return a row for every part of every drive."""
    return AnswerTable(
        [
            Column("case", lambda one: one[0].drive.name),
            Column("part", lambda one: one[1]),
            *life_columns("life_hours", lambda one: one[0].parts[one[1]]),
        ],
        [(found, name) for found in drives for name in found.parts],
    )


def save_drives(drives: Sequence[DriveLife], folder: Path, force: bool) -> None:
    """Write the table of the parts, and the comparison with what is doubtful, into a folder."""
    parts = ["# Comparison", drives_table(drives).markdown()]
    for found in drives:
        warnings = "\n".join(f"- warning: {text}" for text in found.warnings) or "No warnings."
        parts += [f"## {found.drive.title}", warnings]
    with new_folder(folder, force) as place:
        parts_table(drives).write(place / "summary.csv")
        (place / "summary.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")
