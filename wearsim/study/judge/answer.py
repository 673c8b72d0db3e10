"""Which law of wear a table of readings follows."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from typing import TYPE_CHECKING, Any

from wearsim.errors import Allowed, Range, check_ranges
from wearsim.readings.dated_rows import readings_file
from wearsim.report.public_answer import DrawnAnswer
from wearsim.runner.in_threads import Progress, silent
from wearsim.study.judge.model import PARTICLES, Judgement, judge_series
from wearsim.study.judge.series_file import read_series
from wearsim.study.judge.sheet import (
    constants_table,
    forecasts_table,
    judgement_files,
    judgement_json,
    judgement_text,
    laws_table,
    verdict,
)

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

_ALLOWED: dict[str, Allowed] = {"particles": Range(100, 20_000, whole=True)}


@dataclass(frozen=True, repr=False, eq=False)
class JudgementResult(DrawnAnswer):
    """Laws of wear, fitted to some of the readings and scored on the rest.

    Attributes
    ----------
    found : Judgement
        Readings and laws as objects, the best law first.
    data : str
        Name of the file of the readings; ``readings.csv`` for those in no file.
    """

    _tables = ("laws", "constants", "forecasts")

    found: Judgement
    data: str

    @property
    def title(self) -> str:
        """What was judged."""
        return self.data.removesuffix(".csv")

    @property
    def headline(self) -> str:
        """The preferred law, and whether it is good enough."""
        return verdict(self.found)

    @property
    def text(self) -> str:
        """What ``wearsim judge`` prints."""
        return judgement_text(self.found)

    @property
    def explained(self) -> str:
        """The text with every assumption and default."""
        return judgement_text(self.found, explain=True)

    @property
    def laws(self) -> "pd.DataFrame":
        """A row for each law and kind of scatter: its score, its bands, whether it is tied with the best."""
        return laws_table(self.found).frame()

    @property
    def constants(self) -> "pd.DataFrame":
        """Constants of all laws and their scatter: 5, 50 and 95 % points."""
        return constants_table(self.found)

    @property
    def forecasts(self) -> "pd.DataFrame":
        """Every reading beside the bands of the best law."""
        return forecasts_table(self.found)

    def _content(self) -> dict[str, Any]:
        return judgement_json(self.found, self.data)

    def pictures(self) -> "dict[str, Figure]":
        """Return the readings with the bands of the best law, beside the scores of all laws.

        Returns
        -------
        dict of matplotlib.figure.Figure
            ``judgement``.
        """
        from wearsim.study.judge.figure import judgement_figure

        return {"judgement": judgement_figure(self.found, self.title)}

    def _files(self) -> Mapping[str, str]:
        return judgement_files(self.found)


def judge(
    readings: "str | PathLike[str] | pd.DataFrame | Sequence[Mapping[str, Any]]",
    *,
    particles: int = PARTICLES,
    progress: Progress = silent,
) -> JudgementResult:
    """Fit every applicable law of wear to some of the readings, and score it on the rest.

    Parameters
    ----------
    readings : path, pandas.DataFrame or sequence of mapping
        Columns ``series``, one of ``cycles``, ``time_hours``, ``distance_km`` and ``distance_m``, one of
        ``wear_um``, ``wear_mm``, ``wear_mg`` and ``elongation_percent``, and what else is known. Without
        ``held_out`` the later half of each series is held out.
    particles : int
        Draws of the constants of each law, 100 to 20 000.
    progress : callable, optional
        Called with the fraction done, from 0 to 1.

    Returns
    -------
    JudgementResult
        ``laws``, ``constants`` and ``forecasts``.

    Raises
    ------
    CaseError
        What is wrong with the readings, by line and column.
    GeometryError
        ``particles`` is outside its range.

    Examples
    --------
    Wear of 2, 3 and 1.5 um a cycle, which goes on in proportion to the cycles:

    >>> import wearsim
    >>> rows = [
    ...     {"series": f"{rate}", "cycles": n, "wear_um": rate * n}
    ...     for rate in (2.0, 3.0, 1.5) for n in range(1, 7)
    ... ]
    >>> found = wearsim.judge(rows, particles=200)
    >>> found.headline
    'Archard is good enough: its bands hold the expected share of readings'
    """
    check_ranges("judge", {"particles": particles}, _ALLOWED)
    with readings_file(readings) as file:
        series, name = read_series(file), file.name
    return JudgementResult(judge_series(series, particles, progress=progress), name)
