"""What a calculation shows: text, JSON, tables and pictures."""

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from wearsim.files import new_folder

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False)
class Sheet:
    """A finished calculation.

    Attributes
    ----------
    text : str
        For the screen, at most a hundred characters wide.
    content : mapping
        For ``--json``: plain values, never nan.
    tables : callable
        Returns pandas.DataFrame by file stem; units in the names of the columns. Only a folder
        needs them, and the libraries for them.
    figures : callable
        Returns matplotlib.figure.Figure by file stem.
    warnings : tuple of str
        What the user should look at.
    files : mapping of str to callable
        By file name: what writes a further file to the path that it is given.
    """

    text: str
    content: Mapping[str, Any]
    tables: Callable[[], Mapping[str, "pd.DataFrame"]]
    figures: Callable[[], Mapping[str, "Figure"]]
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
        from wearsim.report.figures import save_figure

        with new_folder(folder, force) as place:
            content = json.dumps(self.content, ensure_ascii=False, allow_nan=False, indent=1)
            (place / "result.json").write_text(content + "\n", encoding="utf-8")
            for name, table in self.tables().items():
                table.to_csv(place / f"{name}.csv", index=False, lineterminator="\n")
            for name, figure in self.figures().items():
                save_figure(figure, place, name)
            for name, write in self.files.items():
                write(place / name)
