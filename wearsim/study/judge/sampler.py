"""Draws of parameters given readings: particles led from what is expected to what the readings say."""

from collections.abc import Callable

import numpy as np

from wearsim.geometry.profile_points import Vector

_MOVES = 6
_LAST_MOVES = 12
_HALF_LEFT = 0.5
_SEED = 20


def draws(log_likelihood: Callable[[Vector], Vector], middle: Vector, sd: Vector, count: int) -> Vector:
    """Return draws of a posterior, shape (count, p), the same ones every time.

    Sequential Monte Carlo: the likelihood is raised to a power that grows from 0 to 1 so that half of
    the particles stay effective each time; then they are resampled and moved by Metropolis steps.

    Parameters
    ----------
    log_likelihood : callable
        Of parameters of shape (count, p), shape (count,).
    middle, sd : numpy.ndarray
        Of the independent normal distributions that stand before any reading, shape (p,).
    count : int
        Particles.

    Returns
    -------
    numpy.ndarray
        Draws.

    Examples
    --------
    A reading of 2 with error 1 of what is expected at 0 with sd 1 leaves a mean of 1:

    >>> found = draws(lambda x: -0.5 * (x[:, 0] - 2.0) ** 2, np.zeros(1), np.ones(1), 4000)
    >>> round(float(found.mean()), 1)
    1.0
    """
    random = np.random.default_rng(_SEED)
    at = middle + sd * random.standard_normal((count, middle.size))
    known, power = log_likelihood(at), 0.0
    while power < 1.0:
        step = _step(known, 1.0 - power)
        power = power + step if power + step < 1.0 else 1.0
        weight = np.exp(step * (known - known.max()))
        place = (random.random() + np.arange(count)) / count
        chosen = np.minimum(np.searchsorted(np.cumsum(weight) / weight.sum(), place), count - 1)
        at, known = at[chosen], known[chosen]
        moves = _MOVES if power < 1.0 else _LAST_MOVES
        at, known = _moved(log_likelihood, (at, known), (middle, sd), power, moves, random)
    return at


def _step(known: Vector, most: float) -> float:
    """Return by how much the power may grow."""

    def effective(step: float) -> float:
        weight = np.exp(step * (known - known.max()))
        return float(weight.sum() ** 2 / (weight**2).sum())

    if effective(most) >= _HALF_LEFT * known.size:
        return most
    low, high = 0.0, most
    for _ in range(30):
        middle = 0.5 * (low + high)
        if effective(middle) >= _HALF_LEFT * known.size:
            low = middle
        else:
            high = middle
    return max(low, 1e-9)


def _moved(
    log_likelihood: Callable[[Vector], Vector],
    particles: tuple[Vector, Vector],
    expected: tuple[Vector, Vector],
    power: float,
    moves: int,
    random: np.random.Generator,
) -> tuple[Vector, Vector]:
    """Return particles after steps of the size of their own scatter."""
    (at, known), (middle, sd) = particles, expected
    size = at.shape[1]
    spread = np.atleast_2d(np.cov(at, rowvar=False)) + 1e-12 * np.diag(sd**2)
    root = np.linalg.cholesky(spread)
    scale = 2.0 / np.sqrt(size)
    before = -0.5 * (((at - middle) / sd) ** 2).sum(axis=1)
    for _ in range(moves):
        tried = at + scale * random.standard_normal(at.shape) @ root.T
        likely, prior = log_likelihood(tried), -0.5 * (((tried - middle) / sd) ** 2).sum(axis=1)
        gained = power * (likely - known) + prior - before
        taken = np.log(random.random(known.size)) < gained
        at = np.where(taken[:, None], tried, at)
        known, before = np.where(taken, likely, known), np.where(taken, prior, before)
        scale *= float(np.exp(taken.mean() - 0.25))
    return at, known
