"""What every public function answers: text, plain values, tables, and what a notebook shows of them."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from html import escape
from typing import TYPE_CHECKING, Any

from wearsim.errors import StudyError
from wearsim.notebook import html_rows, one_line

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

_MAX_ROWS = 20
"""Rows of a table that a notebook shows."""


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
    def headline(self) -> str:
        """The answer in a few words."""
        return ""

    @abstractmethod
    def summary(self) -> dict[str, Any]:
        """Return the answer as the command prints it with ``--json``.

        Returns
        -------
        dict
            Plain numbers, strings, lists and None; never nan.
        """

    @abstractmethod
    def tables(self) -> "Mapping[str, pd.DataFrame]":
        """Return all tables of the answer.

        Returns
        -------
        mapping of pandas.DataFrame
            By their names, which are those of its attributes.
        """

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return one_line(type(self).__name__, self.title, self.headline)

    def _repr_html_(self) -> str:
        content = self.summary()
        tables = [
            f"<p>{escape(name.replace('_', ' '))}</p>{table.to_html(max_rows=_MAX_ROWS, index=False)}"
            for name, table in self.tables().items()
            if not table.empty
        ]
        texts = [(name, "; ".join(content.get(name, ()))) for name in ("assumptions", "warnings")]
        return "".join([html_rows(self.title, [("answer", self.headline)]), *tables, html_rows("", texts)])


class DrawnAnswer(Answer):
    """An answer with pictures."""

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


def table_of(rows: Any) -> "pd.DataFrame":
    """Return rows of plain values as a table."""
    import pandas as pd

    return pd.DataFrame(list(rows))
