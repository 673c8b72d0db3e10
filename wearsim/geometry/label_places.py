"""Where labels of a sketch stand free of its lines and of each other."""

import math
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from wearsim.geometry.profile_points import Vector
from wearsim.geometry.scene import Box, Label

_LETTER = 0.56
"""Mean width of a letter over its height."""

_BELOW = 0.25
"""What hangs below the base line, over the height of the letters."""

Point = tuple[float, float]


def label_box(text: str, middle: Point, height: float) -> Box:
    """Return the box that a text takes up around its middle.

    Examples
    --------
    >>> label_box("25 letters are 14 wide...", (7.0, 2.0), 1.0)[1:3]
    (1.5, 14.000000000000002)
    """
    width = _LETTER * height * len(text)
    return middle[0] - 0.5 * width, middle[1] - 0.5 * height, width, height


class FreePlaces:
    """A sketch that labels are set into one after the other, each where it covers least."""

    def __init__(self, lines: Iterable[Vector], spacing: float, clearance: float) -> None:
        self._points = np.concatenate([_dense(line, spacing) for line in lines])
        self._clearance = clearance
        self.boxes: list[Box] = []

    def set(self, text: str, middles: Iterable[Point], height: float) -> Label:
        """Return a label at the first free one of some places, else where it covers least."""
        best = min((label_box(text, middle, height) for middle in middles), key=self._covered)
        self.boxes.append(best)
        left, bottom, width, _ = best
        return Label("text", text, (left + 0.5 * width, bottom + _BELOW * height), height)

    def _covered(self, box: Box) -> float:
        """Points of lines within a box, and many for another label."""
        left, bottom, width, height = box
        x, y = self._points.T
        edge = self._clearance
        lines = (
            (x > left - edge) & (x < left + width + edge) & (y > bottom - edge) & (y < bottom + height + edge)
        )
        labels = sum(_overlap(box, other, 0.3 * height) for other in self.boxes)
        return float(lines.sum()) + 1e3 * labels


def beside_line(start: Vector, end: Vector, outer: Vector, box: Box, gap: float) -> Iterator[Point]:
    """Yield middles of a label along a line, at first on its outer side."""
    for away in (1.0, 1.8, 3.0):
        for side in (1.0, -1.0):
            normal = side * outer
            reach = 0.5 * (box[2] * abs(normal[0]) + box[3] * abs(normal[1])) + away * gap
            for part in (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8):
                x, y = ((1.0 - part) * start + part * end + reach * normal).tolist()
                yield x, y


def around_circle(centre: Point, radius: float, box: Box, gap: float) -> Iterator[Point]:
    """Yield middles of a label in a circle, then around it."""
    yield centre
    for away in (1.0, 2.0, 3.5):
        for degrees in (270, 90, 180, 0, 225, 315, 135, 45, 247, 293, 202, 338, 112, 68, 158, 22):
            x, y = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
            across = 0.5 * min(box[2] / max(abs(x), 1e-9), box[3] / max(abs(y), 1e-9))
            reach = radius + away * gap + across
            yield centre[0] + reach * x, centre[1] + reach * y


def box_around(boxes: Sequence[Box]) -> Box:
    """Return the box around several.

    Examples
    --------
    >>> box_around([(0.0, 0.0, 1.0, 1.0), (2.0, -1.0, 1.0, 1.0)])
    (0.0, -1.0, 3.0, 2.0)
    """
    left, bottom = min(box[0] for box in boxes), min(box[1] for box in boxes)
    right, top = max(box[0] + box[2] for box in boxes), max(box[1] + box[3] for box in boxes)
    return left, bottom, right - left, top - bottom


def _overlap(one: Box, other: Box, edge: float) -> bool:
    return (
        one[0] < other[0] + other[2] + edge
        and other[0] < one[0] + one[2] + edge
        and one[1] < other[1] + other[3] + edge
        and other[1] < one[1] + one[3] + edge
    )


def _dense(line: Vector, spacing: float) -> Vector:
    """Points along a line, not further apart than a spacing."""
    steps = np.maximum(1, np.ceil(np.hypot(*np.diff(line, axis=0).T) / spacing)).astype(int)
    parts = [
        start + (end - start) * np.linspace(0.0, 1.0, count, endpoint=False)[:, None]
        for start, end, count in zip(line[:-1], line[1:], steps, strict=True)
    ]
    return np.concatenate([*parts, line[-1:]])
