"""The Gaussian filter of surface measurement, as weights on scattered points."""

import math

import numpy as np

from wearsim.geometry.profile_points import Vector

_ALPHA = math.sqrt(math.log(2.0) / math.pi)
"""At this constant the filter passes half the amplitude of a wave of the cut-off's length."""


def gaussian_weights(places: Vector, stations: Vector, cutoff: float) -> Vector:
    """Return the weights that smooth measured values to stations along a profile.

    Each row is the Gaussian of ISO 16610-21, exp(-pi (s/(alpha lambda_c))^2) with alpha =
    sqrt(ln 2/pi), at the distances s of the points, its sum made 1. Every point counts alike;
    near an end only the points that are there do.

    Parameters
    ----------
    places : numpy.ndarray
        Arc lengths of the measured points [mm], shape (n,).
    stations : numpy.ndarray
        Arc lengths where smoothed values are wanted [mm], shape (m,), each within reach of a
        point.
    cutoff : float
        Cut-off wavelength lambda_c [mm], above 0.

    Returns
    -------
    numpy.ndarray
        Shape (m, n), rows of sum 1.

    Examples
    --------
    A wave of the cut-off's length keeps half its amplitude:

    >>> s = np.linspace(-5.0, 5.0, 2001)
    >>> weights = gaussian_weights(s, np.array([0.0]), 0.8)
    >>> round(float((weights @ np.cos(2.0 * np.pi * s / 0.8))[0]), 4)
    0.5
    """
    distance = (stations[:, None] - places[None, :]) / (_ALPHA * cutoff)
    # Of the nearest point the weight is 1 before the rows are normalised: none can vanish.
    nearest = np.abs(distance).min(axis=1, keepdims=True)
    weights = np.exp(-math.pi * (distance**2 - nearest**2))
    return np.asarray(weights / weights.sum(axis=1, keepdims=True))


def filter_stations(places: Vector, cutoff: float) -> Vector:
    """Return stations about one cut-off apart, each in the middle of points.

    Examples
    --------
    >>> filter_stations(np.array([0.0, 0.25, 0.5, 2.0]), 0.8).tolist()
    [0.25, 2.0]
    """
    start, end = float(places.min()), float(places.max())
    bins = max(1, math.ceil((end - start) / cutoff))
    edges = np.linspace(start, end, bins + 1)
    which = np.clip(np.searchsorted(edges, places, side="right") - 1, 0, bins - 1)
    return np.array([places[which == index].mean() for index in np.unique(which)])
