"""On which points a life is found: those of the case, and better ones where its error is too large."""

from collections.abc import Generator, Sequence
from dataclasses import dataclass, replace

from wearsim.contact.engagement import FlankContact, Mechanism
from wearsim.drive.wear_task import WearTask
from wearsim.wear.accuracy import depth_missed, exceeds, grid_error
from wearsim.wear.trajectory import Trajectory, difference

LEVELS = 2
"""Times that a flank is refined at most."""

_REFINED = 1.75
"""On the error by the grid of a refined flank: with fine ends less of it is of first order."""


@dataclass(frozen=True, eq=False)
class FlankRun:
    """What came of a flank on one grid."""

    task: WearTask[FlankContact]
    trajectory: Trajectory  # over the cycles of the case
    step_error: float

    @property
    def spacing(self) -> float:
        """Spacing of its points at the ends [mm]."""
        return self.task.contact.end_spacing

    @property
    def own_error(self) -> float:
        """Relative error by its steps and by what lies between its points."""
        run = self.trajectory
        return self.step_error + depth_missed(run.x[-1], run.y[-1], run.depth[-1])

    def change(self, other: "FlankRun") -> float:
        """Return the relative difference to the life, or to the depth at the horizon, of another."""
        return difference(self.trajectory, other.trajectory)


@dataclass(frozen=True, eq=False)
class SettledLife:
    """A life on the points that tell it best."""

    mechanism: Mechanism  # with the new flank on these points
    run: FlankRun  # what came of it
    # relative error by steps and grid; 1 where no other grid has a life to compare with
    error: float
    points: int  # of the flank as the case gives it
    first_error: float  # of the flank as the case gives it
    level: int  # times that it was refined
    is_compared: bool  # whether another grid has a life

    @property
    def _taken(self) -> int:
        return int(self.mechanism.contact.profile.x.size)

    def assumptions(self) -> tuple[str, ...]:
        """Return what was done for the tolerance."""
        if not self.level:
            return ()
        return (
            f"points of the flank: {self._taken}, chosen for the tolerance; with the {self.points} of the "
            f"case the numerical error would be {self.first_error:.1g}",
        )

    def warnings(self, tolerance: float) -> list[str]:
        """Return that the error exceeds a tolerance, if it does, and what to do."""
        if not self.is_compared:
            return ["the grid error could not be estimated, 100 % is stated"]
        if self.error <= tolerance:
            return []
        cure = "use more points (nodes, or rows of the table of loads)"
        if self.level:
            cure = (
                f"with the flank refined to {self._taken} points: use more nodes, or a larger "
                "run.life_tolerance"
            )
        joint = ", even" if self.level else ":"
        return [f"{exceeds(self.error, tolerance)}{joint} {cure}"]


GridSearch = Generator[list[FlankContact], Sequence[FlankRun | None], SettledLife]
"""Yields flanks to wear, is sent what came of them, and returns the life."""


def settle_grid(mechanism: Mechanism, tolerance: float, levels: int) -> GridSearch:
    """Find on which points a life is within its tolerance.

    A generator, so that flanks may be worn one by one or in batches: it yields those to wear
    next, and is sent what came of them.
    """
    run, *more = yield [mechanism.contact, *mechanism.other_grids()]
    assert run is not None
    others = [other for other in more if other is not None]
    error = _error(run, others) * (1.0 if len(others) == len(more) else 2.0)
    error = min(1.0, run.own_error + error) if others else 1.0
    points = int(mechanism.contact.profile.x.size)
    best = SettledLife(mechanism, run, error, points, error, 0, bool(others))
    for level in range(1, levels + 1):
        finer = mechanism.refined(level)
        if best.error <= tolerance or not others or finer is None:
            break
        [better] = yield [finer.contact]
        if better is None:
            # The next one may have a life: this one may be too coarse for its fine ends.
            continue
        others.append(run)
        run = better
        error = run.own_error + _REFINED * _error(run, others)
        if error < best.error:
            best = replace(best, mechanism=finer, run=run, error=error, level=level)
    return best


def _error(run: FlankRun, others: list[FlankRun]) -> float:
    return grid_error(run.spacing, ((other.spacing, run.change(other)) for other in others))
