"""The picture of maintenance: cost and hours against the elongation at which chains are replaced."""

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wearsim.result import Life
from wearsim.study.maintain import MaintenancePlan, Policy


def maintenance_figure(plan: MaintenancePlan) -> Figure:
    """Return cost per 1000 h, hours of chain and sprocket, and chains per sprocket.

    Parameters
    ----------
    plan : MaintenancePlan
        The plan.

    Returns
    -------
    matplotlib.figure.Figure
        Policies with a turned sprocket are dashed; an arrow marks a life that was not reached.
    """
    priced = any(policy.cost is not None for policy in plan.policies)
    figure = Figure(figsize=(7.0, 7.6 if priced else 5.2), layout="constrained")
    panels = list(figure.subplots(3 if priced else 2, 1, sharex=True))
    for turned in (False, True):
        policies = [policy for policy in plan.policies if policy.turned == turned]
        if policies:
            _draw(panels, policies, turned, priced)
    panels[0].set_ylabel("sprocket's life, h")
    panels[1].set_ylabel("chains per sprocket")
    if priced:
        panels[2].set_ylabel("cost per 1000 h")
    for panel in panels:
        panel.set_ylim(bottom=0.0)
        panel.grid(alpha=0.3)
    panels[0].legend(frameon=False, fontsize=8)
    panels[0].set_title(plan.title, fontsize=9, loc="left")
    panels[-1].set_xlabel("elongation at which the chain is replaced, %")
    return figure


def _draw(panels: list[Axes], policies: list[Policy], turned: bool, priced: bool) -> None:
    at = [100.0 * policy.replace_at for policy in policies]
    style, colour = ("--", "tab:orange") if turned else ("-", "tab:blue")
    label = "sprocket turned" if turned else "sprocket not turned"
    panels[0].plot(at, [policy.hours for policy in policies], style, color=colour, label=label)
    for percent, policy in zip(at, policies, strict=True):
        mark = "o" if isinstance(policy.sprocket, Life) else "^"
        panels[0].plot(percent, policy.hours, mark, color=colour)
    chains = [policy.hours / policy.chain_hours for policy in policies]
    panels[1].plot(at, chains, style, marker="o", color=colour)
    if priced:
        costs = [(p, policy.cost) for p, policy in zip(at, policies, strict=True) if policy.cost]
        panels[2].plot(*zip(*costs, strict=True), style, marker="o", color=colour)
