"""What the lives of the samples tell: percentiles, fits, how settled they are, and what is doubtful."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pandas as pd

from wearsim.geometry.profile_points import Vector
from wearsim.quantities import grouped, percentile_shares
from wearsim.report.text_lines import counts_by_kind
from wearsim.runner.run_study import missed_tolerance
from wearsim.study.uncertainty.cross_check import CrossCheck
from wearsim.study.uncertainty.model import UncertaintyStudy
from wearsim.study.uncertainty.percentiles import (
    DistributionFit,
    Flags,
    Percentile,
    fit_distributions,
    percentile,
)

_MAX_KINDS = 8
_FEWEST = 16
"""Samples from which the convergence of the percentiles is followed."""


@dataclass(frozen=True)
class UncertaintyAnswer:
    """The lives of the samples and what they tell."""

    study: UncertaintyStudy  # what was asked
    table: pd.DataFrame  # a row for each sample, of `run_study`
    # the fits as another library repeats them, where that was asked
    crossed: CrossCheck | None = None

    @cached_property
    def sound(self) -> pd.DataFrame:
        """Rows of the samples that did not fail."""
        return self.table[self.table["error"] == ""]

    @property
    def reached(self) -> Flags:
        """Whether each of them is a life, not a bound."""
        return self.sound["life_hours"].notna().to_numpy()

    @property
    def hours(self) -> Vector:
        """Lives, or how long they are at least [h]."""
        return self.sound["hours_run"].to_numpy(float)

    @cached_property
    def percentiles(self) -> tuple[Percentile, ...]:
        """The percentiles of all sound samples."""
        return self._percentiles_of_first(len(self.sound))

    def _percentiles_of_first(self, count: int) -> tuple[Percentile, ...]:
        hours, reached = self.hours[:count], self.reached[:count]
        return tuple(percentile(hours, reached, share) for share in percentile_shares())

    @property
    def error_text(self) -> str:
        """How far the stated errors of the samples move the percentiles where some miss their tolerance.

        A percentile rises with every life, so that the lives at the ends of their errors bound it.
        """
        missed = missed_tolerance(self.sound)
        if not missed:
            return ""
        error = self.sound["numerical_error"].to_numpy(float)
        ends = [
            [
                percentile(self.hours * factor, self.reached, share).hours
                for factor in (1.0 - error, 1.0 + error)
            ]
            for share in percentile_shares()
        ]
        spans = ", ".join(
            f"{one.name} is {grouped(low)} to {grouped(high)} h"
            for one, (low, high) in zip(self.percentiles, ends, strict=True)
            if one.known
        )
        return f"{missed}; with the errors of all, {spans}" if spans else missed

    @property
    def ends_first(self) -> dict[str, float]:
        """Share of the samples in which a part of a whole drive ends first, by its name."""
        return {name: float((self.sound["stop"] == name).mean()) for name in self.study.design.parts}

    @property
    def medians(self) -> dict[str, float]:
        """Median life of every part of a whole drive; infinite where half of the runs did not reach it."""
        return {
            name: float(np.quantile(self.sound[f"{name}_life_hours"].fillna(math.inf), 0.5, method="higher"))
            for name in self.study.design.parts
        }

    @cached_property
    def fits(self) -> list[DistributionFit]:
        """Distributions fitted to the lives, the better one first."""
        return fit_distributions(self.hours, self.reached)

    @cached_property
    def convergence(self) -> pd.DataFrame:
        """Percentiles of the first samples, doubled from row to row up to all; nan for a bound."""
        count = len(self.sound)
        counts = [count >> shift for shift in range(count.bit_length()) if count >> shift >= _FEWEST]
        rows = []
        for some in reversed(counts or [count]):
            found = self._percentiles_of_first(some)
            rows.append(
                {"samples": some} | {one.column: one.hours if one.known else math.nan for one in found}
            )
        return pd.DataFrame(rows)


def uncertainty_warnings(answer: UncertaintyAnswer) -> list[str]:
    """Return what is doubtful about the percentiles."""
    found = []
    failed, count = len(answer.table) - len(answer.sound), len(answer.table)
    if failed:
        first = next(text for text in answer.table["error"] if isinstance(text, str) and text)
        found.append(
            f"{failed} of {count} samples failed and are left out: the percentiles hold only for designs "
            f"that can run. The first failed by: {first}"
        )
    if not all(one.known for one in answer.percentiles):
        found.append("percentiles beyond run.horizon_hours are only bounds: raise it")
    if answer.error_text:
        found.append(answer.error_text)
    if answer.study.method == "sobol" and count & (count - 1):
        below = 1 << (count.bit_length() - 1)
        found.append(
            f"Sobol' points are balanced for powers of two only: take {below} or {2 * below} samples"
        )
    if answer.crossed is not None:
        found += answer.crossed.differences_found
    told, keys = answer.study.scattered.case.warnings, [one.key for one in answer.study.scattered.scatters]
    drawn = [f"{key} = " for key in keys if not any(text.startswith(f"{key} = ") for text in told)]
    return found + _of_samples(answer.sound, tuple(drawn))


def _of_samples(sound: pd.DataFrame, drawn: tuple[str, ...]) -> list[str]:
    """Warnings of the samples, those that differ in their numbers only as one, with the first sample.

    ``drawn``: how those begin that are about a value that was drawn, where the case's own has none.
    """
    texts = [
        (text, index)
        for index, joined in zip(sound["case_index"], sound["warnings"], strict=True)
        for text in filter(None, joined.split("\n"))
        if not text.startswith(drawn)
    ]
    counts, first = counts_by_kind(text for text, _ in texts), dict(reversed(texts))
    found = [
        f"{count} of {len(sound)} samples, such as case_index {first[text]}: {text}"
        for text, count in counts[:_MAX_KINDS]
    ]
    if len(counts) > _MAX_KINDS:
        found.append(f"and {len(counts) - _MAX_KINDS} other kinds of warnings, see cases.csv")
    return found
