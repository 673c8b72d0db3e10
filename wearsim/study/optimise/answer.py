"""The best designs of a case."""

from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd

from wearsim.case.model import Case
from wearsim.drive.case_input import CaseInput, keys_of, with_table
from wearsim.drive.drive_case import DriveCase
from wearsim.errors import Range, check_ranges
from wearsim.report.public_answer import DrawnAnswer
from wearsim.runner.design import Design
from wearsim.runner.in_threads import SEED, THREADS, Progress, silent, threads_of
from wearsim.runner.run_study import run_study
from wearsim.runner.workers import SharedWorkers
from wearsim.study.optimise.model import load_optimise
from wearsim.study.optimise.search import best_designs, check_library
from wearsim.study.optimise.sheet import (
    candidates_table,
    optimise_json,
    optimise_text,
    write_candidates,
    write_optimise,
)
from wearsim.study.optimise.trials import OptimiseOutcome, check_feasible

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_EVALUATIONS = Range(10, 1_000_000, whole=True)


@dataclass(frozen=True, repr=False, eq=False)
class OptimiseResult(DrawnAnswer):
    """The best designs among those that were tried.

    Attributes
    ----------
    outcome : OptimiseOutcome
        Designs and what came of them as objects.
    """

    _tables = ("designs", "candidates")

    outcome: OptimiseOutcome

    @property
    def title(self) -> str:
        """What the case is about."""
        return self.outcome.study.case.title

    @property
    def headline(self) -> str:
        """How many designs are best, and the first of them."""
        best = self.outcome.front[0]
        keys = zip(self.outcome.study.space.keys, best.values, strict=True)
        values = ", ".join(
            f"{key} = {value:.4g}" if isinstance(value, float) else f"{key} = {value}" for key, value in keys
        )
        return f"{len(self.outcome.front)} best of {len(self.outcome.candidates)} designs, the first {values}"

    @property
    def text(self) -> str:
        """What ``wearsim optimise`` prints."""
        return optimise_text(self.outcome)

    @property
    def explained(self) -> str:
        """The text with every assumption and default."""
        return optimise_text(self.outcome, explain=True)

    @property
    def cases(self) -> list[Case | DriveCase]:
        """The best designs as cases, in the order of ``designs``."""
        return self.outcome.cases

    @property
    def designs(self) -> pd.DataFrame:
        """A row for each of the best designs."""
        return candidates_table(self.outcome, self.outcome.front).frame()

    @property
    def candidates(self) -> pd.DataFrame:
        """A row for each design that was tried, the case as given first."""
        return candidates_table(self.outcome, (self.outcome.unchanged, *self.outcome.candidates)).frame()

    def _content(self) -> dict[str, Any]:
        return optimise_json(self.outcome)

    def pictures(self) -> "dict[str, Figure]":
        """Return how the search converged, or the front.

        Returns
        -------
        dict of matplotlib.figure.Figure
            By their names.
        """
        from wearsim.study.optimise.figure import optimise_figures

        return optimise_figures(self.outcome)

    def _write(self, place: Path) -> None:
        write_candidates(self.outcome, place)
        write_optimise(self.outcome, place)


def optimise(
    case: CaseInput,
    parameters: Mapping[str, Any] | None = None,
    *,
    objectives: Sequence[str] = ("life_hours",),
    limits: Mapping[str, Any] | None = None,
    evaluations: int = 400,
    seed: int = 1,
    threads: int | None = None,
    progress: Progress = silent,
) -> OptimiseResult:
    """Return the best designs of a case.

    Parameters
    ----------
    case : Case, path or mapping
        One sprocket or a gear pair; without parameters its table ``[optimise]`` tells all that is asked.
    parameters : mapping, optional
        What may change by dotted keys: ``{"low": 4.0, "high": 8.0}``, or a list of values.
    objectives : sequence of str
        ``life_hours``, ``mass_kg``, ``peak_pressure_MPa``; several give a front (extra ``optimise``).
    limits : mapping, optional
        What a design must keep to, such as ``{"mass_kg": {"high": 2.5}}``.
    evaluations : int
        Designs that may be tried.
    seed : int
        Of the search.
    threads : int, optional
        Designs that run side by side; one a core without it.
    progress : callable, optional
        Called with the fraction of the evaluations done, from 0 to 1; a search may end before.

    Returns
    -------
    OptimiseResult
        ``designs``, ``candidates``, and the best ``cases``.

    Raises
    ------
    CaseError
        What is wrong with the case or with what is asked.
    GeometryError
        Evaluations, seed or threads are outside their ranges.
    StudyError
        No design is feasible.
    """
    given = {"evaluations": evaluations, "seed": seed, "threads": threads}
    check_ranges("optimise", given, {"evaluations": _EVALUATIONS, "seed": SEED, "threads": THREADS})
    table = None
    if parameters is not None:
        table = {
            "parameters": keys_of("parameters", parameters),
            "objectives": list(objectives),
            "limits": keys_of("limits", limits),
        }
    study = load_optimise(with_table(case, "optimise", table), (), evaluations, seed)
    check_library(study)
    done = 0

    def _run_batch(part: Design) -> pd.DataFrame:
        nonlocal done
        found = run_study(part, workers)
        done += len(part.rows)
        progress(min(1.0, done / (evaluations + 1)))
        return found

    with closing(SharedWorkers(threads_of(threads))) as workers:
        outcome = best_designs(study, _run_batch)
    check_feasible(study, outcome.candidates)
    return OptimiseResult(outcome)
