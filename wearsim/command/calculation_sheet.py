"""What a calculation shows: text, JSON, tables and pictures."""

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pandas as pd
from matplotlib.figure import Figure

from wearsim.files import new_folder
from wearsim.report.figures import save_figure


@dataclass(frozen=True, eq=False)
class Sheet:
    """A finished calculation.

    Attributes
    ----------
    text : str
        For the screen, at most a hundred characters wide.
    content : mapping
        For ``--json``: plain values, never nan.
    tables : mapping of str to pandas.DataFrame
        By file stem; units in the names of the columns.
    figures : mapping of str to matplotlib.figure.Figure
        By file stem.
    warnings : tuple of str
        What the user should look at.
    files : mapping of str to callable
        By file name: what writes a further file to the path that it is given.
    """

    text: str
    content: Mapping[str, Any]
    tables: Mapping[str, pd.DataFrame]
    figures: Mapping[str, Figure]
    warnings: tuple[str, ...] = ()
    files: Mapping[str, Callable[[Path], None]] = field(default_factory=dict)

    def save(self, folder: Path, force: bool) -> None:
        """Write ``result.json``, a CSV file for each table, each picture as PNG and SVG, and the files.

        Parameters
        ----------
        folder : pathlib.Path
            New folder.
        force : bool
            Replace what is there.

        Raises
        ------
        OutputError
            Something is in the way.
        """
        with new_folder(folder, force) as place:
            content = json.dumps(self.content, ensure_ascii=False, allow_nan=False, indent=1)
            (place / "result.json").write_text(content + "\n", encoding="utf-8")
            for name, table in self.tables.items():
                table.to_csv(place / f"{name}.csv", index=False, lineterminator="\n")
            for name, figure in self.figures.items():
                save_figure(figure, place, name)
            for name, write in self.files.items():
                write(place / name)
