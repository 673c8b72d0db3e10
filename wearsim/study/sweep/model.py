"""Lives over values of any input keys: grids, keys that go together, designs."""

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from wearsim.errors import CaseError, Fault
from wearsim.input.calculation_file import load_calculation
from wearsim.input.document import read_document, retitled
from wearsim.runner.design import Design, design
from wearsim.study.sweep.keys import Range, SweepTables

MAX_CASES = 10_000_000


@dataclass(frozen=True)
class Sweep:
    """The cases of a sweep."""

    title: str  # what it is about
    # keys that change together, one group for every dimension of the grid
    axes: tuple[tuple[str, ...], ...]
    design: Design  # the cases, those that differ in the last axis only next to one another


def load_sweep(path: Path, overrides: Sequence[str] = ()) -> Sweep:
    """Return the cases of a sweep."""
    tables = load_calculation(path, SweepTables)
    axes = list(_axes(tables))
    keys = [key for names, _ in axes for key in names]
    count = int(np.prod([len(rows) for _, rows in axes], dtype=float))
    if count > MAX_CASES:
        text = f"a sweep may have at most {MAX_CASES} cases, this has {count}: give fewer values"
        raise CaseError([Fault(text, "grid", str(path))])
    rows = [
        tuple(itertools.chain.from_iterable(parts))
        for parts in itertools.product(*(rows for _, rows in axes))
    ]
    document, written = (read_document(path.parent / tables.case, sets) for sets in (overrides, ()))
    title = {"title": tables.title}
    report_progress = retitled({**document.data, **title}, {**written.data, **title})["title"]
    cases = design(document, keys, rows, str(path))
    return Sweep(report_progress, tuple(names for names, _ in axes), cases)


Axis = tuple[tuple[str, ...], list[tuple[Any, ...]]]


def _axes(tables: SweepTables) -> Iterator[Axis]:
    for key, given in tables.grid.items():
        values = values_of(given) if isinstance(given, Range) else given
        yield (key,), [(value,) for value in values]
    for group in tables.zip:
        yield tuple(group), list(zip(*group.values(), strict=True))
    if tables.design:
        keys = tuple(tables.design[0])
        yield keys, [tuple(entry[key] for key in keys) for entry in tables.design]


def values_of(given: Range) -> list[float]:
    """Return the values of a range.

    Examples
    --------
    >>> values_of(Range(**{"from": 1.0, "to": 100.0, "count": 3, "spacing": "log"}))
    [1.0, 10.0, 100.0]
    """
    spaced = np.geomspace if given.spacing == "log" else np.linspace
    return [float(value) for value in spaced(given.first, given.last, given.count)]
