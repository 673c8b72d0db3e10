"""Panels of a moving picture: what stands still in them is drawn, what moves is handed back."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.patches import Circle, Polygon

from wearsim.geometry.profile import Vector
from wearsim.report.flank_view import outline
from wearsim.report.lines import grouped
from wearsim.report.worn_flank import WornFlank, mate
from wearsim.result import Life, WearResult

_AROUND = 0.22
"""Room around the flank, as a fraction of its extent."""

_FAR = 4.0
"""A limit of more than so many times what a run comes to is left out."""


@dataclass(frozen=True)
class Moving:
    """What moves in a panel."""

    artists: list[Artist]  # from the back to the front
    show: Callable[[int], None]  # moves them to the frame of a number from 0


def flank_panel(
    panel: Axes, result: WearResult, flank: WornFlank, points: tuple[Vector, Vector, Vector], time: Vector
) -> Moving:
    """Draw the new flank; the worn one moves."""
    x, y = flank.enlarged(*points[:2])
    depth = points[2]
    if flank.name != "wheel":
        panel.fill(*outline(result), facecolor="0.92", edgecolor="0.6", linewidth=1.0)
        centre, radius, name = mate(result, flank)
        circle = Circle(centre, abs(radius), fill=False, color="0.6", label=name)
        panel.add_patch(circle)
    panel.plot(flank.x[0], flank.y[0], "--", color="black", linewidth=1.4, label="new")
    between = Polygon(np.zeros((1, 2)), color="tab:red", alpha=0.3, linewidth=0)
    panel.add_patch(between)
    label = f"worn, depth x {flank.factor}"
    (worn,) = panel.plot(x[-1], y[-1], color="tab:red", linewidth=2.0, label=label)
    (deepest,) = panel.plot([], [], "o", color="tab:red", markersize=5)
    _frame(panel, flank, x[-1], y[-1])
    title = panel.set_title("", fontsize=10)
    lead = "" if flank.name == "tooth" else f"{flank.name}, "

    def _show(frame: int) -> None:
        deep = float(depth[frame].max())
        place = np.flatnonzero(depth[frame] == deep)[: deep > 0.0]
        back = np.column_stack([flank.x[0], flank.y[0]])[::-1]
        between.set_xy(np.vstack([np.column_stack([x[frame], y[frame]]), back]))
        worn.set_data(x[frame], y[frame])
        deepest.set_data(x[frame, place], y[frame, place])
        title.set_text(f"{lead}{grouped(time[frame])} h: {deep:.3g} mm deep")

    return Moving([between, worn, deepest, title], _show)


def _frame(panel: Axes, flank: WornFlank, x: Vector, y: Vector) -> None:
    """Fix what is seen: the flank, new and at its end, with room around it."""
    room = _AROUND * flank.extent
    low = min(flank.x[0].min(), x.min()), min(flank.y[0].min(), y.min())
    high = max(flank.x[0].max(), x.max()), max(flank.y[0].max(), y.max())
    panel.set_xlim(low[0] - room, high[0] + room, auto=True)
    panel.set_ylim(low[1] - room, high[1] + room, auto=True)
    panel.set_aspect("equal", "datalim")
    panel.set_xlabel("x, mm")
    panel.set_ylabel("y, mm")
    panel.legend(loc="lower left", fontsize=8)


def depth_panel(panel: Axes, result: WearResult, depths: Mapping[str, Vector], time: Vector) -> Moving:
    """Draw limits of the depth; its curves grow."""
    _limits(panel, result, ("critical_depth_mm", "wheel_critical_depth_mm"), depths.values())
    styles = {"wheel": ":"}
    curves = {}
    for name, depth in depths.items():
        label = "" if name == "tooth" else name
        style = styles.get(name, "-")
        (curves[name],) = panel.plot(time, depth, style, color="tab:red", lw=2.0, label=label)
    _against_hours(panel, result, "greatest depth, mm")
    if panel.get_legend_handles_labels()[1]:
        panel.legend(loc="lower right", fontsize=8)

    def _show(frame: int) -> None:
        for name, curve in curves.items():
            curve.set_data(time[: frame + 1], depths[name][: frame + 1])

    return Moving(list(curves.values()), _show)


def elongation_panel(panel: Axes, result: WearResult, time: Vector) -> Moving:
    """Draw the limit of a chain's elongation; its curve grows."""
    hours = result.history_columns["time_hours"]
    grown = result.history_columns["elongation_percent"]
    _limits(panel, result, ("elongation_percent",), [grown])
    (curve,) = panel.plot(hours, grown, color="tab:blue", lw=2.0)
    _against_hours(panel, result, "elongation of the chain, %")

    def _show(frame: int) -> None:
        rows = int(np.searchsorted(hours, time[frame]))
        now = np.interp(time[frame], hours, grown)
        curve.set_data(np.append(hours[:rows], time[frame]), np.append(grown[:rows], now))

    return Moving([curve], _show)


def _limits(panel: Axes, result: WearResult, names: tuple[str, ...], curves: Iterable[Vector]) -> None:
    """Draw the limits that the curves come near to, and fix what is seen upwards."""
    top = max(float(curve.max()) for curve in curves)
    near = [state.limit for state in result.limits if state.name in names]
    near = sorted({limit for limit in near if limit < _FAR * top})
    for limit in near:
        panel.axhline(limit, color="0.3", linestyle="--", label="" if limit > near[0] else "limit")
    panel.set_ylim(0.0, 1.08 * max(top, *near, 1e-12))


def _against_hours(panel: Axes, result: WearResult, label: str) -> None:
    """Name both axes, fix the hours and mark a life that the run goes on after."""
    life = result.life
    if isinstance(life, Life) and life.hours < result.hours_run:
        panel.axvline(life.hours, color="0.3", linestyle=":", label="life")
    panel.set_xlim(0.0, 1.03 * result.hours_run)
    panel.set_xlabel("running time, h")
    panel.set_ylabel(label)
    panel.grid(alpha=0.3)
