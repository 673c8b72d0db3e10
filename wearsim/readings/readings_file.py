"""Readings that Python holds, as the file that commands read."""

import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from wearsim.errors import CaseError

if TYPE_CHECKING:
    import pandas as pd

_NAME = "readings"
"""What faults call readings that are in no file."""


@contextmanager
def readings_file(
    readings: "str | PathLike[str] | pd.DataFrame | Sequence[Mapping[str, Any]]",
) -> Iterator[Path]:
    """Give the file of readings: theirs, or one of their rows for as long as it is read."""
    if isinstance(readings, str | PathLike):
        yield Path(readings)
        return
    import pandas as pd

    table = readings if isinstance(readings, pd.DataFrame) else pd.DataFrame(list(readings))
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / f"{_NAME}.csv"
        _with_whole_paths(table).to_csv(file, index=False)
        try:
            yield file
        except CaseError as error:
            faults = [replace(one, file=one.file.replace(str(file), _NAME)) for one in error.faults]
            raise CaseError(faults) from None


def _with_whole_paths(table: "pd.DataFrame") -> "pd.DataFrame":
    if "points_file" not in table:
        return table
    files = table["points_file"]
    return table.assign(
        points_file=[str(Path(name).resolve()) if isinstance(name, str) and name else "" for name in files]
    )
