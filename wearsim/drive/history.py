"""THE list of columns that the history of every run has: a new one is a row, and its name."""

from collections.abc import Callable

from wearsim.case.model import Case
from wearsim.geometry.profile_points import Vector
from wearsim.wear.trajectory import Trajectory

COLUMNS: dict[str, Callable[[Case, Trajectory], Vector]] = {
    "cycles": lambda case, run: run.cycles,
    "time_hours": lambda case, run: run.cycles / case.cycles_per_hour,
    "max_depth_mm": lambda case, run: run.every_depth.max(axis=(1, 2)),
}
"""The first columns of history.csv; those of one way of running follow them."""


def common_history(case: Case, run: Trajectory) -> dict[str, Vector]:
    """Return the columns of a history that follow from the worn flanks alone."""
    return {name: column(case, run) for name, column in COLUMNS.items()}
