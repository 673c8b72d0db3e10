"""What a case was given, what it took by default, and where its numbers come from."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

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
    taken = {}
    for text in result.assumptions:
        if found := _TAKEN.match(text):
            taken[found[1]] = found[2] or "default"
    known = quantities()
    lines = []
    for key, value in _leaves(result.inputs, ""):
        name = re.sub(r"\[\d+\]", "", key.rpartition(".")[2])
        quantity = known.get(name)
        reason = taken.get(key)
        source = "given" if reason is None else f"default: {reason}"
        lines.append(
            Input(
                key,
                _shown(value),
                quantity.unit if quantity else "",
                quantity.meaning if quantity else "",
                source.replace("default: default", "default"),
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
    found += [
        (f"file {name}", "read by the case, kept with the run") for name in result.input_files
    ]
    return found


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
