"""Several whole drives side by side: a table in words, one of numbers, a folder."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from wearsim.drive.drive_result import DriveLife
from wearsim.drive.maintenance import DrivePlan, drive_plan
from wearsim.files import new_folder
from wearsim.quantities import grouped
from wearsim.report.drive.drive_words import first_text, ratings_text
from wearsim.result import life_keys
from wearsim.result.ends import CHAIN
from wearsim.result.lives import hours

if TYPE_CHECKING:
    import pandas as pd

_HEAD = ("drive", "chain", "sprockets", "first", "ratings", "cost in 1000 h")


def drives_text(drives: Sequence[DriveLife]) -> str:
    """Return the comparison as a Markdown table, bounds with their sign."""
    lines = ["| " + " | ".join(_HEAD) + " |", "|" + "---|" * len(_HEAD)]
    lines += [
        "| " + " | ".join(cell.replace("|", "\\|") for cell in _cells(found)) + " |" for found in drives
    ]
    return "\n".join(lines)


def _cells(found: DriveLife) -> list[str]:
    plan = drive_plan(found)
    lives = ", ".join(f"{name} {hours(life)}" for name, life in plan.lives.items() if name != CHAIN)
    title = f"{found.drive.name}: {found.drive.title}"
    return [title, hours(found.chain), lives, first_text(plan), ratings_text(found), _cost(plan)]


def _cost(plan: DrivePlan) -> str:
    cost = plan.best.cost
    return "-" if cost is None else f"{'at most ' if plan.best.at_most else ''}{grouped(1000.0 * cost)}"


def drives_table(drives: Sequence[DriveLife]) -> "pd.DataFrame":
    """Return a row for every part of every drive."""
    import pandas as pd

    rows = [
        {"case": found.drive.name, "part": name, **life_keys("life_hours", life)}
        for found in drives
        for name, life in found.parts.items()
    ]
    return pd.DataFrame(rows)


def save_drives(drives: Sequence[DriveLife], folder: Path, force: bool) -> None:
    """Write the table of the parts, and the comparison with what is doubtful, into a folder."""
    parts = ["# Comparison", drives_text(drives)]
    for found in drives:
        warnings = "\n".join(f"- warning: {text}" for text in found.warnings) or "No warnings."
        parts += [f"## {found.drive.title}", warnings]
    with new_folder(folder, force) as place:
        drives_table(drives).to_csv(place / "summary.csv", index=False)
        (place / "summary.md").write_text("\n\n".join(parts) + "\n", encoding="utf-8")
