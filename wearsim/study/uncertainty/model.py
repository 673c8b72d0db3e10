"""How sure a life is: samples of a case of which some keys scatter."""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
from scipy.stats import qmc

from wearsim.geometry.profile import Vector
from wearsim.runner.design import Design
from wearsim.runner.scatter import Scattered, load_scattered

Method = Literal["sobol", "lhs", "random"]
METHODS: tuple[Method, ...] = ("sobol", "lhs", "random")

EDGE = 0.5**33
"""Distance from 0 and 1 kept by probabilities: half the spacing of 2^32 points."""


@dataclass(frozen=True)
class UncertaintyStudy:
    """The samples of a case.

    Attributes
    ----------
    scattered : Scattered
        The case and what of it scatters.
    method : str
        ``sobol``, ``lhs`` or ``random``.
    seed : int
        Of the samples.
    design : Design
        The cases of the samples.
    """

    scattered: Scattered
    method: Method
    seed: int
    design: Design


def load_uncertainty(
    path: Path, overrides: Sequence[str], samples: int, seed: int, method: Method,
    least_horizon: float | None = None,
) -> UncertaintyStudy:  # fmt: skip
    """Return the samples of a case.

    Parameters
    ----------
    path : pathlib.Path
        The case; its table [uncertainty] tells what scatters.
    overrides : sequence of str
        ``table.key=VALUE``.
    samples : int
        Number of samples, at least 2.
    seed : int
        The same seed gives the same samples.
    method : str
        ``sobol``: scrambled Sobol' points; ``lhs``: a Latin hypercube; ``random``: independent,
        every sample from its own generator.
    least_horizon : float, optional
        What run.horizon_hours is raised to where it is less [h].

    Returns
    -------
    UncertaintyStudy
        To be run.

    Raises
    ------
    CaseError
        The case is wrong, or a key of the table holds no number that could scatter.
    """
    scattered = load_scattered(path, overrides, least_horizon)
    shares = unit_samples(len(scattered.scatters), samples, seed, method)
    return UncertaintyStudy(scattered, method, seed, scattered.design(shares))


def unit_samples(dimensions: int, count: int, seed: int, method: Method) -> Vector:
    """Return samples in the unit cube.

    Parameters
    ----------
    dimensions, count : int
        Numbers of keys and of samples.
    seed : int
        The same seed gives the same samples.
    method : str
        ``sobol``, ``lhs`` or ``random``.

    Returns
    -------
    numpy.ndarray
        Shape (count, dimensions), inside (0, 1).

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
