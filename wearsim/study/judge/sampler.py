"""Draws of parameters given readings: particles led from what is expected to what the readings say."""

from collections.abc import Callable

import numpy as np

from wearsim.geometry.profile_points import Vector

_TAKEN, _LAST_TAKEN = 1.5, 6.0
"""Steps that a particle takes on average at each power, and at the last one."""

_MOST_STEPS = 100
_WANTED = 0.25
"""Part of the steps that should be taken."""

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
    known, power, scale = log_likelihood(at), 0.0, 2.0 / np.sqrt(middle.size)
    while power < 1.0:
        step = _step(known, 1.0 - power)
        power = power + step if power + step < 1.0 else 1.0
        weight = np.exp(step * (known - known.max()))
        place = (random.random() + np.arange(count)) / count
        chosen = np.minimum(np.searchsorted(np.cumsum(weight) / weight.sum(), place), count - 1)
        at, known = at[chosen], known[chosen]
        wanted, left = _LAST_TAKEN if power == 1.0 else _TAKEN, _MOST_STEPS
        while wanted > 0.0 and left:
            at, known, taken = _moved(log_likelihood, (at, known), (middle, sd), power, scale, random)
            scale *= float(np.exp(taken - _WANTED))
            wanted, left = wanted - taken, left - 1
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
    scale: float,
    random: np.random.Generator,
) -> tuple[Vector, Vector, float]:
    """Return particles after a step along the way between two others, and what part of them took it."""
    (at, known), (middle, sd) = particles, expected
    first, second = random.permutation(len(at)), random.permutation(len(at))
    jitter = 1e-3 * sd * random.standard_normal(at.shape)
    tried = at + scale * (at[first] - at[second]) / np.sqrt(2.0) + jitter
    likely = log_likelihood(tried)
    prior = -0.5 * (((tried - middle) / sd) ** 2 - ((at - middle) / sd) ** 2).sum(axis=1)
    taken = np.log(random.random(known.size)) < power * (likely - known) + prior
    at, known = np.where(taken[:, None], tried, at), np.where(taken, likely, known)
    return at, known, float(taken.mean())
