"""The flank before and after, with a slider for the depth."""

import math

import numpy as np
import plotly.graph_objects as go

from wearsim.geometry.profile import Profile, Vector
from wearsim.report.answer import grouped
from wearsim.report.flank_view import enlargement, outline, run_time, snapshot, touching_circle
from wearsim.report.html.charts import Chart, Values, curve, listed, panels
from wearsim.result import WearResult

_AROUND = 0.22
"""Room around the flank, as a fraction of its extent."""


def tooth_charts(result: WearResult) -> list[Chart]:
    """Return the worn flank, of gears those of both wheels.

    Parameters
    ----------
    result : WearResult
        The result.

    Returns
    -------
    list of Chart
        One or two, each with its slider, whose points the script of the page fills in.
    """
    first, last = snapshot(result, 0), snapshot(result, -1)
    new, worn = Profile(first["x_mm"], first["y_mm"]), (last["x_mm"], last["y_mm"])
    around = [*_body(result), _mate(result, new, int(last["depth_mm"].argmax()))]
    if "wheel_x_mm" not in last:
        return [_chart(result, "tooth", new, worn, last["depth_mm"], around)]
    mate = Profile(first["wheel_x_mm"], first["wheel_y_mm"])
    worn_mate = last["wheel_x_mm"], last["wheel_y_mm"]
    return [
        _chart(result, "pinion", new, worn, last["depth_mm"], around),
        _chart(result, "wheel", mate, worn_mate, last["wheel_depth_mm"], []),
    ]


def _chart(
    result: WearResult,
    name: str,
    new: Profile,
    worn: tuple[Vector, Vector],
    depth: Vector,
    around: list[go.Scatter],
) -> Chart:
    extent = float(max(np.ptp(new.x), np.ptp(new.y)))
    greatest, room = float(depth.max()), _AROUND * extent
    factor = enlargement(greatest, extent)
    figure = panels(1)
    figure.add_traces([*around, *_flanks(depth)])
    figure.update_layout(hovermode="closest")
    figure.update_xaxes(title_text="x, mm", range=[new.x.min() - room, new.x.max() + room])
    figure.update_yaxes(
        title_text="y, mm", range=[new.y.min() - room, new.y.max() + room], scaleanchor="x"
    )
    return Chart(
        name=name,
        title=f"{'flank' if name == 'tooth' else name} before and after {run_time(result)}",
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
            "dx": listed(worn[0] - new.x),
            "dy": listed(worn[1] - new.y),
            "deepest": int(depth.argmax()),
            "factor": factor,
            "most": max(10, 3 * factor),
            "depth": f"{grouped(greatest, 3)} mm",
        },
    )


def _flanks(depth: Vector) -> list[go.Scatter]:
    """What is worn off, the new flank, the worn one and its deepest point: without points yet."""
    between, new, worn = (
        curve([], [], name, role, "mm")
        for name, role in (("worn off", "between"), ("new", "new"), ("worn", "worn"))
    )
    between.update(fill="toself", line={"width": 0}, hoverinfo="skip", hovertemplate=None)
    worn.update(
        customdata=listed(depth), hovertemplate="%{customdata:.4g} mm deep<extra>worn</extra>"
    )
    deepest = curve([], [], "deepest", "worn", "mm")
    deepest.update(
        mode="markers",
        marker={"size": 9},
        hovertemplate=f"deepest, {depth.max():.3g} mm<extra></extra>",
    )
    return [between, new, worn, deepest]


def _body(result: WearResult) -> list[go.Scatter]:
    """The new wheel, or the teeth beside a gap; nothing where only the flank is known."""
    x, y = outline(result)
    if not x.size:
        return []
    body = curve(x, y, "outline", "body", "mm")
    body.update(
        fill="toself", hoverinfo="skip", hovertemplate=None, showlegend=False, line={"width": 1}
    )
    return [body]


def _mate(result: WearResult, new: Profile, deepest: int) -> go.Scatter:
    """The circle that touches the new flank where it wears most."""
    place = float(snapshot(result, -1)["arc_length_mm"][deepest])
    radius, name = touching_circle(result, place)
    x = new.x[deepest] + radius * new.normal_x[deepest]
    y = new.y[deepest] + radius * new.normal_y[deepest]
    angle = np.linspace(0.0, math.tau, 91)
    circle = curve(
        x + radius * np.cos(angle), y + radius * np.sin(angle), name, "mate", "mm", "dash"
    )
    circle.update(hoverinfo="skip", hovertemplate=None, line={"width": 1.2})
    return circle
