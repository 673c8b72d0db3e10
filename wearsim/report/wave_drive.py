"""The diameter of a flexspline by several methods: text, tables and picture."""

import math
from collections.abc import Sequence
from typing import Any

import pandas as pd
from matplotlib.figure import Figure

from wearsim.report.answer import numbered, row
from wearsim.report.sheet import Sheet
from wearsim.sizing.wave_drive import Found

_ASSUMPTIONS = (
    "formulas of six textbooks as collected by Tkachenko (2010), whose tables are lost in part",
    "the range of a method is that over the values the source recommends for its own keys, all "
    "others as given",
    "where a printed formula cannot give the printed diameter the corrected one is taken: a cube "
    "root in torsion, 10 instead of 28.4 in rim_bending",
)


def wave_drive_sheet(title: str, found: Sequence[Found]) -> Sheet:
    """Return what ``wearsim wave-drive`` shows.

    Parameters
    ----------
    title : str
        Of the case.
    found : sequence of Found
        The methods.

    Returns
    -------
    Sheet
        With the tables ``methods`` and ``elasticities``.
    """
    rows = [_row(one) for one in found]
    slopes = [
        {"sizing_method": one.method.name, "key": key, "elasticity": slope}
        for one in found
        for key, slope in one.elasticity.items()
    ]
    return Sheet(
        text=_text(title, found),
        content={"title": title, "methods": rows, "elasticities": slopes},
        tables={"methods": pd.DataFrame(rows), "elasticities": pd.DataFrame(slopes)},
        figures={"wave_drive": wave_drive_figure(title, found)},
        warnings=tuple(_warnings(found)),
    )


def _row(one: Found) -> dict[str, Any]:
    known = not math.isnan(one.published)
    return {
        "sizing_method": one.method.name,
        "textbook": one.method.source,
        "criterion": one.method.criterion,
        "flexspline_diameter_mm": one.diameter,
        "least_diameter_mm": one.least,
        "greatest_diameter_mm": one.greatest,
        "rank": one.rank,
        "best_rank": one.best_rank,
        "worst_rank": one.worst_rank,
        "published_diameter_mm": one.published if known else None,
        "reproduces": one.reproduces if known else None,
        "allowable": one.method.allowable,
        "needed_allowable": None if math.isnan(one.needed) else one.needed,
    }


def _text(title: str, found: Sequence[Found]) -> str:
    head = f"{'method':18s}{'of':5s}{'limits':26s}{'d, mm':>8s}{'range':>14s}{'rank':>8s}"
    lines = [title, "", f"{head}{'published':>11s}"]
    for one in found:
        span = f"{one.least:.1f}-{one.greatest:.1f}" if one.greatest > one.least else "-"
        ranks = f"{one.rank}"
        if one.worst_rank > one.best_rank:
            ranks += f" ({one.best_rank}-{one.worst_rank})"
        shown = "" if math.isnan(one.published) else f"{one.published:g}"
        lines.append(
            f"{one.method.name:18s}{one.method.source:5s}{one.method.criterion:26s}{one.diameter:8.1f}"
            f"{span:>14s}{ranks:>8s}{shown:>11s}"
        )
    published = [one for one in found if not math.isnan(one.published)]
    lines += ["", *(_held(one) for one in published)] if published else []
    return "\n".join([*lines, "", row("Assumes", numbered(_ASSUMPTIONS))])


def _held(one: Found) -> str:
    name, key = one.method.name, one.method.allowable
    verdict = "reproduces" if one.reproduces else "does NOT reproduce"
    needs = "no value does" if math.isnan(one.needed) else f"takes {key} = {one.needed:.6g}"
    return f"{name}: {one.published:g} mm {verdict} ({one.diameter:.1f} mm here); exactly {needs}"


def _warnings(found: Sequence[Found]) -> list[str]:
    diameters = [one.diameter for one in found]
    warnings = []
    if max(diameters) > 1.3 * min(diameters):
        warnings.append(
            f"the methods differ by a factor of {max(diameters) / min(diameters):.2f}: they limit "
            "different things with different safety; take the one whose limits you know"
        )
    for one in found:
        steepest = max(one.elasticity.items(), key=lambda item: abs(item[1]))
        if abs(steepest[1]) > 1.01:
            warnings.append(
                f"{one.method.name}: 1 % of {steepest[0]} moves the diameter by {abs(steepest[1]):.2g} %: "
                "it rests on a small difference"
            )
    return warnings


def wave_drive_figure(title: str, found: Sequence[Found]) -> Figure:
    """Return a bar for the range of each method with its diameter.

    Parameters
    ----------
    title : str
        Of the case.
    found : sequence of Found
        The methods.

    Returns
    -------
    matplotlib.figure.Figure
        Crosses are the published diameters.
    """
    figure = Figure(figsize=(7.2, 0.9 + 0.42 * len(found)), layout="constrained")
    panel = figure.subplots()
    for place, one in enumerate(found):
        panel.plot(
            [one.least, one.greatest], [place, place], color="tab:blue", alpha=0.35, linewidth=9,
            solid_capstyle="butt", label="over the recommended values" if place == 0 else None,
        )  # fmt: skip
        panel.plot(one.diameter, place, "o", color="tab:blue", label="here" if place == 0 else None)
        panel.annotate(
            f"{one.diameter:.0f}", (one.diameter, place), (0, 7), textcoords="offset points",
            ha="center", fontsize=7,
        )  # fmt: skip
    known = [(one.published, place) for place, one in enumerate(found) if one.published > 0.0]
    if known:
        panel.plot(*zip(*known, strict=True), "x", color="tab:red", markersize=8, label="published")
    panel.set_yticks(range(len(found)), [f"{one.method.name} {one.method.source}" for one in found])
    panel.set_ylim(len(found) - 0.4, -0.9)
    panel.set_xlabel("diameter of the flexspline, mm")
    panel.set_title(title, fontsize=9, loc="left")
    panel.grid(axis="x", alpha=0.3)
    panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=8)
    return figure
