"""The search for the best design: differential evolution, local models and a pattern."""

from typing import Any

import numpy as np
from scipy.optimize import differential_evolution

from wearsim.extras import check_installed
from wearsim.geometry.profile_points import Vector
from wearsim.study.optimise.local_model import Places, proposals
from wearsim.study.optimise.model import OptimiseStudy
from wearsim.study.optimise.search_front import evolve_front, refine_front
from wearsim.study.optimise.trials import FAILED, Candidate, OptimiseOutcome, Run, Trials, front

_BROKEN = 1e3
"""Cost above those of all feasible designs."""

_PER_PARAMETER, _LEAST, _MAX = 10, 12, 60
"""Designs of a generation."""

_SAME = 1e-5
"""Scatter of the logarithm of the objective in a generation at which it has converged."""

_FIRST_STEP, _LAST_STEP = 0.02, 2e-5
"""Steps of the pattern as parts of the ranges."""

_GAIN = 1e-4
"""Gain in the logarithm of the objective from first to last step after which all begins again."""

_TRUSTED, _MARGINS = 0.25, (0.0, 3e-4)
"""Part of the ranges in which a model is trusted, and distances from the limits that it keeps."""


def search(study: OptimiseStudy, trials: Trials) -> bool:
    """Try designs until the best are found or no trial is left.

    One objective: differential evolution in generations, then steps to the optimum of local
    models and along random directions. Several: NSGA-II, then the same around designs of the front.
    Designs that break limits come after all that do not, by how far; those that fail come last.
    """
    size = generation_size(study)
    points = _start(study, trials, size)
    if len(study.objectives) > 1:
        evolve_front(study, trials, points)
        refine_front(study, trials, size)
        return True
    if trials.left >= _reserve(study):
        _evolve(study, trials, points)
    return _poll(study, trials)


def best_designs(study: OptimiseStudy, run: Run) -> OptimiseOutcome:
    """Return what comes of a search whose cases are run by a function."""
    trials = Trials(study, run)
    settled = search(study, trials)
    tried = tuple(trials.found.values())
    return OptimiseOutcome(study, trials.unchanged, tried, tuple(front(tried, study.objectives)), settled)


def check_library(study: OptimiseStudy) -> None:
    """Raise where several objectives need a library that is not installed."""
    if len(study.objectives) > 1:
        check_installed(("optuna",), "optimise", "optimise with several objectives")


def generation_size(study: OptimiseStudy) -> int:
    """Return how many designs are tried together."""
    size = min(max(_PER_PARAMETER * len(study.space.parameters), _LEAST), _MAX)
    return max(min(size, study.evaluations // 4), 5)


def _start(study: OptimiseStudy, trials: Trials, size: int) -> Vector:
    """Points of a first generation; more of them are looked at until a design runs."""
    count = size
    while True:
        points = study.space.start(count, study.seed, study.values)
        tried = trials.at([study.space.values(point) for point in points])
        if any(one is not None and not one.error for one in tried) or trials.left <= 0:
            break
        if count > 16 * study.evaluations:
            break
        count *= 2
    costs = np.array([_cost(study, one) for one in tried])
    return np.asarray(points[np.sort(np.argsort(costs, kind="stable")[:size])])


def _cost(study: OptimiseStudy, candidate: Candidate | None) -> float:
    if candidate is None or candidate.error:
        return FAILED
    if not candidate.feasible:
        return _BROKEN + candidate.violation
    return candidate.cost(study.objectives[0])


def _evolve(study: OptimiseStudy, trials: Trials, points: Vector) -> None:
    whole = study.space.whole
    ends = np.array([parameter.high if parameter.choices else 1.0 for parameter in study.space.parameters])

    def costs(places: Vector) -> Vector:
        rows = [study.space.values(place) for place in (places.T / ends)]
        return np.array([_cost(study, one) for one in trials.at(rows)])

    def enough(intermediate_result: Any) -> bool:
        return trials.left < _reserve(study)

    # Its types know one design at a time only.
    evolve: Any = differential_evolution
    evolve(
        costs,
        [(0.0, end) for end in ends],
        init=points * ends,
        integrality=whole,
        rng=np.random.default_rng(study.seed),
        vectorized=True,
        updating="deferred",
        polish=False,
        maxiter=study.evaluations,
        tol=0.0,
        atol=_SAME,
        callback=enough,
    )


def _reserve(study: OptimiseStudy) -> int:
    """Trials kept for the pattern and the generation that may be under way."""
    return generation_size(study) + study.evaluations // 3


def _poll(study: OptimiseStudy, trials: Trials) -> bool:
    """Look where models have the best design, and around the best so far in smaller and smaller steps.

    Whether nothing was gained in the end.
    """
    rng = np.random.default_rng((study.seed, 1))
    free = np.flatnonzero(~study.space.whole)
    step = _FIRST_STEP
    best = min(trials.found.values(), key=lambda one: (_cost(study, one), one.number))
    before = _cost(study, best)
    while trials.left > 0 and not best.error:
        if step <= _LAST_STEP:
            if before - _cost(study, best) < _GAIN:
                return True
            step, before = _FIRST_STEP, _cost(study, best)
        middle = study.space.point(best.values)
        assert middle is not None
        places = proposals(study, list(trials.found.values()), best, (_TRUSTED, 4.0 * step), _MARGINS)
        places += _around(middle, free, step, rng) + _neighbours(study, middle)
        tried = trials.at([study.space.values(place) for place in places])
        ahead = min(tried, key=lambda one: _cost(study, one))
        if ahead is not None and _cost(study, ahead) < _cost(study, best):
            best, step = ahead, 1.5 * step
        else:
            step *= 0.5
    return False


def _around(middle: Vector, free: Places, step: float, rng: np.random.Generator) -> list[Vector]:
    if not free.size:
        return []
    basis, _ = np.linalg.qr(rng.standard_normal((free.size, free.size)))
    places = []
    for direction in (*basis, *-basis):
        place = middle.copy()
        place[free] = np.clip(place[free] + step * direction, 0.0, 1.0)
        places.append(place)
    return places


def _neighbours(study: OptimiseStudy, middle: Vector) -> list[Vector]:
    """Points with one value of a list replaced by the next."""
    places = []
    for at, parameter in enumerate(study.space.parameters):
        for way in (-1.0, 1.0) if parameter.choices else ():
            place = middle.copy()
            place[at] = np.clip(place[at] + way / parameter.high, 0.0, 1.0)
            places.append(place)
    return places
