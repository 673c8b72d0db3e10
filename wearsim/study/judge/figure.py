"""The picture of a judgement: readings with the bands of the best law, and the scores of all laws."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from wearsim.report.figures import number_ticks
from wearsim.report.text_lines import literal
from wearsim.study.judge.model import Judgement

_MOST_SERIES = 10


def judgement_figure(found: Judgement, title: str) -> Figure:
    """Return the picture."""
    figure = Figure(figsize=(11.0, 5.2), layout="constrained")
    readings, scores = figure.subplots(1, 2, width_ratios=(3, 2))
    _readings(readings, found)
    _scores(scores, found)
    figure.suptitle(literal(title), fontsize=10)
    return figure


def _readings(panel: Axes, found: Judgement) -> None:
    data = found.data
    exposure = data.exposure * data.longest
    shown = np.unique(np.linspace(0, len(data.names) - 1, _MOST_SERIES).round().astype(int))
    for place, number in enumerate(shown):
        own, colour = data.series == number, f"C{place}"
        _forecast(panel, found, own, colour)
        for some, face in ((own & data.fitted, colour), (own & data.held_out, "white")):
            panel.plot(exposure[some], data.wear[some], "o", color=colour, markerfacecolor=face, markersize=4)
        panel.plot([], [], "o", color=colour, markersize=4, label=literal(data.names[number]))
    for axis, values in ((panel.xaxis, exposure), (panel.yaxis, data.wear)):
        if np.ptp(np.log(values)) > 1.0:
            (panel.set_xscale if axis is panel.xaxis else panel.set_yscale)("log")
            number_ticks(axis)
    panel.set_title(
        "filled: fitted, open: held out; lines and 90 % bands: forecast by the best law,\n"
        f"{found.best.law} ({found.best.scatter})",
        fontsize=8,
        loc="left",
    )
    panel.set_xlabel(f"exposure, {data.exposure_unit}")
    panel.set_ylabel(f"wear, {data.wear_unit}")
    panel.grid(alpha=0.3)
    count = len(data.names)
    left_out = f"{shown.size} of {count} series drawn" if shown.size < count else None
    panel.legend(frameon=False, fontsize=7, ncols=2, title=left_out, title_fontsize=7)


def _forecast(panel: Axes, found: Judgement, own: NDArray[np.bool_], colour: str) -> None:
    """Draw the band of the held-out readings of a series, from its last fitted one on."""
    data = found.data
    held, known = own & data.held_out, np.flatnonzero(own & data.fitted)
    before = known[-1:][data.exposure[known[-1:]] < data.exposure[held].min(initial=np.inf)]
    exposure = np.concatenate([data.exposure[before], data.exposure[held]]) * data.longest
    low, _, middle, _, high = (np.concatenate([data.wear[before], band[held]]) for band in found.best.bands)
    if exposure.size > 1:
        panel.fill_between(exposure, low, high, color=colour, alpha=0.12, linewidth=0)
        panel.plot(exposure, middle, color=colour, linewidth=1.0)
    elif held.any():
        ends = [middle - low, high - middle]
        panel.errorbar(exposure, middle, yerr=ends, color=colour, alpha=0.5, capsize=3)


def _scores(panel: Axes, found: Judgement) -> None:
    laws = found.laws[::-1]
    behind = np.array([one.behind for one in laws])
    error = [one.behind_error if np.isfinite(one.behind_error) else 0.0 for one in laws]
    colours = ["tab:blue" if one.tied else "0.6" for one in laws]
    place = np.arange(len(laws))
    panel.barh(place, behind, color=colours)
    panel.errorbar(behind, place, xerr=error, fmt="none", ecolor="black", capsize=2, linewidth=0.8)
    panel.plot(behind, place, "|", color="black")
    panel.set_yticks(place, [f"{one.law} ({one.scatter})" for one in laws], fontsize=8)
    for label, colour in zip(panel.get_yticklabels(), colours, strict=True):
        label.set_color(colour if colour != "0.6" else "black")
    panel.set_xscale("symlog", linthresh=1.0)
    panel.set_xlim(left=0.0)
    panel.set_xlabel("log score behind the best law\n(blue: tied with it)")
    panel.grid(alpha=0.3, axis="x")
