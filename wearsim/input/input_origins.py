"""Every key of a complete case: its value, its unit, and where the value comes from."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from wearsim.catalogue.catalogues import catalogue_rows, chain_rows, chains, wear_conditions
from wearsim.input.document import leaves
from wearsim.input.keys import schema_fields, schema_of
from wearsim.quantities import quantities


@dataclass(frozen=True)
class InputRow:
    """A key of a case."""

    key: str  # dotted, tables of a list by their numbers from 1
    value: Any  # as it was used
    unit: str  # of the quantity
    meaning: str  # of the quantity
    # `given` by the user, `taken` by wearsim, or `default` where the value is that of the schema,
    # so that it makes no difference whether it was given
    origin: str
    why: str  # why it was taken, or the source of the row of a catalogue that it names


def input_rows(inputs: Mapping[str, Any], assumptions: Sequence[str]) -> list[InputRow]:
    """Return the keys of a case in their order.

    Examples
    --------
    >>> (row,) = input_rows({"run": {"horizon_hours": 1e6}}, [])
    >>> row.key, row.value, row.unit, row.origin
    ('run.horizon_hours', 1000000.0, 'h', 'default')
    """
    defaults = {
        key: field.get_default(call_default_factory=True)
        for key, field in schema_fields(schema_of(inputs))
        if not field.is_required()
    }
    found = []
    for key, value in leaves(inputs):
        name = key.rpartition(".")[2]
        quantity = quantities().get(name)
        why, origin = _why_taken(key, value, assumptions), "taken"
        if not why:
            default = defaults.get(re.sub(r"\.\d+\.", "[].", key))
            origin = "given" if default is None or value != default else "default"
            why = _source(key, value)
        unit, meaning = (quantity.unit, quantity.meaning) if quantity else ("", "")
        found.append(InputRow(key, value, unit, meaning, origin, why))
    return found


def _why_taken(key: str, value: Any, assumptions: Sequence[str]) -> str:
    """Reason in the assumption that tells of a key; empty where none does."""
    shown = f"{value:.6g}" if isinstance(value, float) else value
    for lead in (f"{key} = {shown} (", f"{key} = {value} ("):
        for text in assumptions:
            if text.startswith(lead) and text.endswith(")"):
                return text.removeprefix(lead).removesuffix(")")
    return ""


def _source(key: str, value: Any) -> str:
    """Source of the row of a catalogue that a key names; empty where it names none."""
    table, _, name = key.partition(".")
    if key == "chain.designation":
        return _chain_source(value)
    if key == "wear.condition":
        return wear_conditions()[value].source
    if table == "material" and name.endswith(".name"):
        return _row("materials", "name", value)
    return ""


def _chain_source(name: str) -> str:
    chain = chains()[name]
    for row in chain_rows():
        if row["designation"].partition(" (")[0] == chain.designation:
            note = f"; note: {chain.note}" if chain.note else ""
            return f"{chain.series}: {row['source']}; trust: {row['trust']}{note}"
    return chain.series


def _row(table: str, column: str, value: str) -> str:
    return next((row["source"] for row in catalogue_rows(table) if row[column] == value), "")


_LONGEST_LINE = 400
"""Letters of the values of a table."""


def input_lines(
    inputs: Mapping[str, Any], assumptions: Sequence[str], warnings: Sequence[str]
) -> list[tuple[str, str | Sequence[str]]]:
    """Return the tables of an input and what is to be known about it as labelled lines.

    Examples
    --------
    >>> input_lines({"load": {"power_kW": 3}}, ["a"], [])
    [('load', 'power_kW = 3'), ('assumes', ['a']), ('warnings', 'none')]
    """
    names = {key.partition(".")[0] for key, _ in leaves(inputs)}
    lines: list[tuple[str, str | Sequence[str]]] = []
    for name in (name for name in inputs if name in names and name not in ("title", "format_version")):
        found = leaves({name: inputs[name]})
        text = ", ".join(f"{key.partition('.')[2] or key} = {value}" for key, value in found)
        lines.append((name, text if len(text) <= _LONGEST_LINE else f"{text[:_LONGEST_LINE]}..."))
    return [*lines, ("assumes", assumptions), ("warnings", warnings or "none")]
