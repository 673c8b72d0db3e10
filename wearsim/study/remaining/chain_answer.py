"""The state of a chain from a table of readings."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from wearsim.quantities import grouped
from wearsim.readings.chain_state import ChainState
from wearsim.report.public_answer import DrawnAnswer
from wearsim.study.remaining.chain_sheet import (
    chain_files,
    chain_json,
    chain_text,
    chains_table,
    intervals_table,
    readings_table,
)

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

    _tables = ("intervals", "readings", "chains")

    found: ChainState

    @property
    def title(self) -> str:
        """What the case is about."""
        return self.found.case.title

    @property
    def headline(self) -> str:
        """The hours that are left, and their interval."""
        low, _, middle, _, high = (grouped(float(one)) for one in self.found.of("remaining_hours").values)
        return f"{middle} h left to the chain (90 %: {low} to {high} h)"

    @property
    def text(self) -> str:
        """What ``wearsim remaining`` prints."""
        return chain_text(self.found)

    @property
    def explained(self) -> str:
        """The text with every assumption and default."""
        return chain_text(self.found, explain=True)

    @property
    def intervals(self) -> "pd.DataFrame":
        """A row for each quantity with its quantiles ``p05``, ``p25``, ``p50``, ``p75``, ``p95``."""
        return intervals_table(self.found).frame()

    @property
    def readings(self) -> "pd.DataFrame":
        """Every reading as an elongation [%] beside its prediction."""
        return readings_table(self.found).frame()

    @property
    def chains(self) -> "pd.DataFrame":
        """Every chain in rotation: its running time, elongation and hours left; empty of a single chain."""
        return chains_table(self.found).frame()

    def _content(self) -> dict[str, Any]:
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

    def _files(self) -> Mapping[str, str]:
        return chain_files(self.found)
