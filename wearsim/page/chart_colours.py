"""Charts of the report's pages as plotly draws them in colour."""

import re
from collections.abc import Mapping
from functools import cache
from importlib import resources
from typing import Any

from wearsim.report.html.charts import Chart

Palette = Mapping[str, str]

_CONFIG = {"displaylogo": False, "modeBarButtonsToRemove": ["lasso2d", "select2d", "autoScale2d"]}


@cache
def palettes() -> tuple[Palette, Palette]:
    """Return the colours of the report's pages by their roles."""
    style = resources.files("wearsim.report.html").joinpath("style.css").read_text("utf-8")
    blocks = re.findall(r":root \{(.*?)\}", style, flags=re.DOTALL)
    light, dark = (dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6})", block)) for block in blocks[:2])
    return light, dark


def figure(chart: Chart, palette: Palette, factor: float = 1.0) -> dict[str, Any]:
    """Return a chart for ``ui.plotly``."""
    content = chart.content
    traces, slider = content["data"], chart.slider
    if slider:
        for trace, places in zip(traces[slider["first"] :], _enlarged(slider, factor), strict=False):
            trace["x"], trace["y"] = places
    return {
        "data": [_coloured(trace, palette) for trace in traces],
        "layout": _furnished(content["layout"], palette),
        "config": _CONFIG,
    }


def _coloured(trace: dict[str, Any], palette: Palette) -> dict[str, Any]:
    role, line = trace["meta"]["role"], trace.get("line", {})
    if role == "between":
        return {**trace, "fillcolor": f"{palette['worn']}55"}
    if role == "body":
        line = {**line, "color": palette["mate"]}
        return {**trace, "line": line, "fillcolor": palette["body"]}
    own = {"color": palette[role]}
    painted = {**trace, "marker": {**trace.get("marker", {}), **own}}
    return painted if trace.get("type") == "bar" else {**painted, "line": {**line, **own}}


def _furnished(layout: dict[str, Any], palette: Palette) -> dict[str, Any]:
    font = {"color": palette["text"], "size": 13, "family": "system-ui, sans-serif"}
    found = {
        **layout,
        "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": palette["page"],
        "font": font,
        "hoverlabel": {"bgcolor": palette["panel"], "bordercolor": palette["line"], "font": font},
    }
    for name in layout:
        if re.match(r"[xy]axis", name):
            found[name] = {
                **layout[name],
                "gridcolor": palette["line"],
                "linecolor": palette["mate"],
                "zeroline": False,
                "showline": True,
                "mirror": True,
                "showgrid": True,
                "ticks": "outside",
                "tickcolor": palette["mate"],
            }
    return found


def _enlarged(slider: Mapping[str, Any], factor: float) -> list[tuple[list[float], list[float]]]:
    """Points of what is worn off, of the new flank, the worn one and its deepest point."""
    ways = []
    for start, shift in ((slider["x"], slider["dx"]), (slider["y"], slider["dy"])):
        worn = [place + factor * off for place, off in zip(start, shift, strict=True)]
        ways.append([[*start, *reversed(worn)], start, worn, [worn[slider["deepest"]]]])
    return list(zip(*ways, strict=True))
