"""Lives over values of any input keys: grids, keys that go together, designs."""

import itertools
import math
from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, overload

import numpy as np
from pydantic import ValidationError

from wearsim.errors import CaseError, Fault
from wearsim.input.document import (
    CaseSource,
    Document,
    GivenInput,
    calculation_tables,
    check_command,
    read_document,
    retitled,
)
from wearsim.input.faults import validation_faults
from wearsim.input.keys import schema_of, whole_number_keys
from wearsim.input.table import Table, without_numbers
from wearsim.runner.design import Design, design, replaced
from wearsim.study.sweep.keys import Range, SweepTables

MAX_CASES = 10_000_000

_MAX_CHECKED = 1000
"""Values of a key that are looked at before any case runs; of more, every so many."""


@dataclass(frozen=True)
class Sweep:
    """The cases of a sweep."""

    title: str  # what it is about
    # keys that change together, one group for every dimension of the grid
    axes: tuple[tuple[str, ...], ...]
    design: Design  # the cases, those that differ in the last axis only next to one another


def load_sweep(source: CaseSource, overrides: Sequence[str] = (), case: GivenInput | None = None) -> Sweep:
    """Return the cases of a sweep; of a case that is given here in place of the file that it names."""
    given = read_document(source, ())
    place = given.faults.file
    tables = calculation_tables(given, SweepTables)
    of_case = given.folder / tables.case if case is None else case
    document, written = (read_document(of_case, sets) for sets in (overrides, ()))
    axes = list(_axes(tables, whole_number_keys(schema_of(document.data))))
    keys = [key for axis in axes for key in axis.keys]
    rows = Combinations([axis.rows for axis in axes])
    count = math.prod(map(len, rows.axes))  # len() has an end
    if count > MAX_CASES:
        text = f"a sweep may have at most {MAX_CASES} cases, this has {count}: give fewer values"
        raise CaseError([Fault(text, "grid", place)])
    check_command(document.data, document.faults.file, "life")
    title = {"title": tables.title}
    retold = retitled({**document.data, **title}, {**written.data, **title})["title"]
    cases = design(document, keys, rows, place)
    _check_values(given, document, cases, axes)
    return Sweep(retold, tuple(axis.keys for axis in axes), cases)


@dataclass(frozen=True)
class Combinations(Sequence[tuple[Any, ...]]):
    """Every combination of rows of some axes, each made when it is asked for, the last axis fastest.

    Examples
    --------
    >>> found = Combinations([[(1,), (2,)], [("a", 0.1), ("b", 0.2), ("c", 0.3)]])
    >>> len(found), found[4], found[2:4]
    (6, (2, 'b', 0.2), [(1, 'c', 0.3), (2, 'a', 0.1)])
    """

    axes: Sequence[Sequence[tuple[Any, ...]]]

    def __len__(self) -> int:
        return math.prod(map(len, self.axes))

    def __iter__(self) -> Iterator[tuple[Any, ...]]:
        for parts in itertools.product(*self.axes):
            yield tuple(itertools.chain.from_iterable(parts))

    @overload
    def __getitem__(self, place: int) -> tuple[Any, ...]: ...

    @overload
    def __getitem__(self, place: slice) -> list[tuple[Any, ...]]: ...

    def __getitem__(self, place: int | slice) -> Any:
        places = range(len(self))[place]
        return [self._row(at) for at in places] if isinstance(places, range) else self._row(places)

    def _row(self, at: int) -> tuple[Any, ...]:
        parts: list[tuple[Any, ...]] = []
        for axis in reversed(self.axes):
            at, here = divmod(at, len(axis))
            parts.insert(0, axis[here])
        return tuple(itertools.chain.from_iterable(parts))


@dataclass(frozen=True)
class _Axis:
    table: str  # table of the sweep that it stands in
    keys: tuple[str, ...]  # keys of the case that go together
    rows: list[tuple[Any, ...]]  # their values


def _check_values(given: Document, document: Document, cases: Design, axes: Sequence[_Axis]) -> None:
    """Raise where no case can have a value, or the case is wrong whatever the values."""
    model = schema_of(cases.tables_of(0))
    for key, message in _wrong(cases.tables_of(0), model):
        if not any(_holds(swept, key) for swept in cases.keys):
            document.faults.add(key, message)
    document.faults.check()
    for axis in axes:
        for row in axis.rows[:: max(1, len(axis.rows) // _MAX_CHECKED)]:
            tables = cases.tables_of(0)
            for key, value in zip(axis.keys, row, strict=True):
                tables = replaced(tables, key.split("."), value)
            for key, message in _wrong(tables, model):
                if any(_holds(swept, key) for swept in axis.keys):
                    given.faults.add(f"{axis.table}.{key}", message)
    given.faults.check()


def _wrong(tables: Mapping[str, Any], model: type[Table]) -> Iterator[tuple[str, str]]:
    """Give the keys whose values are wrong beside any others."""
    try:
        model.model_validate(tables)
    except ValidationError as error:
        yield from ((key, message) for key, message, alone in validation_faults(error, model) if alone)


def _holds(key: str, other: str) -> bool:
    return other == key or other.startswith(f"{key}.")


def _axes(tables: SweepTables, whole: Container[str]) -> Iterator[_Axis]:
    for key, given in tables.grid.items():
        values: list[Any] = given if isinstance(given, list) else values_of(given)
        if isinstance(given, Range) and without_numbers(key) in whole:
            values = [_as_whole(value) for value in values]
        yield _Axis("grid", (key,), [(value,) for value in values])
    for number, group in enumerate(tables.zip, start=1):
        yield _Axis(f"zip.{number}", tuple(group), list(zip(*group.values(), strict=True)))
    if tables.design:
        keys = tuple(tables.design[0])
        yield _Axis("design", keys, [tuple(entry[key] for key in keys) for entry in tables.design])


def _as_whole(value: float) -> float:
    """Return a whole number as such, which a spacing by logarithms misses by a few last digits."""
    return round(value) if math.isclose(value, round(value), rel_tol=1e-12) else value


def values_of(given: Range) -> list[float]:
    """Return the values of a range, those between its ends with 15 digits, which spacing keeps at least.

    Examples
    --------
    >>> values_of(Range(**{"from": 1.0, "to": 100.0, "count": 3, "spacing": "log"}))
    [1.0, 10.0, 100.0]
    >>> values_of(Range(**{"from": 1000.0, "to": 4000.0, "count": 3, "spacing": "log"}))
    [1000.0, 2000.0, 4000.0]
    """
    spaced = np.geomspace if given.spacing == "log" else np.linspace
    between = spaced(given.first, given.last, given.count)[1:-1]
    return [given.first, *(float(f"{value:.15g}") for value in between), given.last]
