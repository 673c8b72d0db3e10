"""A table said once: its columns by their keys in JSON, CSV and pandas, below their heads on the screen."""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, TypeVar

if TYPE_CHECKING:
    import pandas as pd

    from wearsim.result import Life, LowerBound

Row = TypeVar("Row")


@dataclass(frozen=True)
class Column(Generic[Row]):
    """What a table says of each row, and how it is shown."""

    key: str  # in files, with its unit; empty of what only the screen shows
    of: Callable[[Row], Any]  # the value of a row
    head: str | None = None  # on the screen; None of what only files hold
    cell: str | Callable[[Any], str] = "{}"  # form of a value that is known, or what makes a text of it
    side: str = ">"  # where cells stand, with the width of a column that keeps one: "<12"
    missing: str = "-"  # cell of a value that is not known

    def value(self, row: Row) -> Any:
        """Return the value of a row as JSON has it."""
        return plain(self.of(row))

    def text(self, row: Row) -> str:
        """Return the cell of a row."""
        value = self.value(row)
        if value is None:
            return self.missing
        return self.cell.format(value) if isinstance(self.cell, str) else self.cell(value)


@dataclass(frozen=True, repr=False)
class AnswerTable(Generic[Row]):
    """Columns, and the objects that they tell of.

    Examples
    --------
    >>> columns = [Column("part", str.upper, "part", side="<"), Column("letters", len, "letters", "{} of 9")]
    >>> table = AnswerTable(columns, ["roll", "chain"])
    >>> print(table)
      part   letters
      ROLL    4 of 9
      CHAIN   5 of 9
    >>> table.records()
    [{'part': 'ROLL', 'letters': 4}, {'part': 'CHAIN', 'letters': 5}]
    """

    columns: Sequence[Column[Row]]
    rows: Sequence[Row]

    def records(self) -> list[dict[str, Any]]:
        """Return the rows as JSON has them."""
        return [{one.key: one.value(row) for one in self.columns if one.key} for row in self.rows]

    def frame(self) -> "pd.DataFrame":
        """Return the rows as pandas has them."""
        return table_of(self.records())

    def csv(self) -> str:
        """Return the rows as the content of a file."""
        return csv_of(self.frame())

    def write(self, path: Path) -> None:
        """Write the rows into a file."""
        path.write_text(self.csv(), encoding="utf-8", newline="\n")

    @property
    def shown(self) -> list[Column[Row]]:
        """Columns on the screen."""
        return [one for one in self.columns if one.head is not None]

    @property
    def head(self) -> list[str]:
        """Heads on the screen."""
        return [one.head or "" for one in self.shown]

    @property
    def words(self) -> list[int]:
        """Places of the columns on the screen that stand to the left, as words do."""
        return [place for place, one in enumerate(self.shown) if one.side.startswith("<")]

    @property
    def cells(self) -> list[list[str]]:
        """Rows on the screen."""
        return [[one.text(row) for one in self.shown] for row in self.rows]

    def lines(self, indent: str = "  ") -> list[str]:
        """Return head and rows in columns, which are as wide as they need where they keep no width."""
        rows, sides = [self.head, *self.cells], [one.side for one in self.shown]
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        forms = [f"{side}{width if side in '<>' else ''}" for side, width in zip(sides, widths, strict=True)]
        gap = "  " if sides[0] in "<>" else ""
        return [
            indent + gap.join(format(cell, form) for cell, form in zip(row, forms, strict=True))
            for row in rows
        ]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({[self.head, *self.cells]})"

    def __str__(self) -> str:
        return "\n".join(self.lines())

    def markdown(self) -> str:
        """Return head and rows as Markdown."""
        return "\n".join(markdown_lines(self.columns, self.rows))


def markdown_lines(columns: Sequence[Column[Row]], rows: Iterable[Row]) -> Iterator[str]:
    """Give head and rows of a table as Markdown, line by line."""
    table = AnswerTable(columns, ())
    yield _markdown(table.head)
    yield "|" + "---|" * len(table.head)
    for row in rows:
        yield _markdown(one.text(row) for one in table.shown)


def _markdown(cells: Iterable[str]) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def life_columns(
    key: str, of: "Callable[[Row], Life | LowerBound | None]", head: str | None = None
) -> list[Column[Row]]:
    """Return the columns of a life: hours that are known, or those that it lasts at least."""
    from wearsim.result.lives import hours, life_keys

    def bounded(name: str, row: Row) -> float | None:
        return life_keys(key, of(row))[name]

    names = (key, f"{key}_at_least")
    return [*(Column(name, partial(bounded, name)) for name in names), Column("", of, head, hours)]


def in_currency(head: str, currency: str | None) -> str:
    """Return the head of a column of costs with their currency, where it is named.

    Examples
    --------
    >>> in_currency("cost", "EUR"), in_currency("cost", None)
    ('cost, EUR', 'cost')
    """
    return f"{head}, {currency}" if currency else head


def csv_of(frame: "pd.DataFrame") -> str:
    """Return a table of pandas as the content of a file, with no text that a spreadsheet would calculate."""
    return "".join(csv_parts(frame))


def csv_parts(frame: "pd.DataFrame") -> Iterator[str]:
    """Give the content of that file in parts."""
    from pandas.api.types import is_numeric_dtype

    words = [str(name) for name, column in frame.items() if not is_numeric_dtype(column)]
    for number, part in enumerate(_parts(frame)):
        texts = {name: part[name].map(_no_formula) for name in words}
        yield part.assign(**texts).to_csv(index=False, header=number == 0, lineterminator="\n")


_PART = 10_000
"""Rows of a table that are made into text at a time: a million at once take gigabytes."""


def _parts(frame: "pd.DataFrame") -> "Iterator[pd.DataFrame]":
    for first in range(0, max(1, len(frame)), _PART):
        yield frame.iloc[first : first + _PART]


def frame_rows(frame: "pd.DataFrame") -> Iterator[dict[Any, Any]]:
    """Give the rows of a table of pandas, each by the names of its columns."""
    for part in _parts(frame):
        yield from part.to_dict("records")


def _no_formula(cell: Any) -> Any:
    """Return a cell with an apostrophe before what a spreadsheet would calculate (OWASP, "CSV Injection")."""
    if not isinstance(cell, str) or not cell.startswith(("=", "+", "-", "@", "\t", "\r")) or cell == "-":
        return cell
    try:
        float(cell)
    except ValueError:
        return f"'{cell}"
    return cell


def records_of(frame: "pd.DataFrame") -> list[dict[str, Any]]:
    """Return the rows of a table of pandas as JSON has them."""
    return [{str(name): plain(value) for name, value in row.items()} for row in frame_rows(frame)]


def plain(value: Any) -> Any:
    """Return a value as JSON has it.

    Examples
    --------
    >>> plain(math.nan), plain(2.5)
    (None, 2.5)
    """
    return None if isinstance(value, float) and not math.isfinite(value) else value


def table_of(rows: Iterable[Any]) -> "pd.DataFrame":
    """Return rows of plain values as pandas has them, None as nan in columns of numbers."""
    import pandas as pd

    table = pd.DataFrame(list(rows))
    # pandas takes a column of None alone for one of objects.
    empty = [name for name in table.columns if table[name].isna().all()]
    return table.astype(dict.fromkeys(empty, float))
