"""Figures of worn flanks; matplotlib without pyplot, so nothing is global."""

import base64
import io
import re
import textwrap
from collections.abc import Container, Iterable, Mapping
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib import patches
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from wearsim.geometry.scene import Circle, Stroke
from wearsim.quantities import grouped
from wearsim.report.flank_view import at_life, life_time, snapshot
from wearsim.report.text_lines import literal
from wearsim.report.worn_flank import around_flank, flanks_of_life
from wearsim.result import Life, WearResult

FIGURES = ("flanks", "along_flank", "depth_over_hours")
"""Stems of the figures of a comparison."""

Look = Mapping[str, Any]

LOOKS: Mapping[str, Look] = {
    "body": {"facecolor": "0.92", "edgecolor": "0.6", "linewidth": 1.0},
    "mate": {"color": "grey", "linestyle": "--"},
    "between": {"color": "tab:red", "alpha": 0.3, "linewidth": 0},
    "new": {"color": "black", "linewidth": 1.8},
    "worn": {"color": "tab:red", "linewidth": 1.8},
    "deepest": {"color": "tab:red", "linestyle": "none", "marker": "o", "markersize": 5},
}
"""How the roles of lines look in a picture of a flank."""

_PATH = re.compile(r'(?<=\sd=")[^"]*')

_LEGEND = 0.24
"""Part of the height of the same picture that is left free for the legend."""


def comparison_figures(results: list[WearResult], stems: Container[str] = FIGURES) -> dict[str, Figure]:
    """Return the figures of a comparison by file stem."""
    drawn = (flanks_figure, along_flank_figure, depth_figure)
    return {stem: draw(results) for stem, draw in zip(FIGURES, drawn, strict=True) if stem in stems}


def save_figure(figure: Figure, folder: Path, name: str) -> None:
    """Write a figure as PNG and as SVG, the same bytes for the same figure."""
    for kind in ("png", "svg"):
        (folder / f"{name}.{kind}").write_bytes(picture_bytes(figure, kind))


def picture_bytes(figure: Figure, kind: str) -> bytes:
    """Return a figure as the content of a file, the same bytes for the same figure."""
    target = io.BytesIO()
    metadata = {"Date": None} if kind == "svg" else None
    with mpl.rc_context({"svg.hashsalt": "wearsim", "svg.fonttype": "none"}):
        figure.savefig(target, format=kind, dpi=150, metadata=metadata)
    return target.getvalue()


def picture(figure: Figure) -> str:
    """Return a figure inside a page, as a data URI, the same for the same figure."""
    drawn = io.BytesIO()
    with mpl.rc_context({"svg.hashsalt": "wearsim", "svg.fonttype": "none"}):
        _lay_out(figure)
        figure.savefig(drawn, format="svg", metadata={"Date": None})
    lean = _PATH.sub(_two_decimals, drawn.getvalue().decode("utf-8"))
    return "data:image/svg+xml;base64," + base64.b64encode(lean.encode("utf-8")).decode("ascii")


def _lay_out(figure: Figure) -> None:
    """Place the panels as savefig would, which draws all of them once more to do so."""
    FigureCanvasSVG(figure)
    figure.dpi = 72  # of SVG
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
    figure.set_layout_engine(None)


def _two_decimals(path: re.Match[str]) -> str:
    """Points to a hundredth of a point, which is finer than any print."""
    return re.sub(r"(\.\d\d)\d+", r"\1", path[0])


def number_ticks(axis: Axis) -> None:
    """Write numbers as one reads them at the ticks of a logarithmic axis, at 1, 2, 3 and 5."""
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 3.0, 5.0)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: grouped(value)))
    axis.set_minor_formatter(NullFormatter())


def flanks_figure(results: list[WearResult]) -> Figure:
    """Return the flanks new and at the end of their lives, all depths enlarged alike, with the roller."""
    columns = min(3, len(results))
    rows = -(-len(results) // columns)
    layout = ConstrainedLayoutEngine(w_pad=0.1, h_pad=0.1)
    figure = Figure(figsize=(0.8 + 4.0 * columns, 0.4 + 4.4 * rows), layout=layout)
    panels = figure.subplots(rows, columns, squeeze=False).ravel()
    factor = min(flanks_of_life(result)[0].factor for result in results)
    for panel, result in zip(panels, results, strict=False):
        draw_worn_flank(panel, result, factor)
    for panel in panels[len(results) :]:
        panel.set_visible(False)
    return figure


def draw_worn_flank(panel: Axes, result: WearResult, factor: int | None = None) -> None:
    """Draw a flank new and at the end of its life, the depth enlarged, by its own factor if none is given."""
    flank = flanks_of_life(result)[0]
    factor = factor or flank.factor
    extent, depth, still = flank.extent, flank.depth[-1], around_flank(result, flank)
    shapes = flank.strokes(flank.x[-1], flank.y[-1], depth, factor)
    labels = {
        "new": "new flank",
        "worn": f"worn, depth x {factor}",
        "deepest": f"deepest, {depth.max():.3g} mm",
    }
    draw_flank(panel, (*still, *shapes), LOOKS, labels)
    _, new, worn, _ = (shape.vertices for shape in shapes)
    touched = new[flank.deepest]
    low = high = touched
    for mate in (shape for shape in still if isinstance(shape, Circle)):
        x, y = touched + min(1.0, extent / mate.radius) * (mate.centre - touched)
        panel.text(x, y, mate.name, color="grey", ha="center", va="center", clip_on=True)
        low, high = np.subtract(mate.centre, mate.radius), np.add(mate.centre, mate.radius)
    start, end, reach = new.min(axis=0), new.max(axis=0), 1.6 * extent
    left = start[0] - (0.2 if "sprocket" in result.parts else 0.7) * extent
    right = max(end[0], min(high[0], end[0] + reach)) + 0.2 * extent
    bottom = min(start[1], worn[:, 1].min(), max(low[1], start[1] - reach))
    top = max(end[1], min(high[1], end[1] + reach)) + 0.1 * extent
    side, middle = max(right - left, (top - bottom) / (1.0 - _LEGEND)), 0.5 * (left + right)
    panel.set_xlim(middle - 0.5 * side, middle + 0.5 * side)
    panel.set_ylim(top - side, top)
    panel.set_aspect("equal", "box")
    panel.locator_params(nbins=9, steps=[1, 2, 5, 10])
    panel.set_xlabel("x, mm")
    panel.set_ylabel("y, mm")
    title = textwrap.fill(result.title, 42)
    panel.set_title(literal(f"{title}\nafter {life_time(result)}"), fontsize=9)
    panel.legend(loc="lower center", frameon=False, fontsize=8)


def draw_flank(
    panel: Axes, shapes: Iterable[Stroke | Circle], looks: Mapping[str, Look], labels: Mapping[str, str]
) -> list[Any]:
    """Draw lines and circles as their roles look, and return what was drawn."""
    drawn: list[Any] = []
    for shape in shapes:
        look = {**looks[shape.role], "label": labels.get(shape.role)}
        if isinstance(shape, Circle):
            drawn.append(panel.add_patch(patches.Circle(shape.centre, shape.radius, fill=False, **look)))
        elif shape.closed:
            drawn += panel.fill(*shape.vertices.T, **look)
        else:
            drawn += panel.plot(*shape.vertices.T, **look)
    return drawn


def along_flank_figure(results: list[WearResult]) -> Figure:
    """Return depth, pressure and sliding speed along the flanks at the end of their lives."""
    shown = [("depth_mm", "depth, mm")]
    if any("pressure_MPa" in result.flank_columns for result in results):
        shown += [("pressure_MPa", "Hertz pressure, MPa"), ("sliding_speed_mm_per_s", "sliding speed, mm/s")]
    figure = Figure(figsize=(8.0, 2.2 + 2.1 * len(shown)), layout="constrained")
    panels = figure.subplots(len(shown), 1, sharex=True, squeeze=False).ravel()
    for result in results:
        first, last = snapshot(result, 0), at_life(result)
        (line,) = panels[0].plot(last["arc_length_mm"], last["depth_mm"], label=literal(result.title))
        if "wheel_depth_mm" in last:
            wheel = last["arc_length_mm"], last["wheel_depth_mm"]
            panels[0].plot(*wheel, ":", color=line.get_color(), lw=1.2)
        for panel, (name, _) in zip(panels[1:], shown[1:], strict=True):
            if name in last:
                panel.plot(last["arc_length_mm"], last[name], color=line.get_color())
                panel.plot(first["arc_length_mm"], first[name], "--", color=line.get_color(), lw=0.9)
    for panel, (_, label) in zip(panels, shown, strict=True):
        panel.set_ylabel(label)
        panel.grid(alpha=0.3)
        panel.set_ylim(bottom=0.0)
    panels[0].legend(frameon=False, fontsize=8)
    if any("wheel_depth_mm" in result.flank_columns for result in results):
        text = "solid: pinion, dotted: wheel at the place that meets it"
        panels[0].set_title(text, fontsize=9, loc="left")
    if len(shown) > 1:
        panels[1].set_title("solid: at the end of the life, dashed: new", fontsize=9, loc="left")
    panels[-1].set_xlabel("arc length from the root of the flank (from the gap's right tip on a wrap), mm")
    return figure


def depth_figure(results: list[WearResult]) -> Figure:
    """Return the greatest depth against running time."""
    shown = [("max_depth_mm", "greatest depth, mm")]
    if any("elongation_percent" in result.history_columns for result in results):
        shown.append(("elongation_percent", "elongation of the chain, %"))
    figure = Figure(figsize=(8.0, 2.4 + 2.4 * len(shown)), layout="constrained")
    panels = figure.subplots(len(shown), 1, sharex=True, squeeze=False).ravel()
    for result in results:
        time = result.history_columns["time_hours"]
        (line,) = panels[0].plot([], [], label=literal(result.title))
        for panel, (name, _) in zip(panels, shown, strict=True):
            if name in result.history_columns:
                panel.plot(time, result.history_columns[name], color=line.get_color())
        reached = result.parts.get("sprocket", result.life)
        mark, inside = ("o", line.get_color()) if isinstance(reached, Life) else (">", "white")
        depth = result.history_columns["max_depth_mm"]
        panels[0].plot(time[-1], depth[-1], mark, color=line.get_color(), mfc=inside)
    for panel, (_, label) in zip(panels, shown, strict=True):
        panel.set_ylabel(label)
        panel.set_xlim(left=0.0)
        panel.set_ylim(bottom=0.0)
        panel.grid(alpha=0.3)
    panels[-1].set_xlabel("running time, h")
    panels[0].set_title(_depth_caption(results), fontsize=9, loc="left")
    panels[0].legend(frameon=False, fontsize=8)
    return figure


def _depth_caption(results: list[WearResult]) -> str:
    """Return what marks and flat pieces of the depth over running time mean."""
    text = "dot: limit of the sprocket reached; open arrow: run ends before it"
    if any(result.history_columns.get("chain", np.ones(1))[-1] > 1 for result in results):
        text += "\nflat: a new chain wears the teeth at other places first"
    return text
