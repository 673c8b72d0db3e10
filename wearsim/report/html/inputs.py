"""What a case was given, what it took by default, and where its numbers come from."""

import re
from dataclasses import dataclass
from typing import Any

from wearsim.catalogue.catalogues import catalogue_rows
from wearsim.input.input_origins import InputRow, input_rows
from wearsim.result import WearResult


@dataclass(frozen=True)
class Input:
    """A key of a case."""

    key: str  # with its table
    value: str  # as in the case with every default taken
    unit: str  # as in the case with every default taken
    meaning: str  # what it is
    source: str  # whether the case gives it, or why it was taken by default


def input_table(result: WearResult) -> list[Input]:
    """Return every key of a case with the source of its value."""
    return [
        Input(row.key, _shown(row.value), row.unit, row.meaning, _note(row))
        for row in input_rows(result.inputs, result.assumptions)
    ]


def catalogue_sources(result: WearResult) -> list[tuple[str, str]]:
    """Return where the numbers of the catalogue that a case uses come from."""
    inputs = {row.key: row for row in input_rows(result.inputs, result.assumptions)}
    found = []
    if (chain := inputs.get("chain.designation")) is not None:
        found.append((f"chain {chain.value}", chain.why))
    if (condition := inputs.get("wear.condition")) is not None:
        found.append((f"wear condition '{condition.value}'", condition.why))
    else:
        found.append(("wear coefficient", "given in the case; its band: " + result.band))
    reasons = {_reason(row) for row in inputs.values() if row.origin == "taken"}
    names = {row.value for key, row in inputs.items() if re.fullmatch(r"material\.\w+\.name", key)}
    found += [
        (f"material {row['name']}", row["source"])
        for row in catalogue_rows("materials")
        if row["name"] in reasons | names
    ]
    found += [(f"file {name}", "read by the case, kept with the run") for name in result.input_files]
    return found


def _note(row: InputRow) -> str:
    if row.origin == "taken":
        reason = _reason(row)
        return f"default: {reason}" if reason else "default"
    return "default of the format, or given" if row.origin == "default" else "given"


def _reason(row: InputRow) -> str:
    """Why a value was taken, empty where that it is the default is all there is to say."""
    return row.why.removeprefix("default: ").removesuffix("default").removesuffix(", ")


def _shown(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, list | tuple):
        return ", ".join(_shown(entry) for entry in value)
    return str(value)
