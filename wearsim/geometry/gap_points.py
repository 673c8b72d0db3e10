"""A whole gap as one smooth outline: through points, or around an evolute flank."""

import math
from collections.abc import Callable
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from wearsim.errors import GeometryError
from wearsim.geometry.profile_points import Profile, Vector
from wearsim.geometry.tooth import Tooth

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

FEWEST_POINTS = 24

ON_CENTRE_LINE = 1e-3
"""Distance [mm] from the centre line within which a half outline counts as starting on it."""

_SCATTERED = 0.1
"""Part of the reach of a gap to one side within which points on the other side are scatter."""

_SHARPEST_TURN = 0.1
_SEARCH_KNOTS = 12
_MAX_JOINTS = 10
_LEAST_NOISE = 2e-5
_LEAST_BETWEEN = 6
_NO_FIT = 1e12
_MAX_POINTS = 1000


def gap_from_points(x: ArrayLike, y: ArrayLike, noise: float, nodes: int, roller_radius: float) -> Profile:
    """Return a smooth outline of a whole gap through points known within a noise.

    A quintic spline over the chord length, fitted by least squares. Where arcs and lines
    meet, the curvature jumps: such joints are searched one by one, and kept where they
    lower n log(sum of squared residuals + n noise^2) by more than they add to
    9 log(2 n), their share of the Bayesian information criterion; there the spline's
    tangent is continuous and its curvature is not. Between joints it gets as few knots as
    the same criterion asks for. Corners sharper than 0.1 rad stay corners.

    Examples
    --------
    Half a turn of radius 5 mm around (0, 30), of which the roller touches the bottom:

    >>> turn = np.linspace(0.0, np.pi, 201)
    >>> gap = gap_from_points(5.0 * np.cos(turn), 30.0 - 5.0 * np.sin(turn), 0.0, 101, 4.0)
    >>> round(1.0 / float(gap.curvature[50]), 2), round(float(gap.y[50]), 4)
    (-5.0, 25.0)
    """
    points = _whole_outline(np.asarray(x, dtype=float), np.asarray(y, dtype=float), noise)
    points, noise = _thinned(points, noise)
    chord = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    spline = _JointedSpline(points, chord, noise).spline()
    fine = np.linspace(0.0, chord[-1], 20 * nodes + 1)
    speed = np.hypot(*spline.derivative()(fine).T)
    arc = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(fine))])
    profile = Profile(*spline(np.interp(np.linspace(0.0, arc[-1], nodes), arc, fine)).T)
    if not profile.is_simple:
        raise GeometryError(
            "gap points: the outline must not cross itself, but does: check the order of the points"
        )
    _check_roller(profile, roller_radius)
    return profile


def lowest_centre(x: Vector, y: Vector, roller_radius: float) -> tuple[float, float]:
    """Return where the centre of a roller lies that was lowered into a gap as far as it goes.

    On the line of abscissa x the centre stops at max_j(y_j + sqrt(r^2 - (x - x_j)^2)); the
    lowest of these between the tips is searched by narrowing a grid.

    Examples
    --------
    A roller of radius 5 on two corners that are 8 apart: sqrt(25 - 16) above them.

    >>> corners = np.array([4.0, 0.0, -4.0]), np.array([30.0, 20.0, 30.0])
    >>> [round(value, 6) + 0.0 for value in lowest_centre(*corners, 5.0)]
    [0.0, 33.0]
    """
    low, high = float(min(x[0], x[-1])), float(max(x[0], x[-1]))
    while True:
        across = np.linspace(low, high, 201)
        heights = np.array([_stop(x, y, roller_radius, at).max() for at in across])
        best = int(heights.argmin())
        low, high = float(across[max(best - 1, 0)]), float(across[min(best + 1, 200)])
        if high - low < 1e-9 * roller_radius:
            return float(across[best]), float(heights[best])


def evolute_gap(tooth: Tooth, pitch: float, nodes: int) -> Profile:
    """Return the gap around an evolute flank, moved out until it seats the roller.

    On a chain that wraps the sprocket the rollers lie on the pitch circle, not on the
    straight strand: the gap is moved along its centre line until the lowest centre that a
    roller in it can take lies on the radius p / (2 sin(p / (2 R))), R the radius of the
    centrode; that is p / (2 sin(pi / z)) where every gap carries a roller.

    Equation physics.md (W1), for where it is seated.

    Parameters
    ----------
    tooth : Tooth
        Working flank, seat and back flank around a strand.
    pitch : float
        Pitch of the chain p [mm].
    nodes : int
        Points of the result, at equal steps of arc length.

    Returns
    -------
    Profile
        Outline from the tip of the back flank on the right to the tip of the working flank.

    Raises
    ------
    GeometryError
        No seat clears the roller.
    """
    back, flank = tooth.back_flank, tooth.flank
    pieces = (np.column_stack([back.x, back.y]), tooth.seat[::-1], np.column_stack([flank.x, flank.y]))
    dense = np.concatenate([_through(piece, 20 * nodes) for piece in pieces])
    centre_x, centre_y = lowest_centre(dense[::5, 0], dense[::5, 1], tooth.strand.roller_radius)
    pitch_radius = 0.5 * pitch / math.sin(0.5 * pitch / tooth.strand.centrode_radius)
    rise = math.sqrt(pitch_radius**2 - centre_x**2) - centre_y
    x, y = _at_equal_steps(dense, nodes).T
    return Profile(x, y + rise)


def _whole_outline(x: Vector, y: Vector, noise: float) -> Vector:
    """Points from the right tip to the left one, of which a half is mirrored."""
    if x.ndim != 1 or x.shape != y.shape or x.size < FEWEST_POINTS:
        raise GeometryError(
            f"gap points: at least {FEWEST_POINTS} points with as many x as y are needed, got {x.size} x "
            f"and {y.size} y: give more points, in a drawing arcs or shorter lines"
        )
    if not (np.isfinite(x).all() and np.isfinite(y).all()):
        raise GeometryError("gap points: every coordinate must be finite: remove nan and inf")
    if not y.min() > 0.0:
        raise GeometryError(
            "gap points: the gap must lie above the sprocket's centre at the origin, but y goes down to "
            f"{y.min():.4g} mm: move the points"
        )
    near = max(ON_CENTRE_LINE, 3.0 * noise)
    beside = x[np.abs(x) > near]
    side = np.sign(beside)
    crossings = int(np.count_nonzero(np.diff(side)))
    if crossings == 0 and side.size and abs(x[0]) <= near:
        start = int(np.flatnonzero(np.abs(x) <= near)[-1])
        half = np.column_stack([np.abs(x[start:]), y[start:]])
        half[0, 0] = 0.0
        return np.concatenate([half[::-1], half[1:] * [-1.0, 1.0]])
    _check_crossing(x, near, beside, crossings)
    apart = np.concatenate([[True], np.hypot(np.diff(x), np.diff(y)) > 0.0])
    return np.column_stack([x[apart], y[apart]])


def _check_crossing(x: Vector, near: float, beside: Vector, crossings: int) -> None:
    """Raise where the points are neither a whole gap from right to left nor half of one from its bottom."""
    if crossings == 0:
        if abs(x[-1]) <= near:
            raise GeometryError(
                "gap points: half a gap must run from the centre line x = 0 to a tip, but ends at "
                f"x = {x[-1]:.4g} mm: reverse the order of the points"
            )
        raise GeometryError(
            "gap points: the outline must cross the centre line x = 0 or start on it, but keeps "
            f"{np.abs(x).min():.4g} mm away: add the seat, or give a whole gap"
        )
    if (scatter := _scatter_across(beside)) is not None:
        raise GeometryError(
            "gap points: the outline must cross the centre line x = 0 once, but its points scatter by "
            f"{scatter:.4g} mm to both sides: give points_noise_mm = {_rounded_up(scatter / 3.0)} or more"
        )
    if crossings > 1:
        raise GeometryError(
            f"gap points: the outline must cross the centre line x = 0 once, but does {crossings} times: "
            "give one gap, from tip to tip"
        )
    if beside[0] < 0.0:
        raise GeometryError(
            "gap points: the outline must run from the right flank (x > 0) to the left one, but starts at "
            f"x = {x[0]:.4g} mm: reverse the order of the points"
        )


def _scatter_across(x: Vector) -> float | None:
    """How far points stray over the centre line; None where they do not.

    Scatter is what lies between the first crossing and the last, near the line for the size of the gap,
    and what half a gap has on its other side.
    """
    reach = float(np.abs(x).max())
    least = float(min(x.max(), -x.min()))
    if least < _SCATTERED * reach:
        return least
    crossed = np.flatnonzero(np.diff(np.sign(x)))
    between = np.abs(x[crossed[0] + 1 : crossed[-1] + 1])
    if between.size and between.max() < _SCATTERED * reach:
        return float(between.max())
    return None


def _rounded_up(value: float) -> str:
    """Return a number of two digits that is not below a value.

    Examples
    --------
    >>> _rounded_up(0.00341)
    '0.0035'
    """
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return f"{math.ceil(value / unit) * unit:.2g}"


def _thinned(points: Vector, noise: float) -> tuple[Vector, float]:
    """Means of successive points where they lie closer than the noise can tell apart.

    Otherwise the noise would lengthen the chords, and with them the spline's parameter. Of
    very many points some are passed over, none of them a corner.
    """
    step = float(np.median(np.hypot(*np.diff(points, axis=0).T)))
    group = min(int(8.0 * noise / step), points.shape[0] // FEWEST_POINTS)
    if group > 1:
        count = points.shape[0] // group
        first = (points.shape[0] - count * group) // 2
        grouped = points[first : first + count * group].reshape(count, group, 2)
        points, noise = np.asarray(grouped.mean(axis=1)), noise / math.sqrt(group)
    last = points.shape[0] - 1
    spread = range(0, last, max(1, points.shape[0] // _MAX_POINTS))
    return points[sorted({*spread, last, *_corners(points, noise)})], noise


class _JointedSpline:
    """A least-squares quintic with corners, and joints where its curvature may jump.

    Break points are held as the chord length at which they lie.
    """

    def __init__(self, points: Vector, chord: Vector, noise: float) -> None:
        self.points, self.chord = points, chord
        self.count = points.shape[0]
        self.floor = self.count * max(noise, _LEAST_NOISE) ** 2
        self.cost = math.log(2.0 * self.count)
        self.step = max(1, self.count // (4 * _SEARCH_KNOTS))
        self.corners = [float(chord[i]) for i in _corners(points, noise)]

    def spline(self) -> "BSpline":
        """Return the spline with as few joints and knots as the points support."""
        joints = self._joints()
        numbers = self._numbers(joints)
        for _ in range(2):
            with_these = partial(self._spread_score, numbers)
            joints = self._all_placed(joints, with_these)
            numbers = self._numbers(joints)
        score = self._spread_score(numbers, joints)
        for joint in list(joints):
            fewer = [other for other in joints if other != joint]
            instead = self._numbers(fewer)
            without = self._spread_score(instead, fewer)
            if without - score < (9.0 + 2.0 * (sum(numbers) - sum(instead))) * self.cost:
                joints, numbers, score = fewer, instead, without
        try:
            found = self._fitted(self._spread(numbers, joints), joints)
        except (ValueError, np.linalg.LinAlgError):
            found = None
        if found is None or not np.isfinite(found.c).all():
            raise GeometryError(
                "gap points: a smooth outline must pass by the points, but none was found, as they turn "
                f"sharply at {len(self.corners)} places: give points as exact as 0.001 mm, or a larger "
                "points_noise_mm"
            )
        return found

    def _joints(self) -> list[float]:
        """Joints found one by one on top of evenly spread knots, all placed anew each time.

        Of joints that mirror each other one alone may not pay: two more than pay are tried.
        """
        found: list[float] = []
        joints, lowest = found, self._even_score(found)
        while len(found) < min(_MAX_JOINTS, len(joints) + 2):
            trials = [[float(at), *found] for at in self.chord[:: self.step]]
            best = min(trials, key=self._even_score)
            found = self._all_placed(self._all_placed(best, self._even_score), self._even_score)
            score = self._even_score(found) + 9.0 * self.cost * len(found)
            if score <= lowest:
                joints, lowest = found, score
        return joints

    def _all_placed(self, joints: list[float], score: Callable[[list[float]], float]) -> list[float]:
        """Every joint in turn where it fits best, within some points of where it is."""
        from scipy.optimize import minimize_scalar

        for i in range(len(joints)):
            before, after = joints[:i], joints[i + 1 :]

            def moved(at: float, before: list[float] = before, after: list[float] = after) -> float:
                return score([*before, float(at), *after])

            at = float(self._index(joints[i]))
            near = self._chord_at(at + self.step * np.linspace(-1.5, 1.5, 7))
            best = int(np.argmin([moved(at) for at in near]))
            found = minimize_scalar(
                moved,
                bounds=(near[max(best - 1, 0)], near[min(best + 1, 6)]),
                method="bounded",
                options={"xatol": 1e-3 * self.chord[-1] / self.count},
            )
            placed = min(joints[i], float(near[best]), float(found.x), key=moved)
            joints = [*before, placed, *after]
        return joints

    def _numbers(self, joints: list[float]) -> tuple[int, ...]:
        """How many knots every piece between breaks gets, added while they pay."""
        numbers = (0,) * (len(joints) + len(self.corners) + 1)
        greatest = (np.diff(self._breaks(joints)) - _LEAST_BETWEEN) // 3
        total = self._spread_score(numbers, joints)
        while sum(numbers) < self.count // 6:
            trials = [
                (*numbers[:i], numbers[i] + more, *numbers[i + 1 :])
                for i in range(len(numbers))
                for more in (1, 2, 4)
                if numbers[i] + more <= greatest[i]
            ]
            if not trials:
                break
            totals = [self._spread_score(trial, joints) + 2.0 * sum(trial) * self.cost for trial in trials]
            best = int(np.argmin(totals))
            if not totals[best] < total:
                break
            numbers, total = trials[best], totals[best]
        return numbers

    def _spread(self, numbers: tuple[int, ...], joints: list[float]) -> list[float]:
        """Knots evenly spread over the points of every piece between breaks."""
        ends = self._breaks(joints)
        inner = [
            np.linspace(first, last, number + 2)[1:-1]
            for (first, last), number in zip(pairwise(ends), numbers, strict=True)
        ]
        return list(self._chord_at(np.concatenate(inner)))

    def _spread_score(self, numbers: tuple[int, ...], joints: list[float]) -> float:
        return self._score(self._spread(numbers, joints), joints)

    def _even_score(self, joints: list[float]) -> float:
        even = np.linspace(0, self.count - 1, _SEARCH_KNOTS + 2)[1:-1]
        apart = 0.5 * self.count / (_SEARCH_KNOTS + 1)
        breaks = self._index(np.array(joints + self.corners))
        free = np.array([at for at in even if (np.abs(breaks - at) > apart).all()])
        return self._score(list(self._chord_at(free)), joints)

    def _score(self, knots: list[float], joints: list[float]) -> float:
        """Return n log(sum of squared residuals + n noise^2), very large without a fit."""
        if np.diff(self._breaks(joints)).min() < _LEAST_BETWEEN:
            return _NO_FIT
        try:
            residuals = self.points - self._fitted(knots, joints)(self.chord)
        except (ValueError, np.linalg.LinAlgError):
            return _NO_FIT
        total = float(np.sum(residuals**2)) + self.floor
        return self.count * math.log(total) if math.isfinite(total) else _NO_FIT

    def _fitted(self, knots: list[float], joints: list[float]) -> "BSpline":
        from scipy.interpolate import make_lsq_spline

        inner = np.sort([*knots, *np.repeat(joints, 4), *np.repeat(self.corners, 5)])
        ends = np.repeat(self.chord[[0, -1]], 6)
        return make_lsq_spline(self.chord, self.points, np.concatenate([ends[:6], inner, ends[6:]]), k=5)

    def _breaks(self, joints: list[float]) -> Vector:
        """Indices of the ends, corners and joints, in order."""
        return self._index(np.sort([*joints, *self.corners, *self.chord[[0, -1]]]))

    def _index(self, chord: float | Vector) -> Vector:
        return np.asarray(np.interp(chord, self.chord, np.arange(self.count)))

    def _chord_at(self, index: Vector) -> Vector:
        return np.asarray(np.interp(index, np.arange(self.count), self.chord))


def _corners(points: Vector, noise: float) -> list[int]:
    """Points where the outline turns sharply, against its neighbours and against the noise."""
    way = np.diff(points, axis=0)
    length = np.hypot(*way.T)
    cross = way[:-1, 0] * way[1:, 1] - way[:-1, 1] * way[1:, 0]
    turn = np.abs(np.arctan2(cross, np.sum(way[:-1] * way[1:], axis=1)))
    padded = np.concatenate([[0.0], turn, [0.0]])
    beside = 3.0 * np.maximum(padded[:-2], padded[2:])
    doubt = 8.0 * noise / np.minimum(length[:-1], length[1:])
    sharp = turn > np.maximum(np.maximum(beside, doubt), _SHARPEST_TURN)
    return [int(i) + 1 for i in np.flatnonzero(sharp) if 6 <= i + 1 <= points.shape[0] - 7]


def _through(points: Vector, count: int) -> Vector:
    """Points on a cubic spline through given ones, at equal steps of chord length."""
    from scipy.interpolate import CubicSpline

    chord = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    return np.asarray(CubicSpline(chord, points)(np.linspace(0.0, chord[-1], count)))


def _at_equal_steps(points: Vector, nodes: int) -> Vector:
    """Points at equal arc length on a dense row of points."""
    length = np.hypot(*np.diff(points, axis=0).T)
    arc = np.concatenate([[0.0], np.cumsum(length)])
    at = np.linspace(0.0, arc[-1], nodes)
    return np.column_stack([np.interp(at, arc, points[:, 0]), np.interp(at, arc, points[:, 1])])


def _stop(x: Vector, y: Vector, roller_radius: float, across: float) -> Vector:
    """Height at which every point stops the centre of a roller lowered at an abscissa [mm]."""
    inside = roller_radius**2 - (x - across) ** 2
    return np.asarray(np.where(inside >= 0.0, y + np.sqrt(np.maximum(inside, 0.0)), -math.inf))


def _check_roller(profile: Profile, roller_radius: float) -> None:
    """Raise where a roller that is lowered into the gap rests on its tips."""
    x, y = profile.x, profile.y
    centre = lowest_centre(x, y, roller_radius)
    touched = y[int(_stop(x, y, roller_radius, centre[0]).argmax())]
    if touched > y.min() + 0.9 * (min(y[0], y[-1]) - y.min()):
        raise GeometryError(
            f"gap points: a roller of {2.0 * roller_radius:g} mm must enter the gap, but rests on its "
            f"tips, {math.hypot(x[0] - x[-1], y[0] - y[-1]):.4g} mm apart, with its centre at "
            f"y = {centre[1]:.4g} mm: check the roller diameter and the unit of the points"
        )
