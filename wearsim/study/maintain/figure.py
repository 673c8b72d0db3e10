"""The picture of maintenance: cost and hours against the elongation at which chains are replaced."""

import math
import textwrap

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from wearsim.report.text_lines import literal
from wearsim.result import Life
from wearsim.study.maintain.model import MaintenancePlan, ReplacementPolicy

_LETTERS = 85
"""In a line of the title."""


def maintenance_figure(plan: MaintenancePlan) -> Figure:
    """Return cost per 1000 h, hours of chain and sprocket, and chains per sprocket."""
    priced = any(policy.cost is not None for policy in plan.policies)
    figure = Figure(figsize=(7.0, 7.6 if priced else 5.2), layout="constrained")
    panels = list(figure.subplots(3 if priced else 2, 1, sharex=True))
    for reversed_ in (False, True):
        policies = [policy for policy in plan.policies if policy.reversed_ == reversed_]
        if policies:
            _draw(panels, policies, reversed_, priced)
    panels[0].set_ylabel("sprocket's life, h")
    panels[1].set_ylabel("chains per sprocket")
    panels[1].yaxis.set_major_locator(MaxNLocator(5, integer=True))
    if priced:
        panels[2].set_ylabel("cost per 1000 h")
    for panel in panels:
        panel.set_xlim(0.0, 108.0 * max(policy.replace_at for policy in plan.policies))
        panel.set_ylim(0.0, 1.1 * panel.dataLim.y1)
        panel.grid(alpha=0.3)
    panels[0].legend(loc="lower left", frameon=False, fontsize=8)
    panels[0].set_title(literal(textwrap.fill(plan.title, _LETTERS)), fontsize=9, loc="left")
    panels[-1].set_xlabel("elongation at which the chain is replaced, %")
    return figure


def _draw(panels: list[Axes], policies: list[ReplacementPolicy], reversed_: bool, priced: bool) -> None:
    at = [100.0 * policy.replace_at for policy in policies]
    style, colour = ("--", "tab:orange") if reversed_ else ("-", "tab:blue")
    shown = [
        [policy.hours for policy in policies],
        [policy.hours / policy.chain_hours for policy in policies],
    ]
    if priced:
        shown.append([math.nan if policy.cost is None else policy.cost for policy in policies])
    reached = np.array([isinstance(policy.sprocket, Life) for policy in policies])
    label = "sprocket turned" if reversed_ else "sprocket not turned"
    for panel, values in zip(panels, shown, strict=True):
        if reached.any():
            lives = np.where(reached, values, math.nan)
            panel.plot(at, lives, f"o{style}", color=colour, label=label)
        if not reached.all():
            bounds = np.where(reached, math.nan, values)
            panel.plot(
                at, bounds, "^", color=colour, mfc="white", label=f"{label}, > : run ends, limit not reached"
            )
