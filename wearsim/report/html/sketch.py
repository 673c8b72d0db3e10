"""The drive to scale: strokes in mm that the page draws as SVG."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from wearsim.geometry.profile import Vector

_MARGIN = 0.04
"""Free edge around a sketch, as a fraction of its width."""

_TEXT = 1.0 / 34.0
"""Height of letters over the width of the sketch."""


@dataclass(frozen=True)
class Stroke:
    """A line of a sketch."""

    # what it stands for: `wheel`, `worn`, `pitch`, `tip`, `chain`, `roller`, `arrow`, `contact` or
    # `scale`
    role: str
    path: str  # SVG path data, y downwards [mm]


@dataclass(frozen=True)
class Label:
    """A word in a sketch."""

    x: float  # middle of its base line, y downwards [mm]
    y: float  # middle of its base line, y downwards [mm]
    text: str  # the word


@dataclass(frozen=True)
class Sketch:
    """A drawing to scale."""

    box: tuple[float, float, float, float]  # left, top, width and height [mm], y downwards
    text_size: float  # height of letters [mm]
    strokes: tuple[Stroke, ...]  # drawn in this order
    labels: tuple[Label, ...]  # drawn above them
    alt: str  # what there is to see, for those who cannot
    notes: tuple[str, ...]  # what stands below the drawing


def line(points: ArrayLike, closed: bool = False) -> str:
    """Return path data through points.

    Examples
    --------
    >>> line([(0, 0), (10, 5.5)])
    'M0 0L10 -5.5'
    """
    places = [f"{_short(x)} {_short(-y)}" for x, y in np.asarray(points, dtype=float)]
    return f"M{'L'.join(places)}{'Z' if closed else ''}"


def circle(x: float, y: float, radius: float) -> str:
    """Return path data of a circle.

    Examples
    --------
    >>> circle(0.0, 0.0, 5.0)
    'M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0'
    """
    r, width = _short(radius), _short(2.0 * radius)
    half = f"a{r} {r} 0 1 0 "
    return f"M{_short(x - radius)} {_short(-y)}{half}{width} 0{half}-{width} 0"


def turn_arrow(x: float, y: float, radius: float, sense: int) -> str:
    """Return path data of an arrow that turns around a point."""
    angles = sense * np.radians(np.linspace(-150.0, 60.0, 29)) + 0.5 * math.pi
    arc = np.column_stack([x + radius * np.cos(angles), y + radius * np.sin(angles)])
    return line(arc) + _head(arc[-1], arc[-1] - arc[-3], 0.3 * radius)


def straight_arrow(start: tuple[float, float], end: tuple[float, float], head: float) -> str:
    """Return path data of a straight arrow."""
    way = np.subtract(end, start)
    return line([start, end]) + _head(np.asarray(end, dtype=float), way, head)


def _head(tip: Vector, way: Vector, length: float) -> str:
    ahead = way / np.hypot(*way)
    across = np.array([-ahead[1], ahead[0]])
    back = tip - length * ahead
    return line([back + 0.45 * length * across, tip, back - 0.45 * length * across])


def scaled(sketch: Sketch) -> Sketch:
    """Return a sketch with a margin, a bar of round length below it and letters that fit."""
    left, top, width, height = sketch.box
    edge = _MARGIN * width
    text = text_size(sketch.box)
    bar = round_length(0.25 * width)
    y = top + height + 2.6 * text
    tick = 0.4 * text
    x = left
    path = f"M{_short(x)} {_short(y - tick)}v{_short(2 * tick)}m0 {_short(-tick)}h{_short(bar)}"
    path += f"m0 {_short(-tick)}v{_short(2 * tick)}"
    return replace(
        sketch,
        box=(left - edge, top - edge - text, width + 2 * edge, height + 2 * edge + 4.4 * text),
        text_size=text,
        strokes=(*sketch.strokes, Stroke("scale", path)),
        labels=(*sketch.labels, Label(x + 0.5 * bar, y - 0.8 * tick, f"{bar:g} mm")),
    )


def text_size(box: tuple[float, float, float, float]) -> float:
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


def around(circles: Sequence[tuple[float, float, float]]) -> tuple[float, float, float, float]:
    """Return the box around circles."""
    left, right = min(x - r for x, _, r in circles), max(x + r for x, _, r in circles)
    low, high = min(y - r for _, y, r in circles), max(y + r for _, y, r in circles)
    return left, -high, right - left, high - low


def _short(value: float) -> str:
    """Two decimals, without a zero at the end or before the sign of nothing."""
    return f"{round(value, 2) + 0.0:.2f}".rstrip("0").rstrip(".")
