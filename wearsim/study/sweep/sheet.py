"""What is shown of a sweep: a table, JSON, and files in its folder."""

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped
from wearsim.report.study_files import plain, save_figures, save_files
from wearsim.runner.shard import life_columns
from wearsim.study.sweep.model import Sweep


def sweep_text(sweep: Sweep, table: pd.DataFrame) -> str:
    """Return a sweep as a Markdown table."""
    parts = sweep.design.parts
    head = [*sweep.design.keys, "life, h", "ended by", *(f"{name}, h" for name in parts)]
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    for row in table.to_dict("records"):
        cells = [_shown(row[key]) for key in sweep.design.keys]
        cells += [_life(row), "" if row["error"] else row["stop"]]
        cells += [_part(row[column]) for column in life_columns(sweep.design)]
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return "\n".join(lines)


def sweep_json(sweep: Sweep, table: pd.DataFrame) -> list[str]:
    """Return a sweep as JSON, an object for each case."""
    lines = []
    for row in table.to_dict("records"):
        known = {name: plain(value) for name, value in row.items()}
        inputs = {key: known.pop(key) for key in sweep.design.keys}
        content = ANSWER_HEAD | {"case": sweep.design.name, "inputs": inputs, **known}
        lines.append(json.dumps(content, ensure_ascii=False, allow_nan=False))
    return lines


def write_sweep(sweep: Sweep, table: pd.DataFrame, folder: Path) -> None:
    """Write the table and the pictures of a sweep into its folder."""
    from wearsim.study.sweep.figure import sweep_figures

    texts = {
        "cases.csv": table.to_csv(index=False),
        "summary.md": f"# {sweep.title}\n\n{sweep_text(sweep, table)}\n",
    }
    save_files(folder, texts)
    save_figures(folder, sweep.title, sweep_figures(sweep, table))


def _life(row: Mapping[Any, Any]) -> str:
    if row["error"]:
        return f"failed: {row['error']}"
    if math.isnan(row["life_hours"]):
        return f"> {grouped(row['hours_run'])} (limit not reached)"
    return grouped(row["life_hours"])


def _part(life: float) -> str:
    return "-" if math.isnan(life) else grouped(life)


def _shown(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
