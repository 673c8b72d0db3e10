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
    """What plotly draws, without its Python objects, which take longer than all else on a page.

    Attributes
    ----------
    traces : list of dict
        Lines and bars.
    layout : dict
        Axes and what is around them.
    """

    traces: list[Trace]
    layout: dict[str, Any]

    def add(self, traces: Iterable[Trace], panel: int | None = None) -> None:
        """Add lines or bars.

        Parameters
        ----------
        traces : iterable of dict
            What is added.
        panel : int, optional
            Its number from the top, where there are several.
        """
        place = {} if panel is None else {"xaxis": _axis("x", panel), "yaxis": _axis("y", panel)}
        self.traces.extend({**trace, **place} for trace in traces)

    def set_axis(self, letter: str, title: str = "", panel: int = 1, **settings: Any) -> None:
        """Name an axis, or change how it is drawn.

        Parameters
        ----------
        letter : str
            ``x`` or ``y``.
        title : str
            Its name with the unit, where it gets one.
        panel : int
            Number of its panel from the top.
        **settings : object
            As plotly names them.
        """
        axis = self.layout[_axis(f"{letter}axis", panel)]
        axis.update(settings)
        if title:
            axis["title"]["text"] = title


def _axis(name: str, panel: int) -> str:
    return f"{name}{panel}" if panel > 1 else name


@dataclass(frozen=True)
class Values:
    """Some values of a chart, to be read without it.

    Attributes
    ----------
    head : tuple of str
        Heads of the columns with their units.
    rows : tuple of tuple of str
        The cells.
    """

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Chart:
    """A chart and what stands for it where it cannot be seen.

    Attributes
    ----------
    name : str
        Of its element on the page.
    title, alt : str
        What it is, and what there is to see.
    figure : Drawing
        The chart; the colour of a trace follows from ``meta["role"]``.
    values : Values
        Some of its values.
    tall : int
        Panels above each other.
    still : str
        Stem of the picture that stands for it on paper; empty where the values do.
    slider : dict
        What a slider does to it; empty where there is none.
    """

    name: str
    title: str
    alt: str
    figure: Drawing
    values: Values
    tall: int = 1
    still: str = ""
    slider: dict[str, Any] = field(default_factory=dict)

    @property
    def content(self) -> dict[str, Any]:
        """What the script of the page draws; traces and layout may be changed one by one."""
        traces = [dict(trace) for trace in self.figure.traces]
        return {"data": traces, "layout": dict(self.figure.layout), "slider": self.slider}


def panels(count: int) -> Drawing:
    """Return an empty drawing with panels above each other that share their x axis.

    Parameters
    ----------
    count : int
        At least 1.

    Returns
    -------
    Drawing
        Without colours: the page gives them.
    """
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
    """Return a line of a chart.

    Parameters
    ----------
    x, y : array_like
        Its points.
    name : str
        For legend and hover: a text, not markup.
    role : str
        What gives it its colour.
    unit : str
        Of y.
    dash : str
        Of plotly.
    at : str
        Unit of x.

    Returns
    -------
    dict
        The trace.
    """
    plain = html.escape(name, quote=False)
    return {
        "type": "scatter",
        "x": listed(x),
        "y": listed(y),
        "mode": "lines",
        "name": plain,
        "line": {"dash": dash, "width": 2},
        "meta": {"role": role},
        "hovertemplate": f"%{{y:.4g}} {unit} at %{{x:.5g}} {at}<extra>{plain}</extra>",
    }


def silent(trace: Trace, width: float) -> Trace:
    """Return a line that tells nothing where the pointer is over it.

    Parameters
    ----------
    trace : dict
        The line.
    width : float
        How thick it is drawn.

    Returns
    -------
    dict
        The trace.
    """
    told = {name: value for name, value in trace.items() if name != "hovertemplate"}
    return {**told, "hoverinfo": "skip", "line": {**trace["line"], "width": width}}


def series(number: int) -> str:
    """Return the role of one of several drives.

    Parameters
    ----------
    number : int
        From 1.

    Returns
    -------
    str
        Six colours, then again from the first.

    Examples
    --------
    >>> series(7)
    'series-1'
    """
    return f"series-{(number - 1) % 6 + 1}"


def rounded(value: float) -> float:
    """Return a number to five digits, which is what a picture can show.

    Parameters
    ----------
    value : float
        Any number.

    Returns
    -------
    float
        Rounded.

    Examples
    --------
    >>> rounded(1234.567)
    1234.6
    """
    return float(f"{value:.{_DIGITS}g}")


def listed(values: ArrayLike) -> list[float | None]:
    """Return numbers to five digits as a list, None for what is not finite.

    Parameters
    ----------
    values : array_like
        Numbers.

    Returns
    -------
    list of float or None
        Shorter in a file than all of their digits.
    """
    array = np.asarray(values, dtype=float)
    return [rounded(value) if np.isfinite(value) else None for value in array.tolist()]
