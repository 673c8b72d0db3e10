"""Draw the logo of the pages: ``python docs/logo.py docs/_static/logo.svg``.

A sprocket of 11 teeth for 08B-1 by ISO 606, with rollers of the chain in its upper gaps; the flanks that they
press are red. tests/docs/test_strand_drawings.py compares.
"""

import math
import sys
from pathlib import Path

import numpy as np

from wearsim.geometry.forms import TOOTH_FORMS
from wearsim.geometry.outline import rotated
from wearsim.geometry.profile_points import Vector

PITCH, ROLLER, TEETH = 12.7, 8.51, 11
ROLLERS = (-2, -1, 0, 1, 2)
"""Gaps that hold a roller, from the one at the top."""

STYLE = (
    ".wheel { fill: #2f6db5; fill-rule: evenodd; }"
    " .roller { fill: #cfd6de; stroke: #6b7280; }"
    " .worn { fill: none; stroke: #d9483b; stroke-width: 1.8; stroke-linecap: round; }"
)


def path(points: Vector, closed: bool) -> str:
    """Return path data, y downwards."""
    return "M" + "L".join(f"{x:.2f} {-y:.2f}" for x, y in points.tolist()) + ("Z" if closed else "")


def logo() -> str:
    """Return the drawing as a file of its own."""
    gap = TOOTH_FORMS["iso606"].gap(PITCH, ROLLER, TEETH)
    outline = gap.outline(41)
    space = np.column_stack([outline.x, outline.y])[::-1]
    step = math.tau / TEETH
    wheel = np.concatenate([rotated(space, -number * step) for number in range(TEETH)])
    bore = 0.42 * gap.bottom_radius
    reach = gap.pitch_radius + 0.62 * ROLLER
    half = f"a{bore:.2f} {bore:.2f} 0 1 0 "
    hole = f"M{-bore:.2f} 0{half}{2 * bore:.2f} 0{half}{-2 * bore:.2f} 0Z"
    corner, side = f"{-reach:.2f}", f"{2 * reach:.2f}"
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{corner} {corner} {side} {side}">',
        f"<style>{STYLE}</style>",
        f'<path class="wheel" d="{path(wheel, True)}{hole}"/>',
    ]
    for number in ROLLERS:
        ((x, y),) = rotated(np.array([[0.0, gap.pitch_radius]]), number * step)
        lines.append(f'<circle class="roller" cx="{x:.2f}" cy="{-y:.2f}" r="{0.5 * ROLLER:.2f}"/>')
        pressed = rotated(space[3:17], number * step)
        lines.append(f'<path class="worn" d="{path(pressed, False)}"/>')
    return "\n".join([*lines, "</svg>", ""])


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(logo(), "utf-8")
