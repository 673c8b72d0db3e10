"""Pictures of a sweep: curves, a heat map, and parallel coordinates."""

import math
from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, MaxNLocator, NullLocator

from wearsim.quantities import grouped
from wearsim.report.figures import number_ticks
from wearsim.report.key_words import axis_label, number_words, with_value
from wearsim.report.parallel_scales import (
    LEAST_APART,
    is_by_factor,
    is_numeric,
    is_whole,
    name_scales,
    scaled_heights,
)
from wearsim.report.text_lines import literal
from wearsim.study.sweep.model import Sweep

_LIGHTEST = 0.9
"""Place in the colours of the lightest curve, which is to be seen on white."""

_DECADE = 10.0

_MAX_CURVES = 10
_MAX_LINES = 2000
_MAX_NUMBERS = 100


def sweep_figures(sweep: Sweep, table: pd.DataFrame) -> dict[str, Figure]:
    """Return the pictures that suit a sweep, by file stem."""
    if not (table["hours_run"] > 0.0).any():
        return {}
    figures: dict[str, Figure] = {}
    numeric = [axis[0] for axis in sweep.axes if len(axis) == 1 and is_numeric(table[axis[0]])]
    others = [key for key in sweep.design.keys if not numeric or key != numeric[0]]
    # Counted so, as groups of a million cases take 60 MB.
    if numeric and len(table) <= _MAX_CURVES * table[numeric[0]].nunique():
        figures["curves"] = _curves(table, numeric[0], others)
    if len(sweep.axes) == len(numeric) == 2:
        figures["heat_map"] = _heat_map(table, *numeric)
    if len(sweep.design.keys) > 1:
        figures["parallel"] = _parallel(table, sweep.design.keys)
    return figures


def _hours(table: pd.DataFrame) -> "pd.Series[float]":
    """Lives, or how long the run was where no limit was met."""
    return table["life_hours"].fillna(table["hours_run"])


def _curves(table: pd.DataFrame, key: str, others: Sequence[str]) -> Figure:
    figure = Figure(figsize=(7.0, 4.6), layout="constrained")
    panel = figure.subplots()
    in_order = len(others) == 1 and is_numeric(table[others[0]])
    groups = list(table.groupby(list(others), sort=in_order)) if others else [((), table)]
    for colour, (values, group) in zip(_colours(len(groups), in_order), groups, strict=True):
        group = group[group["error"] == ""].sort_values(key)
        shown = ", ".join(
            with_value(other, value, others) for other, value in zip(others, values, strict=True)
        )
        panel.plot(
            group[key], group["life_hours"], "-o", color=colour, markersize=4, label=literal(shown) or None
        )
        bound = group[group["life_hours"].isna()]
        panel.plot(bound[key], bound["hours_run"], "^", color=colour, mfc="white", markersize=9)
    if (table["life_hours"].isna() & (table["error"] == "")).any():
        panel.plot([], [], "^", color="0.4", mfc="white", label="> : limit not reached")
    panel.set_xlabel(axis_label(key))
    panel.set_ylabel("life, h")
    _scale_axes(panel, table, key)
    panel.grid(alpha=0.3)
    if panel.get_legend_handles_labels()[0]:
        panel.legend(frameon=False, fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure


def _colours(count: int, in_order: bool) -> list[Any]:
    """Return colours of curves: from dark to light where they have an order, else as different as can be."""
    if not in_order:
        return [f"C{number}" for number in range(count)]
    return list(mpl.colormaps["viridis"](np.linspace(0.0, _LIGHTEST, count)))


def _scale_axes(panel: Axes, table: pd.DataFrame, key: str) -> None:
    """Scale both axes: by logarithms where values are spaced by a factor, and then lives span a decade."""
    own = np.unique(table[key].to_numpy(float))
    by_factor = is_by_factor(own)
    places = np.log(own) if by_factor else own
    in_words = FuncFormatter(lambda value, _: number_words(value))
    if by_factor:
        panel.set_xscale("log")
        panel.xaxis.set_minor_locator(NullLocator())
    if by_factor and panel.dataLim.y0 > 0.0 and panel.dataLim.y1 > _DECADE * panel.dataLim.y0:
        panel.set_yscale("log")
        number_ticks(panel.yaxis)
    else:
        panel.set_ylim(0.0, 1.1 * panel.dataLim.y1)
        panel.yaxis.set_major_formatter(in_words)
    if np.diff(places).min(initial=math.inf) > LEAST_APART * np.ptp(places):
        panel.set_xticks(own, [number_words(value) for value in own.tolist()])
    elif by_factor:
        panel.xaxis.set_major_formatter(in_words)
    else:
        panel.xaxis.set_major_locator(MaxNLocator(integer=is_whole(table[key])))


def _heat_map(table: pd.DataFrame, across: str, up: str) -> Figure:
    hours = table.assign(hours=_hours(table)).pivot(index=up, columns=across, values="hours")
    reached = table.pivot(index=up, columns=across, values="life_hours").notna().to_numpy()
    figure = Figure(figsize=(7.0, 5.2), layout="constrained")
    panel = figure.subplots()
    norm = _scale(table)
    cells = hours.to_numpy(float)
    image = panel.pcolormesh(np.ma.masked_invalid(cells), norm=norm, cmap="viridis")
    for place, axis in ((hours.columns, panel.xaxis), (hours.index, panel.yaxis)):
        axis.set_ticks(np.arange(len(place)) + 0.5, [number_words(float(value)) for value in place])
    if cells.size <= _MAX_NUMBERS:
        for (row, column), value in np.ndenumerate(cells):
            dark = value < np.sqrt(_least(table) * _hours(table).max())
            sign = "" if reached[row, column] else "> "
            text = "failed" if np.isnan(value) else sign + grouped(float(f"{value:.3g}"))
            panel.text(
                column + 0.5,
                row + 0.5,
                text,
                ha="center",
                va="center",
                fontsize=8,
                color="white" if dark else "black",
            )
    _hours_bar(figure, panel, image)
    panel.set_xlabel(axis_label(across, (across, up)))
    panel.set_ylabel(axis_label(up, (across, up)))
    return figure


def _hours_bar(figure: Figure, panel: Axes, colours: ScalarMappable) -> None:
    number_ticks(figure.colorbar(colours, ax=panel, label="life, h").ax.yaxis)


def _least(table: pd.DataFrame) -> float:
    return float(_hours(table).min())


def _scale(table: pd.DataFrame) -> LogNorm:
    """Colours from the shortest life to the longest."""
    return LogNorm(_least(table), max(float(_hours(table).max()), 1.0001 * _least(table)))


def _parallel(table: pd.DataFrame, keys: Sequence[str]) -> Figure:
    """Every case a line through its values and its life, all scales from least to greatest.

    An open arrow is a life that was not reached.
    """
    sound = np.flatnonzero((table["error"] == "").to_numpy(bool))
    rows = table.iloc[sound[:: max(1, sound.size // _MAX_LINES)]].assign(life=_hours).sort_values("life")
    columns = [*keys, "life"]
    figure = Figure(figsize=(2.0 + 1.7 * len(columns), 4.6), layout="constrained")
    panel = figure.subplots()
    norm = _scale(table)
    heights = np.column_stack([scaled_heights(panel, at, rows[key]) for at, key in enumerate(columns)])
    colours = mpl.colormaps["viridis"](norm(rows["life"].to_numpy()))
    bounds = rows["life_hours"].isna()
    for line, colour, bound in zip(heights, colours, bounds, strict=True):
        panel.plot(np.arange(len(columns)), line, color=colour, alpha=0.6, linewidth=1.0)
        if bound:
            panel.plot(len(columns) - 1, line[-1], "^", color=colour, mfc="white", markersize=8)
    if bounds.any():
        panel.plot([], [], "^", color="0.4", mfc="white", label="> : limit not reached")
        panel.legend(frameon=False, fontsize=8, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    name_scales(panel, [*(axis_label(key, keys) for key in keys), "life, h"])
    _hours_bar(figure, panel, ScalarMappable(norm, "viridis"))
    return figure
