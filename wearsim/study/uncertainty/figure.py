"""Pictures of the uncertainty of a life: how lives are distributed, and whether that has settled."""

import itertools
import math

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import FixedFormatter, FixedLocator, NullLocator
from scipy import stats

from wearsim.report.figures import number_ticks
from wearsim.study.uncertainty.life_statistics import UncertaintyAnswer

_TICKS = (0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 0.95, 0.99)
_COLOURS = ("tab:red", "black", "tab:blue", "tab:orange", "tab:green", "tab:purple")


def uncertainty_figures(answer: UncertaintyAnswer) -> dict[str, Figure]:
    """Return the pictures by file stem."""
    return {"lives": _lives(answer), "convergence": _convergence(answer)}


def _lives(answer: UncertaintyAnswer) -> Figure:
    figure = Figure(figsize=(7.0, 5.0), layout="constrained")
    panel = figure.subplots()
    lives = np.sort(np.where(answer.reached, answer.hours, np.inf))
    share = (np.arange(lives.size) + 0.5) / lives.size
    seen = np.isfinite(lives)
    panel.plot(lives[seen], stats.norm.ppf(share[seen]), ".", color="0.5", markersize=4, label="samples")
    grid = np.geomspace(lives[0], lives[seen][-1], 200) if answer.fits else lives[:0]
    for fit, colour in zip(answer.fits, ("tab:blue", "tab:orange"), strict=False):
        law = stats.lognorm if fit.name == "lognormal" else stats.weibull_min
        at = stats.norm.ppf(law(fit.shape, scale=fit.scale).cdf(grid))
        panel.plot(grid, at, color=colour, label=f"{fit.name.capitalize()} fit")
    names = ", ".join(found.name for found in answer.percentiles)
    for found in answer.percentiles:
        if found.known:
            place = float(stats.norm.ppf(found.share))
            ends = [found.hours - found.low], [found.high - found.hours]
            error = np.array(ends) if math.isfinite(found.high) else None
            panel.errorbar(
                found.hours,
                place,
                xerr=error,
                fmt="o",
                color="tab:red",
                capsize=4,
                zorder=3,
                label=f"{names} and their intervals" if found.share == 0.5 else None,
            )
    if lives[0] > 0.0:
        panel.set_xscale("log")
        number_ticks(panel.xaxis)
    panel.yaxis.set_major_locator(FixedLocator([float(stats.norm.ppf(q)) for q in _TICKS]))
    panel.yaxis.set_major_formatter(FixedFormatter([f"{100 * q:g}" for q in _TICKS]))
    panel.yaxis.set_minor_locator(NullLocator())
    panel.set_ylim(-2.7, 2.7)
    panel.set_xlabel("life, h")
    panel.set_ylabel("lives that end before, %")
    panel.grid(alpha=0.3, which="both")
    panel.legend(frameon=False, fontsize=8, loc="upper left")
    return figure


def _convergence(answer: UncertaintyAnswer) -> Figure:
    figure = Figure(figsize=(7.0, 4.4), layout="constrained")
    panel = figure.subplots()
    table = answer.convergence
    for found, colour in zip(answer.percentiles, itertools.cycle(_COLOURS), strict=False):
        panel.plot(table["samples"], table[found.column], "-o", color=colour, label=found.name)
        if math.isfinite(found.high):
            panel.axhspan(found.low, found.high, color=colour, alpha=0.12, linewidth=0)
    panel.set_xscale("log", base=2)
    panel.xaxis.set_major_locator(FixedLocator(table["samples"].tolist()))
    panel.xaxis.set_major_formatter(FixedFormatter([str(n) for n in table["samples"]]))
    panel.set_ylim(bottom=0.0)
    panel.set_xlabel("samples")
    panel.set_ylabel("life, h; bands: intervals of all samples")
    panel.grid(alpha=0.3)
    panel.legend(frameon=False, fontsize=8)
    return figure
