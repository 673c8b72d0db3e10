"""A closed chain round its sprockets as it is drawn: to scale, with the tension of every span."""

import math
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from wearsim.chain.chain_loop import ChainLoop
from wearsim.chain.loop_forces import LoopForces
from wearsim.geometry.profile_points import Vector
from wearsim.geometry.scene import Box, Circle, Label, Scene, Shape, around, letter_height, line, turn_arrow
from wearsim.quantities import grouped

_ARC = math.radians(3.0)
"""Angle between points of an arc of the chain."""

_ARROW = 0.6
"""Radius of the arrow that tells the sense of a wheel, over that of its pitch circle."""

_UPRIGHT = 0.8
"""Part of the height that letters follow where a sketch is upright."""


def loop_scene(forces: LoopForces, roller_radius: float, worn: Sequence[Shape] = (), own: int = -1) -> Scene:
    """Return all sprockets with the chain around them.

    Parameters
    ----------
    forces : LoopForces
        The loop, and what pulls in its spans.
    roller_radius : float
        Radius of the rollers [mm].
    worn : sequence of shapes
        What is drawn of one sprocket in place of its tip circle.
    own : int
        Which sprocket that is, -1 for none.
    """
    loop = forces.loop
    tips = loop.tip_radii
    centres = [(float(x), float(y)) for x, y in loop.centres]
    box = around(
        [
            *zip(centres, tips.tolist(), strict=True),
            *zip(centres, (loop.pitch_radii + roller_radius).tolist(), strict=True),
        ]
    )
    text = letter_height((*box[:2], max(box[2], _UPRIGHT * box[3]), box[3]))
    shapes: list[Shape] = [*worn]
    arrows = []
    for i, centre in enumerate(centres):
        radius = float(loop.pitch_radii[i])
        if i != own:
            shapes.append(Circle("tip", centre, float(tips[i])))
        arrow = turn_arrow(centre, _ARROW * radius, int(loop.senses[i]))
        arrows += [stroke.vertices for stroke in arrow]
        shapes += [Circle("pitch", centre, radius), *arrow]
    path = chain_path(loop)
    shapes += [line("chain", path, closed=True)]
    circles = [_circle(centre, tip) for centre, tip in zip(centres, tips.tolist(), strict=True)]
    free = FreePlaces([np.vstack([path, path[:1]]), *circles, *arrows], 0.3 * text, 0.3 * text)
    for i, (wheel, centre) in enumerate(zip(loop.wheels, centres, strict=True)):
        name = f"{wheel.name}, {wheel.teeth}" if wheel.teeth else wheel.name
        outer = max(float(tips[i]), _riding(loop, i, roller_radius))
        size = label_box(name, centre, text)
        shapes.append(free.set(name, around_circle(centre, outer, size, 0.5 * text), text))
    for i in range(len(centres)):
        # Beside the span, rather on the side that lies outside of the loop.
        right = np.array([loop.directions[i, 1], -loop.directions[i, 0]]) * loop.turn
        pull = f"{grouped(float(forces.tensions[i]))} N"
        size = label_box(pull, centres[i], text)
        places = beside_line(loop.starts[i], loop.ends[i], right, size, roller_radius + 0.5 * text)
        shapes.append(free.set(pull, places, text))
    box = box_around([box, *free.boxes])
    return Scene(box, tuple(shapes), _alt(loop), _notes(forces)).with_scale(text)


def _circle(centre: tuple[float, float], radius: float) -> Vector:
    angles = np.linspace(0.0, 2.0 * math.pi, 121)
    return centre + radius * np.column_stack([np.cos(angles), np.sin(angles)])


def _riding(loop: ChainLoop, wheel: int, roller_radius: float) -> float:
    """Radius that the chain reaches to on a wheel."""
    return float(loop.pitch_radii[wheel]) + roller_radius


def chain_path(loop: ChainLoop) -> Vector:
    """Return the line of the chain: spans, and arcs of the pitch circles as points, shape (n, 2).

    Examples
    --------
    >>> from wearsim.chain.chain_loop import Wheel
    >>> loop = ChainLoop(10.0, (Wheel("driver", (0.0, 0.0), 20), Wheel("driven", (300.0, 0.0), 20)))
    >>> path = chain_path(loop)
    >>> steps = np.hypot(*np.diff(path, axis=0, append=path[:1]).T)
    >>> bool(abs(steps.sum() / loop.circle_length - 1.0) < 1e-3)
    True
    """
    parts = []
    for i, centre in enumerate(loop.centres):
        first = loop.ends[i - 1] - centre
        angle = math.atan2(first[1], first[0])
        count = max(2, math.ceil(float(loop.wrap_angles[i]) / _ARC) + 1)
        angles = angle + loop.senses[i] * np.linspace(0.0, float(loop.wrap_angles[i]), count)
        parts.append(centre + loop.pitch_radii[i] * np.column_stack([np.cos(angles), np.sin(angles)]))
    return np.concatenate(parts)


def _alt(loop: ChainLoop) -> str:
    wheels = ", ".join(
        f"{wheel.name} of {wheel.teeth} teeth" if wheel.teeth else f"{wheel.name}, smooth"
        for wheel in loop.wheels
    )
    return f"{len(loop.wheels)} sprockets to scale with the chain around them: {wheels}."


def _notes(forces: LoopForces) -> tuple[str, ...]:
    loop = forces.loop
    return (
        "; ".join(
            f"wrap angle of {wheel.name} {math.degrees(angle):.1f} degrees"
            for wheel, angle in zip(loop.wheels, loop.wrap_angles, strict=True)
        ),
        "; ".join(
            f"{loop.span_name(i)} {grouped(float(tension))} N" for i, tension in enumerate(forces.tensions)
        ),
        "sag not drawn; tensions at the highest load, without centrifugal tension",
    )


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
