"""When to replace chain and sprockets, and what that costs."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from typing import TYPE_CHECKING, Any, overload

from wearsim.case.model import Case
from wearsim.drive.case_input import CaseInput, loaded, with_table
from wearsim.drive.life import drive_life
from wearsim.drive.maintenance import DrivePlan, drive_plan
from wearsim.errors import Allowed, Range, check_ranges
from wearsim.readings.dated_rows import readings_file
from wearsim.readings.teeth_as_read import Teeth
from wearsim.report.answer_table import table_of
from wearsim.report.drive.plan_sheet import plan_files, plan_json, plan_text
from wearsim.report.public_answer import DrawnAnswer
from wearsim.runner.in_threads import Progress, silent
from wearsim.study.maintain.from_readings import year_plan
from wearsim.study.maintain.model import MaintenancePlan
from wearsim.study.maintain.model import maintain as compare_policies
from wearsim.study.maintain.sheet import maintenance_files, maintenance_json, maintenance_text
from wearsim.study.maintain.year_answer import YearPlanResult

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

_NESTED = ("parts", "schedule")

_ALLOWED: dict[str, Allowed] = {"error": Range(above=0.0), "teeth": ("case", "chain")}


@dataclass(frozen=True, repr=False, eq=False)
class MaintenanceResult(DrawnAnswer):
    """Policies of replacement side by side.

    Attributes
    ----------
    plan : MaintenancePlan or DrivePlan
        Of one sprocket, or of a whole drive.
    """

    _tables = ("policies", "tooth_counts", "parts", "schedule")

    plan: MaintenancePlan | DrivePlan

    @property
    def title(self) -> str:
        """What the case is about."""
        return self.plan.title if isinstance(self.plan, MaintenancePlan) else self.plan.drive.title

    @property
    def headline(self) -> str:
        """How many policies there are, and the number of the cheapest one."""
        found = self.summary()
        cheapest = (
            "no cost known" if found["cheapest"] is None else f"the cheapest in row {found['cheapest']}"
        )
        count = len(found["policies"])
        return f"{count} {'policy' if count == 1 else 'policies'}, {cheapest}"

    @property
    def text(self) -> str:
        """What ``wearsim maintain`` prints."""
        if isinstance(self.plan, MaintenancePlan):
            return maintenance_text(self.plan)
        return plan_text(self.plan)

    @property
    def explained(self) -> str:
        """The text with every assumption and default."""
        if isinstance(self.plan, MaintenancePlan):
            return maintenance_text(self.plan, explain=True)
        return plan_text(self.plan, explain=True)

    @property
    def policies(self) -> "pd.DataFrame":
        """A row for each policy: lives, chains, stops, cost."""
        return table_of(
            {key: value for key, value in row.items() if key not in _NESTED}
            for row in self.summary()["policies"]
        )

    @property
    def tooth_counts(self) -> "pd.DataFrame":
        """Numbers of teeth and links near those of one sprocket; empty of a whole drive."""
        return table_of(self.summary().get("tooth_counts", ()))

    @property
    def parts(self) -> "pd.DataFrame":
        """The parts that each policy of a whole drive takes; empty of one sprocket."""
        return self._nested("parts")

    @property
    def schedule(self) -> "pd.DataFrame":
        """The stops of each policy of a whole drive; empty of one sprocket."""
        return self._nested("schedule")

    def _nested(self, name: str) -> "pd.DataFrame":
        policies = self.summary()["policies"]
        return table_of({"policy": row["policy"], **one} for row in policies for one in row.get(name, ()))

    def _content(self) -> dict[str, Any]:
        return maintenance_json(self.plan) if isinstance(self.plan, MaintenancePlan) else plan_json(self.plan)

    def pictures(self) -> "dict[str, Figure]":
        """Return lives, chains and cost over the elongation at which the chain of one sprocket goes.

        Returns
        -------
        dict of matplotlib.figure.Figure
            ``maintenance``; of a whole drive the wear of its sprockets, ``history``.
        """
        if isinstance(self.plan, DrivePlan):
            return {"history": self.plan.found.plot_history()}
        from wearsim.study.maintain.figure import maintenance_figure

        return {"maintenance": maintenance_figure(self.plan)}

    def _files(self) -> Mapping[str, str]:
        if isinstance(self.plan, MaintenancePlan):
            return maintenance_files(self.plan)
        return plan_files(self.plan, self.explained)


@overload
def maintain(
    case: CaseInput,
    maintenance: Mapping[str, Any] | None = None,
    *,
    readings: "str | PathLike[str] | pd.DataFrame | Sequence[Mapping[str, Any]]",
    error: float = 0.05,
    teeth: Teeth = "case",
    progress: Progress = silent,
) -> YearPlanResult: ...


@overload
def maintain(
    case: CaseInput, maintenance: Mapping[str, Any] | None = None, *, progress: Progress = silent
) -> MaintenanceResult: ...


def maintain(
    case: CaseInput,
    maintenance: Mapping[str, Any] | None = None,
    *,
    readings: "str | PathLike[str] | pd.DataFrame | Sequence[Mapping[str, Any]] | None" = None,
    error: float = 0.05,
    teeth: Teeth = "case",
    progress: Progress = silent,
) -> MaintenanceResult | YearPlanResult:
    """Compare when to replace the chain and the sprockets of a chain drive, or plan a year from readings.

    Parameters
    ----------
    case : Case, DriveCase, path or mapping
        A chain that wraps a sprocket, or a whole drive.
    maintenance : mapping, optional
        Prices, elongations and whether the sprocket is turned, in place of the table
        ``[maintenance]`` of the case.
    readings : path, pandas.DataFrame or sequence of mapping, optional
        Log of the chain as for `remaining`, to plan the twelve months after its last row.
    error : float
        Standard deviation of readings that state none [%].
    teeth : str
        Of a plan from readings: ``case``, teeth wear as the case says, or ``chain``, as much faster or
        slower than that as the chain does by its readings.
    progress : callable, optional
        Called with the fraction done, from 0 to 1.

    Returns
    -------
    MaintenanceResult or YearPlanResult
        ``policies``, and ``tooth_counts`` of one sprocket or ``parts`` and ``schedule`` of a drive; with
        readings ``jobs`` and ``parts``.

    Raises
    ------
    CaseError
        The case has no chain that wraps a sprocket, or case or readings are wrong.
    GeometryError
        Error or teeth are outside their ranges.
    ContactError, ConvergenceError
        No policy can be run.
    """
    found = loaded(case if maintenance is None else with_table(case, "maintenance", maintenance))
    if readings is not None:
        check_ranges("maintain", {"error": error, "teeth": teeth}, _ALLOWED)
        with readings_file(readings) as file:
            return YearPlanResult(year_plan(found, file, teeth, error, progress))
    if isinstance(found, Case):
        found.drive.check(found)
        return MaintenanceResult(compare_policies(found, lambda done, of: progress(done / of)))
    return MaintenanceResult(drive_plan(drive_life(found, progress).complete()))
