"""What of the input matters to a life: Sobol' indices, Morris' screening, one key at a time.

All indices are of ln L: lives are products of their inputs' powers far more nearly than sums.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from wearsim.case.model import Case
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.load_case import load_case
from wearsim.drive.simulate import simulate
from wearsim.errors import StudyError
from wearsim.extras import library
from wearsim.geometry.profile_points import Vector
from wearsim.runner.design import Design, replaced
from wearsim.runner.samples import EDGE
from wearsim.runner.scatter import ScatteredCase, ScatteredKey, load_scattered
from wearsim.runner.solve_for import hours_to_wear, solve_for

LOW, HIGH = 0.1, 0.9
"""Probabilities between which one key at a time is moved, and Morris' method moves them all."""

_LEVELS = 4
_SAME = 1e-9
"""Difference of ln L below which lives are the same."""

_FELT = 0.01
"""Difference of ln L from the 10 % to the 90 % point of a key below which no value of it is looked for."""


@dataclass(frozen=True)
class SensitivityStudy:
    """The cases of a sensitivity study."""

    scattered: ScatteredCase  # the case and what of it scatters
    seed: int  # of the samples
    morris: Vector  # shares of Morris' trajectories, shape (trajectories (keys + 1), keys)
    sobol: int  # rows of Sobol's method, which come last
    design: Design  # the middle, each key low and high, Morris' rows, Sobol's rows


@dataclass(frozen=True)
class KeyEffect:
    """What one key does to the life."""

    scatter: ScatteredKey  # the key
    # low_hours, high_hours: life with the key at its 10 % and 90 % point, all others in their
    # middle [h]
    low_hours: float
    high_hours: float
    # first, first_error: sobol's index of first order and its 95 % half-width: part of the variance
    # of ln L that goes when the key is known
    first: float
    first_error: float
    # total, total_error: sobol's total index: part of the variance that stays when all others are
    # known
    total: float
    total_error: float
    # morris, morris_error, interaction: Morris' mean of the size of the effects on ln L, its 95 %
    # half-width, and their standard deviation
    morris: float
    morris_error: float
    interaction: float

    @property
    def is_felt(self) -> bool:
        """Whether the key changes the life enough to look for the value that doubles it."""
        return max(self.morris, abs(math.log(self.high_hours / self.low_hours))) > _FELT


def load_sensitivity(
    path: Path, overrides: Sequence[str], samples: int, trajectories: int, seed: int
) -> SensitivityStudy:
    """Return the cases of a sensitivity study."""
    scattered = load_scattered(path, overrides)
    problem = _problem(scattered)
    count = len(scattered.scatters)
    middle = np.full((1, count), 0.5)
    one = np.repeat(middle, 2 * count, axis=0)
    for index in range(count):
        one[2 * index : 2 * index + 2, index] = LOW, HIGH
    sampled = library("SALib.sample.morris", "study", "sensitivity")
    levels = sampled.sample(problem, trajectories, num_levels=_LEVELS, seed=seed)
    saltelli = library("SALib.sample.sobol", "study", "sensitivity")
    cube = saltelli.sample(problem, samples, calc_second_order=False, seed=seed)
    shares = np.concatenate([middle, one, LOW + (HIGH - LOW) * levels, cube.clip(EDGE, 1.0 - EDGE)])
    return SensitivityStudy(scattered, seed, levels, len(cube), scattered.design(shares))


def effects(study: SensitivityStudy, table: pd.DataFrame) -> list[KeyEffect]:
    """Return what every key does to the life."""
    _check(table)
    hours = table["life_hours"].to_numpy(float)
    count, problem = len(study.scattered.scatters), _problem(study.scattered)
    one = hours[1 : 1 + 2 * count].reshape(count, 2)
    logs = np.log(hours)
    if np.ptp(logs) < _SAME:
        raise StudyError("none of the scattering inputs changes the life: there is nothing to rank")
    screened = library("SALib.analyze.morris", "study", "sensitivity").analyze(
        problem, study.morris, logs[1 + 2 * count : -study.sobol], num_levels=_LEVELS, seed=study.seed
    )
    # The estimators lose digits where the mean is large against the scatter.
    varied = logs[-study.sobol :] - logs[-study.sobol :].mean()
    indices = library("SALib.analyze.sobol", "study", "sensitivity").analyze(
        problem, varied, calc_second_order=False, seed=study.seed
    )
    found = [
        KeyEffect(
            scatter,
            *one[index].tolist(),
            *(float(indices[name][index]) for name in ("S1", "S1_conf", "ST", "ST_conf")),
            *(float(screened[name][index]) for name in ("mu_star", "mu_star_conf", "sigma")),
        )
        for index, scatter in enumerate(study.scattered.scatters)
    ]
    return sorted(found, key=lambda effect: -effect.total)


def doubling(scattered: ScatteredCase, found: Sequence[KeyEffect]) -> dict[str, float]:
    """Return the value of every key at which the case lives twice as long, the others as they are.

    It is nan of a key that is not felt, and of one for which no feasible value doubles the life.
    """
    if scattered.case.fatigue is not None:
        return dict.fromkeys(scattered.keys, math.nan)
    hours = simulate(_case_with(scattered, "", math.nan)).life.hours
    doubled = dict.fromkeys(scattered.keys, math.nan)
    for effect in found:
        key, value = effect.scatter.key, effect.scatter.value
        if value > 0.0 and effect.is_felt:
            case_at = partial(_case_with, scattered, key)
            solved = solve_for(case_at, value, 2.0 * hours, life_of=hours_to_wear)
            doubled[key] = solved.trial.value if solved.met else math.nan
    return doubled


def _case_with(scattered: ScatteredCase, key: str, value: float) -> Case | DriveCase:
    tables = scattered.document.data
    for scatter in scattered.scatters:
        given = value if scatter.key == key else scatter.value
        tables = replaced(tables, scatter.key.split("."), given)
    return load_case(tables)


def _problem(scattered: ScatteredCase) -> dict[str, Any]:
    count = len(scattered.keys)
    return {"names": list(scattered.keys), "num_vars": count, "bounds": [[0.0, 1.0]] * count}


def _check(table: pd.DataFrame) -> None:
    failed = table[table["error"] != ""]
    if not failed.empty:
        raise StudyError(
            f"{len(failed)} of {len(table)} cases failed, and indices need them all: narrow the "
            f"distributions; the first: {failed.iloc[0].error}"
        )
    bounds = int(table["life_hours"].isna().sum())
    if bounds:
        raise StudyError(
            f"{bounds} of {len(table)} cases met no limit within run.horizon_hours, and indices need "
            "lives: raise it"
        )
    none = int((table["life_hours"] == 0.0).sum())
    if none:
        raise StudyError(
            f"{none} of {len(table)} cases have a life of 0 h by contact fatigue, and indices are of the "
            "logarithm of the life: narrow the distributions or take a better material"
        )
