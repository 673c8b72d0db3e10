"""The search for a front of several objectives: NSGA-II, then local models and random steps."""

import warnings
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from wearsim.case.keys.study_tables import MeasureLimit
from wearsim.extras import library
from wearsim.geometry.profile_points import Vector
from wearsim.study.optimise.local_model import proposals
from wearsim.study.optimise.model import OptimiseStudy
from wearsim.study.optimise.trials import FAILED, MAXIMISED, Candidate, Trials, front

_RESERVE = 0.5
"""Part of all trials that is kept to refine a front."""

_TRUSTED, _NEAR, _MARGIN = 0.25, 0.9, 3e-4
"""Part of the ranges in which a model is trusted, part of that within which its optimum is its own, and
distance from the other objectives that it keeps."""

_FIRST_STEP, _LAST_STEP, _JUMP = 0.1, 2e-5, 0.2
"""Steps around designs of a front, and the part of values of lists that are drawn anew."""

_MAX_IDLE = 5
"""Generations in a row without a new design after which there are none."""


def evolve_front(study: OptimiseStudy, trials: Trials, points: Vector) -> None:
    """Try designs by NSGA-II with constraints, until half of the trials are left."""
    optuna = library("optuna", "optimise", "several objectives")
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    directions = ["maximize" if name in MAXIMISED else "minimize" for name in study.objectives]
    evolution = optuna.create_study(directions=directions, sampler=_sampler(optuna, len(points), study.seed))
    kinds = _distributions(optuna, study)
    for point in points:
        evolution.enqueue_trial(dict(zip(kinds, _params(study, point), strict=True)))
    idle = 0
    while trials.left > _RESERVE * study.evaluations and idle < _MAX_IDLE:
        before = trials.left
        requested = [evolution.ask(kinds) for _ in points]
        rows = [_row(study, list(trial.params.values())) for trial in requested]
        for trial, one in zip(requested, trials.at(rows), strict=True):
            _constrain(trial, FAILED if one is None or one.error else one.violation)
            evolution.tell(trial, _values(study, one))
        idle = idle + 1 if trials.left == before else 0


def _sampler(optuna: Any, size: int, seed: int) -> Any:
    """NSGA-II with constraints, of optuna 4 by a function, which optuna 5 has given up."""
    has_own = hasattr(optuna.trial.Trial, "set_constraint")
    constraints = {} if has_own else {"constraints_func": _broken}
    with warnings.catch_warnings():
        # Constraints and this crossover are marked as experimental.
        warnings.simplefilter("ignore", optuna.exceptions.ExperimentalWarning)
        crossover = optuna.samplers.nsgaii.VSBXCrossover()
        return optuna.samplers.NSGAIISampler(
            population_size=size, crossover=crossover, seed=seed, **constraints
        )


def _constrain(trial: Any, broken: float) -> None:
    if hasattr(trial, "set_constraint"):
        trial.set_constraint("broken", broken)
    else:
        trial.set_user_attr("broken", broken)


def _broken(trial: Any) -> Sequence[float]:
    return (trial.user_attrs["broken"],)


def refine_front(study: OptimiseStudy, trials: Trials, size: int) -> None:
    """Move each design of the front by models, then all in smaller and smaller random steps."""
    rng = np.random.default_rng((study.seed, 2))
    step, idle, done = _FIRST_STEP, 0, set[int]()
    while trials.left > 0 and idle < _MAX_IDLE:
        before = trials.left
        tried = list(trials.found.values())
        best = front(tried, study.objectives)
        chosen = _spread([one for one in best if one.number not in done], size)
        places = []
        for one in chosen:
            place, own = _by_model(study, tried, one), study.space.point(one.values)
            done.add(one.number)
            if place is not None and own is not None:
                places.append((place, bool(np.abs(place - own).max() < _NEAR * _TRUSTED)))
        found = trials.at([study.space.values(place) for place, _ in places])
        # From the edge of what a model is trusted in it goes on.
        done |= {one.number for one, (_, near) in zip(found, places, strict=True) if one is not None and near}
        if not places:
            moved = [_moved(study, one, step, rng) for one in _spread(best, size)]
            trials.at([study.space.values(place) for place in moved])
            step = max(0.9 * step, _LAST_STEP)
        idle = idle + 1 if trials.left == before else 0


def _spread(designs: Sequence[Candidate], count: int) -> list[Candidate]:
    """So many designs from first to last, all where there are not more."""
    if len(designs) <= count:
        return list(designs)
    return [designs[at] for at in np.linspace(0, len(designs) - 1, count).round().astype(int)]


def _by_model(study: OptimiseStudy, tried: Sequence[Candidate], one: Candidate) -> Vector | None:
    """Where a model has the best of one objective, in turn, that is no worse in the others."""
    sought = study.objectives[one.number % len(study.objectives)]
    limits = dict(study.limits)
    for name in study.objectives:
        if name != sought:
            end = "low" if name in MAXIMISED else "high"
            limit = limits.get(name, MeasureLimit.model_construct())
            limits[name] = limit.model_copy(update={end: one.measures[name]})
    alone = replace(study, objectives=(sought,), limits=limits)
    return next(iter(proposals(alone, tried, one, (_TRUSTED,), (_MARGIN,))), None)


def _moved(study: OptimiseStudy, one: Candidate, step: float, rng: np.random.Generator) -> Vector:
    """A point near a design, some values of lists drawn anew."""
    place, whole = study.space.point(one.values), study.space.whole
    assert place is not None
    moved = np.clip(place + step * rng.standard_normal(place.size), 0.0, 1.0)
    jump = whole & (rng.random(place.size) < _JUMP)
    moved[whole] = place[whole]
    moved[jump] = rng.random(int(jump.sum()))
    return np.asarray(moved)


def _distributions(optuna: Any, study: OptimiseStudy) -> dict[str, Any]:
    kinds = optuna.distributions
    return {
        parameter.key: kinds.IntDistribution(0, len(parameter.choices) - 1)
        if parameter.choices
        else kinds.FloatDistribution(0.0, 1.0)
        for parameter in study.space.parameters
    }


def _params(study: OptimiseStudy, point: Vector) -> list[float | int]:
    return [
        round(float(part) * parameter.high) if parameter.choices else float(part)
        for parameter, part in zip(study.space.parameters, point, strict=True)
    ]


def _row(study: OptimiseStudy, params: list[float | int]) -> tuple[Any, ...]:
    pairs = zip(study.space.parameters, params, strict=True)
    return study.space.values([at / parameter.high if parameter.choices else at for parameter, at in pairs])


def _values(study: OptimiseStudy, candidate: Candidate | None) -> list[float]:
    """Objectives; of a design that failed numbers that never count, as none is worse."""
    if candidate is None or candidate.error:
        return [1e-9 if name in MAXIMISED else 1e9 for name in study.objectives]
    return [candidate.measures[name] for name in study.objectives]
