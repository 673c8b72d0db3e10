"""A closed chain round its sprockets as it is drawn: to scale, with the tension of every span."""

import math
from collections.abc import Sequence

import numpy as np

from wearsim.chain.chain_loop import ChainLoop
from wearsim.chain.loop_forces import LoopForces
from wearsim.geometry.label_places import FreePlaces, around_circle, beside_line, box_around, label_box
from wearsim.geometry.profile_points import Vector
from wearsim.geometry.scene import Circle, Scene, Shape, around, letter_height, line, turn_arrow
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
        name, outer = f"{wheel.name}, {wheel.teeth}", max(float(tips[i]), _riding(loop, i, roller_radius))
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
    wheels = ", ".join(f"{wheel.name} of {wheel.teeth} teeth" for wheel in loop.wheels)
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
