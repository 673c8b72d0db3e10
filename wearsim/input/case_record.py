"""A case while it is being completed: the record of what was given, taken and doubted."""

import sys
from pathlib import Path
from typing import Any

from wearsim.input.faults import Faults
from wearsim.input.table import Table


class CaseRecord:
    """What is given, found, taken and doubted while a case is being completed."""

    def __init__(self, tables: Table, folder: Path, faults: Faults) -> None:
        self.folder = folder
        self.faults = faults
        self.inputs: dict[str, Any] = tables.model_dump(exclude_none=True)
        self.files: list[Path] = []
        self.assumptions: list[str] = []
        self.warnings: list[str] = []

    def take(self, key: str, value: float | int | str | list[int], why: str) -> None:
        """Record a default that the case takes."""
        place = self.inputs
        *tables, last = key.split(".")
        for table in tables:
            place = place.setdefault(table, {})
        place[last] = value
        shown = f"{value:.6g}" if isinstance(value, float) else value
        self.assumptions.append(f"{key} = {shown} ({why})")

    def path(self, name: str) -> Path:
        """Return the place of a file that the case names."""
        path = self.folder / name
        self.files.append(path)
        return path

    def texts(self) -> dict[str, str]:
        """Return the text of the files by their names; the cases of a study share it."""
        found = {}
        for path in self.files:
            text = path.read_text(encoding="utf-8-sig", errors="surrogateescape")
            found[path.name] = sys.intern(text)
        return found
