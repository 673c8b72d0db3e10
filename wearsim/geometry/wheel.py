"""A whole wheel from its tooth spaces, each a row of named stretches of lines and arcs.

A space has its centre line on +y and is run from its right tip through the root to its left
tip, so that a wheel of them is run counterclockwise.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from wearsim.geometry.gap import Gap
from wearsim.geometry.outline import Outline, turned
from wearsim.geometry.profile import Vector
from wearsim.geometry.segments import Arc, Segment

_APART = 1e-9
"""Distance [mm] below which two ends are one point."""


@dataclass(frozen=True, eq=False)
class Stretch:
    """A part of an outline from end to end.

    Attributes
    ----------
    part : str
        ``flank`` (the side that wears), ``back_flank``, ``root``, ``tip``, ``gap`` (both sides
        and the seat in one), or ``step`` between a worn part and one that is not.
    vertices : numpy.ndarray
        Coordinates [mm], both ends included, shape (n, 2).
    bulges : numpy.ndarray
        Of the ways between them, shape (n - 1,): tan of a quarter of the arc's angle, positive
        counterclockwise, 0 for a line.
    is_curve : bool
        Whether the vertices are points of a smooth curve; else the arcs and lines are the form.
    """

    part: str
    vertices: Vector
    bulges: Vector
    is_curve: bool = False

    @property
    def sagitta(self) -> float:
        """Greatest distance of an arc from its chord [mm]."""
        chord = np.hypot(*np.diff(self.vertices, axis=0).T)
        return float((0.5 * chord * np.abs(self.bulges)).max())

    def turned(self, angle: float) -> "Stretch":
        """Return the stretch turned counterclockwise about the origin.

        Parameters
        ----------
        angle : float
            Angle [rad].

        Returns
        -------
        Stretch
            The same part.
        """
        return replace(self, vertices=turned(self.vertices, angle))

    def mirrored(self, part: str) -> "Stretch":
        """Return the mirror image on +y, run from the other end.

        Parameters
        ----------
        part : str
            What it is there.

        Returns
        -------
        Stretch
            Bulges keep their signs: mirror image and reversal both turn them.
        """
        return Stretch(part, self.vertices[::-1] * (-1.0, 1.0), self.bulges[::-1], self.is_curve)


@dataclass(frozen=True, eq=False)
class Space:
    """The space between two teeth.

    Attributes
    ----------
    right : tuple of Stretch
        From the tip on the right on.
    left : tuple of Stretch
        To the tip on the left.
    rooted : bool
        Whether ``left`` starts where ``right`` ends; else the root is not known.
    """

    right: tuple[Stretch, ...]
    left: tuple[Stretch, ...]
    rooted: bool = True


@dataclass(frozen=True, eq=False)
class Chain:
    """Stretches that follow one another.

    Attributes
    ----------
    stretches : tuple of Stretch
        Each starts where the one before ends.
    teeth : tuple of int
        Number of the tooth or space that each belongs to, from 1.
    closed : bool
        Whether the last one ends where the first starts.
    """

    stretches: tuple[Stretch, ...]
    teeth: tuple[int, ...]
    closed: bool

    @property
    def vertices(self) -> Vector:
        """All vertices [mm]; of a closed chain without the first one again."""
        rows = [stretch.vertices[:-1] for stretch in self.stretches]
        last = [] if self.closed else [self.stretches[-1].vertices[-1:]]
        return np.concatenate([*rows, *last])

    @property
    def bulges(self) -> Vector:
        """Bulges of all ways."""
        return np.concatenate([stretch.bulges for stretch in self.stretches])

    def moved(self, centre: tuple[float, float]) -> "Chain":
        """Return the chain about another centre.

        Parameters
        ----------
        centre : tuple of float
            Where the axis comes to lie [mm].

        Returns
        -------
        Chain
            As it is, elsewhere.
        """
        there = (replace(part, vertices=part.vertices + centre) for part in self.stretches)
        return Chain(tuple(there), self.teeth, self.closed)

    @property
    def outline(self) -> Outline:
        """The closed outline."""
        return Outline(self.vertices, self.bulges)


def line(part: str, start: Vector, end: Vector) -> tuple[Stretch, ...]:
    """Return the line between two points, none where they are one.

    Parameters
    ----------
    part : str
        What it is.
    start, end : numpy.ndarray
        Coordinates [mm].

    Returns
    -------
    tuple of Stretch
        One or none.
    """
    if math.dist(start, end) < _APART:
        return ()
    return (Stretch(part, np.array([start, end]), np.zeros(1)),)


def arc_through(part: str, start: Vector, middle: Vector, end: Vector) -> Stretch:
    """Return the arc whose ends and middle are given.

    Parameters
    ----------
    part : str
        What it is.
    start, middle, end : numpy.ndarray
        Coordinates [mm].

    Returns
    -------
    Stretch
        The arc.

    Examples
    --------
    A half circle, run counterclockwise:

    >>> points = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]])
    >>> arc_through("root", *points).bulges.tolist()
    [1.0]
    """
    (x, y), chord = middle - 0.5 * (start + end), end - start
    bulge = 2.0 * (x * chord[1] - y * chord[0]) / (chord @ chord)
    return Stretch(part, np.array([start, end]), np.array([bulge]))


def along_points(part: str, points: Vector) -> Stretch:
    """Return a stretch through points of a curve, with arcs between them where it bends evenly.

    Of two neighbours the lesser of the curvatures is taken, and none where they differ in sign,
    so that corners stay corners.

    Parameters
    ----------
    part : str
        What it is.
    points : numpy.ndarray
        Coordinates [mm], shape (n, 2), at least three.

    Returns
    -------
    Stretch
        All points are its vertices.

    Examples
    --------
    Five points of a half circle of radius 1: four arcs of 45 degrees each.

    >>> angle = np.linspace(0.0, np.pi, 5)
    >>> half = along_points("root", np.column_stack([np.cos(angle), np.sin(angle)]))
    >>> np.degrees(4.0 * np.arctan(half.bulges)).round(9).tolist()
    [45.0, 45.0, 45.0, 45.0]
    """
    way = np.diff(points, axis=0)
    chord = np.hypot(*way.T)
    cross = way[:-1, 0] * way[1:, 1] - way[:-1, 1] * way[1:, 0]
    across = np.hypot(*(points[2:] - points[:-2]).T)
    # The circle through three points has the radius a b c / (2 |a x b|).
    inner = 2.0 * cross / (chord[:-1] * chord[1:] * across)
    curvature = np.concatenate([inner[:1], inner, inner[-1:]])
    before, after = curvature[:-1], curvature[1:]
    lesser = np.where(np.abs(before) < np.abs(after), before, after)
    bent = np.where(before * after > 0.0, lesser, 0.0)
    half_sweep = np.arcsin(np.clip(0.5 * bent * chord, -0.5, 0.5))
    return Stretch(part, points, np.tan(0.5 * half_sweep), is_curve=True)


def up_to(flank: Stretch, point: Vector) -> Stretch:
    """Return the first part of a flank that is run from root to tip.

    Parameters
    ----------
    flank : Stretch
        Farther from the axis from vertex to vertex.
    point : numpy.ndarray
        Point of the flank [mm] where it ends.

    Returns
    -------
    Stretch
        Its vertices below the point, and the point.
    """
    below = np.hypot(*flank.vertices.T) < math.hypot(*point) - _APART
    kept = int(below.argmin())
    start, end = flank.vertices[kept - 1 : kept + 1]
    part = math.dist(start, point) / math.dist(start, end)
    last = math.tan(part * math.atan(flank.bulges[kept - 1]))
    return Stretch(
        flank.part,
        np.concatenate([flank.vertices[:kept], [point]]),
        np.concatenate([flank.bulges[: kept - 1], [last]]),
        flank.is_curve,
    )


def along_gap(gap: Gap) -> Stretch:
    """Return the gap of a standard form by its own arcs and lines.

    Parameters
    ----------
    gap : Gap
        The gap.

    Returns
    -------
    Stretch
        From its right tip to its left one; exact.
    """
    half = gap.segments
    points = np.array([part.start for part in half] + [half[-1].end])
    bulges = np.array([_bulge(part) for part in half])
    if abs(points[0, 0]) < _APART:
        return _joined_halves(points, bulges)
    ends = np.concatenate([points[::-1], points * (-1.0, 1.0)])
    return Stretch("gap", ends, -np.concatenate([bulges[::-1], [0.0], bulges]))


def _joined_halves(points: Vector, bulges: Vector) -> Stretch:
    """Both halves of a gap whose bottom is one point."""
    vertices = np.concatenate([points[:0:-1], points * (-1.0, 1.0)])
    vertices[points.shape[0] - 1, 0] = 0.0
    return Stretch("gap", vertices, -np.concatenate([bulges[::-1], bulges]))


def _bulge(part: Segment) -> float:
    return math.tan(0.25 * (part.last - part.first)) if isinstance(part, Arc) else 0.0


def worn_space(new: Space, points: Vector) -> Space:
    """Return a space whose left side is worn: the new one without what lies between both flanks.

    Where wear reaches an end of the points a straight step joins it to what is not worn, unless
    the worn end lies above the tip, where there was nothing: there the tip cuts the flank off.

    Parameters
    ----------
    new : Space
        The new space; ``left`` ends with the flank that wears.
    points : numpy.ndarray
        Where the points of the flank lie now [mm], root to tip, shape (n, 2).

    Returns
    -------
    Space
        The worn space.
    """
    *below, flank = new.left
    first = line("step", flank.vertices[0], points[0]) if new.rooted else ()
    kept, last = _to_tip(points, flank.vertices[-1])
    worn = along_points("flank", kept)
    return Space(new.right, (*below, *first, worn, *last), new.rooted)


def worn_gap(new: Space, points: Vector) -> Space:
    """Return a space that is worn from tip to tip.

    Parameters
    ----------
    new : Space
        The new space, one stretch.
    points : numpy.ndarray
        Where its points lie now [mm], from the right tip to the left one, shape (n, 2).

    Returns
    -------
    Space
        The worn space.
    """
    (gap,) = new.right
    kept, last = _to_tip(points, gap.vertices[-1])
    backwards, first = _to_tip(kept[::-1], gap.vertices[0])
    steps = tuple(Stretch(part.part, part.vertices[::-1], part.bulges) for part in first)
    return Space((*steps, along_points("gap", backwards[::-1]), *last), ())


def to_circle(points: Vector, radius: float) -> Vector:
    """Return points of a flank that ends on a circle about the axis.

    Parameters
    ----------
    points : numpy.ndarray
        Coordinates from root to tip [mm], shape (n, 2).
    radius : float
        Radius of the circle [mm].

    Returns
    -------
    numpy.ndarray
        Cut off where they pass the circle, else extended straight to it.

    Examples
    --------
    >>> flank = np.array([[0.0, 1.0], [0.0, 2.0], [0.0, 3.0]])
    >>> to_circle(flank, 2.5)[-1].tolist(), to_circle(flank, 4.0)[-1].tolist()
    ([0.0, 2.5], [0.0, 4.0])
    """
    inside = int(np.flatnonzero(np.hypot(*points.T) < radius)[-1])
    start = points[inside]
    along = start - points[inside - 1] if inside + 1 == len(points) else points[inside + 1] - start
    way = along / math.hypot(*along)
    forward = float(start @ way)
    length = math.sqrt(forward**2 + radius**2 - float(start @ start)) - forward
    return np.concatenate([points[: inside + 1], [start + length * way]])


def _to_tip(points: Vector, tip: Vector) -> tuple[Vector, tuple[Stretch, ...]]:
    """Points of a worn flank as far as the tip circle, and the step from there to the new tip."""
    radius = math.hypot(*tip)
    if math.hypot(*points[-1]) <= radius + _APART:
        return points, line("step", points[-1], tip)
    return to_circle(points, radius), ()


def ring(spaces: Sequence[Space], turn: float = 0.0) -> tuple[Chain, ...]:
    """Return the outline of a wheel from its spaces, joined by arcs about the axis over the tips.

    Parameters
    ----------
    spaces : sequence of Space
        One a tooth, counterclockwise; the first has its centre line on +y.
    turn : float
        Angle by which all of it is turned counterclockwise [rad].

    Returns
    -------
    tuple of Chain
        One closed chain; without roots an open one a tooth, from root to root.

    Examples
    --------
    Four notches from corner to corner of a square of 2 mm take trapezia of 0.75 mm2 from it:

    >>> notch = np.array([[1.0, 1.0], [0.5, 0.5], [-0.5, 0.5], [-1.0, 1.0]])
    >>> space = Space((Stretch("gap", notch, np.zeros(3)),), ())
    >>> (chain,) = ring([space] * 4)
    >>> chain.closed, round(chain.outline.area, 12)
    (True, 1.0)
    """
    pitch = math.tau / len(spaces)
    placed = [_placed(space, turn + number * pitch) for number, space in enumerate(spaces)]
    rows: list[tuple[Stretch, ...]] = []
    for space, following in pairwise([*placed, placed[0]]):
        start = (space.left or space.right)[-1].vertices[-1]
        end = following.right[0].vertices[0]
        own = space.right + space.left if space.rooted else space.left
        rows.append(
            (*own, *arc_about_axis("tip", start, end), *(() if space.rooted else following.right))
        )
    if spaces[0].rooted:
        numbers = tuple(n for n, row in enumerate(rows, 1) for _ in row)
        return (Chain(tuple(part for row in rows for part in row), numbers, True),)
    return tuple(Chain(row, (n,) * len(row), False) for n, row in enumerate(rows, 1))


def _placed(space: Space, angle: float) -> Space:
    return Space(
        tuple(part.turned(angle) for part in space.right),
        tuple(part.turned(angle) for part in space.left),
        space.rooted,
    )


def arc_about_axis(part: str, start: Vector, end: Vector) -> tuple[Stretch, ...]:
    """Return the arc about the axis from one point to another at its radius.

    Parameters
    ----------
    part : str
        What it is.
    start, end : numpy.ndarray
        Coordinates [mm].

    Returns
    -------
    tuple of Stretch
        The shorter way round; none where both are one point.
    """
    if math.dist(start, end) < _APART:
        return ()
    bulge = math.tan(0.25 * angle_between(start, end))
    return (Stretch(part, np.array([start, end]), np.array([bulge])),)


def angle_between(start: Vector, end: Vector) -> float:
    """Return the angle from one point to another about the axis.

    Parameters
    ----------
    start, end : numpy.ndarray
        Coordinates [mm].

    Returns
    -------
    float
        Counterclockwise positive, between -pi and pi [rad].
    """
    return math.atan2(start[0] * end[1] - start[1] * end[0], float(start @ end))
