"""The flank before and after, with a slider for the depth."""

import math

import numpy as np

from wearsim.geometry.profile_points import Vector
from wearsim.geometry.scene import Circle, Stroke
from wearsim.quantities import grouped
from wearsim.report.flank_view import life_time
from wearsim.report.html.charts import Chart, Trace, ValueTable, curve, json_numbers, panels, without_hover
from wearsim.report.worn_flank import WornFlank, around_flank, flanks_of_life, worn_flanks
from wearsim.result import Life, WearResult

_AROUND = 0.22
"""Room around the flank, as a fraction of its extent."""


def tooth_charts(result: WearResult) -> list[Chart]:
    """Return the flank worn to the end of the life, of gears those of both wheels."""
    flanks = flanks_of_life(result)
    around = [_trace(shape) for shape in around_flank(result, flanks[0])]
    when = life_time(result)
    return [_chart(flank, [] if flank.name == "wheel" else around, when) for flank in flanks]


def worn_out_chart(result: WearResult) -> Chart:
    """Return the flank of a sprocket worn to the end of its own life, on however many chains."""
    (flank,) = worn_flanks(result)
    reached = isinstance(result.parts["sprocket"], Life)
    when = f"{grouped(result.hours_run)} h ({'its own life' if reached else 'limit not reached'})"
    return _chart(flank, [_trace(shape) for shape in around_flank(result, flank)], when)


def _chart(flank: WornFlank, around: list[Trace], when: str) -> Chart:
    name, new, depth = flank.name, flank.new, flank.depth[-1]
    greatest, room = float(depth.max()), _AROUND * flank.extent
    figure = panels(1)
    figure.add([*around, *_flanks(depth)])
    figure.layout["hovermode"] = "closest"
    figure.set_axis("x", "x, mm", range=[new.x.min() - room, new.x.max() + room])
    figure.set_axis("y", "y, mm", range=[new.y.min() - room, new.y.max() + room], scaleanchor="x")
    return Chart(
        name=name,
        title=f"{'flank' if name == 'tooth' else name} before and after {when}",
        alt=f"The {name} new and worn; the depth, {greatest:.3g} mm at most, is enlarged by the factor of "
        "the slider.",
        figure=figure,
        values=ValueTable((), ()),
        tall=2,
        still="flanks" if name != "wheel" else "",
        slider={
            "first": len(around),
            "x": json_numbers(new.x),
            "y": json_numbers(new.y),
            "dx": json_numbers(flank.x[-1] - new.x),
            "dy": json_numbers(flank.y[-1] - new.y),
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
    hover = {"hovertemplate": "%{customdata:.4g} mm deep<extra>worn</extra>"}
    deepest = {
        **curve([], [], "deepest", "worn", "mm"),
        "mode": "markers",
        "marker": {"size": 9},
        "hovertemplate": f"deepest, {depth.max():.3g} mm<extra></extra>",
    }
    return [
        {**without_hover(between, 0), "fill": "toself"},
        new,
        {**worn, "customdata": json_numbers(depth), **hover},
        deepest,
    ]


def _trace(shape: Stroke | Circle) -> Trace:
    """The steel around the new flank, filled, or the circle that touches it."""
    if isinstance(shape, Circle):
        angle = np.linspace(0.0, math.tau, 91)
        middle_x, middle_y = shape.centre
        points = middle_x + shape.radius * np.cos(angle), middle_y + shape.radius * np.sin(angle)
        return without_hover(curve(*points, shape.name, shape.role, "mm", "dash"), 1.2)
    x, y = np.concatenate([shape.vertices, shape.vertices[:1]]).T
    body = without_hover(curve(x, y, "outline", shape.role, "mm"), 1)
    return {**body, "fill": "toself", "showlegend": False}
