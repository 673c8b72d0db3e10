"""The court: every law that applies, fitted to a part of the readings and scored by the rest."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.special import stdtrit

from wearsim.geometry.profile_points import Vector
from wearsim.study.judge.laws import LawParameter, WearLaw, laws_for, ln_shape
from wearsim.study.judge.sampler import draws
from wearsim.study.judge.series_scatter import (
    Forecasts,
    Scatter,
    drawn_again,
    forecasts,
    log_scores,
    quantiles,
)
from wearsim.study.judge.wear_series import WearSeries

PARTICLES = 1000
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
_ONE_SIGMA = 0.8413447
"""Part of a normal distribution below one standard deviation."""

_NO_DIFFERENCE = 0.05
"""Of scores: a density higher by a twentieth is nothing to choose by."""

_BATCHES = 8
"""Of draws, whose scores differ by chance."""


@dataclass(frozen=True)
class FittedConstant:
    """A constant of a law or of its scatter: 5, 50 and 95 % points of its posterior distribution."""

    name: str
    low: float
    middle: float
    high: float


@dataclass(frozen=True, eq=False)
class JudgedLaw:
    """A law with one kind of scatter, and how well it predicted the held-out readings."""

    law: str
    formula: str
    scatter: str  # factor or walk
    constants: tuple[FittedConstant, ...]  # of the law
    deviations: tuple[FittedConstant, ...]  # standard deviations of the scatter of ln(wear)
    score: float  # mean log density of ln(wear) of held-out readings
    unit_scores: Vector  # the same of each series that has any; with fewer than 3, of each reading
    behind: float  # how much higher the best one's score is
    # standard error of that: paired over the units, by Student's t, and of the draws; inf with one unit
    behind_error: float
    draw_error: float  # of the score, by batches of draws
    coverage_50: float  # part of the held-out readings in their band, nan where all are censored
    coverage_90: float
    # the same in 95 % of the readings that the law itself would give: lower and upper end of both
    by_chance: tuple[tuple[float, float], tuple[float, float]]
    median_error: float  # median of |ln(forecast/reading)|, held out; nan where all are censored
    bands: Vector  # wear at 5, 25, 50, 75 and 95 % of every reading, shape (5, n)

    @property
    def tied(self) -> bool:
        """Whether its score is that of the best one within the standard error."""
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
        """Names of the laws tied with the best one, this included."""
        return tuple(dict.fromkeys(one.law for one in self.laws if one.tied))

    @property
    def simplest(self) -> JudgedLaw:
        """The preferred law: of those tied with the best, the one with the fewest constants."""
        return min((one for one in self.laws if one.tied), key=lambda one: len(one.constants))

    @property
    def objections(self) -> tuple[str, ...]:
        """Why the preferred law is not good enough; empty where it is."""
        found, taken = [], self.simplest
        if NO_LAW in self.ties:
            found.append("no law predicts better than constant wear, independent of exposure and load")
        coverages = zip((50, 90), (taken.coverage_50, taken.coverage_90), taken.by_chance, strict=True)
        for share, held, (low, high) in coverages:
            if held < low or held > high:
                found.append(
                    f"the {share} % band of {taken.law} holds {100 * held:.0f} % of the readings "
                    f"({100 * low:.0f} to {100 * high:.0f} % expected by chance)"
                )
        return tuple(found)


def judge_series(
    data: WearSeries,
    particles: int = PARTICLES,
    wanted: Callable[[str, str], bool] = lambda law, scatter: True,
    progress: Callable[[float], None] = lambda part: None,
) -> Judgement:
    """Return how well every applicable law predicts the held-out readings, fitted to the others.

    Parameters
    ----------
    data : WearSeries
        Readings, some held out, some not.
    particles : int
        Draws of the parameters.
    wanted : callable
        Whether to try a law with a kind of scatter, both by name.
    progress : callable
        Takes the part that is done.

    Returns
    -------
    Judgement
        The laws, ordered by score.
    """
    scatters = SCATTERS if _has_walk(data) else SCATTERS[:1]
    pairs = [(law, scatter) for law in laws_for(data) for scatter in scatters if wanted(law.name, scatter)]
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
        error = math.inf
        if off.size > 1:
            error = float(stdtrit(off.size - 1, _ONE_SIGMA) * off.std(ddof=1) / math.sqrt(off.size))
            error = math.hypot(error, one.draw_error, best.draw_error) if one is not best else 0.0
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
        data = self.data
        rows = draws(lambda some: self.forecasts(some).log_likelihood, self.middle, self.sd, particles)
        found = self.forecasts(rows)
        batches = [_of_batch(found, part) for part in np.array_split(np.arange(particles), _BATCHES)]
        apart = [self.unit_scores(batch).mean() for batch in batches]
        units, constants = self.unit_scores(found), self.constants(rows)
        bands = np.array([quantiles(found, share) for share in (0.05, 0.25, 0.5, 0.75, 0.95)])
        read = data.held_out & (data.censored == 0)
        ln_wear, again, ends = np.log(data.wear), drawn_again(found, data), np.log(bands)
        coverages = [_inside(ln_wear[read], ends[[i, -1 - i]][:, read]) for i in (1, 0)]
        chances = [_by_chance(again[:, read], ends[[i, -1 - i]][:, read]) for i in (1, 0)]
        off = np.abs(ends[2] - ln_wear)[read]
        return JudgedLaw(
            law=self.law.name,
            formula=self.law.formula,
            scatter=self.scatter,
            constants=constants[: len(self.law.parameters)],
            deviations=constants[len(self.law.parameters) :],
            score=float(units.mean()),
            unit_scores=units,
            behind=0.0,
            behind_error=0.0,
            draw_error=float(np.std(apart, ddof=1) / math.sqrt(_BATCHES)),
            coverage_50=float(coverages[0]),
            coverage_90=float(coverages[1]),
            by_chance=(chances[0], chances[1]),
            median_error=float(np.median(off)) if off.size else math.nan,
            bands=bands,
        )

    def unit_scores(self, found: Forecasts) -> Vector:
        """Return the mean score of each unit that is held out."""
        scores = log_scores(found, self.data)
        return np.array([scores[unit].mean() for unit in _units(self.data)])

    def constants(self, rows: Vector) -> tuple[FittedConstant, ...]:
        """Return the constants of law and scatter in the units of the readings."""
        found = []
        for one, value in zip(self.parameters, self.values(rows).values(), strict=True):
            points = np.quantile(value, (0.05, 0.5, 0.95)) * (self.data.longest if one.of_exposure else 1.0)
            found.append(FittedConstant(one.name, *map(float, points)))
        return tuple(found)


def _of_batch(found: Forecasts, part: NDArray[np.intp]) -> Forecasts:
    return Forecasts(found.mean[part], found.variance[part], found.shared[part], found.log_likelihood[part])


def _moved(one: LawParameter, value: float) -> float:
    return math.log(value) if one.log else value


def _inside(ln_wear: Vector, band: Vector) -> Vector:
    """Return what part of readings of shape (..., n) lies in their bands, nan of none."""
    if not ln_wear.shape[-1]:
        return np.array(math.nan)
    return np.asarray(((band[0] <= ln_wear) & (ln_wear <= band[1])).mean(axis=-1))


def _by_chance(again: Vector, band: Vector) -> tuple[float, float]:
    """Return between what the part in the bands lies in 95 of 100 sets that the law would give."""
    low, high = np.nanquantile(_inside(again, band), (0.025, 0.975)) if again.size else (0.0, 1.0)
    return float(low), float(high)
