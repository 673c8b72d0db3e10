"""The picture of a pair's strength: allowable stresses against hours, and what acts."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wearsim.fatigue.endurance import Endurance
from wearsim.handbook.strength.model import PairStrength, StressCheck, shown_hours
from wearsim.report.text_lines import literal

_COLOURS = {"pinion": "tab:blue", "wheel": "tab:orange"}


def strength_figure(title: str, pair: PairStrength) -> Figure:
    """Return the allowable stresses of both gears against hours, contact above bending."""
    figure = Figure(figsize=(7.2, 6.4), layout="constrained")
    upper, lower = figure.subplots(2, 1, sharex=True)
    contact, bending = zip(*pair.stresses, strict=True) if pair.stresses else ((), ())
    for panel, name, endured, stresses in (
        (upper, "contact", [gear.contact for gear in pair.gears], contact),
        (lower, "bending", [gear.bending for gear in pair.gears], bending),
    ):
        for gear, one in zip(pair.gears, endured, strict=True):
            _draw_allowable(panel, gear.name, one, shown_hours(pair))
        _draw_acting(panel, pair, stresses)
        panel.axvline(pair.hours, color="0.5", linewidth=1.0, linestyle=":")
        panel.set_ylabel(f"{name} stress, MPa")
        panel.margins(y=0.12)
        panel.grid(alpha=0.3)
        panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=8)
    upper.set_title(literal(title), fontsize=9, loc="left")
    upper.annotate(
        "required life",
        (pair.hours, 1.0),
        (3, -3),
        xycoords=("data", "axes fraction"),
        textcoords="offset points",
        rotation=90,
        va="top",
        color="0.4",
        fontsize=7,
    )
    lower.set_xscale("log")
    lower.set_xlim(*shown_hours(pair))
    lower.set_xlabel("running time, h")
    return figure


def _draw_allowable(panel: Axes, name: str, endured: Endurance, span: tuple[float, float]) -> None:
    hours = np.geomspace(*span, 241)
    panel.plot(
        hours,
        [endured.allowable_at(each) for each in hours.tolist()],
        color=_COLOURS[name],
        label=f"allowable, {name}",
    )
    panel.plot(endured.hours, endured.allowable, "o", color=_COLOURS[name], markersize=5)


def _draw_acting(panel: Axes, pair: PairStrength, stresses: Sequence[StressCheck]) -> None:
    """Draw what acts, once where it is the same for both gears."""
    alike = len({one.lasting for one in stresses}) == 1
    for gear, one in zip(pair.gears, stresses, strict=False):
        colour = "black" if alike else _COLOURS[gear.name]
        if not alike or gear is pair.gears[0]:
            label = "acting" if alike else f"acting, {gear.name}"
            panel.axhline(one.lasting, color=colour, linestyle="--", linewidth=1.2, label=label)
        first, last = shown_hours(pair)
        if not one.life.bound and first <= one.life.hours <= last:
            panel.plot(
                one.life.hours,
                one.lasting,
                "x",
                color=_COLOURS[gear.name],
                markersize=8,
                markeredgewidth=2,
                label=f"life, {gear.name}",
            )
