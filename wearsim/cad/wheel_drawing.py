"""Wheels as a drawing, outlines on layers of their own with circles, axes and a note, and as points."""

import math
import textwrap
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from wearsim.cad.dxf_writer import Layers
from wearsim.geometry.outline import along_ways
from wearsim.geometry.scene import Circle, Label, Scene, Shape, Stroke, around, line
from wearsim.geometry.wheel_outline import OutlineChain, State, WheelShape

if TYPE_CHECKING:
    import pandas as pd

CHORD_TOLERANCE = 1e-4
"""Distance [mm] of the chords from the arcs where only points can be written."""

_STATES: Layers = {"new": (7, 25, "Continuous"), "worn": (1, 25, "Continuous")}
_OTHERS: Layers = {
    "pitch_circle": (8, 13, "DASHDOT"),
    "centre": (8, 13, "CENTER"),
    "notes": (8, 13, "Continuous"),
}
_ABOUT_THE_AXIS: Layers = {"bore": (7, 25, "Continuous"), "hub": (7, 25, "Continuous")}
"""Both are seen: the hub lies on the side of the face that is drawn."""

_CROSS = 0.05
_LETTERS = 0.015
_LINE = 1.7
_LETTERS_IN_LINE = 75


def wheel_scene(
    shapes: Sequence[WheelShape], states: Sequence[State], note: Sequence[str]
) -> tuple[Scene, Layers]:
    """Return wheels as a drawing, and its layers."""
    layers: dict[str, tuple[int, int, str]] = {}
    drawn: list[Shape] = []
    for shape in shapes:
        for state in states:
            role = state if len(shapes) == 1 else f"{shape.name}_{state}"
            layers[role] = _STATES[state]
            drawn += [chain.stroke(role) for chain in shape.chains(state)]
    for shape in shapes:
        drawn += _about_the_axis(shape)
    layers |= {shape.role: _ABOUT_THE_AXIS[shape.role] for shape in drawn if shape.role in _ABOUT_THE_AXIS}
    for shape in shapes:
        drawn += _axes(shape)
    # A tenth of the largest radius is left free.
    free = 0.1 * max(shape.tip_radius for shape in shapes)
    left, bottom, width, height = around((shape.centre, shape.tip_radius + free) for shape in shapes)
    letters, lines = _LETTERS * width, [row for text in note for row in textwrap.wrap(text, _LETTERS_IN_LINE)]
    for number, text in enumerate(lines, 1):
        drawn.append(Label("notes", text, (left, bottom - _LINE * number * letters), letters))
    below = _LINE * (len(lines) + 1) * letters
    low, size = (math.floor(left), math.floor(bottom - below)), (math.ceil(width), math.ceil(height + below))
    return Scene((*low, size[0] + 1, size[1] + 1), tuple(drawn)), {**layers, **_OTHERS}


def _about_the_axis(shape: WheelShape) -> list[Shape]:
    """Bore, a whole circle where it has no keyway, and hub."""
    hub, bore = shape.hub, shape.bore
    found: list[Shape] = []
    if bore is not None and hub.keyway_width:
        found.append(Stroke("bore", bore.vertices, bore.bulges.tolist(), closed=True))
    elif bore is not None:
        found.append(Circle("bore", shape.centre, 0.5 * hub.bore))
    if hub.hub_diameter:
        found.append(Circle("hub", shape.centre, 0.5 * hub.hub_diameter))
    return found


def _axes(shape: WheelShape) -> list[Shape]:
    """Pitch circle, cross of the axis and the centre line of the first space."""
    (x, y), arm, up = shape.centre, _CROSS * shape.tip_radius, 1.05 * shape.tip_radius
    end = (x - up * math.sin(shape.turn), y + up * math.cos(shape.turn))
    return [
        Circle("pitch_circle", shape.centre, shape.pitch_radius),
        line("centre", [(x - arm, y), (x + arm, y)]),
        line("centre", [(x, y - arm), (x, y + arm)]),
        line("centre", [(x, y), end]),
    ]


def wheel_points(shapes: Sequence[WheelShape], states: Sequence[State]) -> "pd.DataFrame":
    """Return the outlines of wheels by points."""
    import pandas as pd  # takes 0.3 s, and a drawing has no table

    columns = ("wheel", "state", "tooth", "stretch", "x_mm", "y_mm")
    return pd.DataFrame(
        (
            (shape.name, state, *row)
            for shape in shapes
            for state in states
            for chain in shape.chains(state)
            for row in _rows(chain)
        ),
        columns=columns,
    )


def csv_bytes(shapes: Sequence[WheelShape], states: Sequence[State]) -> bytes:
    """Return the points of wheels as the content of a CSV file."""
    return wheel_points(shapes, states).to_csv(index=False).encode()


def _rows(chain: OutlineChain) -> Iterator[tuple[int, str, float, float]]:
    """Tooth, stretch and place of every point of an outline."""
    for stretch, tooth in zip(chain.stretches, chain.teeth, strict=True):
        points, _ = along_ways(stretch.vertices[:-1], stretch.vertices[1:], stretch.bulges, CHORD_TOLERANCE)
        if not chain.closed and stretch is chain.stretches[-1]:
            points = np.concatenate([points, stretch.vertices[-1:]])
        yield from ((tooth, stretch.part, x, y) for x, y in points.tolist())
