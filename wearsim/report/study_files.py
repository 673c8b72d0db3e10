"""What every study leaves in its folder: tables and pictures."""

import textwrap
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from wearsim.errors import OutputError
from wearsim.files import Content, mark, write_file, written
from wearsim.report.text_lines import literal

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_KINDS = ("png", "svg")

_LETTER = 0.085
"""Width of a letter of the title [inch]."""


def save_files(folder: Path, files: Mapping[str, Content]) -> None:
    """Write tables or pictures of a study, each in place of that of an earlier run and of nothing else."""
    for name in sorted(files.keys() - written(folder)):
        if (folder / name).exists():
            raise OutputError(
                f"{folder / name}: must be free for the study, but wearsim did not write what is there: move "
                "it away, then the same command goes on"
            )
    mark(folder, files)
    for name, content in files.items():
        write_file(folder / name, content, force=True)


def save_figures(folder: Path, title: str, figures: "Mapping[str, Figure]") -> None:
    """Write the pictures of a study as PNG and SVG."""
    from wearsim.report.figures import picture_bytes

    for figure in figures.values():
        letters = int(figure.get_figwidth() / _LETTER)
        figure.suptitle(literal(textwrap.fill(title, letters)), fontsize=10)
    pictures = {
        f"{name}.{kind}": picture_bytes(figure, kind) for name, figure in figures.items() for kind in _KINDS
    }
    save_files(folder, pictures)
