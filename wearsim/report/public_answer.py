"""What every public function answers: text, plain values, tables, and what a notebook shows of them."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from html import escape
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from wearsim.errors import StudyError
from wearsim.files import new_folder
from wearsim.notebook import html_rows, one_line

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

_MAX_ROWS = 20
"""Rows of a table that a notebook shows."""

_LONGEST = 60
"""Letters of a cell that a notebook shows."""


class Answer(ABC):
    """An answer of a public function.

    ``print`` shows what the command prints; a notebook shows the tables.
    """

    @property
    @abstractmethod
    def title(self) -> str:
        """What it is about."""

    @property
    @abstractmethod
    def text(self) -> str:
        """What the command prints."""

    @property
    def explained(self) -> str:
        """What the command prints with ``--explain``: the text with every assumption and default."""
        return self.text

    @property
    def headline(self) -> str:
        """The answer in a few words."""
        return ""

    _tables: ClassVar[tuple[str, ...]]
    """Names of the attributes that are tables."""

    @abstractmethod
    def _content(self) -> dict[str, Any]:
        """Return the answer as plain values."""

    def summary(self) -> dict[str, Any]:
        """Return the answer as the command prints it with ``--json``.

        Returns
        -------
        dict
            Plain numbers, strings, lists and None; never nan.
        """
        return self._content()

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is doubtful about it."""
        return tuple(self._content().get("warnings", ()))

    def tables(self) -> "dict[str, pd.DataFrame]":
        """Return all tables of the answer.

        Returns
        -------
        dict of pandas.DataFrame
            By their names, which are those of its attributes.
        """
        return {name: getattr(self, name) for name in self._tables}

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return one_line(type(self).__name__, self.title, self.headline)

    def _repr_html_(self) -> str:
        content = self.summary()
        tables = [
            f"<p>{escape(name.replace('_', ' '))}</p>{_html_table(table)}"
            for name, table in self.tables().items()
            if not table.empty
        ]
        texts = [
            (name, content.get(name) or "none") for name in ("assumptions", "warnings") if name in content
        ]
        return "".join([html_rows(self.title, [("answer", self.headline)]), *tables, html_rows("", texts)])


class DrawnAnswer(Answer):
    """An answer with pictures, which its command writes into a folder."""

    @abstractmethod
    def pictures(self) -> "Mapping[str, Figure]":
        """Return the pictures that suit the answer.

        Returns
        -------
        mapping of matplotlib.figure.Figure
            By their names, the first one says most.
        """

    def plot(self, name: str | None = None) -> "Figure":
        """Draw the answer.

        Parameters
        ----------
        name : str, optional
            One of ``pictures``; the first one without it.

        Returns
        -------
        matplotlib.figure.Figure
            A notebook shows it; ``savefig`` writes it.

        Raises
        ------
        StudyError
            There is no such picture.
        """
        from wearsim.report.result_pictures import shown

        drawn = self.pictures()
        chosen = next(iter(drawn), "") if name is None else name
        if chosen not in drawn:
            names = ", ".join(drawn) or "there are none"
            raise StudyError(f"plot: must name one of the pictures: {names} (got {name!r})")
        return shown(drawn[chosen])

    def _files(self) -> Mapping[str, str]:
        """Return what its folder holds beside the pictures."""
        return {}

    def _write(self, place: Path) -> None:
        """Write tables, words and pictures into an empty folder."""
        from wearsim.report.figures import save_figure

        for name, text in self._files().items():
            (place / name).write_text(text, encoding="utf-8", newline="\n")
        for name, figure in self.pictures().items():
            save_figure(figure, place, name)

    def save(self, folder: str | PathLike[str], force: bool = False) -> None:
        """Write the answer into a folder as the command does with ``--out``, all of it or nothing.

        Parameters
        ----------
        folder : path
            New folder for tables, words and pictures.
        force : bool
            Replace a folder that is there, if wearsim wrote it.

        Raises
        ------
        OutputError
            The folder is there, or cannot be written.
        """
        with new_folder(Path(folder), force) as place:
            self._write(place)


def _html_table(table: "pd.DataFrame") -> str:
    """Return a table as HTML without columns that hold nothing or long texts."""
    shown = [
        name
        for name, column in table.items()
        if column.notna().any() and 0 < max(len(str(value)) for value in column.head(_MAX_ROWS)) <= _LONGEST
    ]
    return table[shown].to_html(max_rows=_MAX_ROWS, index=False, float_format="{:.6g}".format, na_rep="-")
