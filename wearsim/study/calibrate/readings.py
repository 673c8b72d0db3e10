"""What was measured in service, checked to the cell."""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from wearsim.case.model import Case
from wearsim.drive.wrap_life import wrap_of
from wearsim.errors import CaseError, Fault
from wearsim.extras import library
from wearsim.geometry.profile_points import Vector
from wearsim.input.csv_tables import read_columns
from wearsim.input.faults import Faults
from wearsim.input.named_files import outside_fault
from wearsim.readings.chain_lengths import new_length
from wearsim.readings.chain_readings import ELONGATION, GAUGE, LENGTH, chain_cells, elongation_over, odd_error
from wearsim.readings.dated_rows import (
    CHAINS,
    SPROCKETS,
    DatedRows,
    ServiceTime,
    read_dated_rows,
    service_time,
)
from wearsim.readings.kept_tables import HOURS, number
from wearsim.readings.relubrications import (
    EVENTS,
    RelubricationLog,
    at_one_interval,
    event_faults,
    late_new_faults,
    relubrication_log,
)

if TYPE_CHECKING:
    import pandas as pd

DEEPEST, POINT, OVER_PINS = "max_depth_mm", "depth_mm", "over_pins_mm"
PROFILE = "profile"
SIZE = "size_over_pins_mm"
"""The measurement over pins itself, of which its decrease from that of the new sprocket is read."""

QUANTITIES = (DEEPEST, POINT, OVER_PINS, SIZE, ELONGATION, PROFILE, LENGTH, GAUGE)

REQUIRED = ("quantity", "error")
OPTIONAL = ("value", "arc_length_mm", "gap_kind", "points_file", "links", "result")
_PARTS = (CHAINS, SPROCKETS)
"""Columns of a log of several parts."""

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
    result: str = ""  # of a gauge: `go` or `no-go`

    @property
    def of_chain(self) -> bool:
        """Whether it is of the chain, not of the teeth."""
        return self.quantity in (ELONGATION, GAUGE)


def read_readings(path: Path, case: Case) -> tuple[tuple[Reading, ...], RelubricationLog, ServiceTime]:
    """Read measurements and relubrications; [service] of the case turns km and days into hours."""
    whole = read_dated_rows(path, REQUIRED, (*OPTIONAL, *_PARTS))
    time = service_time(whole, case.inputs)
    rows = replace(whole, rows=tuple(row for row in whole.rows if row[1]["quantity"] not in EVENTS))
    table = _table(rows)
    faults = [
        *_several_parts(whole),
        *event_faults(whole, time),
        *late_new_faults(whole),
        *_bad_cells(table, _common(time), path),
    ]
    for quantity, some in table.groupby("quantity"):
        if quantity in QUANTITIES:
            faults += _bad_cells(some, _of_quantity(str(quantity)), path)
    points = {
        row: _points(cells["points_file"], int(str(row)), path, faults) for row, cells in table.iterrows()
    }
    if faults:
        raise CaseError(sorted(faults, key=lambda fault: fault.line))
    found = [_reading(int(str(row)), cells, time, points[row]) for row, cells in table.iterrows()]
    if not found:
        raise CaseError([Fault("must hold at least one reading below its header", "", str(path))])
    readings = tuple(
        _counted(one, cells, whole, case) for one, (_, cells) in zip(found, rows.rows, strict=True)
    )
    log = relubrication_log(whole, [time.hours(cells[whole.time]) for _, cells in whole.rows])
    return readings, at_one_interval({"": log})[""], time


def _several_parts(table: DatedRows) -> Iterator[Fault]:
    """Give the first row of each part that is named, as a table is of one."""
    for name in _PARTS:
        for line, cells in [row for row in table.rows if row[1].get(name)][:1]:
            text = (
                f"must be empty, as coefficients are fitted to the log of one part (got {cells[name]!r}): "
                "wearsim remaining and wearsim maintain take several"
            )
            yield Fault(text, name, table.file, line)


def _counted(reading: Reading, cells: Mapping[str, str], table: DatedRows, case: Case) -> Reading:
    """Return a length of a chain as its elongation, with the error of odd links, a size as its decrease."""
    if reading.quantity == SIZE and case.drive.wear_coefficients:
        return replace(reading, quantity=OVER_PINS, value=wrap_of(case).over_pins - reading.value)
    if reading.quantity not in (LENGTH, ELONGATION) or not case.drive.wear_coefficients:
        return reading
    links = int(number(cells["links"])) if cells.get("links") else 0
    value, error = reading.value, reading.error
    if reading.quantity == LENGTH:
        new = new_length(table, wrap_of(case).chain.pitch)
        value = elongation_over(value, links, new.pitch)
        error = new.error_with(100.0 * error / (links * new.pitch))
    error = math.hypot(error, odd_error(value, links))
    return replace(reading, quantity=ELONGATION, value=value, error=error)


def _table(rows: DatedRows) -> "pd.DataFrame":
    """Return the cells, each row by its line in the file."""
    import pandas as pd

    columns = [rows.time, *REQUIRED, *OPTIONAL]
    cells = [[cells.get(name, "") for name in columns] for _, cells in rows.rows]
    return pd.DataFrame(cells, columns=columns, index=[line for line, _ in rows.rows], dtype=str)


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


def _common(time: ServiceTime) -> Any:
    words = ", ".join((*QUANTITIES, *EVENTS))
    hours = f"must be a number above 0, from {_LEAST_HOURS:g} to {_MAX_HOURS:g} h"
    return _columns(
        {
            time.column: (
                lambda text: _LEAST_HOURS <= time.hours(text) <= _MAX_HOURS,
                hours if time.column == HOURS else f"must be {time.must}, later than the part was new",
            ),
            "error": (
                lambda text: _LEAST_ERROR <= number(text) <= _MAX_VALUE,
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
    profile, of_chain = quantity == PROFILE, chain_cells(quantity)
    value = (lambda text: abs(number(text)) <= _MAX_VALUE, f"must be a number of at most {_MAX_VALUE:g}")
    return _columns(
        {
            "value": of_chain["value"] if profile or quantity in (LENGTH, GAUGE) else value,
            "points_file": (bool, "must name a file with x_mm and y_mm") if profile else empty,
            "arc_length_mm": (lambda text: number(text) >= 0.0, "must be a number of at least 0")
            if quantity == POINT
            else empty,
            "links": of_chain["links"],
            "result": of_chain["result"],
        }
    )


def _reading(row: int, cells: Any, time: ServiceTime, points: tuple[Vector, Vector]) -> Reading:
    x, y = points
    return Reading(
        row=row,
        hours=time.hours(cells[time.column]),
        quantity=cells["quantity"],
        value=number(cells["value"]),
        error=float(cells["error"]),
        arc_length=number(cells["arc_length_mm"]),
        gap_kind=int(cells["gap_kind"]) if cells["gap_kind"] else None,
        x=x,
        y=y,
        result=cells["result"],
    )


def _points(name: str, row: int, path: Path, faults: list[Fault]) -> tuple[Vector, Vector]:
    """Read the points of a profile; none where there are none or where there was a fault."""
    nothing = np.empty(0), np.empty(0)
    if not name:
        return nothing
    if fault := outside_fault(path.parent, name):
        faults.append(Fault(fault, "points_file", str(path), row))
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
