"""What is shown of a sweep: a table, JSON, and files in its folder."""

import itertools
import json
import math
from collections.abc import Iterator, Mapping
from functools import partial
from operator import itemgetter
from pathlib import Path
from typing import Any

import pandas as pd

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped
from wearsim.report.answer_table import Column, csv_parts, frame_rows, markdown_lines, plain
from wearsim.report.chain_first import chain_first, is_of_form
from wearsim.report.study_files import save_figures, save_files
from wearsim.runner.run_study import missed_tolerance
from wearsim.runner.shard import life_columns
from wearsim.study.sweep.model import Sweep


def sweep_text(sweep: Sweep, table: pd.DataFrame) -> str:
    """Return a sweep as a Markdown table."""
    return "\n".join(sweep_lines(sweep, table))


def sweep_lines(sweep: Sweep, table: pd.DataFrame) -> Iterator[str]:
    """Give the lines of a sweep as a Markdown table."""
    design = sweep.design
    parts = zip(design.lives, life_columns(design), strict=True)
    columns: list[Column[Any]] = [
        *(Column("", itemgetter(key), key, _shown, missing="None") for key in design.keys),
        Column("", _life, "life, h"),
        Column("", lambda row: "" if row["error"] else row["stop"], "ended by"),
        *(Column("", partial(_part_life, column), f"{name}, h") for name, column in parts),
    ]
    return markdown_lines(columns, frame_rows(table))


def sweep_caution(sweep: Sweep, table: pd.DataFrame) -> str:
    """Return a warning where tooth forms of one sprocket are swept and the chain ends first."""
    if sweep.design.parts or not any(map(is_of_form, sweep.design.keys)):
        return ""
    text = chain_first(table.loc[table["error"] == "", "stop"])
    return text and f"{text}; compare sprocket_life_hours instead"


def sweep_accuracy(table: pd.DataFrame) -> str:
    """Return how many lives are known less exactly than was asked for; empty where none is."""
    text = missed_tolerance(table)
    return text and f"{text}: numerical_error of each is in --json and cases.csv of --out"


def sweep_warning(table: pd.DataFrame) -> str:
    """Return how many cases have warnings, and the first one."""
    warned = [text for text in table["warnings"] if text]
    if not warned:
        return ""
    count = f"{len(warned)} of {len(table)} cases {'has' if len(warned) == 1 else 'have'} warnings"
    return f"{count} (listed by --json and in cases.csv of --out), the first: {warned[0].splitlines()[0]}"


def sweep_json(sweep: Sweep, table: pd.DataFrame) -> Iterator[str]:
    """Give a sweep as JSON, an object for each case."""
    for row in frame_rows(table):
        known = {name: plain(value) for name, value in row.items()}
        inputs = {key: known.pop(key) for key in sweep.design.keys}
        content = ANSWER_HEAD | {"case": sweep.design.name, "inputs": inputs, **known}
        yield json.dumps(content, ensure_ascii=False, allow_nan=False)


def write_sweep(sweep: Sweep, table: pd.DataFrame, folder: Path) -> None:
    """Write the table and the pictures of a sweep into its folder."""
    from wearsim.study.sweep.figure import sweep_figures

    lines = (f"{line}\n" for line in sweep_lines(sweep, table))
    summary = itertools.chain([f"# {sweep.title}\n\n"], lines)
    save_files(folder, {"cases.csv": csv_parts(table), "summary.md": summary})
    save_figures(folder, sweep.title, sweep_figures(sweep, table))


def _life(row: Mapping[Any, Any]) -> str:
    if row["error"]:
        return f"failed: {'; '.join(row['error'].splitlines())}"
    if math.isnan(row["life_hours"]):
        return f"> {grouped(row['hours_run'])} (limit not reached)"
    return grouped(row["life_hours"])


def _part_life(column: str, row: Mapping[Any, Any]) -> str:
    """Return the hours of a part; empty where the case failed, as the row says above."""
    if row["error"]:
        return ""
    return "limit not reached" if math.isnan(row[column]) else grouped(row[column])


def _shown(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
