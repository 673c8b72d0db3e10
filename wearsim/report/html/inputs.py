"""What a case was given, what it took by default, and where its numbers come from."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import BaseModel

from wearsim.case.schema import CaseTables
from wearsim.case.schema.gear import GearTables
from wearsim.catalogue.tables import chain_name, chains, rows, wear_conditions
from wearsim.quantities import quantities
from wearsim.result import WearResult

_TAKEN = re.compile(r"([a-z_]+(?:\.[a-zA-Z_]+)+) = .*?(?: \((.*)\))?$")


@dataclass(frozen=True)
class Input:
    """A key of a case.

    Attributes
    ----------
    key : str
        With its table.
    value, unit : str
        As in the case with every default taken.
    meaning : str
        What it is.
    source : str
        Whether the case gives it, or why it was taken by default.
    """

    key: str
    value: str
    unit: str
    meaning: str
    source: str


def input_table(result: WearResult) -> list[Input]:
    """Return every key of a case with the source of its value.

    Parameters
    ----------
    result : WearResult
        The result.

    Returns
    -------
    list of Input
        In the order of the tables.
    """
    taken = _taken(result)
    known, tables = quantities(), GearTables if "gear" in result.inputs else CaseTables
    lines = []
    for key, value in _leaves(result.inputs, ""):
        plain = re.sub(r"\[\d+\]", "", key)
        quantity = known.get(plain.rpartition(".")[2])
        if key in taken:
            source = f"default: {taken[key]}" if taken[key] else "default"
        else:
            alike = value == _default(tables, plain.split("."))
            source = "default of the format, or given" if alike else "given"
        lines.append(
            Input(
                key,
                _shown(value),
                quantity.unit if quantity else "",
                quantity.meaning if quantity else "",
                source,
            )
        )
    return lines


def catalogue_sources(result: WearResult) -> list[tuple[str, str]]:
    """Return where the numbers of the catalogue that a case uses come from.

    Parameters
    ----------
    result : WearResult
        The result.

    Returns
    -------
    list of tuple of str
        What it is, and its sources with the notes on them.
    """
    found = []
    inputs = result.inputs
    designation = chain_name(inputs.get("chain", {}).get("designation", ""))
    if designation:
        chain = chains()[designation]
        base = chain.designation if chain.strands == 1 else chain.designation.rpartition("-")[0]
        for row in rows("chains"):
            if row["designation"].partition(" (")[0] in (chain.designation, base, f"{base}-1"):
                notes = f"; note: {chain.flag}" if chain.flag else ""
                found.append((f"chain {chain.designation}", row["source"] + notes))
                break
    condition = inputs.get("wear", {}).get("condition")
    if condition in wear_conditions():
        found.append((f"wear condition '{condition}'", wear_conditions()[condition].source))
    else:
        found.append(("wear coefficient", "given in the case; its band: " + result.band))
    reasons = set(_taken(result).values())
    found += [
        (f"material {row['name']}", row["source"])
        for row in rows("materials")
        if row["name"] in reasons
    ]
    found += [
        (f"file {name}", "read by the case, kept with the run") for name in result.input_files
    ]
    return found


def _taken(result: WearResult) -> dict[str, str]:
    """Keys taken by default and why; empty where that is all there is to say."""
    found = (_TAKEN.match(text) for text in result.assumptions)
    return {
        match[1]: (match[2] or "").removesuffix("default").removesuffix(", ")
        for match in found
        if match
    }


def _default(model: type[BaseModel], path: list[str]) -> Any:
    """Value of a key that an input may leave out; None where it has no such value."""
    field = model.model_fields.get(path[0])
    if field is None:
        return None
    if len(path) == 1:
        return field.get_default()
    inner = [field.annotation, *getattr(field.annotation, "__args__", ())]
    below = [kind for kind in inner if isinstance(kind, type) and issubclass(kind, BaseModel)]
    return _default(below[0], path[1:]) if below else None


def _leaves(table: Mapping[str, Any], prefix: str) -> Iterator[tuple[str, Any]]:
    """Dotted keys of nested tables with their values; entries of a list of tables are counted."""
    for key, value in table.items():
        name = f"{prefix}{key}"
        if isinstance(value, Mapping):
            yield from _leaves(value, f"{name}.")
        elif isinstance(value, list) and value and isinstance(value[0], Mapping):
            for index, entry in enumerate(value, start=1):
                yield from _leaves(entry, f"{name}[{index}].")
        else:
            yield name, value


def _shown(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, list | tuple):
        return ", ".join(_shown(entry) for entry in value)
    return str(value)
