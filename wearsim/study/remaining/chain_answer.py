"""The state of a chain from a table of readings."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from wearsim.quantities import grouped
from wearsim.report.public_answer import DrawnAnswer, table_of
from wearsim.study.remaining.chain_sheet import (
    chain_json,
    chain_text,
    interval_rows,
    reading_rows,
    write_chain,
)
from wearsim.study.remaining.chain_state import ChainState

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


@dataclass(frozen=True, repr=False, eq=False)
class ChainReadingsResult(DrawnAnswer):
    """The state of a chain and what is left of it, from all that was read.

    Attributes
    ----------
    found : ChainState
        Readings, distribution of the coefficient and quantiles as objects.
    """

    found: ChainState

    @property
    def title(self) -> str:
        """What the case is about."""
        return self.found.case.title

    @property
    def headline(self) -> str:
        """The hours that are left, and their interval."""
        low, _, middle, _, high = self.found.of("remaining_hours").values
        return f"{grouped(float(middle))} h left to the chain (90 %: {low:.4g} to {high:.4g} h)"

    @property
    def text(self) -> str:
        """What ``wearsim remaining`` prints."""
        return chain_text(self.found)

    @property
    def intervals(self) -> "pd.DataFrame":
        """A row for each quantity with its quantiles ``p05``, ``p25``, ``p50``, ``p75``, ``p95``."""
        return table_of(interval_rows(self.found))

    @property
    def readings(self) -> "pd.DataFrame":
        """Every reading as an elongation [%] beside its prediction."""
        return table_of(reading_rows(self.found))

    def tables(self) -> "dict[str, pd.DataFrame]":
        """Return intervals and readings.

        Returns
        -------
        dict of pandas.DataFrame
            ``intervals``, ``readings``.
        """
        return {"intervals": self.intervals, "readings": self.readings}

    def summary(self) -> dict[str, Any]:
        """Return the answer as ``wearsim remaining --json`` prints it.

        Returns
        -------
        dict
            Plain numbers, strings, lists and None; never nan.
        """
        return chain_json(self.found)

    def pictures(self) -> "dict[str, Figure]":
        """Return the readings with the bands of the elongation.

        Returns
        -------
        dict of matplotlib.figure.Figure
            By their names.
        """
        from wearsim.study.remaining.figure import chain_figure

        return {"readings": chain_figure(self.found)}

    def _write(self, place: Path) -> None:
        write_chain(self.found, place)
