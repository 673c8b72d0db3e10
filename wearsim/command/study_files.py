"""What every study leaves in its folder and prints: tables, pictures, plain values."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from wearsim.files import mark, write_file
from wearsim.report.figures import picture_bytes
from wearsim.report.text_lines import literal

_KINDS = ("png", "svg")


def save_texts(folder: Path, files: Mapping[str, str]) -> None:
    """Write the tables of a study, each in place of that of an earlier run."""
    mark(folder, files)
    for name, content in files.items():
        write_file(folder / name, content, force=True)


def save_figures(folder: Path, title: str, figures: Mapping[str, Figure]) -> None:
    """Write the pictures of a study as PNG and SVG."""
    mark(folder, (f"{name}.{kind}" for name in figures for kind in _KINDS))
    for name, figure in figures.items():
        figure.suptitle(literal(title), fontsize=10)
        for kind in _KINDS:
            write_file(folder / f"{name}.{kind}", picture_bytes(figure, kind), force=True)


def plain(value: Any) -> Any:
    """Return a value as JSON has it.

    Examples
    --------
    >>> plain(math.nan), plain(2.5)
    (None, 2.5)
    """
    return None if isinstance(value, float) and not math.isfinite(value) else value
