"""The plan of the next twelve months as Python has it."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from wearsim.report.public_answer import DrawnAnswer
from wearsim.study.maintain.from_readings import YearPlan
from wearsim.study.maintain.year_plan import REPLACE
from wearsim.study.maintain.year_sheet import jobs_table, parts_table, year_files, year_json, year_text

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


@dataclass(frozen=True, repr=False, eq=False)
class YearPlanResult(DrawnAnswer):
    """What to do in the twelve months after the last reading of a chain.

    Attributes
    ----------
    plan : YearPlan
        Parts, jobs and prices as objects.
    """

    _tables = ("jobs", "parts")

    plan: YearPlan

    @property
    def title(self) -> str:
        """What the case is about."""
        return self.plan.state.case.title

    @property
    def headline(self) -> str:
        """How many stops there are."""
        stops = sum(job.job == REPLACE for job in self.plan.jobs)
        return f"{stops} {'stop' if stops == 1 else 'stops'} in the next 12 months"

    @property
    def text(self) -> str:
        """What ``wearsim maintain`` prints with readings."""
        return year_text(self.plan)

    @property
    def explained(self) -> str:
        """The same with all assumptions."""
        return year_text(self.plan, explain=True)

    @property
    def jobs(self) -> "pd.DataFrame":
        """A row for each job, and for each part that is kept."""
        return jobs_table(self.plan).frame()

    @property
    def parts(self) -> "pd.DataFrame":
        """A row for each part: its life, and how much of it is used."""
        return parts_table(self.plan).frame()

    def _content(self) -> dict[str, Any]:
        return year_json(self.plan)

    def pictures(self) -> "dict[str, Figure]":
        """Return no picture: `wearsim.remaining` draws the readings.

        Returns
        -------
        dict of matplotlib.figure.Figure
            Empty.
        """
        return {}

    def _files(self) -> Mapping[str, str]:
        return year_files(self.plan, self.explained)
