"""How sure a life is: samples of a case of which some keys scatter."""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.stats import qmc

from wearsim.geometry.profile_points import Vector
from wearsim.input.document import CaseSource
from wearsim.runner.design import Design
from wearsim.runner.scatter import ScatteredCase, load_scattered

Method = Literal["sobol", "lhs", "random"]
METHODS: tuple[Method, ...] = ("sobol", "lhs", "random")

EDGE = 0.5**33
"""Distance from 0 and 1 kept by probabilities: half the spacing of 2^32 points."""


@dataclass(frozen=True)
class UncertaintyStudy:
    """The samples of a case."""

    scattered: ScatteredCase  # the case and what of it scatters
    method: Method  # `sobol`, `lhs` or `random`
    seed: int  # of the samples
    design: Design  # the cases of the samples


def load_uncertainty(
    source: CaseSource,
    overrides: Sequence[str],
    samples: int,
    seed: int,
    method: Method,
    least_horizon: float | None = None,
) -> UncertaintyStudy:
    """Return the samples of a case."""
    scattered = load_scattered(source, overrides, least_horizon)
    shares = unit_samples(len(scattered.scatters), samples, seed, method)
    return UncertaintyStudy(scattered, method, seed, scattered.design(shares))


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
