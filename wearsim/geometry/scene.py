"""A drawing in mm that no format is chosen for yet: lines, circles and labels, y upwards."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from wearsim.geometry.profile_points import Vector

Box = tuple[float, float, float, float]
"""Left, bottom, width and height [mm]."""

_MARGIN = 0.04
"""Free edge around a sketch, as a fraction of its width."""

_TEXT = 1.0 / 32.0
"""Height of letters over the width of a sketch."""


@dataclass(frozen=True, eq=False)
class Stroke:
    """Straight ways and arcs from one vertex to the next."""

    role: str  # what it stands for, which its look follows from
    vertices: Vector  # shape (n, 2)
    bulges: Sequence[float] = ()  # of the ways as in `Outline`; empty where all are straight
    closed: bool = False


@dataclass(frozen=True)
class Circle:
    """A whole circle."""

    role: str
    centre: tuple[float, float]
    radius: float
    name: str = ""  # in a legend


@dataclass(frozen=True)
class Label:
    """A line of text."""

    role: str
    text: str
    place: tuple[float, float]  # on its base line: the left end on paper, the middle in a sketch
    height: float  # of the letters


Shape = Stroke | Circle | Label


@dataclass(frozen=True, eq=False)
class Scene:
    """A drawing."""

    box: Box
    shapes: tuple[Shape, ...]  # drawn in this order
    alt: str = ""  # what there is to see, for those who cannot
    notes: tuple[str, ...] = ()  # what stands below the drawing

    def with_scale(self, letters: float = 0.0) -> "Scene":
        """Return a sketch with a margin and, below it, a bar of round length; letters as high as others."""
        left, bottom, width, height = self.box
        edge, text = _MARGIN * width, letters or letter_height(self.box)
        bar, y, tick = round_length(0.25 * width), bottom - 2.6 * text, 0.4 * text
        ends = [line("scale", [(x, y + tick), (x, y - tick)]) for x in (left, left + bar)]
        label = Label("text", f"{bar:g} mm", (left + 0.5 * bar, y + 1.4 * tick), text)
        return replace(
            self,
            box=(left - edge, bottom - edge - 3.4 * text, width + 2 * edge, height + 2 * edge + 4.4 * text),
            shapes=(*self.shapes, *ends, line("scale", [(left, y), (left + bar, y)]), label),
        )


def line(role: str, points: ArrayLike, closed: bool = False) -> Stroke:
    """Return the straight ways from point to point."""
    return Stroke(role, np.asarray(points, dtype=float), closed=closed)


def turn_arrow(centre: tuple[float, float], radius: float, sense: int) -> tuple[Stroke, Stroke]:
    """Return an arrow that turns around a point."""
    angles = sense * np.radians(np.linspace(-150.0, 60.0, 29)) + 0.5 * math.pi
    arc = centre + radius * np.column_stack([np.cos(angles), np.sin(angles)])
    return line("arrow", arc), _head(arc[-1], arc[-1] - arc[-3], 0.3 * radius)


def straight_arrow(
    start: tuple[float, float], end: tuple[float, float], head: float
) -> tuple[Stroke, Stroke]:
    """Return a straight arrow."""
    return line("arrow", [start, end]), _head(np.asarray(end), np.subtract(end, start), head)


def _head(tip: Vector, way: Vector, length: float) -> Stroke:
    ahead = way / np.hypot(*way)
    across = np.array([-ahead[1], ahead[0]])
    back = tip - length * ahead
    return line("arrow", [back + 0.45 * length * across, tip, back - 0.45 * length * across])


def around(circles: Iterable[tuple[tuple[float, float], float]]) -> Box:
    """Return the box around circles, given by centres and radii.

    Examples
    --------
    >>> around([((0.0, 0.0), 1.0), ((3.0, 0.0), 2.0)])
    (-1.0, -2.0, 6.0, 4.0)
    """
    ends = np.array([(x - r, y - r, x + r, y + r) for (x, y), r in circles])
    (left, bottom), (right, top) = ends[:, :2].min(axis=0).tolist(), ends[:, 2:].max(axis=0).tolist()
    return left, bottom, right - left, top - bottom


def letter_height(box: Box) -> float:
    """Return the height of letters in a sketch."""
    return _TEXT * (1.0 + 2.0 * _MARGIN) * box[2]


def round_length(length: float) -> float:
    """Return the largest of 1, 2, 5, 10, 20, ... that is not above a length.

    Examples
    --------
    >>> round_length(99.0), round_length(0.3)
    (50.0, 0.2)
    """
    power = 10.0 ** math.floor(math.log10(length))
    return max(factor * power for factor in (1.0, 2.0, 5.0) if factor * power <= length)
