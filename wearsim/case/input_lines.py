"""The tables of an input as a notebook shows them."""

from collections.abc import Mapping, Sequence
from typing import Any

from wearsim.input.document import leaves

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
