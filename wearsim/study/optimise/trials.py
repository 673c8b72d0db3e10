"""Designs that an optimisation has tried: what came of them, and which are best."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import pandas as pd

from wearsim.case.keys.study_tables import MeasureLimit
from wearsim.case.model import Case
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.part_life import new_peak_pressure as single_peak_pressure
from wearsim.errors import StudyError, WearsimError
from wearsim.report.text_lines import counts_by_kind
from wearsim.runner.design import Design
from wearsim.runner.shard import loaded_cases
from wearsim.study.optimise.model import OptimiseStudy, blank_mass

MAXIMISED = ("life_hours",)
"""Measures of which more is better; of the others less is."""


def new_peak_pressure(case: Case | DriveCase) -> float:
    """Return the highest pressure on the new flanks of a case, of a drive that of its worst sprocket."""
    return max(map(single_peak_pressure, case.single_cases.values()))


_OF_THE_CASE: dict[str, Callable[[Case | DriveCase], float]] = {
    "mass_kg": blank_mass,
    "peak_pressure_MPa": new_peak_pressure,
}
"""Measures that take no run."""

FAILED = 1e6
"""Cost of a design that fails, above all others."""

Run = Callable[[Design], pd.DataFrame]


@dataclass(frozen=True)
class Candidate:
    """A design that was tried."""

    number: int  # in the order of trial, from 1; 0 is the case as given
    values: tuple[Any, ...]  # of the parameters
    measures: Mapping[str, float]  # what came of it; empty where it failed
    reached: bool  # whether the life was reached before the horizon
    stop: str  # limit that ended the life
    # sum over the limits that it breaks of how far, as natural logarithms; infinite where it failed
    violation: float
    error: str  # why it failed
    warnings: str  # what is doubtful about it, a line for each

    @property
    def feasible(self) -> bool:
        """Whether it runs and keeps all limits."""
        return self.violation == 0.0

    def cost(self, objective: str) -> float:
        """Return what a search makes as small as it can."""
        return (-1.0 if objective in MAXIMISED else 1.0) * math.log(self.measures[objective])


@dataclass(frozen=True)
class OptimiseOutcome:
    """What came of a search."""

    study: OptimiseStudy  # what was asked
    unchanged: Candidate  # the case as it is
    candidates: tuple[Candidate, ...]  # what was tried, in order
    # the best design, or those than which none is better in all objectives; none where no design is
    # feasible
    front: tuple[Candidate, ...]
    settled: bool  # whether the search ended as nothing was gained any more

    @property
    def cases(self) -> list[Case | DriveCase]:
        """The best designs as cases."""
        cases = loaded_cases(self.study.design([one.values for one in self.front]))
        return [case for case in cases if not isinstance(case, WearsimError)]


class Trials:
    """Designs that were tried, each once."""

    def __init__(self, study: OptimiseStudy, run: Run) -> None:
        self.study, self.run = study, run
        self.found: dict[tuple[Any, ...], Candidate] = {}
        (self.unchanged,) = self._tried(study.unchanged, [study.values], 0)

    @property
    def left(self) -> int:
        """Designs that may still be tried."""
        return self.study.evaluations - len(self.found)

    def at(self, rows: Sequence[tuple[Any, ...]]) -> list[Candidate | None]:
        """Return what comes of designs; those that were tried before are not run again."""
        new = [row for row in dict.fromkeys(rows) if row not in self.found][: self.left]
        if new:
            first = len(self.found) + 1
            tried = self._tried(self.study.design(new), new, first)
            self.found |= dict(zip(new, tried, strict=True))
        return [self.found.get(row) for row in rows]

    def _tried(self, cases: Design, rows: Sequence[tuple[Any, ...]], first: int) -> list[Candidate]:
        table = self.run(cases).to_dict("records")
        needed = [name for name in self.study.measures if name in _OF_THE_CASE]
        loaded = loaded_cases(cases) if needed else [self.study.case] * len(rows)
        return [
            _candidate(self.study, first + at, row, table[at], loaded[at], needed)
            for at, row in enumerate(rows)
        ]


def _candidate(
    study: OptimiseStudy,
    number: int,
    row: tuple[Any, ...],
    found: Mapping[Any, Any],
    case: Case | DriveCase | WearsimError,
    needed: Sequence[str],
) -> Candidate:
    error, measures = str(found["error"]), {}
    reached = not math.isnan(found["life_hours"])
    if not error:
        measures["life_hours"] = found["life_hours"] if reached else found["hours_run"]
        try:
            assert not isinstance(case, WearsimError)
            measures |= {name: _OF_THE_CASE[name](case) for name in needed}
            error = "".join(
                f"{name} must be above 0, is {value:g}" for name, value in measures.items() if not value > 0.0
            )
        except WearsimError as reason:
            error, measures = str(reason), {}
    violation = math.inf if error else sum(_excesses(study.limits, measures).values())
    stop = "" if error else str(found["stop"])
    measures = {} if error else measures
    return Candidate(number, row, measures, reached, stop, violation, error, str(found["warnings"]))


def _excesses(limits: Mapping[str, MeasureLimit], measures: Mapping[str, float]) -> dict[str, float]:
    """How far a design is beyond each limit, as a natural logarithm; 0 where it keeps it."""
    found = {}
    for name, limit in limits.items():
        above = 0.0 if limit.high is None else math.log(measures[name] / limit.high)
        below = 0.0 if limit.low is None else math.log(limit.low / measures[name])
        found[name] = max(above, below, 0.0)
    return found


def limit_names(study: OptimiseStudy) -> list[str]:
    """Return the limits by names such as ``life_hours.low``."""
    return [
        f"{name}.{end}"
        for name, limit in study.limits.items()
        for end in ("low", "high")
        if getattr(limit, end) is not None
    ]


def margins(study: OptimiseStudy, candidate: Candidate) -> dict[str, float]:
    """Return how far a design is from its limits."""
    found = {}
    for key in limit_names(study):
        name, end = key.split(".")
        ratio = candidate.measures[name] / getattr(study.limits[name], end)
        found[key] = ratio - 1.0 if end == "low" else 1.0 - ratio
    return found


def front(candidates: Sequence[Candidate], objectives: Sequence[str]) -> list[Candidate]:
    """Return the feasible designs than which none is better in all objectives."""
    feasible = [candidate for candidate in candidates if candidate.feasible]
    costs = {candidate.number: tuple(candidate.cost(name) for name in objectives) for candidate in feasible}
    feasible.sort(key=lambda candidate: (costs[candidate.number], candidate.number))
    kept: list[Candidate] = []
    for candidate in feasible:
        own = costs[candidate.number]
        if not any(_covers(costs[other.number], own) for other in kept):
            kept.append(candidate)
    return kept


def _covers(one: tuple[float, ...], other: tuple[float, ...]) -> bool:
    return all(a <= b for a, b in zip(one, other, strict=True))


def check_feasible(study: OptimiseStudy, candidates: Sequence[Candidate]) -> None:
    """Raise where no design is feasible."""
    if any(candidate.feasible for candidate in candidates):
        return
    nearest = min(candidates, key=lambda one: one.violation)
    near = ""
    if not nearest.error:
        beyond = 100.0 * math.expm1(nearest.violation)
        near = f"; design {nearest.number} comes nearest, {beyond:.3g} % beyond the limits in all"
    raise StudyError(
        f"none of {len(candidates)} designs is feasible: {commonest_reason(study, candidates)}{near}: "
        "widen the parameters, loosen the limits, or try more (--evaluations)"
    )


def commonest_reason(study: OptimiseStudy, candidates: Sequence[Candidate]) -> str:
    """Return why most designs that are not feasible are not."""
    reasons = counts_by_kind(text for candidate in candidates for text in _reasons(study, candidate))
    return f"{reasons[0][1]} of them by {reasons[0][0]}" if reasons else ""


def _reasons(study: OptimiseStudy, candidate: Candidate) -> list[str]:
    if candidate.error:
        return [candidate.error.splitlines()[0]]
    excesses = _excesses(study.limits, candidate.measures)
    found = []
    for name in (name for name, excess in excesses.items() if excess > 0.0):
        limit, value = study.limits[name], candidate.measures[name]
        low = limit.low is not None and value < limit.low
        end = f"below low = {limit.low:g}" if low else f"above high = {limit.high:g}"
        found.append(f"limits.{name}, {end} ({value:.4g})")
    return found
