"""When to lubricate again, and which lubricant pays."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from wearsim.drive.case_input import CaseInput, loaded
from wearsim.quantities import grouped
from wearsim.report.answer_table import csv_of, table_of
from wearsim.report.public_answer import DrawnAnswer
from wearsim.runner.in_threads import Progress, silent
from wearsim.study.lubricate.model import LubricationStudy
from wearsim.study.lubricate.runs import compare_intervals
from wearsim.study.lubricate.sheet import lubrication_json, lubrication_text, policy_rows

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


@dataclass(frozen=True, repr=False, eq=False)
class LubricationResult(DrawnAnswer):
    """Intervals between relubrications side by side, for one lubricant or several.

    Attributes
    ----------
    study : LubricationStudy
        Lubricants, their intervals, the cheapest one.
    """

    _tables = ("intervals", "lubricants")

    study: LubricationStudy

    @property
    def title(self) -> str:
        """What the case is about."""
        return self.study.title

    @property
    def headline(self) -> str:
        """The cheapest interval and its lubricant."""
        best = self.study.cheapest
        if best is None or best.cheapest is None:
            return "no cheapest interval known"
        name = f" with {best.name}" if best.name else ""
        when = "all the time" if best.supplied else f"every {grouped(best.cheapest.interval)} h"
        return f"cheapest {when}{name}"

    @property
    def text(self) -> str:
        """What ``wearsim lubricate`` prints."""
        return lubrication_text(self.study)

    @property
    def explained(self) -> str:
        """The text with every assumption and default."""
        return lubrication_text(self.study, explain=True)

    @property
    def intervals(self) -> "pd.DataFrame":
        """A row for each lubricant and interval: lives with their bands, cost per 1000 h."""
        return table_of(policy_rows(self.study))

    @property
    def lubricants(self) -> "pd.DataFrame":
        """A row for each lubricant: how long it lasts, the cheapest interval, what a missed one costs."""
        return table_of(self._content()["lubricants"])

    def _content(self) -> dict[str, Any]:
        return lubrication_json(self.study)

    def pictures(self) -> "dict[str, Figure]":
        """Return lives and cost over the interval.

        Returns
        -------
        dict of matplotlib.figure.Figure
            ``lubrication``.
        """
        from wearsim.study.lubricate.figure import lubrication_figure

        return {"lubrication": lubrication_figure(self.study)}

    def _files(self) -> Mapping[str, str]:
        return {"intervals.csv": csv_of(self.intervals), "lubrication.txt": f"{self.text}\n"}


def lubricate(case: CaseInput, *, progress: Progress = silent) -> LubricationResult:
    """Compare intervals between relubrications: lives of the parts, and cost per 1000 h.

    Parameters
    ----------
    case : Case, DriveCase, path or mapping
        With a ``[lubrication]`` that says how long the lubricant lasts. Other lubricants stand in
        ``[[lubrication.option]]``, prices in both and in ``[maintenance]``.
    progress : callable, optional
        Called with the fraction done, from 0 to 1.

    Returns
    -------
    LubricationResult
        ``intervals`` and ``lubricants``.

    Raises
    ------
    CaseError
        The case has no lubricant that ages, or a programme of its own.
    ContactError, ConvergenceError
        A lubricant's life cannot be run.

    Examples
    --------
    100 h at the wear of well lubricated contacts, then 50 h dry at four times that: 300 h of wear in 150 h.

    >>> import wearsim
    >>> found = wearsim.lubricate({
    ...     "format_version": 1,
    ...     "chain": {"designation": "16B-1"},
    ...     "sprocket": {"teeth": 20, "profile": "evolute"},
    ...     "load": {"power_kW": 3, "speed_rpm": 100},
    ...     "wear": {"condition": "hardened, oiled"},
    ...     "lubrication": {"lasts_hours": 100.0, "dry_factor": 4.0, "interval_hours": 150.0},
    ... })
    >>> round(found.study.plans[0].own.wear_factor, 12)
    2.0
    """
    return LubricationResult(compare_intervals(loaded(case), progress))
