"""How readings scatter about a law, and what a law says of each one before it is read.

The logarithm of a reading is that of the law, plus the state of its series, plus an error of its
own. The state is normal with standard deviation `sd_series` where the exposure is the smallest of
all; it stays ("factor"), or wanders with variance `sd_walk`^2 per unit of ln(exposure) ("walk").
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import log_ndtr, ndtr

from wearsim.geometry.profile_points import Vector
from wearsim.study.judge.wear_series import WearSeries

_SEED = 21
_LEAST = -50.0
"""Logarithm of wear that no gauge tells from none."""

_LN_2PI = float(np.log(2.0 * np.pi))


@dataclass(frozen=True, eq=False)
class Scatter:
    """Standard deviations of ln(wear), each of shape (k, 1)."""

    series: Vector  # of the factor of a series
    walk: Vector  # of its wandering while the exposure grows by a factor e
    reading: Vector  # of one reading, besides the error of the gauge


@dataclass(frozen=True, eq=False)
class Forecasts:
    """Normal distributions of ln(wear) of every reading, shape (k, n), and likelihoods."""

    mean: Vector  # given the earlier fitted readings of the series
    variance: Vector
    shared: Vector  # part of the variance that readings of a series have in common
    log_likelihood: Vector  # of the fitted readings, shape (k,)


def forecasts(ln_law: Vector, scatter: Scatter, data: WearSeries) -> Forecasts:
    """Return what k sets of parameters say of each reading, given the fitted ones before it in its series.

    A scalar Kalman filter along each series: exact, but after a censored reading the state is taken
    as the normal distribution of the same mean and variance.

    Parameters
    ----------
    ln_law : numpy.ndarray
        Logarithm of the law, shape (k, n).
    scatter : Scatter
        About the law.
    data : WearSeries
        The readings.

    Returns
    -------
    Forecasts
        Of all readings.
    """
    ln_wear, ln_exposure = (np.log(column)[:, None] for column in (data.wear, data.exposure))
    # Readings run down, so that those of a step stand together in memory.
    law = np.ascontiguousarray(ln_law.T)
    own = np.broadcast_to(scatter.reading.T**2, law.shape)
    if data.error.any():
        own = own + (data.error[:, None] * np.exp(-np.maximum(law, _LEAST))) ** 2
    mean, shared = np.empty_like(law), np.empty_like(law)
    shape = len(data.names), law.shape[1]
    state, spread = np.zeros(shape), np.broadcast_to(scatter.series.T**2, shape).copy()
    at = np.full((shape[0], 1), ln_exposure.min())
    total = np.zeros(shape[1])
    for slot in data.slots.T:
        alive = np.flatnonzero(slot >= 0)
        rows = slot[alive]
        z, p = state[alive], spread[alive] + scatter.walk.T**2 * (ln_exposure[rows] - at[alive])
        at[alive] = ln_exposure[rows]
        mean[rows], shared[rows] = law[rows] + z, p
        used = data.fitted[rows, None]
        if used.any():
            size = p + own[rows]
            density, moved, left = _read(ln_wear[rows] - mean[rows], size, data.censored[rows, None])
            total += np.where(used, density, 0.0).sum(axis=0)
            gain = np.where(used, p / size, 0.0)
            z, p = z + gain * moved, p - gain * p + gain**2 * left
        state[alive], spread[alive] = z, p
    return Forecasts(mean.T, (shared + own).T, shared.T, total)


def _read(off: Vector, size: Vector, sign: NDArray[np.intp]) -> tuple[Vector, Vector, Vector]:
    """Return log likelihood of readings, and mean and variance of ln(wear) about its forecast after them."""
    exact = -0.5 * (_LN_2PI + np.log(size) + off**2 / size)
    if not sign.any():
        return exact, off, np.zeros_like(off)
    root = np.sqrt(size)
    t = np.clip(-sign * off / root, -30.0, 30.0)
    beyond = log_ndtr(t)
    ratio = np.exp(-0.5 * (_LN_2PI + t**2) - beyond)
    cut = sign != 0
    moved = np.where(cut, sign * root * ratio, off)
    left = np.where(cut, size * (1.0 - ratio * (t + ratio)), 0.0)
    return np.where(cut, beyond, exact), moved, np.maximum(left, 0.0)


def log_scores(found: Forecasts, data: WearSeries) -> Vector:
    """Return the log of the mean density of ln(wear), or probability where censored, shape (n,)."""
    density, _, _ = _read(np.log(data.wear) - found.mean, found.variance, data.censored)
    most = density.max(axis=0)
    return np.asarray(most + np.log(np.exp(density - most).mean(axis=0)))


def probabilities(found: Forecasts, ln_wear: Vector) -> Vector:
    """Return how likely less wear than that is, shape (n,)."""
    return np.asarray(ndtr((ln_wear - found.mean) / np.sqrt(found.variance)).mean(axis=0))


def drawn_again(found: Forecasts, data: WearSeries) -> Vector:
    """Return readings of ln(wear) as the law would give them, shape (k, n), the same ones every time."""
    random = np.random.default_rng(_SEED)
    count = len(found.mean)
    series = random.standard_normal((count, len(data.names)))[:, data.series]
    own = random.standard_normal(found.mean.shape) * np.sqrt(found.variance - found.shared)
    return np.asarray(found.mean + np.sqrt(found.shared) * series + own)


def quantiles(found: Forecasts, share: float) -> Vector:
    """Return the wear of which a share is below, shape (n,), by bisection."""
    half = 5.0 * np.sqrt(found.variance)
    low, high = (found.mean - half).min(axis=0), (found.mean + half).max(axis=0)
    for _ in range(26):
        middle = 0.5 * (low + high)
        below = probabilities(found, middle) < share
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return np.asarray(np.exp(0.5 * (low + high)))
