"""A closed outline of lines and circular arcs, as drawing formats hold it."""

import math
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from wearsim.errors import GeometryError
from wearsim.geometry.profile_points import Vector


def rotated(points: Vector, angle: float) -> Vector:
    """Return points turned counterclockwise about the origin."""
    cos, sin = math.cos(angle), math.sin(angle)
    return np.asarray(points @ np.array([[cos, sin], [-sin, cos]]))


def along_ways(
    starts: Vector, ends: Vector, bulges: Vector, tolerance: float
) -> tuple[Vector, NDArray[np.int64]]:
    """Return points on lines and arcs, those by as many chords as a tolerance asks for."""
    chord = ends - starts
    sweep = 4.0 * np.arctan(bulges)
    half = np.sin(0.5 * np.where(sweep == 0.0, 1.0, sweep))
    radius = 0.5 * np.hypot(*chord.T) / np.abs(half)
    # n chords of an arc lie within R sweep^2 / (8 n^2) of it.
    parts = np.ceil(np.abs(sweep) * np.sqrt(radius / (8.0 * tolerance))).clip(1.0).astype(int)
    which = np.repeat(np.arange(parts.size), parts)
    step = np.arange(which.size) - (np.cumsum(parts) - parts)[which]
    # The point at an angle t along the arc lies at sin(t/2) / sin(sweep/2) of the chord from
    # the start, turned by (t - sweep)/2.
    t = sweep[which] * step / parts[which]
    along, turn = np.sin(0.5 * t) / half[which], 0.5 * (t - sweep[which])
    cos, sin = along * np.cos(turn), along * np.sin(turn)
    (x, y), (u, v) = starts[which].T, chord[which].T
    points = np.column_stack([x + cos * u - sin * v, y + sin * u + cos * v])
    return points, which


@dataclass(frozen=True, eq=False)
class Outline:
    """Vertices of a closed outline, run counterclockwise, and the arcs between them.

    Examples
    --------
    A circle of radius 1 from two half circles:

    >>> circle = Outline(np.array([[-1.0, 0.0], [1.0, 0.0]]), np.array([1.0, 1.0]))
    >>> round(shapely.Polygon(circle.polygon(1e-8)).area, 6)
    3.141593
    >>> round(circle.area, 12) == round(math.pi, 12)
    True
    """

    vertices: Vector  # coordinates [mm], shape (n, 2); the first is not repeated
    # of the way from each vertex to the next: tan of a quarter of the angle of its arc, positive
    # counterclockwise, 0 for a line
    bulges: Vector

    @property
    def area(self) -> float:
        """Area inside, that between arcs and their chords included [mm2]."""
        (x, y), (u, v) = self.vertices.T, np.roll(self.vertices, -1, axis=0).T
        sweep = 4.0 * np.arctan(self.bulges)
        half = np.sin(0.5 * np.where(sweep == 0.0, 1.0, sweep))
        radius = 0.5 * np.hypot(u - x, v - y) / half
        return 0.5 * float(np.sum(x * v - u * y) + np.sum(radius**2 * (sweep - np.sin(sweep))))

    def polygon(self, tolerance: float) -> Vector:
        """Return points of the outline, arcs by chords."""
        points, _ = along_ways(self.vertices, np.roll(self.vertices, -1, axis=0), self.bulges, tolerance)
        if not shapely.Polygon(points).is_valid:
            raise GeometryError(
                "outline: it must not cross itself, but does: take fewer or larger teeth, or a lower "
                "addendum_ratio"
            )
        return points
