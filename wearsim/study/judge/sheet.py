"""What is shown of a judgement: text, JSON and tables."""

import math
from pathlib import Path
from typing import Any

import pandas as pd

from wearsim._version import ANSWER_HEAD
from wearsim.report.study_files import plain
from wearsim.report.text_lines import numbered_assumptions, row, table_lines
from wearsim.study.judge.model import FittedConstant, JudgedLaw, Judgement

ASSUMPTIONS = (
    "wear is log-normal about a law, by a factor of the series and one of the reading",
    "bands hold the uncertainty of the constants, by sequential Monte Carlo",
    "before any reading each constant is expected within the range that docs/judge.md names",
)


def judgement_text(found: Judgement) -> str:
    """Return the answer as ``wearsim judge`` prints it."""
    data, taken = found.data, found.simplest
    held = int(data.held_out.sum())
    rows = [
        ("Readings", f"{data.wear.size} in {len(data.names)} series; {held} held out to judge by"),
        ("Best law", _described(found.best)),
        ("As good", ", ".join(found.ties[1:]) or "none: the readings tell it from all others"),
        *([("Take", f"{_described(taken)}, the simplest of them")] if taken is not found.best else []),
        *([("Constants", "; ".join(map(_constant, taken.constants)))] if taken.constants else []),
        ("Scatter", "; ".join(map(_constant, taken.deviations)) + ", of ln(wear)"),
        ("Verdict", verdict(found)),
        ("Assumes", numbered_assumptions(ASSUMPTIONS)),
        ("Warnings", "; ".join(data.warnings) or "none"),
    ]
    return "\n".join([*(row(label, text) for label, text in rows), "", *_table(found)])


def verdict(found: Judgement) -> str:
    """Return in words whether the best law is good enough."""
    if found.objections:
        return "no law is good enough: " + "; ".join(found.objections)
    return f"{found.simplest.law} is good enough: its bands hold what they should"


def _described(one: JudgedLaw) -> str:
    return f"{one.law}, wear = {one.formula}, with {_SCATTERS[one.scatter]}"


_SCATTERS = {"factor": "a factor of each series that stays", "walk": "a factor of each series that wanders"}


def _constant(one: FittedConstant) -> str:
    return f"{one.name} = {one.middle:.3g} ({one.low:.3g} to {one.high:.3g})"


_HEAD = ("law", "scatter", "score", "behind", "+-", "in 50 %", "in 90 %", "off by")


def _table(found: Judgement) -> list[str]:
    return [f"  {line}" for line in table_lines([_HEAD, *(_cells(one) for one in found.laws)], words=2)]


def _cells(one: JudgedLaw) -> tuple[str, ...]:
    error = f"{one.behind_error:.2f}" if math.isfinite(one.behind_error) else "?"
    shares = (_percent(one.coverage_50), _percent(one.coverage_90), _factor(one.median_error))
    return one.law, one.scatter, f"{one.score:.2f}", f"{one.behind:.2f}", error, *shares


def _factor(ln_error: float) -> str:
    return "" if math.isnan(ln_error) else f"{math.exp(ln_error):.2f}"


def _percent(share: float) -> str:
    return "" if math.isnan(share) else f"{100 * share:.0f} %"


def judgement_json(found: Judgement, source: str) -> dict[str, Any]:
    """Return the answer as ``wearsim judge --json`` prints it."""
    data = found.data
    return {
        **ANSWER_HEAD,
        "data": source,
        "readings": data.wear.size,
        "series_count": len(data.names),
        "held_out_readings": int(data.held_out.sum()),
        "wear_unit": data.wear_unit,
        "exposure_unit": data.exposure_unit,
        "best": found.best.law,
        "ties": list(found.ties),
        "take": found.simplest.law,
        "good_enough": not found.objections,
        "objections": list(found.objections),
        "laws": [_law(one) for one in found.laws],
        "assumptions": list(ASSUMPTIONS),
        "warnings": list(data.warnings),
    }


def _law(one: JudgedLaw) -> dict[str, Any]:
    numbers = {name: plain(getattr(one, name)) for name in _NUMBERS}
    constants = [vars(constant) for constant in (*one.constants, *one.deviations)]
    names = {"law": one.law, "formula": one.formula, "scatter": one.scatter}
    return {**names, **numbers, "tied": one.tied, "constants": constants}


_NUMBERS = ("score", "behind", "behind_error", "coverage_50", "coverage_90", "median_error")


def laws_table(found: Judgement) -> pd.DataFrame:
    """Return a row for each law and kind of scatter."""
    return pd.DataFrame(
        {
            "law": one.law,
            "scatter": one.scatter,
            **{name: plain(getattr(one, name)) for name in _NUMBERS},
            "tied": one.tied,
        }
        for one in found.laws
    )


def constants_table(found: Judgement) -> pd.DataFrame:
    """Return the constants of all laws."""
    return pd.DataFrame(
        {"law": one.law, "scatter": one.scatter, **vars(constant)}
        for one in found.laws
        for constant in (*one.constants, *one.deviations)
    )


def forecasts_table(found: Judgement) -> pd.DataFrame:
    """Return every reading beside what the best law says of it."""
    data = found.data
    bands = dict(zip(("p05", "p25", "p50", "p75", "p95"), found.best.bands, strict=True))
    return pd.DataFrame(
        {
            "series": [data.names[index] for index in data.series],
            "exposure": data.exposure * data.longest,
            "wear": data.wear,
            "held_out": data.held_out.astype(int),
            **bands,
        }
    )


def write_judgement(found: Judgement, title: str, place: Path) -> None:
    """Write tables and the picture into a folder."""
    from wearsim.report.figures import save_figure
    from wearsim.study.judge.figure import judgement_figure

    laws_table(found).to_csv(place / "laws.csv", index=False)
    constants_table(found).to_csv(place / "constants.csv", index=False)
    forecasts_table(found).to_csv(place / "forecasts.csv", index=False)
    summary = f"```\n{judgement_text(found)}\n```\n"
    (place / "summary.md").write_text(summary, encoding="utf-8")
    save_figure(judgement_figure(found, title), place, "judgement")
