"""Samples in the unit cube: probabilities at which what scatters is taken, by one of three methods."""

import warnings
from typing import Literal

import numpy as np
from scipy.stats import qmc

from wearsim.geometry.profile_points import Vector

Method = Literal["sobol", "lhs", "random"]
METHODS: tuple[Method, ...] = ("sobol", "lhs", "random")

EDGE = 0.5**33
"""Distance from 0 and 1 kept by probabilities: half the spacing of 2^32 points."""


def unit_samples(dimensions: int, count: int, seed: int, method: Method) -> Vector:
    """Return samples in the unit cube.

    Examples
    --------
    >>> unit_samples(2, 4, 1, "lhs").shape
    (4, 2)
    """
    if method == "random":
        streams = (np.random.SeedSequence(seed, spawn_key=(index,)) for index in range(count))
        points = np.array([np.random.default_rng(stream).random(dimensions) for stream in streams])
    elif method == "lhs":
        points = qmc.LatinHypercube(dimensions, rng=np.random.default_rng(seed)).random(count)
    else:
        points = _sobol(dimensions, count, seed)
    return np.asarray(points.clip(EDGE, 1.0 - EDGE))


def _sobol(dimensions: int, count: int, seed: int) -> Vector:
    engine = qmc.Sobol(dimensions, bits=32, rng=np.random.default_rng(seed))
    with warnings.catch_warnings():
        # Of a number that is no power of two the command tells in its own words.
        warnings.filterwarnings("ignore", "The balance properties of Sobol'", UserWarning)
        return np.asarray(engine.random(count))
