"""What is shown of the uncertainty of a life: text, JSON, tables and pictures."""

import math
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import pandas as pd

from wearsim.command.study_files import plain, save_figures, save_texts
from wearsim.geometry.profile import Vector
from wearsim.quantities import grouped
from wearsim.study.similar_texts import kinds
from wearsim.study.uncertainty.cross_check import CrossCheck
from wearsim.study.uncertainty.cross_check_sheet import cross_check_json, cross_check_lines
from wearsim.study.uncertainty.model import UncertaintyStudy
from wearsim.study.uncertainty.percentiles import CONFIDENCE, Fit, Flags, Percentile, fits, percentile

SHARES = (0.1, 0.5, 0.9)
_MOST_KINDS = 8
_FEWEST = 16
"""Samples from which the convergence of the percentiles is followed."""


@dataclass(frozen=True)
class Answer:
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
        """P10, P50 and P90."""
        return tuple(percentile(self.hours, self.reached, share) for share in SHARES)

    @cached_property
    def fits(self) -> list[Fit]:
        """Distributions fitted to the lives, the better one first."""
        return fits(self.hours, self.reached)

    @cached_property
    def convergence(self) -> pd.DataFrame:
        """Percentiles of the first samples, doubled from row to row up to all; nan for a bound."""
        count = len(self.sound)
        counts = [count >> shift for shift in range(count.bit_length()) if count >> shift >= _FEWEST]
        rows = []
        for some in reversed(counts or [count]):
            found = [percentile(self.hours[:some], self.reached[:some], q) for q in SHARES]
            names = [f"p{100 * share:.0f}_hours" for share in SHARES]
            known = (one.hours if one.known else math.nan for one in found)
            rows.append({"samples": some} | dict(zip(names, known, strict=True)))
        return pd.DataFrame(rows)


def uncertainty_text(answer: Answer) -> str:
    """Return percentiles, what they rest on, and fits, as text."""
    study = answer.study
    lines = [study.scattered.case.title, ""]
    for found, text in zip(answer.percentiles, _MEANING, strict=True):
        name = f"P{100 * found.share:.0f}"
        lines.append(f"{name:<12} {_hours(found):>12} h    {_interval(found)}    {text}")
    lines += ["", f"samples      {len(answer.sound)}, {_METHODS[study.method]}, seed {study.seed}"]
    for fit in answer.fits:
        lines.append(
            f"{fit.name:<12} {_parameters(fit)}, B10 {grouped(fit.b10)} h, ln likelihood "
            f"{fit.log_likelihood:.1f}"
        )
    if answer.crossed is not None:
        lines += cross_check_lines(answer.crossed)
    lines += ["", "what scatters:"]
    lines += [f"  {scatter.key}: {scatter.text}" for scatter in study.scattered.scatters]
    lines += ["", "percentiles of the first samples, h:"]
    lines += [f"  {line}" for line in _columns(answer.convergence)]
    lines += ["", "assumptions:"]
    lines += [f"  {number}. {text}" for number, text in enumerate(_assumptions(study), start=1)]
    lines += [f"warning: {text}" for text in warnings_of(answer)]
    return "\n".join(lines)


_MEANING = ("9 of 10 live longer (B10)", "half live longer", "1 of 10 lives longer")
_METHODS = {"sobol": "scrambled Sobol' points", "lhs": "Latin hypercube", "random": "independent"}
_OF_INTERVALS = (
    f"intervals hold the percentile with {100 * CONFIDENCE:.0f} % confidence for independent samples, "
    "whatever the distribution; they do not tell of errors of the model"
)


def warnings_of(answer: Answer) -> list[str]:
    """Return what is doubtful about the percentiles."""
    found = []
    failed, count = len(answer.table) - len(answer.sound), len(answer.table)
    if failed:
        found.append(
            f"{failed} of {count} samples failed and are left out: the percentiles hold only for designs "
            "that can run"
        )
    if not all(one.known for one in answer.percentiles):
        found.append("percentiles beyond run.horizon_hours are only bounds: raise it")
    if answer.study.method == "sobol" and count & (count - 1):
        below = 1 << (count.bit_length() - 1)
        found.append(
            f"Sobol' points are balanced for powers of two only: take {below} or {2 * below} samples"
        )
    if answer.crossed is not None:
        found += answer.crossed.doubts
    return found + _of_samples(answer.sound["warnings"])


def _of_samples(warnings: "pd.Series[str]") -> list[str]:
    """Warnings of the samples, those that differ in their numbers only as one."""
    most = kinds(text for joined in warnings for text in filter(None, joined.split("\n")))
    found = [f"{count} of {len(warnings)} samples, such as: {text}" for text, count in most[:_MOST_KINDS]]
    if len(most) > _MOST_KINDS:
        found.append(f"and {len(most) - _MOST_KINDS} other kinds of warnings, see cases.csv")
    return found


def uncertainty_json(answer: Answer) -> dict[str, Any]:
    """Return the answer as plain values."""
    study = answer.study
    case = study.scattered.case
    content: dict[str, Any] = {"schema_version": 1, "case": case.name, "title": case.title}
    for found in answer.percentiles:
        name = f"p{100 * found.share:.0f}_hours"
        content[name] = found.hours if found.known else None
        content[f"{name}_low"], content[f"{name}_high"] = found.low, plain(found.high)
        content[f"{name}_at_least"] = None if found.known else found.hours
    content["confidence"] = CONFIDENCE
    content |= {"samples": len(answer.sound), "failed": len(answer.table) - len(answer.sound)}
    content |= {"method": study.method, "seed": study.seed}
    content["inputs"] = {
        scatter.key: scatter.distribution.model_dump(exclude_none=True)
        for scatter in study.scattered.scatters
    }
    content["fits"] = [
        {
            "name": f.name,
            "shape": f.shape,
            "scale_hours": f.scale,
            "b10_hours": f.b10,
            "log_likelihood": f.log_likelihood,
        }
        for f in answer.fits
    ]
    if answer.crossed is not None:
        content["cross_check"] = cross_check_json(answer.crossed)
    content["convergence"] = [
        {name: plain(value) for name, value in row.items()} for row in answer.convergence.to_dict("records")
    ]
    content["assumptions"] = _assumptions(study)
    content["warnings"] = warnings_of(answer)
    return content


def save_uncertainty(answer: Answer, folder: Path) -> None:
    """Write tables and pictures into the folder of a study."""
    from wearsim.study.uncertainty.figure import uncertainty_figures

    texts = {
        "cases.csv": answer.table.to_csv(index=False),
        "convergence.csv": answer.convergence.to_csv(index=False),
        "summary.md": f"```\n{uncertainty_text(answer)}\n```\n",
    }
    save_texts(folder, texts)
    save_figures(folder, answer.study.scattered.case.title, uncertainty_figures(answer))


def _assumptions(study: UncertaintyStudy) -> list[str]:
    scattered = study.scattered
    return [*scattered.assumptions, _OF_INTERVALS, *scattered.case.assumptions]


def _hours(found: Percentile) -> str:
    return grouped(found.hours) if found.known else f"> {grouped(found.hours)}"


def _interval(found: Percentile) -> str:
    high = grouped(found.high) if math.isfinite(found.high) else "not known"
    return f"({grouped(found.low)} to {high})"


def _parameters(fit: Fit) -> str:
    if fit.name == "lognormal":
        return f"median {grouped(fit.scale)} h, sigma_ln {fit.shape:.3f}"
    return f"shape {fit.shape:.3f}, scale {grouped(fit.scale)} h"


def _columns(table: pd.DataFrame) -> list[str]:
    head = "".join(f"{name.removesuffix('_hours'):>12}" for name in table.columns)
    return [head] + [
        f"{int(row[0]):>12}"
        + "".join(f"{'not known' if math.isnan(value) else grouped(value):>12}" for value in row[1:])
        for row in table.itertuples(index=False)
    ]
