"""Charts as plotly reads them, without colours: the page gives them."""

import html
import json
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import plotly.graph_objects as go
from numpy.typing import ArrayLike
from plotly.subplots import make_subplots

_DIGITS = 5


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
    figure : plotly.graph_objects.Figure
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
    figure: go.Figure
    values: Values
    tall: int = 1
    still: str = ""
    slider: dict[str, Any] = field(default_factory=dict)

    @property
    def content(self) -> dict[str, Any]:
        """What the script of the page draws."""
        drawn = json.loads(self.figure.to_json())
        return {"data": drawn["data"], "layout": drawn["layout"], "slider": self.slider}


def panels(count: int) -> go.Figure:
    """Return an empty figure with panels above each other that share their x axis.

    Parameters
    ----------
    count : int
        At least 1.

    Returns
    -------
    plotly.graph_objects.Figure
        Without colours: the page gives them.
    """
    figure = make_subplots(rows=count, cols=1, shared_xaxes=True, vertical_spacing=0.06)
    figure.update_layout(
        template="none",
        margin={"l": 8, "r": 12, "t": 8, "b": 8},
        legend={"orientation": "h", "x": 0, "y": 1.02, "yanchor": "bottom"},
        hovermode="x unified" if count == 1 else "x",
        autosize=True,
    )
    figure.update_xaxes(automargin=True, title_standoff=8)
    figure.update_yaxes(automargin=True, title_standoff=8)
    return figure


def curve(
    x: ArrayLike, y: ArrayLike, name: str, role: str, unit: str, dash: str = "solid", at: str = "mm"
) -> go.Scatter:
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
    plotly.graph_objects.Scatter
        The trace.
    """
    plain = html.escape(name, quote=False)
    return go.Scatter(
        x=listed(x),
        y=listed(y),
        mode="lines",
        name=plain,
        line={"dash": dash, "width": 2},
        meta={"role": role},
        hovertemplate=f"%{{y:.4g}} {unit} at %{{x:.5g}} {at}<extra>{plain}</extra>",
    )


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
