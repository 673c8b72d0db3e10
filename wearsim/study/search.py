"""The search for the best designs: differential evolution and a pattern, or NSGA-II."""

import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.optimize import differential_evolution

from wearsim.extras import library
from wearsim.geometry.profile import Vector
from wearsim.study.local_model import Places, proposals
from wearsim.study.optimise import OptimiseStudy
from wearsim.study.trials import MAXIMISED, Candidate, Trials, front

_BROKEN, _FAILED = 1e3, 1e6
"""Costs above all of feasible designs: of those that break a limit, and of those that fail."""

_PER_PARAMETER, _LEAST, _MOST = 10, 12, 60
"""Designs of a generation."""

_SAME = 1e-5
"""Scatter of the logarithm of the objective in a generation at which it has converged."""

_FIRST_STEP, _LAST_STEP = 0.02, 2e-5
"""Steps of the pattern as parts of the ranges."""

_GAIN = 1e-4
"""Gain in the logarithm of the objective from first to last step after which all begins again."""

_TRUSTED, _MARGINS = 0.25, (0.0, 3e-4)
"""Part of the ranges in which a model is trusted, and distances from the limits that it keeps."""

_FRONT_RESERVE = 0.5
"""Part of all trials that is kept to refine a front."""

_FIRST_FRONT_STEP, _GAINED, _JUMP = 0.1, 0.3, 0.2
"""First step around designs of a front; the part of new ones that must join it to keep the step; the
part of values of lists that are drawn anew."""

_MOST_IDLE = 5
"""Generations in a row without a new design after which there are none."""


def search(study: OptimiseStudy, trials: Trials) -> None:
    """Try designs until the best are found or no trial is left.

    One objective: differential evolution in generations, then steps to the optimum of local
    models and along random directions. Several: NSGA-II, then random steps around the front.
    Designs that break limits come after all that do not, by how far; those that fail come last.

    Parameters
    ----------
    study : OptimiseStudy
        What is asked.
    trials : Trials
        Takes what is tried.

    Raises
    ------
    CaseError
        Several objectives, and optuna is not installed.
    """
    size = generation_size(study)
    points = _start(study, trials, size)
    if len(study.objectives) > 1:
        _evolve_front(study, trials, points)
        _refine_front(study, trials, size)
        return
    if trials.left >= _reserve(study):
        _evolve(study, trials, points)
    _poll(study, trials)


def generation_size(study: OptimiseStudy) -> int:
    """Return how many designs are tried together.

    Parameters
    ----------
    study : OptimiseStudy
        What is asked.

    Returns
    -------
    int
        Ten a parameter, from 12 to 60, not more than a fourth of all, 5 at least.
    """
    size = min(max(_PER_PARAMETER * len(study.space.parameters), _LEAST), _MOST)
    return max(min(size, study.evaluations // 4), 5)


def _start(study: OptimiseStudy, trials: Trials, size: int) -> Vector:
    """Points of a first generation; more of them are looked at until a design runs."""
    count = size
    while True:
        points = study.space.start(count, study.seed, study.values)
        tried = trials.at([study.space.row(point) for point in points])
        if any(one is not None and not one.error for one in tried) or trials.left <= 0:
            break
        if count > 16 * study.evaluations:
            break
        count *= 2
    costs = np.array([_cost(study, one) for one in tried])
    return np.asarray(points[np.sort(np.argsort(costs, kind="stable")[:size])])


def _cost(study: OptimiseStudy, candidate: Candidate | None) -> float:
    if candidate is None or candidate.error:
        return _FAILED
    if not candidate.feasible:
        return _BROKEN + candidate.violation
    return candidate.cost(study.objectives[0])


def _evolve(study: OptimiseStudy, trials: Trials, points: Vector) -> None:
    whole = study.space.whole
    ends = np.array(
        [parameter.high if parameter.choices else 1.0 for parameter in study.space.parameters]
    )

    def costs(places: Vector) -> Vector:
        rows = [study.space.row(place) for place in (places.T / ends)]
        return np.array([_cost(study, one) for one in trials.at(rows)])

    def enough(intermediate_result: Any) -> bool:
        return trials.left < _reserve(study)

    # Its types know one design at a time only.
    evolve: Any = differential_evolution
    evolve(
        costs, [(0.0, end) for end in ends], init=points * ends, integrality=whole,
        rng=np.random.default_rng(study.seed), vectorized=True, updating="deferred", polish=False,
        maxiter=study.evaluations, tol=0.0, atol=_SAME, callback=enough,
    )  # fmt: skip


def _reserve(study: OptimiseStudy) -> int:
    """Trials kept for the pattern and the generation that may be under way."""
    return generation_size(study) + study.evaluations // 3


def _poll(study: OptimiseStudy, trials: Trials) -> None:
    """Look where models have the best design, and around the best so far in smaller and smaller steps."""
    rng = np.random.default_rng((study.seed, 1))
    free = np.flatnonzero(~study.space.whole)
    step = _FIRST_STEP
    best = min(trials.found.values(), key=lambda one: (_cost(study, one), one.number))
    before = _cost(study, best)
    while trials.left > 0 and not best.error:
        if step <= _LAST_STEP:
            if before - _cost(study, best) < _GAIN:
                return
            step, before = _FIRST_STEP, _cost(study, best)
        middle = study.space.place(best.values)
        assert middle is not None
        places = proposals(
            study, list(trials.found.values()), best, (_TRUSTED, 4.0 * step), _MARGINS
        )
        places += _around(middle, free, step, rng) + _neighbours(study, middle)
        tried = trials.at([study.space.row(place) for place in places])
        ahead = min(tried, key=lambda one: _cost(study, one))
        if ahead is not None and _cost(study, ahead) < _cost(study, best):
            best, step = ahead, 1.5 * step
        else:
            step *= 0.5


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


def _evolve_front(study: OptimiseStudy, trials: Trials, points: Vector) -> None:
    optuna = library("optuna", "optimise", "several objectives")
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    directions = ["maximize" if name in MAXIMISED else "minimize" for name in study.objectives]
    evolution = optuna.create_study(
        directions=directions, sampler=_sampler(optuna, len(points), study.seed)
    )
    kinds = _distributions(optuna, study)
    for point in points:
        evolution.enqueue_trial(dict(zip(kinds, _params(study, point), strict=True)))
    idle = 0
    while trials.left > _FRONT_RESERVE * study.evaluations and idle < _MOST_IDLE:
        before = trials.left
        asked = [evolution.ask(kinds) for _ in points]
        rows = [_row(study, list(trial.params.values())) for trial in asked]
        for trial, one in zip(asked, trials.at(rows), strict=True):
            _constrain(trial, _FAILED if one is None or one.error else one.violation)
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


def _refine_front(study: OptimiseStudy, trials: Trials, size: int) -> None:
    """Look around designs of the front in random directions, in steps that get smaller."""
    rng = np.random.default_rng((study.seed, 2))
    whole, step, idle = study.space.whole, _FIRST_FRONT_STEP, 0
    while trials.left > 0 and idle < _MOST_IDLE:
        before = trials.left
        best = front(list(trials.found.values()), study.objectives)
        if not best:
            return
        chosen = [best[at] for at in np.linspace(0, len(best) - 1, size).round().astype(int)]
        rows = []
        for one in chosen:
            place = study.space.place(one.values)
            assert place is not None
            moved = np.clip(place + step * rng.standard_normal(place.size), 0.0, 1.0)
            jump = whole & (rng.random(place.size) < _JUMP)
            moved[whole] = place[whole]
            moved[jump] = rng.random(int(jump.sum()))
            rows.append(study.space.row(moved))
        known = {one.number for one in best}
        trials.at(rows)
        better = front(list(trials.found.values()), study.objectives)
        gained = sum(one.number not in known for one in better)
        step = max(step * (1.0 if gained > _GAINED * size else 0.7), _LAST_STEP)
        idle = idle + 1 if trials.left == before else 0


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
    return study.space.row(
        [at / parameter.high if parameter.choices else at for parameter, at in pairs]
    )


def _values(study: OptimiseStudy, candidate: Candidate | None) -> list[float]:
    """Objectives; of a design that failed numbers that never count, as none is worse."""
    if candidate is None or candidate.error:
        return [1e-9 if name in MAXIMISED else 1e9 for name in study.objectives]
    return [candidate.measures[name] for name in study.objectives]
