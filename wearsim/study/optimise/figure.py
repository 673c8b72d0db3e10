"""Pictures of an optimisation: how the best came about, the front, and what its designs share."""

from itertools import combinations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from wearsim.report.key_words import axis_label
from wearsim.report.parallel_scales import name_scales, scaled_heights
from wearsim.study.optimise.trials import MAXIMISED, Candidate, OptimiseOutcome

_MAX_LINES = 500

_BOUND = "> : limit not reached"
"""In legends: a life that is a bound, an open arrow."""


def optimise_figures(outcome: OptimiseOutcome) -> dict[str, Figure]:
    """Return the pictures that suit an optimisation, by file stem."""
    figures = {"convergence": _convergence(outcome)}
    if len(outcome.study.objectives) > 1:
        figures["front"] = _front(outcome)
    figures["parallel"] = _parallel(outcome)
    return figures


def _feasible(outcome: OptimiseOutcome) -> list[Candidate]:
    return [one for one in outcome.candidates if one.feasible]


def _is_bound(one: Candidate, name: str) -> bool:
    """Whether a measure is a life that was not reached."""
    return name == "life_hours" and not one.reached


def _convergence(outcome: OptimiseOutcome) -> Figure:
    names = outcome.study.objectives
    figure = Figure(figsize=(7.0, 1.2 + 2.6 * len(names)), layout="constrained")
    panels = figure.subplots(len(names), 1, sharex=True, squeeze=False)[:, 0]
    tried = _feasible(outcome)
    numbers = np.array([one.number for one in tried])
    for panel, name in zip(panels, names, strict=True):
        values = np.array([one.measures[name] for one in tried])
        better = np.maximum if name in MAXIMISED else np.minimum
        bound = np.array([_is_bound(one, name) for one in tried], bool)
        panel.plot(numbers[~bound], values[~bound], ".", color="0.65", markersize=4, label="feasible design")
        if bound.any():
            panel.plot(numbers[bound], values[bound], "^", color="0.65", mfc="white", label=_BOUND)
        panel.step(
            [*numbers, len(outcome.candidates)],
            [*better.accumulate(values), better.reduce(values)],
            where="post",
            color="tab:red",
            label="best so far",
        )
        if not outcome.unchanged.error:
            panel.axhline(
                outcome.unchanged.measures[name],
                color="black",
                linestyle="--",
                linewidth=1.0,
                label="case as given",
            )
        panel.set_ylabel(axis_label(name))
        panel.grid(alpha=0.3)
    panels[-1].set_xlabel("designs tried")
    panels[0].legend(frameon=False, fontsize=8, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
    return figure


def _front(outcome: OptimiseOutcome) -> Figure:
    pairs = list(combinations(outcome.study.objectives, 2))
    figure = Figure(figsize=(1.5 + 5.0 * len(pairs), 4.8), layout="constrained")
    panels = figure.subplots(1, len(pairs), squeeze=False)[0]
    shown = [
        ("feasible design", _feasible(outcome), {"color": "0.7", "s": 10}),
        ("front", outcome.front, {"color": "tab:red", "s": 22}),
    ]
    if not outcome.unchanged.error:
        shown.append(("case as given", [outcome.unchanged], {"color": "black", "marker": "x", "s": 60}))
    for panel, (across, up) in zip(panels, pairs, strict=True):
        for label, designs, style in shown:
            x = [one.measures[across] for one in designs]
            y = [one.measures[up] for one in designs]
            panel.scatter(x, y, label=label, **style)
            bounds = [_is_bound(one, across) or _is_bound(one, up) for one in designs]
            if any(bounds):
                marked = np.column_stack([x, y])[bounds].T
                panel.scatter(
                    *marked,
                    marker="^",
                    s=60,
                    facecolor="white",
                    edgecolor=style["color"],
                    label=f"{label}, {_BOUND}",
                )
        panel.set_xlabel(axis_label(across))
        panel.set_ylabel(axis_label(up))
        panel.grid(alpha=0.3)
    panels[0].legend(frameon=False, fontsize=8)
    return figure


def _parallel(outcome: OptimiseOutcome) -> Figure:
    """Every feasible design a line through its values and what came of it, the best on top."""
    study = outcome.study
    tried = _feasible(outcome)
    tried = tried[:: max(1, len(tried) // _MAX_LINES)]
    best = {one.number for one in outcome.front}
    rows = [*(one for one in tried if one.number not in best), *outcome.front]
    columns = [*study.space.keys, *study.measures]
    table = pd.DataFrame(
        [(*one.values, *(one.measures[name] for name in study.measures)) for one in rows], columns=columns
    )
    figure = Figure(figsize=(2.0 + 1.7 * len(columns), 4.6), layout="constrained")
    panel = figure.subplots()
    places = np.arange(len(columns))
    heights = [scaled_heights(panel, at, table[name]) for at, name in enumerate(columns)]
    for one, line in zip(rows, np.column_stack(heights), strict=True):
        top = one.number in best
        panel.plot(
            places,
            line,
            color="tab:red" if top else "0.7",
            alpha=0.9 if top else 0.35,
            linewidth=1.4 if top else 0.7,
        )
        for place, name in enumerate(columns):
            if _is_bound(one, name):
                colour = "tab:red" if top else "0.7"
                panel.plot(place, line[place], "^", color=colour, mfc="white", markersize=8)
    name_scales(panel, [axis_label(key, columns) for key in columns])
    panel.plot([], [], color="tab:red", label="best")
    panel.plot([], [], color="0.7", label="feasible")
    if any(_is_bound(one, name) for one in rows for name in columns):
        panel.plot([], [], "^", color="0.7", mfc="white", label=_BOUND)
    panel.legend(frameon=False, fontsize=8, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
    return figure
