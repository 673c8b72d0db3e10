"""What a calculation shows: text, JSON, tables and pictures."""

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from wearsim.files import new_folder
from wearsim.report.answer_table import AnswerTable, csv_of
from wearsim.report.text_lines import answer_text, assumed

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False)
class CalculationSheet:
    """A finished calculation."""

    text: str  # for the screen, at most a hundred characters wide
    # for `--json`: plain values, never nan; the assumptions are among them
    content: Mapping[str, Any]
    # by file stem; units in the names of the columns. Only a folder needs them, and the libraries for them
    tables: Callable[[], Mapping[str, "AnswerTable[Any] | pd.DataFrame"]]
    figures: Callable[[], Mapping[str, "Figure"]]  # returns matplotlib.figure.Figure by file stem
    warnings: tuple[str, ...] = ()  # what the user should look at
    # by file name: what writes a further file to the path that it is given
    files: Mapping[str, Callable[[Path], None]] = field(default_factory=dict)

    def words(self, explain: bool) -> str:
        """Return the text with the number of its assumptions, on request with each of them."""
        return answer_text(self.text, "", assumed(self.content["assumptions"], explain))

    def save(self, folder: Path, force: bool) -> None:
        """Write ``result.json``, a CSV file for each table, each picture as PNG and SVG, and the files."""
        from wearsim.report.figures import save_figure

        with new_folder(folder, force) as place:
            content = json.dumps(self.content, ensure_ascii=False, allow_nan=False, indent=1)
            (place / "result.json").write_text(content + "\n", encoding="utf-8")
            for name, table in self.tables().items():
                frame = table.frame() if isinstance(table, AnswerTable) else table
                (place / f"{name}.csv").write_text(csv_of(frame), encoding="utf-8", newline="")
            for name, figure in self.figures().items():
                save_figure(figure, place, name)
            for name, write in self.files.items():
                write(place / name)
