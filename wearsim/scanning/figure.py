"""The photograph with the new form and the edge on it, the wear enlarged and coloured."""

import math

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from wearsim.geometry.profile_points import Vector
from wearsim.report.text_lines import literal
from wearsim.report.worn_flank import enlargement
from wearsim.scanning.model import ScannedWheel
from wearsim.scanning.new_wheel import around

_LARGEST = 1400
"""Pixels of the larger side of the picture below the overlay."""


def overlay_figure(found: ScannedWheel) -> Figure:
    """Return the photograph with the new form and the worn edge on it, beside the mean depth along a gap."""
    figure = Figure(figsize=(9.0, 8.6), layout="constrained")
    upper, lower = figure.subplots(2, 1, height_ratios=(3.4, 1.0))
    _draw_picture(upper, found)
    _draw_depth(lower, found)
    figure.suptitle(literal(f"{found.photograph.name}: {found.wheel.words}"), fontsize=9)
    return figure


def _draw_picture(axes: Axes, found: ScannedWheel) -> None:
    place = found.depths.place
    step = max(1, math.ceil(max(found.photograph.light.shape) / _LARGEST))
    coded = np.clip(found.photograph.light[::step, ::step], 0.0, 1.0) ** (1.0 / 2.2)
    height, width = found.photograph.light.shape
    axes.imshow(coded, cmap="gray", vmin=0.0, vmax=1.0, extent=(-0.5, width - 0.5, height - 0.5, -0.5))
    depth = np.where(np.isfinite(found.depths.teeth), found.depths.teeth, 0.0)
    factor = enlargement(max(float(found.depths.mean.max()), 1e-3), 0.6 * found.wheel.pitch)
    normals = around(place.stations.normals, found.wheel.teeth)
    points = around(place.stations.points, found.wheel.teeth)
    new = place.projection.seen(points)
    worn = place.projection.seen(points - factor * depth[..., None] * normals)
    axes.add_collection(LineCollection(list(new), colors="C0", linewidths=0.7, label="new form"))
    drawn = LineCollection(_pieces(worn), cmap="plasma", linewidths=1.3)
    drawn.set_array(depth[:, :-1].ravel())
    axes.add_collection(drawn)
    axes.figure.colorbar(drawn, ax=axes, label="depth, mm")
    tips = place.edges.tips.points.mean(axis=1)
    for number, (x, y) in enumerate(tips + 0.08 * (tips - place.projection.seen(np.zeros(2))), 1):
        axes.text(x, y, str(number), color="C0", fontsize=6, ha="center", va="center")
    reach = 1.25 * np.abs(tips - tips.mean(axis=0)).max(axis=0)
    shown = np.array([tips.mean(axis=0) - reach, tips.mean(axis=0) + reach])
    if found.chain is not None:
        pins = found.chain.pins
        axes.plot(
            *pins.T, "+", color="C1", markersize=6, label=f"every second pin, {found.chain.links} links"
        )
        shown = np.concatenate([shown, pins - 0.2 * reach, pins + 0.2 * reach])
    (left, top), (right, bottom) = shown.min(axis=0), shown.max(axis=0)
    axes.set(xlim=(max(left, -0.5), min(right, width)), ylim=(min(bottom, height), max(top, -0.5)))
    # As deep wear is drawn: a collection of many colours has the first one in a legend.
    axes.plot([], [], color=colormaps["plasma"](0.7), label=f"worn edge, depth x {factor}")
    axes.legend(loc="upper right", fontsize=7)


def _pieces(rows: Vector) -> list[Vector]:
    """Return the ways between successive points of every row."""
    return list(np.stack([rows[:, :-1], rows[:, 1:]], axis=2).reshape(-1, 2, 2))


def _draw_depth(axes: Axes, found: ScannedWheel) -> None:
    depths, way = found.depths, found.depths.place.stations.way
    axes.plot(way, depths.teeth.T, color="0.75", linewidth=0.5)
    axes.fill_between(way, depths.mean - 2.0 * depths.error, depths.mean + 2.0 * depths.error, alpha=0.25)
    axes.plot(way, depths.mean, label="mean of all teeth, two standard errors")
    axes.plot(way[depths.deepest], depths.depth, "o")
    axes.axhline(0.0, color="0.4", linewidth=0.6)
    axes.set(xlabel="along the gap from its right tip, mm", ylabel="depth, mm")
    axes.legend(fontsize=7)
