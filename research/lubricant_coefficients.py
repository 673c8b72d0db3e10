"""Coefficients of lubricants by category from the blocks of the rig: a Markov chain in plain numpy.

The coefficients of a lubricant are those of its category times a scatter, all logarithms normal
with one covariance, with the tails of Student's t; what a block grows is what the law gives with
them, again with a scatter of heavy tails, and the error of the reading. All of it is drawn by Gibbs
and Metropolis steps for several sets of readings at once (leave-one-out).
"""

from dataclasses import dataclass

import numpy as np
from lubricant_rig import HOURS, READING, STEP, growth

NAMES = ("clean", "running_in", "dust", "wet", "extreme", "removed")
TAILS = 4.0
"""Degrees of freedom of Student's t, of lubricants and of blocks."""

_MEAN = np.log([0.05 / 35.0, 0.02, 0.1 / 35.0, 0.3 / 35.0, 1.5, 1.0])
_MEAN_SPREAD = np.array([2.0, 1.5, 1.5, 1.5, 0.5, 1.0])
"""Where the mean over categories is expected, and how far off it may be."""

_BETWEEN = np.array([1.0, 1.0, 0.8, 0.6, 0.2, 0.4])
"""Scatter of categories about that mean."""

_WITHIN, _WEIGHT = np.array([1.0, 1.0, 0.8, 0.6, 0.4, 0.6]), 10.0
"""Scatter within a category before it is seen, and how many lubricants that is worth."""


def wear(theta):
    """Growth in the six blocks for the logarithms of coefficients (the last axis of ``theta``)."""
    clean, run_in, dust, wet, extreme = np.moveaxis(np.exp(theta[..., :5]), -1, 0)
    dirt = {"dust": dust, "wet": wet, "extreme": wet * extreme}
    return growth(clean, run_in, dirt, 1.0 / (1.0 + np.exp(-theta[..., 5])))


def scale(grown, spread):
    """Scale on which scatter and reading error together are even: logarithmic, straight near zero."""
    return np.arcsinh(grown * spread / READING)


def log_likelihood(theta, read, spread):
    """Log-likelihood of readings by lubricant; a reading of 0 is one below half a step, NaN none."""
    spread = spread[..., None, None]
    off = scale(np.maximum(read, 0.5 * STEP), spread) - scale(wear(theta), spread)
    t = off / spread
    density = -0.5 * (TAILS + 1.0) * np.log1p(t * t / TAILS) - 0.5 * np.log(read**2 + (READING / spread) ** 2)
    density -= np.log(spread)
    u = 1.0 + 0.25 * t * t
    below = 0.5 + 0.375 * t / np.sqrt(u) * (1.0 - t * t / (12.0 * u))
    terms = np.where(read > 0.0, density, np.log(np.maximum(below, 1e-12)))
    return np.where(np.isnan(read), 0.0, terms).sum(axis=-1)


@dataclass(frozen=True)
class Draws:
    """Draws of the coefficients: (draws, sets, lubricants, coefficients), and of the scatter of a block."""

    theta: np.ndarray
    spread: np.ndarray  # (draws, sets)
    mean: np.ndarray  # of categories, (draws, sets, categories, coefficients)
    covariance: np.ndarray  # (draws, sets, coefficients, coefficients)

    def only(self, one: int) -> "Draws":
        """Draws of one set of readings."""
        return Draws(*(getattr(self, name)[:, [one]] for name in self.__dataclass_fields__))

    def readings(self, generator, lubricants) -> np.ndarray:
        """Draw what would be read in the six blocks, of the only set: (draws, lubricants, 6)."""
        theta, spread = self.theta[:, 0, lubricants], self.spread[..., None]
        at = scale(wear(theta), spread) + spread * generator.standard_t(
            TAILS, (*theta.shape[:-1], len(HOURS))
        )
        grown = READING / spread * np.sinh(np.clip(at, -20.0, 20.0))
        return STEP * np.round(np.maximum(grown, 0.0) / STEP)


class _Sampler:
    """State of the chain: sets of readings by lubricants by coefficients."""

    def __init__(self, read, kind, kinds, generator):
        self.read, self.generator = read, generator
        self.member = np.eye(kinds)[kind]
        sets, lubricants = read.shape[:2]
        self.theta = _MEAN + 0.1 * generator.standard_normal((sets, lubricants, len(NAMES)))
        self.mean = np.tile(_MEAN, (sets, kinds, 1))
        self.centre = np.tile(_MEAN, (sets, 1))
        self.covariance = np.tile(np.diag(_WITHIN**2), (sets, 1, 1))
        self.weight = np.ones((sets, lubricants))
        self.spread = np.full(sets, 0.5)
        self.step = np.full((sets, lubricants, len(NAMES)), 0.5)
        self.likely = log_likelihood(self.theta, read, self.spread)

    def round(self, adapt):
        precision = np.linalg.inv(self.covariance)
        self._coefficients(precision, adapt)
        self._spread()
        self._weights(precision)
        self._means(precision)
        self._covariance()

    def _coefficients(self, precision, adapt):
        draw = self.generator
        for one in range(len(NAMES)):
            moved = self.theta.copy()
            moved[..., one] += self.step[..., one] * draw.standard_normal(moved.shape[:2])
            likely = log_likelihood(moved, self.read, self.spread)
            change = (
                likely
                - self.likely
                - 0.5
                * self.weight
                * (self._distance(moved, precision) - self._distance(self.theta, precision))
            )
            taken = np.log(draw.random(change.shape)) < change
            self.theta = np.where(taken[..., None], moved, self.theta)
            self.likely = np.where(taken, likely, self.likely)
            if adapt:
                self.step[..., one] *= np.exp(0.1 * (taken - 0.4))

    def _distance(self, theta, precision):
        off = theta - self.member @ self.mean
        return np.einsum("sli,sij,slj->sl", off, precision, off, optimize=True)

    def _spread(self):
        draw = self.generator
        moved = self.spread * np.exp(0.15 * draw.standard_normal(self.spread.shape))
        likely = log_likelihood(self.theta, self.read, moved)
        prior = [-0.5 * (np.log(spread / 0.4) / 0.5) ** 2 for spread in (moved, self.spread)]
        change = (likely - self.likely).sum(axis=1) + prior[0] - prior[1]
        taken = np.log(draw.random(change.shape)) < change
        self.spread = np.where(taken, moved, self.spread)
        self.likely = np.where(taken[:, None], likely, self.likely)

    def _weights(self, precision):
        shape = 0.5 * (TAILS + len(NAMES))
        rate = 0.5 * (TAILS + self._distance(self.theta, precision))
        self.weight = self.generator.gamma(shape, 1.0 / rate)

    def _means(self, precision):
        draw = self.generator
        between = np.diag(_BETWEEN**-2.0)
        weight = self.weight @ self.member
        total = between + weight[..., None, None] * precision[:, None]
        summed = np.einsum("sl,lk,sli->ski", self.weight, self.member, self.theta)
        right = (self.centre @ between)[:, None] + np.einsum("sij,skj->ski", precision, summed)
        inverse = np.linalg.inv(total)
        factor = np.linalg.cholesky(inverse)
        centre = np.einsum("skij,skj->ski", inverse, right)
        self.mean = centre + np.einsum("skij,skj->ski", factor, draw.standard_normal(centre.shape))
        narrow = 1.0 / (self.mean.shape[1] * _BETWEEN**-2.0 + _MEAN_SPREAD**-2.0)
        middle = narrow * (self.mean.sum(axis=1) * _BETWEEN**-2.0 + _MEAN * _MEAN_SPREAD**-2.0)
        self.centre = middle + np.sqrt(narrow) * draw.standard_normal(middle.shape)

    def _covariance(self):
        off = (self.theta - self.member @ self.mean) * np.sqrt(self.weight)[..., None]
        total = _WEIGHT * np.diag(_WITHIN**2) + np.einsum("sli,slj->sij", off, off)
        self.covariance = inverse_wishart(self.generator, _WEIGHT + off.shape[1] + len(NAMES) + 1.0, total)


def inverse_wishart(generator, freedom, matrix):
    """Draw covariances from inverse Wishart distributions, by Bartlett's decomposition of the inverse."""
    size = matrix.shape[-1]
    lower = np.tril(generator.standard_normal(matrix.shape), -1)
    lower[..., range(size), range(size)] = np.sqrt(
        generator.chisquare(freedom - np.arange(size), matrix.shape[:-1])
    )
    root = np.linalg.cholesky(np.linalg.inv(matrix)) @ lower
    return np.linalg.inv(root @ np.swapaxes(root, -1, -2))


def fit(read, kind, kinds, rounds, seed=21, thin=2) -> Draws:
    """Draw the coefficients of lubricants given sets of readings (sets, lubricants, 6), NaN where none."""
    sampler = _Sampler(np.asarray(read, dtype=float), kind, kinds, np.random.default_rng(seed))
    for _ in range(rounds // 3):
        sampler.round(adapt=True)
    kept = []
    for number in range(rounds):
        sampler.round(adapt=False)
        if number % thin == 0:
            kept.append((sampler.theta, sampler.spread, sampler.mean, sampler.covariance))
    return Draws(*(np.stack(column) for column in zip(*kept, strict=True)))
