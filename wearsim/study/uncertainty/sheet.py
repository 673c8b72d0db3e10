"""What is shown of the uncertainty of a life: text, JSON, tables and pictures."""

import math
from pathlib import Path
from typing import Any

import pandas as pd

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped, percentile_meaning
from wearsim.report.answer_table import csv_of, csv_parts, plain, records_of
from wearsim.report.study_files import save_figures, save_files
from wearsim.report.text_lines import closing_lists, fenced
from wearsim.study.uncertainty.cross_check import BoundedValue, CrossCheck, CrossFit
from wearsim.study.uncertainty.life_statistics import UncertaintyAnswer, uncertainty_warnings
from wearsim.study.uncertainty.model import UncertaintyStudy
from wearsim.study.uncertainty.percentiles import B10, CONFIDENCE, DistributionFit, Percentile


def uncertainty_text(answer: UncertaintyAnswer, explain: bool = False) -> str:
    """Return percentiles, what they rest on, and fits, as text."""
    study = answer.study
    lines = [study.scattered.case.title, ""]
    for found in answer.percentiles:
        text = f"{percentile_meaning(found.share)}{' (B10)' if found.share == B10 else ''}"
        lines.append(f"{found.name:<12} {_hours(found):>12} h    {_interval(found)}    {text}")
    lines += ["", f"samples      {len(answer.sound)}, {_METHODS[study.method]}, seed {study.seed}"]
    for fit in answer.fits:
        lines.append(
            f"{fit.name:<12} {_parameters(fit)}, B10 {grouped(fit.b10)} h, ln likelihood "
            f"{fit.log_likelihood:.1f}"
        )
    if answer.crossed is not None:
        lines += _cross_check_lines(answer.crossed)
    if answer.ends_first:
        lines += ["", *_part_lines(answer)]
    lines += ["", "scattering inputs:"]
    lines += [f"  {scatter.key}: {scatter.text}" for scatter in study.scattered.scatters]
    lines += ["", "percentiles of the first samples, h:"]
    lines += [f"  {line}" for line in _columns(answer.convergence)]
    lines += closing_lists(_assumptions(study), uncertainty_warnings(answer), explain)
    return "\n".join(lines)


_METHODS = {"sobol": "scrambled Sobol' points", "lhs": "Latin hypercube", "random": "independent"}
_OF_INTERVALS = (
    f"intervals hold the percentile with {100 * CONFIDENCE:.0f} % confidence for independent samples, "
    "whatever the distribution; they do not include model errors"
)


def uncertainty_json(answer: UncertaintyAnswer) -> dict[str, Any]:
    """Return the answer as plain values."""
    study = answer.study
    case = study.scattered.case
    content: dict[str, Any] = {**ANSWER_HEAD, "case": case.name, "title": case.title}
    for found in answer.percentiles:
        name = found.column
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
        content["cross_check"] = _cross_check_json(answer.crossed)
    content["convergence"] = records_of(answer.convergence)
    if answer.ends_first:
        content["ends_first"] = answer.ends_first
        content["median_life_hours"] = {name: plain(hours) for name, hours in answer.medians.items()}
    content["assumptions"] = _assumptions(study)
    content["warnings"] = uncertainty_warnings(answer)
    return content


def write_uncertainty(answer: UncertaintyAnswer, folder: Path) -> None:
    """Write tables and pictures into the folder of a study."""
    from wearsim.study.uncertainty.figure import uncertainty_figures

    texts = {
        "cases.csv": csv_parts(answer.table),
        "convergence.csv": csv_of(answer.convergence),
        "summary.md": fenced(uncertainty_text(answer, explain=True)),
    }
    save_files(folder, texts)
    save_figures(folder, answer.study.scattered.case.title, uncertainty_figures(answer))


def _assumptions(study: UncertaintyStudy) -> list[str]:
    scattered = study.scattered
    return [*scattered.assumptions, _OF_INTERVALS, *scattered.case.assumptions]


def _part_lines(answer: UncertaintyAnswer) -> list[str]:
    """Say of a whole drive which parts end first, and how long each lives, as text."""
    first = sorted(answer.ends_first.items(), key=lambda item: -item[1])
    shares = ", ".join(f"{name} in {100.0 * share:.0f} %" for name, share in first if share > 0.0)
    lives = ", ".join(
        f"{name} {grouped(hours)} h" if math.isfinite(hours) else f"{name} not reached"
        for name, hours in answer.medians.items()
    )
    return [f"ends first   {shares or 'nothing within the horizon'}", f"P50 by part  {lives}"]


def _hours(found: Percentile) -> str:
    return grouped(found.hours) if found.known else f"> {grouped(found.hours)}"


def _interval(found: Percentile) -> str:
    high = grouped(found.high) if math.isfinite(found.high) else "not known"
    return f"({grouped(found.low)} to {high})"


def _parameters(fit: DistributionFit) -> str:
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


def _cross_check_lines(crossed: CrossCheck) -> list[str]:
    """Return the repeated fits with the bounds of their parameters, as text."""
    if not crossed.fits:
        return [f"cross-check  by {crossed.library}: no fit"]
    head = f"cross-check  by {crossed.library}, parameters with their 95 % bounds"
    return [head, *(f"  {fit.name:<10} {_bounded_parameters(fit)}" for fit in crossed.fits)]


def _bounded_parameters(fit: CrossFit) -> str:
    shape = f"{fit.shape.value:.3f} ({fit.shape.low:.3f} to {fit.shape.high:.3f})"
    scale = f"{grouped(fit.scale.value)} h ({grouped(fit.scale.low)} to {grouped(fit.scale.high)})"
    if fit.name == "lognormal":
        return f"median {scale}, sigma_ln {shape}"
    return f"shape {shape}, scale {scale}"


def _cross_check_json(crossed: CrossCheck) -> dict[str, Any]:
    """Return the repeated fits as plain values."""
    return {
        "library": crossed.library,
        "fits": [
            {"name": fit.name} | _bounded("shape", fit.shape) | _bounded("scale_hours", fit.scale)
            for fit in crossed.fits
        ],
    }


def _bounded(name: str, found: BoundedValue) -> dict[str, float | None]:
    return {name: plain(found.value), f"{name}_low": plain(found.low), f"{name}_high": plain(found.high)}
