"""Wheels of a case or run in the formats of CAD."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from wearsim._version import __version__
from wearsim.case.model import Case
from wearsim.export.wheel_drawing import CHORD_TOLERANCE, drawing_box, wheel_drawing
from wearsim.export.wheel_shapes import wheel_shapes
from wearsim.export.wheel_states import State, WheelShape
from wearsim.geometry.outline import along_ways
from wearsim.geometry.wheel import Chain
from wearsim.report.lines import grouped
from wearsim.result import WearResult

if TYPE_CHECKING:
    import pandas as pd


def export(case: Case, result: WearResult | None, states: Sequence[State], form: str) -> bytes:
    """Return the wheels of a case as the content of a file."""
    shapes = wheel_shapes(case, result)
    if form == "csv":
        return wheel_points(shapes, states).to_csv(index=False).encode()
    if form == "step":
        from wearsim.export.step import step_bytes

        return step_bytes(shapes, states)
    note = wheel_note(case, result, shapes, states)
    drawing = wheel_drawing(shapes, states, note)
    if form == "svg":
        from wearsim.export.printed_page import svg_text

        return svg_text(drawing, drawing_box(shapes, note)).encode()
    from wearsim.export.dxf_writer import dxf_text

    return dxf_text(drawing).encode()


def wheel_note(
    case: Case, result: WearResult | None, shapes: Sequence[WheelShape], states: Sequence[State]
) -> list[str]:
    """Return what stands below the wheels in a drawing."""
    taken = [f"{shape.name}: {text}" for shape in shapes for text in shape.notes]
    if len(shapes) > 1 and shapes[0].notes == shapes[1].notes:
        taken = list(shapes[0].notes)
    return [
        f"{case.title} (case {case.name})",
        _condition(result if "worn" in states else None, states),
        "All in mm, 1:1. Vertices lie on the computed outline within 1e-6 mm; between points of a curve "
        f"run arcs, {_greatest_sagitta(shapes):.1g} mm off their chords at most.",
        *(f"{text[0].upper()}{text[1:]}." for text in taken),
        f"wearsim {__version__}",
    ]


def _condition(result: WearResult | None, states: Sequence[State]) -> str:
    if result is None:
        return "New."
    both = "New, and worn" if len(states) > 1 else "Worn"
    deepest = f"{result.max_depth:.3g} mm off at the deepest point"
    return f"{both} after {grouped(result.hours_run)} h: {deepest}."


def _greatest_sagitta(shapes: Sequence[WheelShape]) -> float:
    """Greatest distance of an arc between computed points from its chord [mm], 0 without any."""
    return max(
        (
            stretch.sagitta
            for shape in shapes
            for space in (*shape.new[:1], *shape.worn[:2])
            for stretch in (*space.right, *space.left)
            if stretch.is_curve
        ),
        default=0.0,
    )


def wheel_points(shapes: Sequence[WheelShape], states: Sequence[State]) -> "pd.DataFrame":
    """Return the outlines of wheels by points."""
    import pandas as pd

    tables = [
        pd.DataFrame(_chain_points(chain)).assign(wheel=shape.name, state=state)
        for shape in shapes
        for state in states
        for chain in shape.chains(state)
    ]
    return pd.concat(tables)[["wheel", "state", "tooth", "stretch", "x_mm", "y_mm"]]


def _chain_points(chain: Chain) -> dict[str, Any]:
    rows, numbers, names = [], [], []
    for stretch, tooth in zip(chain.stretches, chain.teeth, strict=True):
        points, _ = along_ways(stretch.vertices[:-1], stretch.vertices[1:], stretch.bulges, CHORD_TOLERANCE)
        if not chain.closed and stretch is chain.stretches[-1]:
            points = np.concatenate([points, stretch.vertices[-1:]])
        rows.append(points)
        numbers += [tooth] * len(points)
        names += [stretch.part] * len(points)
    x, y = np.concatenate(rows).T
    return {"tooth": numbers, "stretch": names, "x_mm": x, "y_mm": y}
