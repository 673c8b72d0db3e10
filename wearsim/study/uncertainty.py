"""How sure a life is: lives over values of keys that scatter."""

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
from scipy.stats import qmc

from wearsim.case.document import Document, read_document
from wearsim.case.load import load_case
from wearsim.case.model import Case
from wearsim.case.schema.uncertainty import Distribution
from wearsim.errors import CaseError, Fault
from wearsim.geometry.profile import Vector
from wearsim.study.distributions import described, quantile
from wearsim.study.runner.design import Design, design, replaced

PUBLISHED_SIGMA = 0.5
"""Scatter of published wear coefficients about those of one system: standard deviation of ln k,
as +-40 to 60 % (Podra and Andersson 1999)."""

Method = Literal["sobol", "lhs", "random"]
METHODS: tuple[Method, ...] = ("sobol", "lhs", "random")
MOST_SAMPLES = 10_000_000

_EDGE = 0.5**33
"""Distance from 0 and 1 kept by probabilities: half the spacing of 2^32 points."""


@dataclass(frozen=True)
class Scatter:
    """A key that scatters.

    Attributes
    ----------
    key : str
        Its dotted name.
    distribution : Distribution
        How it scatters.
    value : float
        What it is in the case.
    text : str
        The distribution in words.
    """

    key: str
    distribution: Distribution
    value: float
    text: str


@dataclass(frozen=True)
class UncertaintyStudy:
    """The samples of a case.

    Attributes
    ----------
    case : Case
        With the values of the input file.
    scatters : tuple of Scatter
        What scatters, independently of one another.
    method : str
        ``sobol``, ``lhs`` or ``random``.
    seed : int
        Of the samples.
    assumptions : tuple of str
        What is taken for granted about the scatter.
    design : Design
        The cases of the samples.
    """

    case: Case
    scatters: tuple[Scatter, ...]
    method: Method
    seed: int
    assumptions: tuple[str, ...]
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
        Where no wear coefficient scatters by the table, it does log-normally, by the published
        scatter.

    Raises
    ------
    CaseError
        The case is wrong, or a key of the table holds no number that could scatter.
    """
    document = read_document(path, overrides)
    case = load_case(path, overrides).with_horizon(least_horizon or 0.0)
    given: dict[str, Distribution] = _given(case)
    coefficient = coefficient_key(case)
    assumptions = []
    if coefficient not in given:
        given[coefficient] = Distribution(distribution="lognormal", sigma_ln=PUBLISHED_SIGMA)
        assumptions.append(
            f"{coefficient} is log-normal with sigma_ln = {PUBLISHED_SIGMA:g}, the scatter of published "
            "coefficients (default; [uncertainty] gives another)"
        )
    if len(given) > 1:
        assumptions.append("keys scatter independently of one another")
    scatters = tuple(_scatter(case, key, law) for key, law in given.items())
    shares = unit_samples(len(scatters), samples, seed, method)
    values = _values(case, scatters, shares)
    keys = [scatter.key for scatter in scatters]
    cases = design(_without_condition(document, case), keys, values.tolist(), str(path))
    return UncertaintyStudy(case, scatters, method, seed, tuple(assumptions), cases)


def coefficient_key(case: Case) -> str:
    """Return the key of a case's wear coefficient.

    Parameters
    ----------
    case : Case
        A case.

    Returns
    -------
    str
        Its life is inversely proportional to this key's value.
    """
    name = "specific_wear_rate_mm2_per_N" if case.wear.law == "archard" else "coefficient"
    return f"wear.{name}"


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
    return np.asarray(points.clip(_EDGE, 1.0 - _EDGE))


def _sobol(dimensions: int, count: int, seed: int) -> Vector:
    engine = qmc.Sobol(dimensions, bits=32, rng=np.random.default_rng(seed))
    with warnings.catch_warnings():
        # Of a number that is no power of two the command tells in its own words.
        warnings.filterwarnings("ignore", "The balance properties of Sobol'", UserWarning)
        return np.asarray(engine.random(count))


def _given(case: Case) -> dict[str, Distribution]:
    table: Mapping[str, Any] = case.inputs.get("uncertainty") or {}
    return {key: Distribution.model_validate(entry) for key, entry in table.items()}


def _scatter(case: Case, key: str, distribution: Distribution) -> Scatter:
    value = case.wear.coefficient if key == coefficient_key(case) else _value(case, key)
    return Scatter(key, distribution, value, described(distribution, value))


def _value(case: Case, key: str) -> float:
    found: Any = case.inputs
    for part in key.split("."):
        if isinstance(found, Mapping):
            found = found.get(part)
        elif isinstance(found, list) and part.isdigit() and 0 < int(part) <= len(found):
            found = found[int(part) - 1]
        else:
            found = None
    if isinstance(found, bool | int) or not isinstance(found, float):
        what = "is not in the case" if found is None else f"is {found!r}"
        text = f"only a key that holds a number with a fraction can scatter, but it {what}"
        raise CaseError([Fault(text, f'uncertainty."{key}"', case.name)])
    return found


def _values(case: Case, scatters: tuple[Scatter, ...], shares: Vector) -> Vector:
    columns, faults = [], []
    for scatter, column in zip(scatters, shares.T, strict=True):
        try:
            columns.append(quantile(scatter.distribution, scatter.value)(column))
        except ValueError as error:
            faults.append(Fault(str(error), f'uncertainty."{scatter.key}"', case.name))
    if faults:
        raise CaseError(faults)
    return np.column_stack(columns)


def _without_condition(document: Document, case: Case) -> Document:
    """Give the coefficient by its own key, which scatters, in place of a condition."""
    data = {name: table for name, table in document.data.items() if name != "uncertainty"}
    if "condition" in data["wear"]:
        wear = {name: value for name, value in data["wear"].items() if name != "condition"}
        data = replaced({**data, "wear": wear}, coefficient_key(case).split("."), 1.0)
    data = replaced(data, ("run", "horizon_hours"), case.run.horizon_hours)
    return replace(document, data=data)
