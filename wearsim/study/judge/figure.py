"""The picture of a judgement: readings with the bands of the best law, and the scores of all laws."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

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
    shown = sorted(range(len(data.names)), key=lambda one: -data.held_out[data.series == one].sum())
    for place, number in enumerate(sorted(shown[:_MOST_SERIES])):
        own, colour = data.series == number, f"C{place}"
        low, _, middle, _, high = found.best.bands[:, own]
        if own.sum() > 1:
            panel.fill_between(exposure[own], low, high, color=colour, alpha=0.12, linewidth=0)
            panel.plot(exposure[own], middle, color=colour, linewidth=1.0)
        else:
            panel.errorbar(
                exposure[own], middle, yerr=[middle - low, high - middle], color=colour, alpha=0.5, capsize=3
            )
        for held, face in ((False, colour), (True, "white")):
            some = own & (data.held_out == held)
            label = literal(data.names[number]) if not held or not (own & data.fitted).any() else None
            panel.plot(
                exposure[some], data.wear[some], "o", color=colour, markerfacecolor=face, markersize=4, label=label
            )
    for axis, values in ((panel.xaxis, exposure), (panel.yaxis, data.wear)):
        if np.ptp(np.log(values)) > 1.0:
            (panel.set_xscale if axis is panel.xaxis else panel.set_yscale)("log")
            number_ticks(axis)
    panel.set_title(
        f"full: fitted, open: held out; lines and bands of 90 %: {found.best.law} ({found.best.scatter}), "
        "given what was read before",
        fontsize=8,
        loc="left",
    )
    panel.set_xlabel(f"exposure, {data.exposure_unit}")
    panel.set_ylabel(f"wear, {data.wear_unit}")
    panel.grid(alpha=0.3)
    panel.legend(frameon=False, fontsize=7, ncols=2)


def _scores(panel: Axes, found: Judgement) -> None:
    laws = found.laws[::-1]
    behind = np.array([one.behind for one in laws])
    error = np.nan_to_num([one.behind_error for one in laws])
    colours = ["tab:blue" if one.tied else "0.6" for one in laws]
    place = np.arange(len(laws))
    panel.barh(place, behind, color=colours)
    panel.errorbar(behind, place, xerr=error, fmt="none", ecolor="black", capsize=2, linewidth=0.8)
    panel.plot(behind, place, "|", color="black")
    panel.set_yticks(place, [f"{one.law} ({one.scatter})" for one in laws], fontsize=8)
    for label, colour in zip(panel.get_yticklabels(), colours, strict=True):
        label.set_color(colour if colour != "0.6" else "black")
    panel.set_xscale("symlog", linthresh=1.0)
    panel.set_xlim(left=min(0.0, panel.get_xlim()[0]))
    panel.set_xlabel("log score behind the best law; blue: not told apart from it")
    panel.grid(alpha=0.3, axis="x")
