"""Charts as plotly reads them, without colours: the page gives them."""

import html
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

_DIGITS = 5
_SPACING = 0.06
"""Between panels, as a fraction of the height of all."""

Trace = dict[str, Any]
"""A line, or bars, as plotly reads it."""


@dataclass(frozen=True)
class Drawing:
    """What plotly draws, without its Python objects, which take longer than all else on a page."""

    traces: list[Trace]  # lines and bars
    layout: dict[str, Any]  # axes and what is around them

    def add(self, traces: Iterable[Trace], panel: int | None = None) -> None:
        """Add lines or bars."""
        place = {} if panel is None else {"xaxis": _axis("x", panel), "yaxis": _axis("y", panel)}
        self.traces.extend({**trace, **place} for trace in traces)

    def set_axis(self, letter: str, title: str = "", panel: int = 1, **settings: Any) -> None:
        """Name an axis, or change how it is drawn."""
        axis = self.layout[_axis(f"{letter}axis", panel)]
        axis.update(settings)
        if title:
            axis["title"]["text"] = title


def _axis(name: str, panel: int) -> str:
    return f"{name}{panel}" if panel > 1 else name


@dataclass(frozen=True)
class ValueTable:
    """Some values of a chart, to be read without it."""

    head: tuple[str, ...]  # heads of the columns with their units
    rows: tuple[tuple[str, ...], ...]  # the cells


@dataclass(frozen=True)
class Chart:
    """A chart and what stands for it where it cannot be seen."""

    name: str  # of its element on the page
    title: str  # what it is, and what there is to see
    alt: str  # what it is, and what there is to see
    figure: Drawing  # the chart; the colour of a trace follows from `meta["role"]`
    values: ValueTable  # some of its values
    tall: int = 1  # panels above each other
    still: str = ""  # stem of the picture that stands for it on paper; empty where the values do
    # what a slider does to it; empty where there is none
    slider: dict[str, Any] = field(default_factory=dict)

    @property
    def content(self) -> dict[str, Any]:
        """What the script of the page draws; traces and layout may be changed one by one."""
        traces = [dict(trace) for trace in self.figure.traces]
        return {"data": traces, "layout": dict(self.figure.layout), "slider": self.slider}


def panels(count: int) -> Drawing:
    """Return an empty drawing with panels above each other that share their x axis."""
    layout: dict[str, Any] = {
        "template": {"data": {"scatter": [{"type": "scatter"}]}},
        "margin": {"l": 8, "r": 12, "t": 8, "b": 8},
        "legend": {"orientation": "h", "x": 0, "y": 1.02, "yanchor": "bottom"},
        "hovermode": "x unified" if count == 1 else "x",
        "autosize": True,
    }
    height = (1.0 - _SPACING * (count - 1)) / count
    for panel in range(1, count + 1):
        below = count - panel
        bottom = sum([height] * below) + below * _SPACING
        for letter, other, ends in (("x", "y", [0.0, 1.0]), ("y", "x", [bottom, bottom + height])):
            layout[_axis(f"{letter}axis", panel)] = {
                "anchor": _axis(other, panel),
                "domain": ends,
                "automargin": True,
                "title": {"standoff": 8},
            }
        if below:
            shared = {"matches": _axis("x", count), "showticklabels": False}
            layout[_axis("xaxis", panel)].update(shared)
    return Drawing([], layout)


def curve(
    x: ArrayLike, y: ArrayLike, name: str, role: str, unit: str, dash: str = "solid", at: str = "mm"
) -> Trace:
    """Return a line of a chart."""
    plain = html.escape(name, quote=False)
    return {
        "type": "scatter",
        "x": json_numbers(x),
        "y": json_numbers(y),
        "mode": "lines",
        "name": plain,
        "line": {"dash": dash, "width": 2},
        "meta": {"role": role},
        "hovertemplate": f"%{{y:.4g}} {unit} at %{{x:.5g}} {at}<extra>{plain}</extra>",
    }


def without_hover(trace: Trace, width: float) -> Trace:
    """Return a line that tells nothing where the pointer is over it."""
    hover = {name: value for name, value in trace.items() if name != "hovertemplate"}
    return {**hover, "hoverinfo": "skip", "line": {**trace["line"], "width": width}}


def series(number: int) -> str:
    """Return the role of one of several drives.

    Examples
    --------
    >>> series(7)
    'series-1'
    """
    return f"series-{(number - 1) % 6 + 1}"


def rounded_numbers(value: float) -> float:
    """Return a number to five digits, which is what a picture can show.

    Examples
    --------
    >>> rounded_numbers(1234.567)
    1234.6
    """
    return float(f"{value:.{_DIGITS}g}")


def json_numbers(values: ArrayLike) -> list[float | None]:
    """Return numbers to five digits as a list, None for what is not finite."""
    array = np.asarray(values, dtype=float)
    return [rounded_numbers(value) if np.isfinite(value) else None for value in array.tolist()]
