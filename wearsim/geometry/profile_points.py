"""A flank as a row of points, with its normals and signed curvature."""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from wearsim.errors import GeometryError
from wearsim.kernels.flank_geometry import flank_frame

Vector = NDArray[np.float64]
Places = NDArray[np.int64]

_END_PIECES, _END_PARTS = 8, 40
"""Pieces of the first and the last interval of a flank with fine ends, and 1 over the part of the
flank in which their number falls to 1/e."""


def _vector(values: ArrayLike) -> Vector:
    array = np.array(values, dtype=float)
    array.setflags(write=False)
    return array


def chord_lengths(x: Vector, y: Vector) -> Vector:
    """Return the length along the chords of a row of points.

    Examples
    --------
    >>> chord_lengths(np.array([0.0, 3.0, 3.0]), np.array([0.0, 4.0, 6.0])).tolist()
    [0.0, 5.0, 7.0]
    """
    return np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])


def area_between(x_before: Vector, y_before: Vector, x: Vector, y: Vector) -> float:
    """Return the area between two flanks, by the shoelace formula.

    Examples
    --------
    A flank along +y with the gap on its right recedes by 0.5 mm over 2 mm:

    >>> import numpy as np
    >>> y = np.array([0.0, 1.0, 2.0])
    >>> area_between(0.0 * y, y, 0.0 * y - 0.5, y)
    1.0
    """
    u = np.concatenate([x_before - x_before[0], (x - x_before[0])[::-1]])
    v = np.concatenate([y_before - y_before[0], (y - y_before[0])[::-1]])
    return 0.5 * float(np.dot(u, np.roll(v, -1)) - np.dot(v, np.roll(u, -1)))


def area_swept(x: Vector, y: Vector, depth: Vector) -> float:
    """Return the area that a flank loses as its points recede along their normals.

    Examples
    --------
    A flank of 2 mm that recedes by 0.5 mm:

    >>> import numpy as np
    >>> y = np.array([[0.0, 1.0, 2.0]] * 2)
    >>> depth = np.array([[0.0] * 3, [0.5] * 3])
    >>> area_swept(-depth, y, depth)
    1.0
    """
    half = 0.5 * np.hypot(np.diff(x, axis=1), np.diff(y, axis=1))
    length = np.zeros_like(x)
    length[:, 1:] += half
    length[:, :-1] += half
    return float(np.sum(np.diff(depth, axis=0) * 0.5 * (length[1:] + length[:-1])))


@dataclass(frozen=True, eq=False)
class Profile:
    """Points of a flank from root to tip, with what follows from them.

    Raises
    ------
    GeometryError
        Too few points, a value that is not finite, or two successive points that coincide.

    Examples
    --------
    Three points of a circle of radius 5 mm around the origin, run through
    counterclockwise so that the material is inside:

    >>> profile = Profile([5.0, 3.0, 0.0], [0.0, 4.0, 5.0])
    >>> float(round(profile.curvature[1], 12))
    0.2
    """

    # x, y: coordinates in the sprocket's frame [mm], at least three points, no two successive ones equal; the
    # gap lies to the right of the direction of travel
    x: Vector
    y: Vector

    def __post_init__(self) -> None:
        x, y = _vector(self.x), _vector(self.y)
        if x.ndim != 1 or x.shape != y.shape or x.size < 3:
            raise GeometryError(
                f"profile: needs at least three points with as many x as y, got {x.shape} x and "
                f"{y.shape} y: give one x and one y for every point"
            )
        if not (np.isfinite(x).all() and np.isfinite(y).all()):
            raise GeometryError("profile: every coordinate must be finite: remove nan and inf")
        gaps = np.hypot(np.diff(x), np.diff(y))
        if not gaps.min() > 0.0:
            raise GeometryError(
                f"profile: successive points must differ, points {gaps.argmin() + 1} and "
                f"{gaps.argmin() + 2} coincide: remove one"
            )
        object.__setattr__(self, "x", x)
        object.__setattr__(self, "y", y)

    @cached_property
    def _frame(self) -> tuple[Vector, ...]:
        frame = np.empty((4, self.x.size))
        with np.errstate(all="raise"):
            flank_frame(self.x.copy(), self.y.copy(), *frame)
        return tuple(_vector(row) for row in frame[:3])

    @property
    def normal_x(self) -> Vector:
        """Unit normal into the gap, of the circle through a point and its neighbours.

        At the ends it is that of the parabola through the three end points.
        """
        return self._frame[0]

    @property
    def normal_y(self) -> Vector:
        """Component of the normal along y."""
        return self._frame[1]

    @property
    def curvature(self) -> Vector:
        """Signed curvature [1/mm], positive where the flank is convex."""
        return self._frame[2]

    @property
    def arc_length(self) -> Vector:
        """Length along the points from the first one [mm], each chord taken as its circle's arc."""
        chord = np.hypot(np.diff(self.x), np.diff(self.y))
        mean = 0.5 * (self.curvature[1:] + self.curvature[:-1])
        return np.concatenate([[0.0], np.cumsum(chord * (1.0 + (mean * chord) ** 2 / 24.0))])

    def recede(self, depth: ArrayLike) -> "Profile":
        """Return the profile with every point moved against its normal."""
        return Profile(*self.receded(depth))

    def receded(self, depth: ArrayLike) -> tuple[Vector, Vector]:
        """Return where the points lie after moving against their normals."""
        removed = np.asarray(depth, dtype=float)
        return self.x - removed * self.normal_x, self.y - removed * self.normal_y

    def mirrored(self) -> "Profile":
        """Return the mirror image on the gap's centre line, run from tip to root."""
        return Profile(-self.x[::-1], self.y[::-1])

    def rotated(self, angle: float) -> "Profile":
        """Return the profile turned counterclockwise about the origin."""
        cosine, sine = np.cos(angle), np.sin(angle)
        return Profile(self.x * cosine - self.y * sine, self.x * sine + self.y * cosine)

    def with_fine_ends(self, intervals: int) -> "Profile":
        """Return the same flank on even intervals, of which those near both ends are divided.

        The first and the last are divided into eight; over a fortieth of the flank the number
        falls to 1/e. Lagrange's polynomial through six neighbours carries the points over; where
        they are those of this flank they stay as they are.

        Examples
        --------
        >>> straight = Profile(np.linspace(0.0, 8.0, 9), np.zeros(9))
        >>> straight.with_fine_ends(4).x.tolist()[:10]
        [0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0, 4.0]
        """
        return _with_fine_ends(self, intervals)

    def thinned(self) -> tuple["Profile", Places]:
        """Return about every second point, with both ends, and which of the points these are.

        Examples
        --------
        >>> thin, places = Profile(np.arange(5.0), np.zeros(5)).thinned()
        >>> thin.x.tolist(), places.tolist()
        ([0.0, 2.0, 4.0], [0, 2, 4])
        """
        return _thinned(self)

    @property
    def is_simple(self) -> bool:
        """Whether the line through the points neither crosses nor touches itself."""
        return bool(shapely.LineString(np.column_stack([self.x, self.y])).is_simple)

    @property
    def crossing(self) -> int:
        """Number of the point nearest to where a line that is not simple first meets itself.

        Examples
        --------
        A loop that closes at (1, 0), between the first point and the second and nearest to neither
        but to the last but one:

        >>> Profile([0.0, 3.0, 3.0, 1.0, 1.0], [0.0, 0.0, 2.0, 0.5, -2.0]).crossing
        3
        """
        parts = shapely.node(shapely.LineString(np.column_stack([self.x, self.y])))
        where = parts.geoms[0].coords[-1]
        return int(np.hypot(self.x - where[0], self.y - where[1]).argmin())


@lru_cache(maxsize=64)
def _thinned(flank: Profile) -> tuple[Profile, Places]:
    """Take about every second point; cases of a study share their flank."""
    points = flank.x.size
    keep = np.unique(np.linspace(0, points - 1, max(3, (points + 1) // 2)).round().astype(int))
    keep.setflags(write=False)
    return Profile(flank.x[keep], flank.y[keep]), keep


@lru_cache(maxsize=64)
def _with_fine_ends(flank: Profile, intervals: int) -> Profile:
    """Divide the intervals near the ends; cases of a study share their flank."""
    last, even = flank.x.size - 1, np.arange(intervals)
    from_end = np.minimum(even, intervals - 1 - even)
    pieces = _END_PIECES * np.exp(-from_end * _END_PARTS / intervals)
    pieces = np.maximum(1, pieces.round().astype(int))
    part = np.concatenate([np.arange(count) / count for count in pieces])
    at = np.append((np.repeat(even, pieces) + part) * (last / intervals), last)
    near = np.arange(min(6, last + 1))
    first = np.clip(np.floor(at).astype(int) - 2, 0, last + 1 - near.size)
    way = (at - first)[:, None]
    weight = np.ones((at.size, near.size))
    for place in near:
        others = near[near != place]
        weight[:, place] = np.prod((way - others) / (place - others), axis=1)
    points = first[:, None] + near
    return Profile(*((weight * values[points]).sum(axis=1) for values in (flank.x, flank.y)))
