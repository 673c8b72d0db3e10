"""Picture of a convex-concave pair: the mesh, and the reduced radius along the path."""

import numpy as np
import shapely
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from wearsim.geometry.outline import rotated
from wearsim.handbook.convex_concave.model import PairLayout
from wearsim.report.text_lines import literal

_TOLERANCE = 1e-3
_PITCHES_SHOWN = 1.8
_HEIGHT = 0.72
_ANGLES = 201


def convex_concave_figure(title: str, layout: PairLayout) -> Figure:
    """Return the teeth in contact at the pitch point, and the reduced radius beside the involute's."""
    figure = Figure(figsize=(10.4, 5.0), layout=ConstrainedLayoutEngine(w_pad=0.1))
    mesh, along = figure.subplots(1, 2, width_ratios=[1.15, 1.0])
    _draw_mesh(mesh, layout)
    _draw_radius(along, layout)
    figure.suptitle(literal(title), fontsize=10)
    return figure


def _draw_mesh(panel: Axes, layout: PairLayout) -> None:
    """Draw the teeth around the pitch point, which is the origin."""
    pair = layout.pair
    across = _PITCHES_SHOWN * np.pi * pair.module
    high = _HEIGHT * across
    window = shapely.box(-1.1 * across, -1.1 * high, 1.1 * across, 1.1 * high)
    angle = np.linspace(-1.0, 1.0, 201)
    colours = ("tab:blue", "tab:orange")
    for body, colour, sense in zip(layout.bodies, colours, (1.0, -1.0), strict=True):
        gear = body.gear
        points = rotated(body.outline.polygon(_TOLERANCE), gear.turn) - (0.0, gear.pitch_radius)
        for piece in shapely.get_parts(shapely.Polygon(sense * points) & window):
            outline = shapely.get_coordinates(piece.exterior).T
            panel.fill(*outline, facecolor=colour, alpha=0.35, linewidth=0.0)
            panel.plot(*outline, color=colour, linewidth=1.2)
        circle = gear.pitch_radius * np.stack([np.sin(angle), np.cos(angle) - 1.0])
        label = "pitch circles" if body.name == "pinion" else None
        panel.plot(*(sense * circle), color="grey", linewidth=0.8, linestyle=":", label=label)
    labels = ("line of action, zone a", "zone b")
    for zone, label, style in zip(pair.zones, labels, ("-", "--"), strict=True):
        path = zone.pinion.path_points(zone.angles(_ANGLES)) - (0.0, pair.pinion.pitch_radius)
        panel.plot(*path.T, color="tab:red", linewidth=2.2, linestyle=style, label=label)
    panel.plot(0.0, 0.0, "o", color="black", markersize=4, label="pitch point C")
    for name, y in (("pinion", -0.85 * high), ("wheel", 0.85 * high)):
        panel.text(0.0, y, name, ha="center", va="center")
    panel.set_xlim(-across, across)
    panel.set_ylim(-high, high)
    panel.set_aspect("equal", "box")
    panel.set_xlabel("x from the pitch point, mm")
    panel.set_ylabel("y from the pitch point, mm")
    _legend_below(panel)


def _draw_radius(panel: Axes, layout: PairLayout) -> None:
    """Draw the reduced radius of the pair and of the involute over the path."""
    for zone, style in zip(layout.pair.zones, ("-", "--"), strict=True):
        alpha = zone.angles(_ANGLES)
        panel.plot(
            zone.pinion.path_coordinate(alpha),
            zone.reduced_radius(alpha),
            color="tab:red",
            linewidth=1.8,
            linestyle=style,
            label=f"convex-concave, zone {zone.name}",
        )
    involute = layout.involute
    path = np.linspace(-involute.approach, involute.recess, _ANGLES)
    panel.plot(
        path,
        involute.reduced_radius(involute.pitch_point + path),
        color="black",
        linewidth=1.2,
        label="involute",
    )
    panel.set_ylim(bottom=0.0)
    panel.set_xlabel("distance l from the pitch point, mm")
    panel.set_ylabel("reduced radius of curvature, mm")
    panel.grid(alpha=0.3)
    _legend_below(panel)


def _legend_below(panel: Axes) -> None:
    panel.legend(
        loc="upper center",
        bbox_to_anchor=(0.5, -0.16),
        ncols=4,
        fontsize=8,
        frameon=False,
        columnspacing=1.2,
        handlelength=1.8,
    )
