"""The flank before and after, with a slider for the depth."""

import math

import numpy as np

from wearsim.geometry.profile import Vector
from wearsim.report.flank_view import life_time, outline
from wearsim.report.html.charts import Chart, Trace, Values, curve, listed, panels, silent
from wearsim.report.lines import grouped
from wearsim.report.worn_flank import WornFlank, flanks_of_life, mate
from wearsim.result import WearResult

_AROUND = 0.22
"""Room around the flank, as a fraction of its extent."""


def tooth_charts(result: WearResult) -> list[Chart]:
    """Return the flank worn to the end of the life, of gears those of both wheels."""
    flanks = flanks_of_life(result)
    around = [*_body(result), _mate(result, flanks[0])]
    return [_chart(result, flank, [] if flank.name == "wheel" else around) for flank in flanks]


def _chart(result: WearResult, flank: WornFlank, around: list[Trace]) -> Chart:
    name, new, depth = flank.name, flank.new, flank.depth[-1]
    greatest, room = float(depth.max()), _AROUND * flank.extent
    figure = panels(1)
    figure.add([*around, *_flanks(depth)])
    figure.layout["hovermode"] = "closest"
    figure.set_axis("x", "x, mm", range=[new.x.min() - room, new.x.max() + room])
    figure.set_axis("y", "y, mm", range=[new.y.min() - room, new.y.max() + room], scaleanchor="x")
    return Chart(
        name=name,
        title=f"{'flank' if name == 'tooth' else name} before and after {life_time(result)}",
        alt=f"The {name} new and worn; the depth, {greatest:.3g} mm at most, is enlarged by the factor of "
        "the slider.",
        figure=figure,
        values=Values((), ()),
        tall=2,
        still="flanks" if name != "wheel" else "",
        slider={
            "first": len(around),
            "x": listed(new.x),
            "y": listed(new.y),
            "dx": listed(flank.x[-1] - new.x),
            "dy": listed(flank.y[-1] - new.y),
            "deepest": flank.deepest,
            "factor": flank.factor,
            "most": max(10, 3 * flank.factor),
            "depth": f"{grouped(greatest, 3)} mm",
        },
    )


def _flanks(depth: Vector) -> list[Trace]:
    """What is worn off, the new flank, the worn one and its deepest point: without points yet."""
    between, new, worn = (
        curve([], [], name, role, "mm")
        for name, role in (("worn off", "between"), ("new", "new"), ("worn", "worn"))
    )
    told = {"hovertemplate": "%{customdata:.4g} mm deep<extra>worn</extra>"}
    deepest = {
        **curve([], [], "deepest", "worn", "mm"),
        "mode": "markers",
        "marker": {"size": 9},
        "hovertemplate": f"deepest, {depth.max():.3g} mm<extra></extra>",
    }
    return [
        {**silent(between, 0), "fill": "toself"},
        new,
        {**worn, "customdata": listed(depth), **told},
        deepest,
    ]


def _body(result: WearResult) -> list[Trace]:
    """The new wheel, or the teeth beside a gap; nothing where only the flank is known."""
    x, y = outline(result)
    if not x.size:
        return []
    body = silent(curve(x, y, "outline", "body", "mm"), 1)
    return [{**body, "fill": "toself", "showlegend": False}]


def _mate(result: WearResult, flank: WornFlank) -> Trace:
    """The circle that touches the new flank where it wears most."""
    (x, y), radius, name = mate(result, flank)
    angle = np.linspace(0.0, math.tau, 91)
    circle_x, circle_y = x + radius * np.cos(angle), y + radius * np.sin(angle)
    return silent(curve(circle_x, circle_y, name, "mate", "mm", "dash"), 1.2)
