"""The production run: equation (10) as d(state)/dN = f(state), by an implicit solver.

The state is the cycle loop's: the way of every point along its current normal, and the
depth summed on that way. It obeys a parabolic equation, so explicit jumps over many
cycles are either wrong or slow. LSODA with the banded Jacobian of the three-point
curvature is stable on any grid and takes steps as long as the tolerance allows. The
wear coefficient is a factor of the cycle count, so the run is made with coefficient 1
and scaled: life times coefficient is constant to rounding.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.integrate import LSODA, DenseOutput

from wearsim.contact.dwelling import Dwelling
from wearsim.contact.engagement import Contact
from wearsim.errors import ContactError, ConvergenceError
from wearsim.geometry.profile import Vector
from wearsim.kernels.flank import flank_frame
from wearsim.kernels.wear import soften, wear_depth
from wearsim.wear.criteria import Criterion, first_met
from wearsim.wear.law import Law
from wearsim.wear.trajectory import SNAPSHOTS, Trajectory, check_sawtooth, check_touch

_BAND = 8
"""Way in x, way in y and depth of a point reach those of two points on (at the ends)."""

_LOOSEST, _TIGHTEST = 1e-6, 0.9e-10
"""Relative tolerances of the solver per step tried on the way to the asked tolerance of the life."""


_MOST_STEPS = 20_000
"""Steps of one solve; a life takes some hundreds."""


@dataclass(frozen=True, eq=False)
class _Flank:
    """Points and depth of a worn flank [mm]."""

    x: Vector
    y: Vector
    depth: Vector


class _Rate:
    """Rate of the state per cycle and unit coefficient."""

    def __init__(self, contact: Contact, law: Law) -> None:
        self.contact = contact
        self.law = replace(law, coefficient=1.0).numbers(contact.kind)
        points = contact.profile.x.size
        self.frame, self.touch = np.empty((4, points)), np.empty((4, points))
        self.pressure, self.step = np.empty(points), np.empty(points)
        self.calls = 0

    def flank(self, state: Vector) -> _Flank:
        way_x, way_y, depth = np.ascontiguousarray(state.reshape(-1, 3).T)
        return _Flank(self.contact.profile.x + way_x, self.contact.profile.y + way_y, depth)

    def __call__(self, time: float, state: Vector) -> Vector:
        self.calls += 1
        contact, flank = self.contact, self.flank(state)
        flank_frame(flank.x, flank.y, *self.frame)
        normal_x, normal_y, curvature = self.frame[:3]
        contact.kernel(
            flank.x, flank.y, normal_x, normal_y, curvature, flank.depth, contact.constants,
            contact.columns, *self.touch,
        )  # fmt: skip
        load, slip, speed, relative = self.touch
        # A trial of the solver may conform where the solution does not; accepted steps are checked.
        np.maximum(relative, 1e-6 / contact.roller_radius, out=relative)
        wear_depth(load, slip, speed, relative, contact.modulus, self.law, self.pressure, self.step)
        soften(flank.depth, self.law, self.step)
        rate = np.empty((self.step.size, 3))
        rate[:, 0] = -self.step * normal_x
        rate[:, 1] = -self.step * normal_y
        rate[:, 2] = self.step
        return rate.ravel()


@dataclass(frozen=True, eq=False)
class _Solution:
    """Dense output of one solve, in cycles times coefficient."""

    end: float
    pieces: list[DenseOutput]
    starts: Vector
    met: Criterion | None

    def __call__(self, time: float) -> Vector:
        piece = int(np.searchsorted(self.starts, time, side="right")) - 1
        state: Vector = self.pieces[max(piece, 0)](time)
        return state


def _first_below(margin: Callable[[float], float], low: float, high: float) -> float:
    """Time at which a margin positive at low and not at high has vanished, to rounding."""
    while True:
        middle = 0.5 * (low + high)
        if not low < middle < high:
            return high
        low, high = (middle, high) if margin(middle) > 0.0 else (low, middle)


def _solve(
    rate: _Rate,
    coefficient: float,
    criteria: tuple[Criterion, ...],
    horizon: float,
    tolerance: float,
) -> _Solution:
    contact, depth_limit = rate.contact, criteria[0].limit
    state = np.zeros(3 * contact.profile.x.size)
    fastest = float(rate(0.0, state).max())
    if not fastest > 0.0:
        raise ContactError(
            "contact at cycle 0: the loaded points must slide, but none does: without sliding there "
            "is no wear and no life"
        )
    solver = LSODA(
        rate, 0.0, state, np.inf, first_step=1e-4 * depth_limit / fastest, rtol=tolerance,
        atol=tolerance * depth_limit, lband=_BAND, uband=_BAND,
    )  # fmt: skip
    pieces: list[DenseOutput] = []
    starts: list[float] = []
    met = None
    while met is None and solver.t < horizon:
        message = solver.step()
        cycles = solver.t / coefficient
        if (
            solver.status != "running"
            or len(pieces) > _MOST_STEPS
            or not np.isfinite(solver.y).all()
        ):
            place = contact.arc_length[_fastest(rate, solver.y)]
            raise ConvergenceError(
                f"wear at cycle {cycles:.6g}, {place:.4g} mm from the root: the solver must be able to go "
                "on, but stopped"
                f'{f" ({message})" if message else ""}: use method = "per_cycle" or more nodes'
            )
        met = _met(rate, criteria, solver.y)
        if met is None:
            _check(rate, solver.y, cycles, depth_limit)
        pieces.append(solver.dense_output())
        starts.append(float(solver.t_old or 0.0))
    return _ended(rate, criteria, horizon, pieces, np.array(starts), float(solver.t), met)


def _fastest(rate: _Rate, state: Vector) -> int:
    """Return the point whose depth is not a number, else the one that wears fastest."""
    depth = state[2::3]
    if not np.isfinite(depth).all():
        return int(np.argmin(np.isfinite(depth)))
    return int(np.nan_to_num(rate(0.0, state)[2::3]).argmax())


def _check(rate: _Rate, state: Vector, cycles: float, depth_limit: float) -> None:
    flank = rate.flank(state)
    check_touch(rate.contact, flank.x, flank.y, flank.depth, cycles)
    check_sawtooth(rate.contact, flank.depth, cycles, depth_limit)


def _met(rate: _Rate, criteria: tuple[Criterion, ...], state: Vector) -> Criterion | None:
    flank = rate.flank(state)
    return first_met(criteria, flank.x, flank.y, flank.depth)


def _ended(
    rate: _Rate, criteria: tuple[Criterion, ...], horizon: float,
    pieces: list[DenseOutput], starts: Vector, reached: float, met: Criterion | None,
) -> _Solution:  # fmt: skip
    """Cut the last step at the first limit met in it, or at the horizon."""
    if met is None:
        return _Solution(min(horizon, reached), pieces, starts, None)

    def least(time: float) -> float:
        flank = rate.flank(pieces[-1](time))
        return min(criterion.margin(flank.x, flank.y, flank.depth) for criterion in criteria)

    end = _first_below(least, float(starts[-1]), reached)
    if end > horizon:
        return _Solution(horizon, pieces, starts, None)
    return _Solution(end, pieces, starts, _met(rate, criteria, pieces[-1](end)))


def _progress(solution: _Solution) -> float:
    """What two solves are compared by: the life, or the depth at the horizon."""
    return solution.end if solution.met else float(solution(solution.end)[2::3].max())


def run_advance(
    contact: Contact | Dwelling,
    law: Law,
    criteria: tuple[Criterion, ...],
    horizon: float,
    life_tolerance: float,
) -> tuple[Trajectory, float]:
    """Wear a flank with step control until a criterion is met or the horizon is reached.

    The solve is repeated with a tenth of the solver's tolerance until two successive
    lives differ by less than a tenth of the asked tolerance. A contact error counts only
    where the tightest solve meets it too.

    Parameters
    ----------
    contact : Contact or Dwelling
        The flank and its contact.
    law : Law
        The wear law.
    criteria : tuple of Criterion
        Limits, the depth criterion first.
    horizon : float
        Loading cycles at which the run ends in any case.
    life_tolerance : float
        Relative tolerance of the life.

    Returns
    -------
    tuple of Trajectory and float
        The run, and the relative difference of its last two solves.

    Raises
    ------
    ConvergenceError
        The tolerance cannot be met, or the depth alternates from point to point.
    ContactError
        The flank conforms to the roller, or the contact is gone.
    """
    if not isinstance(contact, Contact):
        # Its kernels compile where it is imported for the first time.
        from wearsim.wear.halving import advance_dwelling

        return advance_dwelling(contact, law, criteria, horizon, life_tolerance)
    rate = _Rate(contact, law)
    profile = contact.profile
    check_touch(contact, profile.x.copy(), profile.y.copy(), np.zeros(profile.x.size), 0.0)
    tolerance, change = min(_LOOSEST, 1e-2 * life_tolerance), math.inf
    before, failure = None, None
    while tolerance >= _TIGHTEST:
        try:
            after = _solve(rate, law.coefficient, criteria, horizon * law.coefficient, tolerance)
        except ContactError as error:
            # Loose steps may run past what the flank itself never does; tighter ones decide.
            before, failure = None, error
        else:
            if before is not None and before.met == after.met:
                change = abs(_progress(after) / _progress(before) - 1.0)
                if change <= 0.1 * life_tolerance:
                    return _trajectory(rate, after, law.coefficient), change
            before = after
        tolerance *= 0.1
    if before is None and failure is not None:
        raise failure
    raise ConvergenceError(
        f"wear: two solves must agree on the life within {0.1 * life_tolerance:.1g}, but differ by "
        f"{change:.1g} even at the tightest step tolerance: ask a larger life_tolerance"
    )


def _trajectory(rate: _Rate, solution: _Solution, coefficient: float) -> Trajectory:
    times = np.linspace(0.0, solution.end, SNAPSHOTS + 1)
    flanks = [rate.flank(solution(time)) for time in times]
    for time, flank in zip(times, flanks, strict=True):
        check_touch(rate.contact, flank.x, flank.y, flank.depth, time / coefficient)
    profile = rate.contact.profile
    flanks[0] = _Flank(profile.x, profile.y, np.zeros(profile.x.size))
    return Trajectory(
        cycles=times / coefficient,
        x=np.array([flank.x for flank in flanks]),
        y=np.array([flank.y for flank in flanks]),
        depth=np.array([flank.depth for flank in flanks]),
        met=solution.met,
        updates=rate.calls,
    )
