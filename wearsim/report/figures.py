"""Figures of worn flanks; matplotlib without pyplot, so nothing is global."""

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wearsim.geometry.profile import Profile, Vector
from wearsim.result import WearResult

_LARGEST_SHOWN = 0.12
"""Depth in the picture of a flank, as a fraction of the flank's extent."""

_ROUND = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)


def comparison_figures(results: list[WearResult]) -> dict[str, Figure]:
    """Return the figures of a comparison by file stem.

    Parameters
    ----------
    results : list of WearResult
        At least one.

    Returns
    -------
    dict
        ``flanks``, ``along_flank`` and ``depth_over_hours``.
    """
    with mpl.rc_context({"svg.hashsalt": "wearsim", "svg.fonttype": "none"}):
        return {
            "flanks": flanks_figure(results),
            "along_flank": along_flank_figure(results),
            "depth_over_hours": depth_figure(results),
        }


def flanks_figure(results: list[WearResult]) -> Figure:
    """Return the flanks before and after, the depth enlarged.

    Parameters
    ----------
    results : list of WearResult
        At least one; a panel each.

    Returns
    -------
    matplotlib.figure.Figure
        Equal scale on both axes; the enlargement stands in the title of each panel.
    """
    columns = min(3, len(results))
    rows = -(-len(results) // columns)
    figure = Figure(figsize=(1.5 + 4.0 * columns, 0.6 + 4.2 * rows), layout="constrained")
    panels = np.atleast_1d(figure.subplots(rows, columns, squeeze=False)).ravel()
    for panel, result in zip(panels, results, strict=False):
        _draw_flank(panel, result)
    for panel in panels[len(results) :]:
        panel.set_visible(False)
    return figure


def _draw_flank(panel: Axes, result: WearResult) -> None:
    first, last = _snapshot(result, 0), _snapshot(result, -1)
    before = Profile(first["x_mm"], first["y_mm"])
    extent = max(np.ptp(before.x), np.ptp(before.y))
    enlarged = max(n for n in _ROUND if n == 1 or n * result.max_depth <= _LARGEST_SHOWN * extent)
    x = before.x + enlarged * (last["x_mm"] - before.x)
    y = before.y + enlarged * (last["y_mm"] - before.y)
    panel.fill(
        np.concatenate([before.x, x[::-1]]),
        np.concatenate([before.y, y[::-1]]),
        color="tab:red",
        alpha=0.25,
        linewidth=0,
    )
    panel.plot(before.x, before.y, color="black", linewidth=1.2, label="new")
    panel.plot(x, y, color="tab:red", linewidth=1.2, label="worn")
    panel.set_aspect("equal", "datalim")
    panel.set_xlabel("x, mm")
    panel.set_ylabel("y, mm")
    panel.set_title(f"{result.title}\ndepth enlarged {enlarged} times", fontsize=9)
    panel.legend(frameon=False)


def along_flank_figure(results: list[WearResult]) -> Figure:
    """Return depth, pressure and sliding speed along the flanks at the end of the run.

    Parameters
    ----------
    results : list of WearResult
        At least one.

    Returns
    -------
    matplotlib.figure.Figure
        Pressure and sliding of the new flank are dashed.
    """
    figure = Figure(figsize=(8.0, 8.5), layout="constrained")
    panels = figure.subplots(3, 1, sharex=True)
    for result in results:
        first, last = _snapshot(result, 0), _snapshot(result, -1)
        (line,) = panels[0].plot(last["arc_length_mm"], last["depth_mm"], label=result.title)
        for panel, name in zip(panels[1:], ("pressure_MPa", "sliding_speed_mm_per_s"), strict=True):
            panel.plot(last["arc_length_mm"], last[name], color=line.get_color())
            panel.plot(first["arc_length_mm"], first[name], "--", color=line.get_color(), lw=0.9)
    for panel, label in zip(
        panels, ("depth, mm", "Hertz pressure, MPa", "sliding speed, mm/s"), strict=True
    ):
        panel.set_ylabel(label)
        panel.grid(alpha=0.3)
        panel.set_ylim(bottom=0.0)
    panels[0].legend(frameon=False, fontsize=8)
    panels[1].set_title("solid: at the end of the run, dashed: new", fontsize=9, loc="left")
    panels[2].set_xlabel("arc length from the root, mm")
    return figure


def depth_figure(results: list[WearResult]) -> Figure:
    """Return the greatest depth against running time,.

    Parameters
    ----------
    results : list of WearResult
        At least one.

    Returns
    -------
    matplotlib.figure.Figure
        A dot marks a life, an arrow a run that went on.
    """
    figure = Figure(figsize=(8.0, 4.8), layout="constrained")
    panel = figure.subplots()
    for result in results:
        time, depth = (result.history_columns[name] for name in ("time_hours", "max_depth_mm"))
        reached = result.stop != "horizon_hours"
        (line,) = panel.plot(time, depth, label=result.title)
        panel.plot(time[-1], depth[-1], "o" if reached else ">", color=line.get_color())
    panel.set_xlabel("running time, h")
    panel.set_ylabel("greatest depth, mm")
    panel.set_xlim(left=0.0)
    panel.set_ylim(bottom=0.0)
    panel.grid(alpha=0.3)
    panel.set_title("dot: life reached; arrow: run ends at the horizon", fontsize=9, loc="left")
    panel.legend(frameon=False, fontsize=8)
    return figure


def _snapshot(result: WearResult, index: int) -> dict[str, Vector]:
    """Columns of the flank at one snapshot."""
    cycles = result.flank_columns["cycles"]
    at = cycles == np.unique(cycles)[index]
    return {name: values[at] for name, values in result.flank_columns.items()}
