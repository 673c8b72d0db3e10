"""Pictures of a calibration: what was measured beside what is predicted, and what is left."""

import math
from collections.abc import Iterator
from itertools import groupby

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.stats import norm

from wearsim.readings.chain_readings import ELONGATION, GAUGE
from wearsim.report.text_lines import literal
from wearsim.study.calibrate.calibration import Calibration
from wearsim.study.calibrate.observations import ReadingResidual
from wearsim.study.calibrate.readings import DEEPEST, OVER_PINS, POINT, PROFILE

_AXES = {
    DEEPEST: "depth at the deepest point, mm",
    POINT: "depth at points, mm",
    OVER_PINS: "less over pins, mm",
    ELONGATION: "elongation of the chain, %",
    PROFILE: "profile behind the new one, mm",
    GAUGE: "mark of a gauge, %",
}


def calibration_figures(found: Calibration) -> dict[str, Figure]:
    """Return the pictures by file stem."""
    figures = {"fit": _readings(found), "residuals": _residuals(found)}
    for figure in figures.values():
        figure.suptitle(literal(found.case.title), fontsize=10)
    return figures


def _readings(found: Calibration) -> Figure:
    names = [name for name in _AXES if any(one.quantity == name for one in found.shown)]
    figure = Figure(figsize=(7.5, 3.6 * len(names)), layout="constrained")
    for panel, name in zip(figure.subplots(len(names), squeeze=False)[:, 0], names, strict=True):
        shown = [one for one in found.shown if one.quantity == name]
        along = name == PROFILE
        for index, (label, line) in enumerate(_lines(shown)):
            x = [one.arc_length if along else one.hours for one in line]
            _points(panel, x, line, f"C{index}")
            fitted = found.chain_course if name in (ELONGATION, GAUGE) else _between(x, line)
            panel.plot(*fitted, "-", color=f"C{index}", label=label)
        read = "marks of gauges, go below and no-go above" if name == GAUGE else "measured"
        panel.set_title(f"points: {read}, lines: fitted", fontsize=8, loc="left")
        panel.set_xlabel("along the new flank, mm" if along else "running time, h")
        panel.set_ylabel(_AXES[name])
        times = found.relubrications.hours
        if not along and times:
            panel.plot(times, [0.0] * len(times), "|", color="C2", markersize=14, label="relubricated")
        if not along:
            panel.set_xlim(left=0.0)
            panel.set_ylim(bottom=min(0.0, panel.get_ylim()[0]))
        panel.grid(alpha=0.3)
        if panel.get_legend_handles_labels()[1]:
            panel.legend(frameon=False, fontsize=8)
    return figure


def _lines(shown: list[ReadingResidual]) -> Iterator[tuple[str, list[ReadingResidual]]]:
    """Give the values that belong on one line with what it is."""
    if shown[0].quantity == PROFILE:
        for _, line in groupby(shown, key=lambda one: one.row):
            values = list(line)
            yield f"{values[0].hours:g} h", values
        return
    ordered = sorted(shown, key=lambda one: (one.arc_length, one.hours))
    for place, line in groupby(ordered, key=lambda one: str(one.arc_length)):
        yield "" if place == "nan" else f"at {float(place):g} mm", list(line)


def _between(x: list[float], line: list[ReadingResidual]) -> tuple[list[float], list[float]]:
    """Return what is predicted from one reading to the next."""
    start = [] if line[0].quantity == PROFILE else [0.0]
    return [*start, *x], [*start, *(one.predicted for one in line)]


def _points(panel: Axes, x: list[float], line: list[ReadingResidual], colour: str) -> None:
    panel.errorbar(
        x,
        [one.value for one in line],
        yerr=[one.error for one in line],
        fmt="o",
        markersize=4,
        color=colour,
        capsize=3,
        linewidth=0.0,
        elinewidth=1.0,
    )


def _residuals(found: Calibration) -> Figure:
    figure = Figure(figsize=(7.5, 7.0), layout="constrained")
    over, against = figure.subplots(2)
    # Which side of a mark a gauge saw has no residual that is normal by chance.
    measured = [one for one in found.shown if one.quantity != GAUGE]
    for index, name in enumerate(_AXES):
        some = [one for one in measured if one.quantity == name]
        if some:
            x, y = [one.hours for one in some], [one.residual for one in some]
            over.plot(x, y, "o", color=f"C{index}", markersize=4, label=_AXES[name].split(",")[0])
    over.axhline(0.0, color="black", linewidth=0.8)
    over.axhspan(-1.645, 1.645, color="0.5", alpha=0.15, linewidth=0, label="90 % expected by chance")
    over.set_xlabel("running time, h")
    over.set_ylabel("(fit - measured) / error")
    over.legend(frameon=False, fontsize=8)
    ordered = np.sort([one.residual for one in measured])
    chance = norm.ppf((np.arange(ordered.size) + 0.5) / ordered.size)
    greatest = max(2.0, math.ceil(float(np.abs([*chance, *ordered]).max())))
    against.plot(chance, ordered, "o", color="0.3", markersize=4)
    against.plot([-greatest, greatest], [-greatest, greatest], color="black", linewidth=0.8)
    against.set_xlabel("by chance (quantiles of the normal distribution)")
    against.set_ylabel("(fit - measured) / error, in order")
    for panel in (over, against):
        panel.grid(alpha=0.3)
    return figure
