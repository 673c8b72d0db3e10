"""Scales of parallel coordinates: a line for each case, a scale for each key."""

import textwrap
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from wearsim.report.key_words import number_words
from wearsim.report.text_lines import literal

LEAST_APART = 0.07
"""Least distance of two ticks, as a part of their axis."""

_FEW = 8
"""Values spaced by a factor that all stand at their scale."""

_LETTERS = 18
"""In a line below a scale of parallel coordinates."""


def is_numeric(column: "pd.Series[Any]") -> bool:
    """Whether all values of a column are numbers."""
    return all(isinstance(value, int | float) and value is not True for value in column)


def is_whole(column: "pd.Series[Any]") -> bool:
    """Whether all values of a column are whole numbers."""
    return all(isinstance(value, int) for value in column)


_LEAST_SPAN = 3.0
"""Greatest of some values over the least from which on they may be spaced by a factor."""


def is_by_factor(values: "Sequence[float] | np.ndarray[Any, Any]") -> bool:
    """Whether values are rather spaced by a factor than by a step.

    Examples
    --------
    >>> is_by_factor([1e-10, 1e-9, 1e-8]), is_by_factor([10, 20, 50, 100]), is_by_factor([4.0, 5.0, 6.0])
    (True, True, False)
    """
    own = np.unique(np.asarray(values, float))
    if len(own) < 3 or own[0] <= 0.0 or own[-1] < _LEAST_SPAN * own[0]:
        return False
    factors, steps = np.diff(np.log(own)), np.diff(own)
    return bool(factors.std() / factors.mean() < steps.std() / steps.mean())


def name_scales(panel: Axes, names: Sequence[str]) -> None:
    """Write below each scale of parallel coordinates what it shows."""
    panel.set_xticks(np.arange(len(names)), [textwrap.fill(name, _LETTERS) for name in names], fontsize=8)
    panel.tick_params(length=0.0)
    panel.set_yticks([])
    panel.set_ylim(-0.05, 1.05)
    panel.set_xlim(-0.5, len(names) - 0.5)
    panel.spines[["top", "right", "left", "bottom"]].set_visible(False)


def scaled_heights(panel: Axes, at: int, values: "pd.Series[Any]") -> "np.ndarray[Any, Any]":
    """Draw one scale of parallel coordinates; its numbers stand on white, in front of all lines."""
    panel.axvline(at, color="0.3", linewidth=1.0)
    if is_numeric(values):
        places = values.to_numpy(float)
        by_factor = is_by_factor(places)
        ticks = _factor_ticks(places) if by_factor else _scale_ticks(values)
        marks = {np.log(at) if by_factor else at: number_words(at) for at in ticks.tolist()}
        places = np.log(places) if by_factor else places
    else:
        names = list(dict.fromkeys(map(str, values)))
        places = np.array([names.index(str(value)) for value in values], float)
        marks = dict(enumerate(names))
    low, span = places.min(), np.ptp(places)
    for place, text in marks.items():
        panel.annotate(
            literal(text),
            (at, (place - low) / span if span else 0.5),
            xytext=(-5.0, 0.0),
            textcoords="offset points",
            ha="right",
            va="center",
            fontsize=8,
            zorder=5,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8},
        )
    return (places - low) / span if span else np.full(len(places), 0.5)


def _factor_ticks(values: "np.ndarray[Any, Any]") -> "np.ndarray[Any, Any]":
    """The values themselves where they are few, else both ends and powers of ten well between them."""
    own = np.unique(values)
    if len(own) <= _FEW:
        return own
    apart = (own[-1] / own[0]) ** LEAST_APART
    decades = 10.0 ** np.arange(np.ceil(np.log10(own[0] * apart)), np.log10(own[-1] / apart))
    return np.array([own[0], *decades, own[-1]])


def _scale_ticks(values: "pd.Series[Any]") -> "np.ndarray[Any, Any]":
    """The values themselves where they are few, else both ends and round numbers between them."""
    own = np.unique(values.to_numpy(float))
    apart = LEAST_APART * np.ptp(own)
    if len(own) <= 2 or np.diff(own).min() > apart:
        return own
    low, high = own[0], own[-1]
    inner = MaxNLocator(5, integer=is_whole(values)).tick_values(low, high)
    return np.array([low, *inner[(inner > low + apart) & (inner < high - apart)], high])
