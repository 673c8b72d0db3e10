"""Readings of a chain with the bands of its elongation, up to the limit."""

import math
import textwrap
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wearsim.readings.chain_readings import ChainReading
from wearsim.readings.chain_state import ChainState
from wearsim.report.text_lines import literal

_LETTERS = 88
"""Letters of a line of the title."""


def chain_figure(found: ChainState) -> Figure:
    """Return elongation over running time: readings, and what they say of past and future."""
    figure = Figure(figsize=(7.5, 4.5), layout="constrained")
    panel = figure.subplots()
    hours = found.course_hours
    low, lower, middle, upper, high = (factor * found.course for factor in found.posterior.quantiles)
    panel.fill_between(hours, low, high, color="C0", alpha=0.15, linewidth=0, label="90 %")
    panel.fill_between(hours, lower, upper, color="C0", alpha=0.3, linewidth=0, label="50 %")
    panel.plot(hours, middle, color="C0", label="median")
    panel.axhline(found.limit, color="C3", linewidth=1.0, label=f"limit, {found.limit:g} %")
    panel.axvline(found.log.today, color="0.5", linewidth=0.8, linestyle=":", label="last row")
    _measured([one for one in found.log.readings if one.measured], panel)
    _gauges([one for one in found.log.readings if not one.measured], panel)
    times = found.log.relubrications.hours
    if times:
        panel.plot(times, [0.0] * len(times), "|", color="C2", markersize=14, label="relubricated")
    panel.set_xlim(0.0, float(hours[-1]))
    panel.set_ylim(0.0, 1.25 * found.limit)
    panel.set_xlabel("running time, h")
    panel.set_ylabel("elongation of the chain, %")
    panel.grid(alpha=0.3)
    panel.legend(frameon=False, fontsize=8, loc="lower right")
    figure.suptitle(literal(textwrap.fill(found.case.title, _LETTERS)), fontsize=10)
    return figure


def _measured(readings: Sequence[ChainReading], panel: Axes) -> None:
    if readings:
        panel.errorbar(
            [one.hours for one in readings],
            [one.mark for one in readings],
            yerr=[one.error for one in readings],
            fmt="o",
            markersize=4,
            color="black",
            capsize=3,
            elinewidth=1.0,
            label="measured, with its error",
        )


def _gauges(readings: Sequence[ChainReading], panel: Axes) -> None:
    """Draw gauges as arrows to the side of the mark on which the chain is."""
    for marker, above, label in (("v", False, "go: below the mark"), ("^", True, "no-go: above it")):
        some = [one for one in readings if math.isinf(one.high) == above]
        if some:
            x, y = [one.hours for one in some], [one.mark for one in some]
            panel.plot(x, y, marker, color="black", markersize=7, fillstyle="none", label=label)
