"""How long one application of a lubricant lasts: its jump and its allowance on three roads.

By the law of lubrication with a jump (w = 0) the wear at a distance x is a x up to the jump J and
a J + b (x - J) after it, with a the lubricated and b the dry rate on that road. The allowance of 1
is at A = J + (1 - a J)/b. a comes from the blocks, a jump that was read is taken as it is.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from lubricant_coefficients import inverse_wishart

ROADS = ("road", "gravel", "extreme")

_MEAN = np.log([0.3, 3000.0, 1500.0, 500.0])
_MEAN_SPREAD, _BETWEEN = 1.0, np.array([0.6, 0.4, 0.4, 0.2])
"""Where the mean over categories is expected, and how far off; scatter of categories about it."""

_WITHIN, _WEIGHT = np.array([0.6, 0.6, 0.6, 0.25]), 6.0
"""Scatter within a category before it is seen, and how many lubricants that is worth."""

_EVERY = 50
"""Distance of which jumps that were seen at a reading are a multiple [km]."""


@dataclass(frozen=True)
class Coefficients:
    """Draws of what makes the distance to an allowance, by lubricant: a jump and the dry rate after it."""

    jump: np.ndarray  # [km]
    dry: np.ndarray  # [1/km]; infinite where allowance and jump were read as one


def extreme_allowances(seen, kind, kinds, rounds, generator):
    """Draw the allowance in extreme wet by Gibbs steps: (draws, lubricants) [km].

    ``seen`` holds wet wear in 1000 km, the jumps on road and gravel and that allowance, NaN where not
    read. Their logarithms are normal about the means of the category, with one covariance.
    """
    member, missing = np.eye(kinds)[kind], np.isnan(seen)
    value = np.where(missing, _MEAN, np.log(seen))
    mean, covariance = np.broadcast_to(_MEAN, seen.shape), np.diag(_WITHIN**2)
    kept = []
    for number in range(rounds + rounds // 3):
        precision = np.linalg.inv(covariance)
        for one in range(1, 4):
            free = missing[:, one]
            own = precision[one, one]
            others = (value - mean) @ precision[one] / own - (value - mean)[:, one]
            drawn = mean[:, one] - others + generator.standard_normal(len(value)) / np.sqrt(own)
            value[free, one] = drawn[free]
        mean = member @ _category_means(value, member, precision, generator)
        off = value - mean
        total = _WEIGHT * np.diag(_WITHIN**2) + off.T @ off
        covariance = inverse_wishart(generator, _WEIGHT + len(off) + 5.0, total)
        if number >= rounds // 3:
            kept.append(np.exp(value[:, 3]))
    return np.array(kept)


def _category_means(value, member, precision, generator):
    between = _BETWEEN**2 + _MEAN_SPREAD**2 / member.shape[1]
    means = []
    for column in member.T:
        total = np.linalg.inv(np.diag(1.0 / between) + column.sum() * precision)
        centre = total @ (_MEAN / between + precision @ (column @ value))
        means.append(centre + np.linalg.cholesky(total) @ generator.standard_normal(4))
    return np.array(means)


def student(values, draws, generator):
    """Draw a new value beside normal ones whose mean and scatter are not known."""
    number = len(values)
    spread = np.std(values, ddof=1) * np.sqrt(1.0 + 1.0 / number)
    return np.mean(values) + spread * generator.standard_t(number - 1, draws)


def extreme(seen, jumps, lubricated, kind, kinds, rounds, generator) -> Coefficients:
    """Draw the coefficients in extreme wet, of all lubricants, from the allowance and the jump as part of it.

    That part scatters less with the allowance than the jump and the dry rate do with each other.
    """
    allowance = extreme_allowances(seen, kind, kinds, rounds, generator)
    read = jumps / seen[:, 3]
    part = np.clip(student(read[~np.isnan(read)], allowance.shape, generator), 0.05, 1.0)
    jump = part * allowance
    with np.errstate(divide="ignore"):
        return Coefficients(jump, np.maximum(1.0 - lubricated * jump, 0.05) / (allowance - jump))


def dry_after(jump, jumps, allowances, lubricated, draws, generator) -> np.ndarray:
    """Draw the dry rate after a jump on road or gravel, given those of other lubricants, (n, roads).

    Infinite where allowance and jump are read as one; that is as frequent as among the jumps which,
    like this one, are or are not at a multiple of 50 km.
    """
    left = allowances - jumps
    alike = (jumps % _EVERY == 0) == (jump % _EVERY == 0)
    ties = ((left == 0) & alike).sum() + 0.5
    tie = generator.random(draws) < ties / ((~np.isnan(left) & alike).sum() + 1.0)
    slow = left > 0
    rate = np.log((1.0 - lubricated[slow] * jumps[slow]) / left[slow])
    return np.where(tie, np.inf, np.exp(student(rate, draws, generator)))


def allowance(jump, lubricated, dry) -> np.ndarray:
    """Distance at which the wear comes to the allowance [km]."""
    return jump + np.maximum(1.0 - lubricated * jump, 0.0) / dry


def outward(quantiles: Sequence[float], unit: float) -> list[float]:
    """Round quantiles so that bands do not lose their edges: lower ones down, upper ones up.

    Examples
    --------
    >>> outward([1.5, 2.5, 3.5, 4.5, 5.5], 1.0)
    [1.0, 2.0, 4.0, 5.0, 6.0]
    """
    rounded = (np.floor, np.floor, np.round, np.ceil, np.ceil)
    return [float(unit * turn(value / unit)) for turn, value in zip(rounded, quantiles, strict=True)]
