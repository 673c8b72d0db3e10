"""How sure a life is."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd

from wearsim.drive.case_input import CaseInput, with_table
from wearsim.errors import Allowed, Range, check_ranges
from wearsim.quantities import grouped
from wearsim.report.answer_table import table_of
from wearsim.report.public_answer import DrawnAnswer
from wearsim.runner.in_threads import SEED, THREADS, Progress, run, silent
from wearsim.runner.run_study import failures
from wearsim.runner.samples import METHODS, Method
from wearsim.study.uncertainty.life_statistics import UncertaintyAnswer
from wearsim.study.uncertainty.model import load_uncertainty
from wearsim.study.uncertainty.sheet import uncertainty_json, uncertainty_text, write_uncertainty

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, repr=False, eq=False)
class UncertaintyResult(DrawnAnswer):
    """Percentiles of a life whose inputs scatter.

    Attributes
    ----------
    answer : UncertaintyAnswer
        Samples, percentiles and fits as objects.
    """

    _tables = ("percentiles", "fits", "convergence", "samples")

    answer: UncertaintyAnswer

    @property
    def title(self) -> str:
        """What the case is about."""
        return self.answer.study.scattered.case.title

    @property
    def headline(self) -> str:
        """The percentiles in one line."""
        shown = (
            f"{one.name} {'' if one.known else '> '}{grouped(one.hours)} h" for one in self.answer.percentiles
        )
        return ", ".join(shown)

    @property
    def text(self) -> str:
        """What ``wearsim uncertainty`` prints."""
        return uncertainty_text(self.answer)

    @property
    def explained(self) -> str:
        """The text with every assumption and default."""
        return uncertainty_text(self.answer, explain=True)

    @property
    def samples(self) -> pd.DataFrame:
        """A row for each sample: its values, life, what ended it."""
        return self.answer.table

    @property
    def percentiles(self) -> pd.DataFrame:
        """Percentiles with the ends of their intervals; ``known`` is False of a bound."""
        return table_of(
            {
                "percentile": one.name,
                "life_hours": one.hours,
                "life_hours_low": one.low,
                "life_hours_high": one.high,
                "known": one.known,
            }
            for one in self.answer.percentiles
        )

    @property
    def convergence(self) -> pd.DataFrame:
        """Percentiles of the first samples, doubled from row to row; nan for a bound."""
        return self.answer.convergence

    @property
    def fits(self) -> pd.DataFrame:
        """Distributions fitted to the lives, the better one first."""
        return table_of(self._content()["fits"])

    def _content(self) -> dict[str, Any]:
        return uncertainty_json(self.answer)

    def pictures(self) -> "dict[str, Figure]":
        """Return the lives with their percentiles, and how these settle.

        Returns
        -------
        dict of matplotlib.figure.Figure
            By their names.
        """
        from wearsim.study.uncertainty.figure import uncertainty_figures

        return uncertainty_figures(self.answer)

    def _write(self, place: Path) -> None:
        write_uncertainty(self.answer, place)


def uncertainty(
    case: CaseInput,
    scatter: Mapping[str, Any] | None = None,
    *,
    samples: int = 1024,
    seed: int = 1,
    method: Method = "sobol",
    threads: int | None = None,
    progress: Progress = silent,
) -> UncertaintyResult:
    """Return the life that 9 of 10, half and 1 of 10 drives outlive whose inputs scatter.

    Parameters
    ----------
    case : Case, DriveCase, path or mapping
        The case; its table ``[uncertainty]`` tells what scatters, else wear coefficient and lubricant do by
        the published scatter.
    scatter : mapping, optional
        Distributions by dotted keys in place of that table, such as
        ``{"load.tension_N": {"distribution": "normal", "standard_deviation": 200}}``.
    samples : int
        Lives that are calculated; a power of 2 for Sobol' points.
    seed : int
        Of the samples.
    method : str
        ``sobol``, ``lhs`` or ``random``.
    threads : int, optional
        Cases that run side by side; one a core without it.
    progress : callable, optional
        Called with the fraction done, from 0 to 1.

    Returns
    -------
    UncertaintyResult
        ``percentiles``, ``fits``, ``convergence`` and ``samples``, and pictures.

    Raises
    ------
    CaseError
        What is wrong with the case or with what scatters.
    GeometryError
        Samples, seed, method or threads are outside their ranges.
    StudyError
        Every case failed.

    Examples
    --------
    A life goes with 1/k: where k is log-normal with sigma_ln, so is the life.

    >>> import wearsim
    >>> case = wearsim.load_case({
    ...     "format_version": 1,
    ...     "chain": {"designation": "16B-1"},
    ...     "sprocket": {"teeth": 20, "profile": "evolute"},
    ...     "load": {"tension_N": 3000, "speed_rpm": 100},
    ...     "wear": {"specific_wear_rate_mm2_per_N": 5e-11},
    ...     "run": {"life_tolerance": 0.1},
    ... })
    >>> rate = {"wear.specific_wear_rate_mm2_per_N": {"distribution": "lognormal", "sigma_ln": 0.4}}
    >>> fits = wearsim.uncertainty(case, rate, samples=64).fits.set_index("name")
    >>> round(float(fits["shape"]["lognormal"]), 1)
    0.4
    """
    given = {"samples": samples, "seed": seed, "method": method, "threads": threads}
    check_ranges("uncertainty", given, _ALLOWED)
    study = load_uncertainty(with_table(case, "uncertainty", scatter), (), samples, seed, method)
    table = run(study.design, threads, progress)
    failures(table)
    return UncertaintyResult(UncertaintyAnswer(study, table))


_ALLOWED: dict[str, Allowed] = {
    "samples": Range(2, 10_000_000, whole=True),
    "seed": SEED,
    "method": METHODS,
    "threads": THREADS,
}
