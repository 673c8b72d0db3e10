"""Panels of a moving picture: what stands still in them is drawn, what moves is handed back."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from wearsim.geometry.profile_points import Vector
from wearsim.geometry.scene import Circle
from wearsim.quantities import grouped
from wearsim.report.figures import LOOKS, draw_flank
from wearsim.report.worn_flank import WornFlank, around_flank
from wearsim.result import Life, WearResult

_AROUND = 0.22
"""Room around the flank, as a fraction of its extent."""

_LOOKS = {
    **LOOKS,
    "mate": {"color": "0.6"},
    "new": {"color": "black", "linewidth": 1.4, "linestyle": "--"},
    "worn": {"color": "tab:red", "linewidth": 2.0},
}
"""How the roles of lines look where they differ from a still figure."""

_FAR = 4.0
"""A limit of more than so many times what a run comes to is left out."""


@dataclass(frozen=True)
class MovingPanel:
    """What moves in a panel."""

    artists: list[Artist]  # from the back to the front
    show: Callable[[int], None]  # moves them to the frame of a number from 0


def flank_panel(
    panel: Axes, result: WearResult, flank: WornFlank, points: tuple[Vector, Vector, Vector], time: Vector
) -> MovingPanel:
    """Draw the new flank; the worn one moves."""
    frames = list(zip(*points, strict=True))
    still = () if flank.name == "wheel" else around_flank(result, flank)
    last = flank.strokes(*frames[-1], flank.factor)
    labels = {"new": "new", "worn": f"worn, depth x {flank.factor}"}
    labels |= {shape.role: shape.name for shape in still if isinstance(shape, Circle)}
    artists = draw_flank(panel, (*still, *last), _LOOKS, labels)
    _frame(panel, flank, last[2].vertices)
    title = panel.set_title("", fontsize=10)
    lead = "" if flank.name == "tooth" else f"{flank.name}, "
    between, _, worn, deepest = artists[len(still) :]

    def _show(frame: int) -> None:
        off, _, now, deep = flank.strokes(*frames[frame], flank.factor)
        between.set_xy(off.vertices)
        worn.set_data(*now.vertices.T)
        deepest.set_data(*deep.vertices.T)
        title.set_text(f"{lead}{grouped(time[frame])} h: {float(points[2][frame].max()):.3g} mm deep")

    return MovingPanel([between, worn, deepest, title], _show)


def _frame(panel: Axes, flank: WornFlank, worn: Vector) -> None:
    """Fix what is seen: the flank, new and at its end, with room around it."""
    points, room = np.concatenate([np.column_stack([flank.x[0], flank.y[0]]), worn]), _AROUND * flank.extent
    low, high = points.min(axis=0) - room, points.max(axis=0) + room
    panel.set_xlim(low[0], high[0], auto=True)
    panel.set_ylim(low[1], high[1], auto=True)
    # Data as far as the wheel's axis: the aspect then widens the frame and never narrows it.
    panel.update_datalim([(0.0, 0.0)])
    panel.set_aspect("equal", "datalim")
    panel.set_xlabel("x, mm")
    panel.set_ylabel("y, mm")
    panel.legend(loc="lower left", fontsize=8)


def depth_panel(panel: Axes, result: WearResult, depths: Mapping[str, Vector], time: Vector) -> MovingPanel:
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

    return MovingPanel(list(curves.values()), _show)


def elongation_panel(panel: Axes, result: WearResult, time: Vector) -> MovingPanel:
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

    return MovingPanel([curve], _show)


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
