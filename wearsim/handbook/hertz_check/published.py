"""Reading the input of ``wearsim handbook hertz-check`` with the stresses that it names."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from wearsim.geometry.profile_points import Vector
from wearsim.handbook.hertz_check.keys import HertzCheckTables
from wearsim.input.csv_tables import read_columns
from wearsim.input.document import CaseSource, checked, read_document

_KEY = "finite_elements.axis_file"


@dataclass(frozen=True, eq=False)
class AxisFile:
    """Stresses on the axis of a contact, from a file."""

    depth: Vector  # below the surface [mm]
    von_mises: Vector  # von Mises' stress there [MPa]


def load_hertz_check(
    source: CaseSource, overrides: Sequence[str] = ()
) -> tuple[HertzCheckTables, AxisFile | None]:
    """Return the tables of a check, and the stresses of ``finite_elements.axis_file``."""
    document = read_document(source, overrides)
    document.data.setdefault("title", document.name)
    tables = checked(document, HertzCheckTables)
    name = tables.finite_elements.axis_file
    if name is None:
        return tables, None
    path, faults = document.folder / name, document.faults
    columns = read_columns(path, ("below_surface_mm", "von_mises_MPa"), (), _KEY, faults)
    for column, values in columns.items():
        for index in np.flatnonzero(values < 0.0):
            faults.add(
                _KEY, f"{path.name}:{index + 2}: {column} must be at least 0, but is {values[index]:g}"
            )
    if columns and columns["below_surface_mm"].size == 0:
        faults.add(_KEY, f"{path.name}: needs at least one row, has none")
    faults.check()
    return tables, AxisFile(columns["below_surface_mm"], columns["von_mises_MPa"])
