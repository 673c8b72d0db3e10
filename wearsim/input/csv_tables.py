"""The CSV files that a case names, checked to the row."""

import csv
import math
import re
from array import array
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from wearsim.catalogue.catalogues import nearest
from wearsim.files import given_lines
from wearsim.geometry.profile_points import Vector, chord_lengths
from wearsim.input.faults import Faults
from wearsim.input.units import LEAST, MAX

_MOST_ROWS = 200_000
"""Of a table, if nothing else is said."""

MOST_NAMED = 1000
"""Faults of a table that are named, before the rest of it is left unread."""

_NAME = re.compile(r"[\w .,;%/()\[\]-]{0,60}")
"""What may be the name of a column."""


@dataclass(frozen=True, eq=False)
class PrescribedTable:
    """Load and sliding along a flank."""

    arc_length: Vector  # [mm]
    load_per_width: Vector  # [N/mm]
    flank_curvature: Vector  # [1/mm]
    slip_ratio: Vector | None  # |v_s|/v_t, where the file gives it
    sliding_distance: Vector | None  # path [mm], where the file gives it
    sliding_speed: Vector | None  # sliding speed [mm/s], where the file gives it


def read_columns(
    path: Path,
    required: tuple[str, ...],
    optional: tuple[str, ...],
    key: str,
    faults: Faults,
    most_rows: int = _MOST_ROWS,
) -> dict[str, Vector]:
    """Read a CSV file of numbers and report every bad cell."""
    before = faults.count
    try:
        rows = (cells for _, cells in given_lines(path))
        names = [name.strip() for name in next(rows, [])]
        for text in header_faults(names, required, optional):
            faults.add(key, f"{path.name}:1: {text}")
        values = _cells(path, names, rows, key, faults, most_rows) if faults.count == before else array("d")
    except (OSError, ValueError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or str(error)
        faults.add(key, f"the file must be readable CSV (got {str(path)!r}: {reason})")
    if faults.count > before:
        return {}
    table = np.array(values).reshape(-1, len(names))
    return {name: np.ascontiguousarray(table[:, i]) for i, name in enumerate(names)}


def header_faults(names: Sequence[str], required: Sequence[str], optional: Sequence[str]) -> list[str]:
    """Return what is wrong with the names of columns.

    What cannot be one is not quoted: the file may be another than was meant, and its lines nobody's business.

    Examples
    --------
    >>> header_faults(["x_mm"], ["x_mm", "load_N"], [])
    ["column 'load_N' is missing"]
    >>> header_faults(["x_mm", "y:0:root"], ["x_mm"], [])
    ['column 2 must be one of x_mm: its head is no name']
    """
    if not names:
        return ["the names of the columns must be here, but the file is empty"]
    if len(names) == 1 and ";" in names[0]:
        return [
            "columns are separated by semicolons: separate them by commas, and write decimals with a point"
        ]
    known = [*required, *optional]
    found = [
        f"column {name!r} is missing{nearest(name, list(names))}" for name in required if name not in names
    ]
    for number, name in enumerate(names, start=1):
        if name not in known and _NAME.fullmatch(name):
            found.append(f"unknown column {name!r}{nearest(name, known)}")
        elif name not in known:
            found.append(f"column {number} must be one of {', '.join(known)}: its head is no name")
    if len(set(names)) != len(names):
        found.append("each column may appear only once")
    return found


def _cells(
    path: Path, names: list[str], rows: Iterable[list[str]], key: str, faults: Faults, most_rows: int
) -> "array[float]":
    """Return all numbers, row by row."""
    values = array("d")
    before = faults.count
    for number, row in enumerate(rows, start=2):
        if faults.count > before + MOST_NAMED:
            break
        if number > most_rows + 1:
            faults.add(key, f"{path.name}: must have at most {most_rows} rows")
            break
        if row and len(row) != len(names):
            faults.add(key, f"{path.name}:{number}: needs {len(names)} values, has {len(row)}")
        elif row:
            values.extend(_numbers(f"{path.name}:{number}", names, row, key, faults))
    return values


def _numbers(place: str, names: list[str], row: list[str], key: str, faults: Faults) -> Iterator[float]:
    for name, cell in zip(names, row, strict=True):
        try:
            value = float(cell)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            faults.add(key, f"{place}: {name} must be a finite number (got {cell!r})")
        elif abs(value) > MAX:
            faults.add(key, f"{place}: {name} must be at most {MAX:g} in size (got {cell!r})")
        # Below the least number it is what is left of a formula that should come to 0.
        yield value if abs(value) >= LEAST else 0.0


def read_flank_points(path: Path, key: str, faults: Faults) -> tuple[Vector, Vector] | None:
    """Read the points of a flank, from root to tip."""
    found = read_points(path, key, faults)
    if found is None:
        return None
    radius = np.hypot(*found)
    if radius[0] > radius[-1]:
        faults.add(
            key, f"{path.name}: points must run from root to tip, but the radius decreases: reverse them"
        )
        return None
    return found


def read_points(path: Path, key: str, faults: Faults) -> tuple[Vector, Vector] | None:
    """Read the points of an outline in their order."""
    columns = read_columns(path, ("x_mm", "y_mm"), (), key, faults)
    if not columns:
        return None
    x, y = columns["x_mm"], columns["y_mm"]
    if x.size < 11:
        faults.add(key, f"{path.name}: a flank needs at least 11 points, has {x.size}")
        return None
    # Along the flank, where steps too small for its length are lost.
    same = np.flatnonzero(np.diff(chord_lengths(x, y)) == 0.0)
    for index in same:
        faults.add(key, f"{path.name}:{index + 3}: the point repeats the one before: remove it")
    return None if same.size else (x, y)


def read_prescribed(path: Path, key: str, faults: Faults) -> PrescribedTable | None:
    """Read load and sliding along a flank."""
    required = ("arc_length_mm", "load_per_width_N_per_mm", "flank_curvature_per_mm")
    optional = ("slip_ratio", "sliding_distance_mm", "sliding_speed_mm_per_s")
    columns = read_columns(path, required, optional, key, faults)
    if not columns:
        return None
    before = faults.count
    arc = columns["arc_length_mm"]
    if arc.size < 5:
        faults.add(key, f"{path.name}: needs at least 5 rows, has {arc.size}")
    for index in np.flatnonzero(np.diff(arc) <= 0.0):
        faults.add(key, f"{path.name}:{index + 3}: arc_length_mm must increase from row to row")
    for name in ("load_per_width_N_per_mm", *optional):
        if name in columns:
            for index in np.flatnonzero(columns[name] < 0.0):
                faults.add(key, f"{path.name}:{index + 2}: {name} must not be negative")
    given = [name for name in optional[:2] if name in columns]
    if len(given) != 1:
        faults.add(
            key,
            f"{path.name}:1: exactly one of the columns slip_ratio and sliding_distance_mm must be "
            f"there, found {len(given)}",
        )
    if faults.count > before:
        return None
    return PrescribedTable(
        arc,
        columns["load_per_width_N_per_mm"],
        columns["flank_curvature_per_mm"],
        columns.get("slip_ratio"),
        columns.get("sliding_distance_mm"),
        columns.get("sliding_speed_mm_per_s"),
    )
