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
        One or two; their sliders go together.
    """
    first, last = snapshot(result, 0), snapshot(result, -1)
    depth = float(last["depth_mm"].max())
    gears = "wheel_x_mm" in last
    name = "pinion" if gears else "tooth"
    new = Profile(first["x_mm"], first["y_mm"])
    found = [_chart(result, name, new, (last["x_mm"], last["y_mm"]), last["depth_mm"])]
    figure = found[0].figure
    _add_mate(figure, result, new, int(last["depth_mm"].argmax()))
    x, y = outline(result)
    if x.size:
        wheel = go.Scatter(
            x=listed(x), y=listed(y), mode="lines", fill="toself", name="outline", hoverinfo="skip",
            showlegend=False, meta={"role": "body"}, line={"width": 1},
        )  # fmt: skip
        figure.add_trace(wheel)
    if gears and depth > 0.0:
        mate = Profile(first["wheel_x_mm"], first["wheel_y_mm"])
        worn = last["wheel_x_mm"], last["wheel_y_mm"]
        found.append(_chart(result, "wheel", mate, worn, last["wheel_depth_mm"]))
    return found


def _chart(
    result: WearResult, name: str, new: Profile, worn: tuple[Vector, Vector], depth: Vector
) -> Chart:
    extent = float(max(np.ptp(new.x), np.ptp(new.y)))
    deepest, greatest = int(depth.argmax()), float(depth.max())
    factor = enlargement(greatest, extent)
    shift = worn[0] - new.x, worn[1] - new.y
    x, y = new.x + factor * shift[0], new.y + factor * shift[1]
    figure = panels(1)
    between = curve(np.append(new.x, x[::-1]), np.append(new.y, y[::-1]), "worn off", "between", "mm")
    between.update(fill="toself", line={"width": 0}, hoverinfo="skip", hovertemplate=None)
    figure.add_trace(between)
    figure.add_trace(curve(new.x, new.y, "new", "new", "mm"))
    flank = curve(x, y, "worn", "worn", "mm")
    flank.update(
        customdata=listed(depth), hovertemplate="%{customdata:.4g} mm deep<extra>worn</extra>"
    )
    figure.add_trace(flank)
    point = go.Scatter(
        x=listed(x[deepest : deepest + 1]), y=listed(y[deepest : deepest + 1]), mode="markers",
        name="deepest", marker={"size": 9}, meta={"role": "worn"},
        hovertemplate=f"deepest, {greatest:.3g} mm<extra></extra>",
    )  # fmt: skip
    figure.add_trace(point)
    figure.update_layout(hovermode="closest")
    room = _AROUND * extent
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
            "x": listed(new.x), "y": listed(new.y), "dx": listed(shift[0]), "dy": listed(shift[1]),
            "deepest": deepest, "factor": factor, "most": max(10, 3 * factor),
            "depth": f"{grouped(greatest, 3)} mm",
        },
    )  # fmt: skip


def _add_mate(figure: go.Figure, result: WearResult, new: Profile, deepest: int) -> None:
    """Add the circle that touches the new flank where it wears most."""
    place = float(snapshot(result, -1)["arc_length_mm"][deepest])
    radius, mate = touching_circle(result, place)
    x = new.x[deepest] + radius * new.normal_x[deepest]
    y = new.y[deepest] + radius * new.normal_y[deepest]
    angle = np.linspace(0.0, math.tau, 181)
    circle = curve(
        x + radius * np.cos(angle), y + radius * np.sin(angle), mate, "mate", "mm", "dash"
    )
    circle.update(hoverinfo="skip", hovertemplate=None, line={"width": 1.2})
    figure.add_trace(circle)
