"""The picture of relubrication: lives and cost against the interval."""

import math
import textwrap
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from wearsim.report.text_lines import literal
from wearsim.study.lubricate.model import LubricantPlan, LubricationStudy

_LETTERS = 85
"""In a line of the title."""

_DASH = 4.0
"""In widths of a line."""


def lubrication_figure(study: LubricationStudy) -> Figure:
    """Return the life of every part, and the cost per 1000 h where it is known, against the interval."""
    names = [part.name for part in study.plans[0].parts]
    priced = any(plan.cheapest is not None for plan in study.plans)
    panels = len(names) + priced
    figure = Figure(figsize=(7.0, 1.6 + 2.0 * panels), layout="constrained")
    axes = list(figure.subplots(panels, 1, sharex=True, squeeze=False)[:, 0])
    for number, plan in enumerate(study.plans):
        colour = f"C{number}"
        if plan.supplied:
            _draw_supplied(axes, plan, names, number)
            continue
        at = [policy.interval for policy in plan.policies]
        for axis, name in zip(axes, names, strict=False):
            axis.plot(
                at, [policy.lives[name] for policy in plan.policies], "-", color=colour, label=plan.name
            )
            low, high = (
                [getattr(policy, end)[name] for policy in plan.policies]
                for end in ("lives_low", "lives_high")
            )
            axis.fill_between(at, low, high, color=colour, alpha=0.12, linewidth=0.0)
        if priced:
            _draw_cost(axes[-1], plan, at, colour)
    for axis, name in zip(axes, names, strict=False):
        axis.set_ylabel(f"life of {name}, h")
        axis.set_yscale("log")
    if priced:
        axes[-1].set_ylabel("cost per 1000 h")
        axes[-1].set_yscale("log")
    for axis in axes:
        axis.grid(alpha=0.3)
    axes[-1].set_xscale("log")
    axes[-1].xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes[-1].xaxis.set_minor_formatter(NullFormatter())
    axes[-1].xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes[-1].set_xlabel("interval between relubrications, h")
    if len(study.plans) > 1:
        figure.legend(
            *axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=len(study.plans)
        )
    axes[0].set_title(literal(textwrap.fill(study.title, _LETTERS)), fontsize=9, loc="left")
    return figure


def _draw_supplied(axes: Sequence[Axes], plan: LubricantPlan, names: Sequence[str], number: int) -> None:
    """Draw a lubricant that has no interval: dashed, at all of them."""
    (policy,), colour = plan.policies, f"C{number}"
    dashes = (_DASH * number, (_DASH, _DASH))  # one behind the other where two are alike
    for axis, name in zip(axes, names, strict=False):
        axis.axhline(policy.lives[name], color=colour, linestyle=dashes, label=f"{plan.name}, all the time")
        axis.axhspan(policy.lives_low[name], policy.lives_high[name], color=colour, alpha=0.12, linewidth=0.0)
    if plan.cheapest is not None:
        axes[-1].axhline(policy.cost or math.nan, color=colour, linestyle=dashes)


def _draw_cost(axis: Axes, plan: LubricantPlan, at: list[float], colour: str) -> None:
    if plan.cheapest is None:
        return
    costs = [[getattr(policy, end) for policy in plan.policies] for end in ("cost", "cost_low", "cost_high")]
    cost, low, high = (np.array(values, dtype=float) for values in costs)
    axis.plot(at, cost, "-", color=colour)
    axis.fill_between(at, low, high, color=colour, alpha=0.12, linewidth=0.0)
    axis.plot([plan.cheapest.interval], [plan.cheapest.cost or math.nan], "o", color=colour)
