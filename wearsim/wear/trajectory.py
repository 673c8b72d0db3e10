"""A flank as it wears: what both ways of running hand back."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from wearsim.contact.engagement import FlankContact
from wearsim.contact.stop_limits import StopLimit
from wearsim.errors import ContactError, ConvergenceError
from wearsim.geometry.profile_points import Profile, Vector
from wearsim.kernels.hertz_wear import sawtooth

SNAPSHOTS = 180
"""Worn flanks kept of one run, about."""


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Worn flanks over the cycles of a run."""

    cycles: Vector  # loading cycles, increasing from 0, shape (snapshots,)
    # x, y, depth: the flank at each of them [mm], shape (snapshots, points)
    x: Vector
    y: Vector
    depth: Vector
    met: StopLimit | None  # the limit that ended the run at the last of them; None where the horizon did
    updates: int  # evaluations of the wear rate

    @property
    def every_depth(self) -> Vector:
        """Depth of every body that wears [mm], shape (snapshots, bodies, points)."""
        return self.depth[:, None, :]


def compared(*runs: Trajectory) -> tuple[bool, list[float]]:
    """Return whether all runs met a limit, and their lives; else their depths where the shortest ends."""
    ends = [float(run.cycles[-1]) for run in runs]
    reached = all(run.met is not None for run in runs)
    return reached, ends if reached else [depth_at(run, min(ends)) for run in runs]


def difference(run: Trajectory, other: Trajectory) -> float:
    """Return the relative difference of two runs of one case."""
    _, (worn, others) = compared(run, other)
    if not worn > 0.0:  # a short run on a coarse grid wears nothing off
        return 0.0 if others == worn else math.inf
    return abs(others / worn - 1.0)


def depth_at(run: Trajectory, cycles: float) -> float:
    """Return the greatest depth after so many cycles of a run."""
    return float(np.interp(cycles, run.cycles, run.depth.max(axis=1)))


def check_touch(
    contact: FlankContact, x: Vector, y: Vector, depth: Vector, cycles: float, least: float = 0.0
) -> None:
    """Raise where the contact of a worn flank is outside Hertz's theory or gone."""
    touch = contact.engage(x, y, depth)
    pulling = ~(touch.load_per_width >= 0.0)
    if pulling.any():
        point = int(pulling.argmax())
        raise ContactError(
            f"contact at cycle {cycles:.6g}, {contact.arc_length[point]:.4g} mm from the root: the flank "
            f"must press on the {contact.mate} (pressure angle below 90 degrees), but is worn so far that it "
            "would pull there: move contact_end_mm away from the line of the pitch point, or stop at a "
            "smaller depth"
        )
    loaded = touch.load_per_width > 0.0
    if not loaded.any():
        deepest = contact.arc_length[int(depth.argmax())]
        raise ContactError(
            f"contact at cycle {cycles:.6g}, deepest {deepest:.4g} mm from the root: the {contact.mate} must "
            "touch the loaded stretch of the flank, but touches no point of it: check the contact range, "
            "or stop at a smaller depth"
        )
    conforming = loaded & ~(touch.relative_curvature > least)
    if conforming.any():
        point = int(conforming.argmax())
        raise ContactError(
            f"contact at cycle {cycles:.6g}, {contact.arc_length[point]:.4g} mm from the root: Hertz "
            f"needs a flank flatter than the {contact.mate} (1/rho_H > 0), but 1/rho_H is "
            f"{touch.relative_curvature[point]:.3g} 1/mm there: the flank conforms to the {contact.mate}; "
            "use a larger flank radius or a smaller critical depth"
        )


def no_sliding(cycles: float) -> ContactError:
    """Return the error of a flank that is loaded where nothing slides."""
    return ContactError(
        f"contact at cycle {cycles:.6g}: the loaded points must slide, but none does: without sliding "
        "there is no wear and no life"
    )


def check_fold(contact: FlankContact, run: Trajectory) -> None:
    """Raise where the worn flank crosses itself."""
    against = overturned(run.x, run.y)
    if against.any():
        shot, point = np.argwhere(against)[0]
        raise ConvergenceError(
            f"wear at cycle {run.cycles[shot]:.6g}, {contact.arc_length[point]:.4g} mm from the root: the "
            "worn flank must run the same way as the new one, but is worn beyond its centre of "
            "curvature there: stop at a smaller critical_depth_mm"
        )
    if Profile(run.x[-1], run.y[-1]).is_simple:
        return
    for cycles, x, y in zip(run.cycles, run.x, run.y, strict=True):
        flank = Profile(x, y)
        if not flank.is_simple:
            raise ConvergenceError(
                f"wear at cycle {cycles:.6g}, {contact.arc_length[flank.crossing]:.4g} mm from the root: "
                "the worn flank must not cross itself, but does: stop at a smaller critical_depth_mm"
            )


def folds(runs: Sequence[Trajectory]) -> list[bool]:
    """Return of each run whether the flank in the end crosses itself or is turned over."""
    if not runs:
        return []
    ends = shapely.linestrings([np.stack([run.x[-1], run.y[-1]], axis=1) for run in runs])
    turned = [bool(overturned(run.x, run.y).any()) for run in runs]
    return [over or not simple for over, simple in zip(turned, shapely.is_simple(ends), strict=True)]


def overturned(x: Vector, y: Vector) -> NDArray[np.bool_]:
    """Return where a piece between two points runs against that of the new flank."""
    dx, dy = np.diff(x, axis=1), np.diff(y, axis=1)
    against: NDArray[np.bool_] = dx * dx[0] + dy * dy[0] <= 0.0
    return against


def check_sawtooth(contact: FlankContact, depth: Vector, cycles: float, depth_limit: float) -> None:
    """Raise where the depth alternates from point to point, the mark of an unstable run.

    The second difference over one spacing is compared with that over two, which an
    alternating depth does not enter.
    """
    point = sawtooth(np.ascontiguousarray(depth), depth_limit)
    if point < 0:
        return
    place = f"wear at cycle {cycles:.6g}, {contact.arc_length[point]:.4g} mm from the root"
    touch = contact.new_engagement()
    given = touch.load_per_width * touch.slip
    if sawtooth(given * (depth.max() / given.max()), depth_limit) >= 0:
        raise ConvergenceError(
            f"{place}: load times sliding of the new flank must vary smoothly along it, but alternates "
            "from point to point, and so does the depth: smooth the table of loads, or give it more rows"
        )
    raise ConvergenceError(
        f"{place}: the depth must vary smoothly along the flank, but alternates from point to point, so "
        'the run is unstable: take fewer cycles_per_update or method = "advance"'
    )
