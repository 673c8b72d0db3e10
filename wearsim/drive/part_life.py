"""The one place that wires case, mechanism, wear engine and result."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from wearsim.case.model import Case
from wearsim.result import WearResult

if TYPE_CHECKING:
    from wearsim.wear.accuracy import GridStudy
    from wearsim.wear.mate_clock import LubricatedClock

__all__ = ["simulate", "verify_grid"]

_TIGHTER, _TIGHTEST = 1e-2, 1e-7
"""On the tolerance of a life whose grids are compared: steps must not hide them; its least."""


def simulate(case: Case, progress: Callable[[float], None] = lambda part: None) -> WearResult:
    """Wear the sprocket of a case until its first limit, as the public `wearsim.simulate` does."""
    case.drive.check(case)
    if case.drive.rests:
        from wearsim.drive.wrap_life import simulate_wrap
        from wearsim.result.kept_runs import kept_or_run

        return kept_or_run(case, lambda: simulate_wrap(case, progress))
    from wearsim.drive.pointwise import simulate_points

    return simulate_points(case, progress)


def verify_grid(case: Case) -> "GridStudy":
    """Run a case on three grids, of all, half and a quarter of its points."""
    tolerance = case.run.life_tolerance
    if case.drive.rests:
        from wearsim.drive.wrap_life import wrap_grid_study

        return wrap_grid_study(case, tolerance)
    from wearsim.drive.pointwise import points_grid_study

    return points_grid_study(case, max(_TIGHTER * tolerance, _TIGHTEST))


def case_clock(case: Case) -> "LubricatedClock":
    """Return the clock of the wear of a case, in its cycles, without a run."""
    if case.drive.rests:
        from wearsim.drive.wrap_life import wrap_of, wrap_task

        return wrap_task(case, wrap_of(case).contact(case)).clock
    from wearsim.drive.wear_task import wear_task

    return wear_task(case, case.drive.mechanism(case).contact).clock


def new_peak_pressure(case: Case) -> float:
    """Return the highest pressure of a case on its new flanks, without a run."""
    from wearsim.drive.wear_task import new_flank_pressure, wear_law

    if case.drive.rests:
        from wearsim.drive.wrap_life import wrap_of
        from wearsim.wear.resting_bodies import highest_load

        law = wear_law(case.wear, case.wear.coefficient)
        return highest_load(wrap_of(case).contact(case), law, None)[0]
    return new_flank_pressure(case.drive.mechanism(case).contact)
