"""Where the best design should be, by smooth models of all that was tried near the best so far."""

from collections.abc import Sequence
from itertools import combinations_with_replacement
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from wearsim.geometry.profile_points import Vector
from wearsim.study.optimise.model import OptimiseStudy
from wearsim.study.optimise.trials import MAXIMISED, Candidate

Places = NDArray[np.signedinteger[Any]]

_PER_TERM = 2
"""Designs nearest to the best that a model is fitted to, for each of its terms."""

_STEPS = 100


def proposals(
    study: OptimiseStudy,
    tried: Sequence[Candidate],
    best: Candidate,
    radii: Sequence[float],
    margins: Sequence[float],
) -> list[Vector]:
    """Return points at which models of the measures have their best feasible design.

    Logarithms of measures are quadratic in the parameters, or linear where too few designs are
    near, by least squares: lives, masses and pressures go with powers of most of them. For the
    largest radius and margin there is also a point with each parameter in turn as it is: designs
    that fail have no measures, so that a model may lead into them.
    """
    middle, free = study.space.point(best.values), np.flatnonzero(~study.space.whole)
    if middle is None or not free.size or best.error:
        return []
    near = _alike(study, tried, best)
    wanted = [(radius, margin, -1) for radius in radii for margin in margins]
    wanted += [(max(radii), max(margins), kept) for kept in range(free.size if free.size > 1 else 0)]
    models = {radius: _model(near, middle[free], free, radius) for radius in radii}
    found = []
    for radius, margin, kept in wanted:
        model = models[radius]
        if model is not None:
            place = middle.copy()
            place[free] += radius * _solved(study, model, (middle[free], radius), margin, kept)
            found.append(np.clip(place, 0.0, 1.0))
    return found


def _alike(study: OptimiseStudy, tried: Sequence[Candidate], best: Candidate) -> list[tuple[Vector, Vector]]:
    """Places of designs with the same values of lists, and logarithms of their measures."""
    lists = np.flatnonzero(study.space.whole)
    found = []
    for one in tried:
        place = study.space.point(one.values)
        if place is None or one.error or any(one.values[at] != best.values[at] for at in lists):
            continue
        found.append((place, np.log([one.measures[name] for name in study.measures])))
    return found


def _model(near: list[tuple[Vector, Vector]], middle: Vector, free: Places, radius: float) -> Vector | None:
    """Coefficients of each measure, shape (terms, measures)."""
    offsets = np.array([(place[free] - middle) / radius for place, _ in near])
    logs = np.array([measures for _, measures in near])
    order = np.argsort(np.abs(offsets).max(axis=1), kind="stable")
    for degree in (2, 1):
        count = _PER_TERM * _terms(offsets[:1], degree).shape[1]
        if len(order) >= count:
            kept = order[: max(count, int((np.abs(offsets).max(axis=1) <= 1.0).sum()))]
            terms = _terms(offsets[kept], degree)
            return np.asarray(np.linalg.lstsq(terms, logs[kept])[0])
    return None


def _terms(offsets: Vector, degree: int) -> Vector:
    columns = [np.ones(len(offsets)), *offsets.T]
    if degree == 2:
        pairs = combinations_with_replacement(range(offsets.shape[1]), 2)
        columns += [offsets[:, i] * offsets[:, j] for i, j in pairs]
    return np.column_stack(columns)


def _solved(
    study: OptimiseStudy, model: Vector, trusted: tuple[Vector, float], margin: float, kept: int
) -> Vector:
    """Offset over the radius at which the model is best; one parameter may keep its value."""
    middle, radius = trusted
    degree = 1 if len(model) == 1 + len(middle) else 2
    sought = study.measures.index(study.objectives[0])
    sign = -1.0 if study.objectives[0] in MAXIMISED else 1.0

    def logs(offset: Vector) -> Vector:
        return np.asarray(_terms(offset[None], degree)[0] @ model)

    def room(offset: Vector) -> Vector:
        found = dict(zip(study.measures, logs(offset), strict=True))
        high = [np.log(limit.high) - found[name] for name, limit in study.limits.items() if limit.high]
        low = [found[name] - np.log(limit.low) for name, limit in study.limits.items() if limit.low]
        return np.array([*high, *low]) - margin

    ends = [(max(-1.0, -part / radius), min(1.0, (1.0 - part) / radius)) for part in middle.tolist()]
    if kept >= 0:
        ends[kept] = (0.0, 0.0)
    # Its types take neither numpy's numbers nor a list of constraints that is empty.
    solve: Any = minimize
    result = solve(
        lambda offset: float(sign * logs(offset)[sought]),
        np.zeros(len(middle)),
        method="SLSQP",
        bounds=ends,
        constraints=[{"type": "ineq", "fun": room}] if study.limits else [],
        options={"maxiter": _STEPS},
    )
    low, high = np.array(ends).T
    return np.asarray(np.clip(np.nan_to_num(result.x), low, high))
