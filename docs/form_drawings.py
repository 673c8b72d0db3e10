"""Draw where a roller presses on each tooth form: ``python docs/form_drawings.py docs/tooth_forms.svg``.

Drive E of research/tooth_forms.py, its first tooth under a new chain.
"""

import math
import runpy
import sys
from pathlib import Path

import numpy as np

from wearsim.drive.load_case import load_single
from wearsim.geometry.scene import Circle, Label, Scene, Stroke, line
from wearsim.mechanisms.wrap.tooth_loads import tooth_loads

DOCS = Path(__file__).parent
RESEARCH = runpy.run_path(str(DOCS.parent / "research" / "tooth_forms.py"))
SVG = runpy.run_path(str(DOCS / "strand_drawings.py"))["svg"]
COLUMNS, APART, ROW, HIGH = 3, 14.5, 15.0, 1.05
"""Drawings in a row, their distances to the right and down, and the height of the letters [mm]."""


def pressed(form: str, right: float, up: float) -> tuple[list[Stroke | Circle | Label], float]:
    """Return the gap of a form with the roller on its first tooth, and the pressure angle [deg]."""
    case = load_single(RESEARCH["tables"](RESEARCH["DRIVES"]["E"], RESEARCH["FORMS"][form]))
    teeth, radius = case.inputs["sprocket"]["teeth"], 0.5 * case.inputs["chain"]["roller_diameter_mm"]
    loads = tooth_loads(case).loads
    angle = float(loads.pressure_angle[0])
    columns = case.drive.profile_columns()
    touched = int(np.abs(columns["arc_length_mm"] - loads.contact_arc_length[0]).argmin())
    # Drawn with the working flank on the right, and from the bottom of the gap.
    side = math.copysign(1.0, columns["x_mm"][touched])
    heights = columns["y_mm"] - columns["y_mm"].min() + up
    points = np.column_stack([right + side * columns["x_mm"], heights])[::8]
    from_inward = 0.5 * math.pi - math.pi / teeth - angle
    x, y = (float(value) for value in (right + side * columns["x_mm"][touched], heights[touched]))
    centre = (x - radius * math.sin(from_inward), y + radius * math.cos(from_inward))
    low, half = up - 3.0, math.copysign(0.5 * case.inputs["chain"]["pitch_mm"], points[-1, 0] - right)
    (first, last), edges = points[[0, -1], 1], (right - half, right + half)
    sides = [(edges[1], last), (edges[1], low), (edges[0], low), (edges[0], first)]
    steel = np.concatenate([points, sides])
    share = float(loads.force[0] / loads.tension[0])
    return [
        line("body", steel, closed=True),
        Circle("touching", centre, radius),
        line("normal", [(x, y), centre]),
        Circle("dot", (x, y), 0.25),
        Label("text", form, (right, up + 9.4), 1.2 * HIGH),
        Label("text", f"{math.degrees(angle):.0f}°, {share:.2f} of the pull", (right, low + 0.6), HIGH),
    ], math.degrees(angle)


def scene() -> Scene:
    """Return all forms side by side."""
    drawn = {
        form: pressed(form, APART * (number % COLUMNS), -ROW * (number // COLUMNS))
        for number, form in enumerate(RESEARCH["FORMS"])
    }
    shapes = [shape for parts, _ in drawn.values() for shape in parts]
    angles = ", ".join(f"{form} {angle:.0f}" for form, (_, angle) in drawn.items())
    return Scene(
        (-0.5 * APART, -ROW - 3.6, APART * COLUMNS, 2.0 * ROW + 0.6),
        tuple(shapes),
        f"Gaps of five tooth forms with the roller on its first tooth; pressure angles, degrees: {angles}.",
    )


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(SVG(scene()), "utf-8")
