"""Wheels as STEP solids; takes build123d, the extra ``step``."""

import io
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from wearsim.geometry.outline_stretch import OutlineStretch
from wearsim.geometry.profile_points import Vector
from wearsim.geometry.wheel_outline import State, WheelShape

if TYPE_CHECKING:
    from build123d import Edge, Solid

SPLINE_TOLERANCE = 5e-6
"""Distance [mm] of splines from the arcs between the computed points."""

_FEWEST = 4
"""Points of a spline."""


def step_bytes(shapes: Sequence[WheelShape], states: Sequence[State]) -> bytes:
    """Return wheels as the content of a STEP file."""
    from build123d import Compound, export_step

    solids = []
    for shape in shapes:
        for state in states:
            (chain,) = shape.chains(state)
            body = _with_hub(solid(chain.stretches, shape.width), shape)
            body.label = f"{shape.name} {state}"
            solids.append(body)
    stream = io.BytesIO()
    whole = solids[0] if len(solids) == 1 else Compound(label="wheels", children=solids)
    export_step(whole, stream, write_pcurves=False, timestamp="1970-01-01T00:00:00")
    return stream.getvalue()


def solid(stretches: Sequence[OutlineStretch], width: float) -> "Solid":
    """Return an outline extruded along z."""
    from build123d import Face, Solid, Wire
    from build123d import Vector as Direction

    edges = [edge for stretch in stretches for edge in _edges(stretch)]
    return Solid.extrude(Face(Wire(edges)), Direction(0.0, 0.0, width))


def _with_hub(body: "Solid", shape: WheelShape) -> "Solid":
    """Return a wheel with its hub added above the face and its bore cut through both."""
    from build123d import Pos, SkipClean, Solid

    hub, bore, (x, y) = shape.hub, shape.bore, shape.centre
    length = shape.width + hub.hub_length
    # Cleaning would join the edges of the teeth into longer ones.
    with SkipClean():
        if hub.hub_diameter:
            cylinder = Solid.make_cylinder(0.5 * hub.hub_diameter, hub.hub_length)
            body = body.fuse(Pos(x, y, shape.width) * cylinder)
        if bore is not None and hub.keyway_width:
            ends = np.concatenate([bore.vertices, bore.vertices[:1]])
            body = body.cut(solid([OutlineStretch("bore", ends, bore.bulges)], length))
        elif bore is not None:
            body = body.cut(Pos(x, y, 0.0) * Solid.make_cylinder(0.5 * hub.bore, length))
    return body


def _edges(stretch: OutlineStretch) -> "list[Edge]":
    from build123d import Edge

    if stretch.is_curve:
        return [edge for part in _smooth(stretch) for edge in _curve(part)]
    found = []
    for start, end, bulge in zip(stretch.vertices[:-1], stretch.vertices[1:], stretch.bulges, strict=True):
        if bulge == 0.0:
            found.append(Edge.make_line(tuple(start), tuple(end)))
        else:
            (middle,) = _middles(start[None], end[None], np.array([bulge]))
            found.append(Edge.make_three_point_arc(tuple(start), tuple(middle), tuple(end)))
    return found


def _curve(part: OutlineStretch) -> "list[Edge]":
    """One spline, or the arcs where there are few."""
    from build123d import Edge

    if len(part.vertices) < _FEWEST:
        return _edges(replace(part, is_curve=False))
    points = [(x, y, 0.0) for x, y in part.vertices.tolist()]
    tangents = [(x, y, 0.0) for x, y in _ends(part)]
    return [Edge.make_spline(points, tangents, parameters=_way(part).tolist(), scale=False)]


def _smooth(stretch: OutlineStretch) -> list[OutlineStretch]:
    """Parts of a curve on which one spline keeps to the arcs between its points.

    A spline has no corners and no jumps of curvature; it is split where it leaves the arcs most.
    """
    from scipy.interpolate import CubicSpline

    if len(stretch.vertices) < _FEWEST:
        return [stretch]
    way, (first, last) = _way(stretch), _ends(stretch)
    spline = CubicSpline(way, stretch.vertices, bc_type=((1, first), (1, last)))
    middles = _middles(stretch.vertices[:-1], stretch.vertices[1:], stretch.bulges)
    off = np.hypot(*(spline(0.5 * (way[1:] + way[:-1])) - middles).T)
    if off.max() <= SPLINE_TOLERANCE:
        return [stretch]
    cut = min(max(int(off.argmax()), 1), len(off) - 1)
    before = replace(stretch, vertices=stretch.vertices[: cut + 1], bulges=stretch.bulges[:cut])
    after = replace(stretch, vertices=stretch.vertices[cut:], bulges=stretch.bulges[cut:])
    return _smooth(before) + _smooth(after)


def _way(stretch: OutlineStretch) -> Vector:
    """Length along the arcs to every vertex [mm]."""
    half = 2.0 * np.arctan(stretch.bulges)
    chord = np.hypot(*np.diff(stretch.vertices, axis=0).T)
    return np.concatenate([[0.0], np.cumsum(chord / np.sinc(half / math.pi))])


def _ends(stretch: OutlineStretch) -> tuple[Vector, Vector]:
    """Directions of travel at both ends, half of an arc's angle off its chord."""
    found = []
    for way, sense in ((0, -1.0), (-1, 1.0)):
        x, y = np.diff(stretch.vertices, axis=0)[way]
        angle = math.atan2(y, x) + sense * 2.0 * math.atan(stretch.bulges[way])
        found.append(np.array([math.cos(angle), math.sin(angle)]))
    return found[0], found[1]


def _middles(starts: Vector, ends: Vector, bulges: Vector) -> Vector:
    """Middles of arcs: off those of their chords by the bulge times half of the chord."""
    across = (ends - starts)[:, ::-1] * (1.0, -1.0)
    return np.asarray(0.5 * (starts + ends) + 0.5 * bulges[:, None] * across)
