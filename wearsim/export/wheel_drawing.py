"""Wheels as a drawing: outlines on layers of their own, circles, axes and a note."""

import math
import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING

from wearsim.export.dxf_writer import add_polyline, new_drawing
from wearsim.export.wheel_states import State, WheelShape

if TYPE_CHECKING:
    from ezdxf.document import Drawing

CHORD_TOLERANCE = 1e-4
"""Distance [mm] of the chords from the arcs where only points can be written."""

_COLOURS = {"NEW": 7, "WORN": 1, "PITCH_CIRCLE": 8, "CENTRE": 8, "NOTES": 8}
_WEIGHTS = {"NEW": 25, "WORN": 25}
_DASHED = {"PITCH_CIRCLE": "DASHDOT", "CENTRE": "CENTER"}
_CROSS = 0.05
_LETTERS = 0.015
_LINE = 1.7
_LETTERS_IN_LINE = 75


def wheel_drawing(shapes: Sequence[WheelShape], states: Sequence[State], note: Sequence[str]) -> "Drawing":
    """Return wheels as a drawing."""
    drawing = new_drawing()
    for shape in shapes:
        for state in states:
            name = state.upper() if len(shapes) == 1 else f"{shape.name}_{state}".upper()
            add_layer(drawing, name, state.upper())
            for chain in shape.chains(state):
                add_polyline(drawing, name, chain.vertices, chain.bulges, chain.closed)
    for name in ("PITCH_CIRCLE", "CENTRE", "NOTES"):
        add_layer(drawing, name, name)
    for shape in shapes:
        _add_axes(drawing, shape)
    left, bottom, width, _ = _around(shapes)
    height = _LETTERS * width
    for number, text in enumerate(_folded(note), 1):
        add_text(drawing, text, (left, bottom - _LINE * number * height), height)
    return drawing


def add_layer(drawing: "Drawing", name: str, kind: str) -> None:
    """Add a layer that looks like its kind."""
    drawing.layers.add(
        name,
        color=_COLOURS[kind],
        linetype=_DASHED.get(kind, "Continuous"),
        lineweight=_WEIGHTS.get(kind, 13),
    )


def add_text(
    drawing: "Drawing", text: str, place: tuple[float, float], height: float, layer: str = "NOTES"
) -> None:
    """Add a line of text."""
    # %%d and the like are codes in a DXF text, and so is a caret.
    plain = " ".join(text.replace("%%", "% %").replace("^", "^ ").split())
    drawing.modelspace().add_text(plain, height=height, dxfattribs={"layer": layer, "insert": place})


def drawing_box(shapes: Sequence[WheelShape], note: Sequence[str]) -> tuple[float, float, float, float]:
    """Return the rectangle that wheels and the note below them take."""
    left, bottom, width, height = _around(shapes)
    below = _LINE * (len(_folded(note)) + 1) * _LETTERS * width
    return (math.floor(left), math.floor(bottom - below), math.ceil(width) + 1, math.ceil(height + below) + 1)


def _around(shapes: Sequence[WheelShape]) -> tuple[float, float, float, float]:
    """Left, bottom, width and height of the wheels, a tenth of the largest radius left free."""
    free = 0.1 * max(shape.tip_radius for shape in shapes)
    reach = [(shape.centre, shape.tip_radius + free) for shape in shapes]
    left, right = min(x - r for (x, _), r in reach), max(x + r for (x, _), r in reach)
    bottom, top = min(y - r for (_, y), r in reach), max(y + r for (_, y), r in reach)
    return left, bottom, right - left, top - bottom


def _folded(note: Sequence[str]) -> list[str]:
    return [line for text in note for line in textwrap.wrap(text, _LETTERS_IN_LINE)]


def _add_axes(drawing: "Drawing", shape: WheelShape) -> None:
    """Pitch circle, cross of the axis and the centre line of the first space."""
    space, (x, y) = drawing.modelspace(), shape.centre
    space.add_circle(shape.centre, shape.pitch_radius, dxfattribs={"layer": "PITCH_CIRCLE"})
    arm = _CROSS * shape.tip_radius
    up = 1.05 * shape.tip_radius
    end = (x - up * math.sin(shape.turn), y + up * math.cos(shape.turn))
    for first, last in (((x - arm, y), (x + arm, y)), ((x, y - arm), (x, y + arm)), ((x, y), end)):
        space.add_line(first, last, dxfattribs={"layer": "CENTRE"})
