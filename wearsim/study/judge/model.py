"""The court: every law that applies, fitted to a part of the readings and scored by the rest."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from wearsim.geometry.profile_points import Vector
from wearsim.study.judge.laws import LawParameter, WearLaw, laws_for, ln_shape
from wearsim.study.judge.sampler import draws
from wearsim.study.judge.scatter import (
    Forecasts,
    Scatter,
    forecasts,
    log_scores,
    probabilities,
    quantiles,
)
from wearsim.study.judge.wear_series import WearSeries

PARTICLES = 600
SCATTERS = ("factor", "walk")
NO_LAW = "none"

_SD = {
    "sd_series": LawParameter("sd_series", 0.02, 2.0),
    "sd_walk": LawParameter("sd_walk", 0.01, 1.0),
    "sd_reading": LawParameter("sd_reading", 0.01, 1.0),
}
_LEVEL_SD = 1.5
_ENDS_SD = 1.96
_LEAST_SERIES = 3
_NO_DIFFERENCE = 0.05
"""Of scores, which is about that of other draws."""


@dataclass(frozen=True)
class FittedConstant:
    """A constant of a law or its scatter: 5, 50 and 95 % points of what the readings leave possible."""

    name: str
    low: float
    middle: float
    high: float


@dataclass(frozen=True, eq=False)
class JudgedLaw:
    """A law with one kind of scatter, and how well it foretold what was held out."""

    law: str
    formula: str
    scatter: str  # factor or walk
    constants: tuple[FittedConstant, ...]
    score: float  # mean log density of ln(wear) of held-out readings
    unit_scores: Vector  # the same of each series that has any; with fewer than 3, of each reading
    behind: float  # how much higher the best one's score is
    behind_error: float  # standard error of that, paired over the units; inf with one
    coverage_50: float  # part of the held-out readings in their band, nan where all are censored
    coverage_90: float
    median_error: float  # median of |ln(forecast/reading)|, held out; nan where all are censored
    bands: Vector  # wear at 5, 25, 50, 75 and 95 % of every reading, shape (5, n)

    @property
    def tied(self) -> bool:
        """Whether the readings do not tell it from the best one."""
        return self.behind <= max(self.behind_error, _NO_DIFFERENCE)


@dataclass(frozen=True, eq=False)
class Judgement:
    """All laws that apply, the best one first."""

    data: WearSeries
    laws: tuple[JudgedLaw, ...]

    @property
    def best(self) -> JudgedLaw:
        """The law with the highest score."""
        return self.laws[0]

    @property
    def ties(self) -> tuple[str, ...]:
        """Names of the laws that are not told apart from the best one, this included."""
        return tuple(dict.fromkeys(one.law for one in self.laws if one.tied))

    @property
    def objections(self) -> tuple[str, ...]:
        """Why the best law is not good enough; empty where it is."""
        found = []
        if NO_LAW in self.ties:
            found.append("it foretells no better than wear that neither grows nor depends on the load")
        count = len(self.best.unit_scores)
        for share, held in ((0.5, self.best.coverage_50), (0.9, self.best.coverage_90)):
            if abs(held - share) > 2.0 * math.sqrt(share * (1.0 - share) / count):
                found.append(f"its band of {100 * share:g} % holds {100 * held:.0f} %")
        return tuple(found)


def judge_series(
    data: WearSeries,
    particles: int = PARTICLES,
    wanted: Callable[[WearLaw], bool] = lambda law: True,
    progress: Callable[[float], None] = lambda part: None,
) -> Judgement:
    """Return how every law that applies foretells the readings held out, fitted to the others.

    Parameters
    ----------
    data : WearSeries
        Readings, some held out, some not.
    particles : int
        Draws of the parameters.
    wanted : callable
        Whether to try a law.
    progress : callable
        Takes the part that is done.

    Returns
    -------
    Judgement
        The laws, ordered by score.
    """
    laws = [law for law in laws_for(data) if wanted(law)]
    scatters = SCATTERS if _has_walk(data) else SCATTERS[:1]
    pairs = [(law, scatter) for law in laws for scatter in scatters]
    found = []
    for number, (law, scatter) in enumerate(pairs, start=1):
        found.append(_Candidate(law, scatter, data).judged(particles))
        progress(number / len(pairs))
    return Judgement(data, tuple(_ranked(found)))


def _has_walk(data: WearSeries) -> bool:
    fitted = np.bincount(data.series[data.fitted], minlength=len(data.names))
    return bool(fitted.max() > 1)


def _ranked(found: list[JudgedLaw]) -> list[JudgedLaw]:
    ordered = sorted(found, key=lambda one: -one.score)
    best = ordered[0]
    ranked = []
    for one in ordered:
        off = best.unit_scores - one.unit_scores
        error = float(off.std(ddof=1) / math.sqrt(off.size)) if off.size > 1 else math.inf
        ranked.append(replace(one, behind=float(off.mean()), behind_error=error))
    return ranked


def _units(data: WearSeries) -> list[NDArray[np.intp]]:
    """Return the held-out readings of each series, or each reading where fewer than 3 series have any."""
    held = np.flatnonzero(data.held_out)
    by_series = [held[data.series[held] == one] for one in np.unique(data.series[held])]
    return by_series if len(by_series) >= _LEAST_SERIES else list(held[:, None])


class _Candidate:
    """A law with a kind of scatter on some readings, its parameters a row of numbers."""

    def __init__(self, law: WearLaw, scatter: str, data: WearSeries) -> None:
        self.law, self.scatter, self.data = law, scatter, data
        walk = ["sd_walk"] if scatter == "walk" else []
        self.parameters = [*law.parameters, *(_SD[name] for name in ("sd_series", *walk, "sd_reading"))]
        places = [(_moved(one, one.low), _moved(one, one.high)) for one in self.parameters]
        low, high = np.array(places).T
        middle = float(np.log(data.wear[data.fitted]).mean())
        self.middle = np.array([middle, *(0.5 * (low + high))])
        self.sd = np.array([_LEVEL_SD, *(0.5 * (high - low) / _ENDS_SD)])

    def forecasts(self, rows: Vector) -> Forecasts:
        """Return what parameters of shape (k, p) say."""
        values = self.values(rows)
        shape = ln_shape(self.law, values, self.data)
        level = rows[:, :1] - shape[:, self.data.fitted].mean(axis=1, keepdims=True)
        scatter = Scatter(
            values["sd_series"], values.get("sd_walk", np.zeros_like(rows[:, :1])), values["sd_reading"]
        )
        return forecasts(shape + level, scatter, self.data)

    def values(self, rows: Vector) -> dict[str, Vector]:
        """Return parameters by name, each of shape (k, 1)."""
        return {
            one.name: np.exp(np.clip(column, -40.0, 40.0)) if one.log else column
            for one, column in zip(self.parameters, rows.T[1:, :, None], strict=True)
        }

    def judged(self, particles: int) -> JudgedLaw:
        """Return the law fitted and scored."""
        data, held = self.data, self.data.held_out
        rows = draws(lambda some: self.forecasts(some).log_likelihood, self.middle, self.sd, particles)
        found = self.forecasts(rows)
        scores = log_scores(found, data)
        units = np.array([scores[unit].mean() for unit in _units(data)])
        read = held & (data.censored == 0)
        place = probabilities(found, np.log(data.wear))[read]
        bands = np.array([quantiles(found, share) for share in (0.05, 0.25, 0.5, 0.75, 0.95)])
        off = np.abs(np.log(bands[2] / data.wear))[read]
        return JudgedLaw(
            law=self.law.name,
            formula=self.law.formula,
            scatter=self.scatter,
            constants=tuple(self.constants(rows)),
            score=float(units.mean()),
            unit_scores=units,
            behind=0.0,
            behind_error=0.0,
            coverage_50=_part(np.abs(place - 0.5) <= 0.25),
            coverage_90=_part(np.abs(place - 0.5) <= 0.45),
            median_error=float(np.median(off)) if off.size else math.nan,
            bands=bands,
        )

    def constants(self, rows: Vector) -> list[FittedConstant]:
        """Return the constants in the units of the readings."""
        values = self.values(rows)
        return [
            FittedConstant(one.name, *map(float, scale * np.quantile(values[one.name], (0.05, 0.5, 0.95))))
            for one in self.parameters
            for scale in [self.data.longest if one.of_exposure else 1.0]
        ]


def _moved(one: LawParameter, value: float) -> float:
    return math.log(value) if one.log else value


def _part(inside: Vector) -> float:
    return float(inside.mean()) if inside.size else math.nan
