"""What was measured in service, checked to the cell."""

import csv
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from wearsim.errors import CaseError, Fault
from wearsim.extras import library
from wearsim.geometry.profile_points import Vector
from wearsim.input.csv_tables import header_faults, read_columns
from wearsim.input.faults import Faults

if TYPE_CHECKING:
    import pandas as pd

DEEPEST, POINT, OVER_PINS = "max_depth_mm", "depth_mm", "over_pins_mm"
ELONGATION, PROFILE = "elongation_percent", "profile"
QUANTITIES = (DEEPEST, POINT, OVER_PINS, ELONGATION, PROFILE)

REQUIRED = ("time_hours", "quantity", "error")
OPTIONAL = ("value", "arc_length_mm", "gap_kind", "points_file")
_LEAST_POINTS = 11
_LEAST_HOURS, _MAX_HOURS = 1e-6, 1e9
_LEAST_ERROR, _MAX_VALUE = 1e-9, 1e6


@dataclass(frozen=True, eq=False)
class Reading:
    """A row of the table of measurements."""

    row: int  # its line in the file
    hours: float  # running time since the part that was measured, sprocket or chain, was new [h]
    quantity: str  # one of `QUANTITIES`
    value: float  # in the unit of the quantity; nan for a profile
    error: float  # standard deviation of the value, of a profile that of each point across it
    arc_length: float  # place of a depth along the new flank [mm]; nan for other quantities
    gap_kind: int | None  # number of the gap that was measured, from 1; None where it is not told
    x: Vector  # points of a profile [mm]; none for other quantities
    y: Vector  # points of a profile [mm]; none for other quantities


def read_readings(path: Path) -> tuple[Reading, ...]:
    """Read a table of measurements."""
    table = _table(path)
    faults = [*_bad_cells(table, _common(), path)]
    for quantity, rows in table.groupby("quantity"):
        if quantity in QUANTITIES:
            faults += _bad_cells(rows, _of_quantity(str(quantity)), path)
    points = {
        row: _points(cells["points_file"], int(str(row)), path, faults) for row, cells in table.iterrows()
    }
    if faults:
        raise CaseError(sorted(faults, key=lambda fault: fault.line))
    found = [_reading(int(str(row)), cells, points[row]) for row, cells in table.iterrows()]
    if not found:
        raise CaseError([Fault("must hold at least one reading below its header", "", str(path))])
    return tuple(found)


def _table(path: Path) -> "pd.DataFrame":
    """Read the cells as text, each row by its line in the file."""
    import pandas as pd

    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            reader = csv.reader(file)
            lines = [
                (reader.line_num, [cell.strip() for cell in line])
                for line in reader
                if line and not line[0].startswith("#")
            ]
    except (OSError, ValueError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise CaseError([Fault(f"must be a readable CSV file: {reason}", "", str(path))]) from None
    head, names = lines[0] if lines else (1, [])
    if len(names) == 1 and any(mark in names[0] for mark in ";\t"):
        text = "cells must be separated by commas, with points in numbers: export it as such"
        raise CaseError([Fault(text, "", str(path), head)])
    faults = [Fault(text, "", str(path), head) for text in header_faults(names, REQUIRED, OPTIONAL)]
    rows = [(number, cells) for number, cells in lines[1:] if any(cells)]
    faults += [
        Fault(f"needs {len(names)} values, has {len(cells)}", "", str(path), number)
        for number, cells in rows
        if len(cells) != len(names)
    ]
    if faults:
        raise CaseError(faults)
    table = pd.DataFrame(
        [cells for _, cells in rows], columns=names, index=[number for number, _ in rows], dtype=str
    )
    return table.reindex(columns=[*REQUIRED, *OPTIONAL], fill_value="")


def _bad_cells(table: "pd.DataFrame", schema: Any, path: Path) -> list[Fault]:
    try:
        schema.validate(table, lazy=True)
    except library("pandera.errors", "study", "calibrate").SchemaErrors as errors:
        return [
            Fault(f"{cell.check} (got {cell.failure_case!r})", cell.column, str(path), int(cell.index))
            for cell in errors.failure_cases.itertuples()
        ]
    return []


Holds = Callable[[str], bool]


def _columns(rules: Mapping[str, tuple[Holds, str]]) -> Any:
    pandera = library("pandera.pandas", "study", "calibrate")
    return pandera.DataFrameSchema(
        {
            name: pandera.Column(str, pandera.Check(holds, element_wise=True, error=must))
            for name, (holds, must) in rules.items()
        }
    )


def _common() -> Any:
    words = ", ".join(QUANTITIES)
    return _columns(
        {
            "time_hours": (
                lambda text: _LEAST_HOURS <= _number(text) <= _MAX_HOURS,
                f"must be a number above 0, from {_LEAST_HOURS:g} to {_MAX_HOURS:g} h",
            ),
            "error": (
                lambda text: _LEAST_ERROR <= _number(text) <= _MAX_VALUE,
                "must be a number above 0, the standard deviation of the value, from "
                f"{_LEAST_ERROR:g} to {_MAX_VALUE:g}",
            ),
            "quantity": (lambda text: text in QUANTITIES, f"must be one of {words}"),
            "gap_kind": (
                lambda text: text == "" or (text.isdecimal() and int(text) > 0),
                "must be the number of a gap from 1, or empty",
            ),
        }
    )


def _of_quantity(quantity: str) -> Any:
    empty = (lambda text: text == "", f"must be empty for {quantity}")
    profile = quantity == PROFILE
    return _columns(
        {
            "value": empty
            if profile
            else (
                lambda text: abs(_number(text)) <= _MAX_VALUE,
                f"must be a number of at most {_MAX_VALUE:g}",
            ),
            "points_file": (bool, "must name a file with x_mm and y_mm") if profile else empty,
            "arc_length_mm": (lambda text: _number(text) >= 0.0, "must be a number of at least 0")
            if quantity == POINT
            else empty,
        }
    )


def _number(text: str) -> float:
    """Read a number; nan for anything else, also what only Python takes for one."""
    try:
        return float(text) if "_" not in text else math.nan
    except ValueError:
        return math.nan


def _reading(row: int, cells: Any, points: tuple[Vector, Vector]) -> Reading:
    x, y = points
    return Reading(
        row=row,
        hours=float(cells["time_hours"]),
        quantity=cells["quantity"],
        value=_number(cells["value"]),
        error=float(cells["error"]),
        arc_length=_number(cells["arc_length_mm"]),
        gap_kind=int(cells["gap_kind"]) if cells["gap_kind"] else None,
        x=x,
        y=y,
    )


def _points(name: str, row: int, path: Path, faults: list[Fault]) -> tuple[Vector, Vector]:
    """Read the points of a profile; none where there are none or where there was a fault."""
    nothing = np.empty(0), np.empty(0)
    if not name:
        return nothing
    found = Faults(str(path), "", ())
    columns = read_columns(path.parent / name, ("x_mm", "y_mm"), (), "", found)
    try:
        found.check()
    except CaseError as error:
        faults += [Fault(fault.message, "points_file", str(path), row) for fault in error.faults]
        return nothing
    if columns["x_mm"].size < _LEAST_POINTS:
        text = f"{name} needs at least {_LEAST_POINTS} points, has {columns['x_mm'].size}"
        faults.append(Fault(text, "points_file", str(path), row))
    return columns["x_mm"], columns["y_mm"]
