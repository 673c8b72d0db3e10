"""What is shown of a judgement: text, JSON and tables."""

import math
from collections.abc import Mapping
from typing import Any

import pandas as pd

from wearsim._version import ANSWER_HEAD
from wearsim.report.answer_table import AnswerTable, Column, csv_of
from wearsim.report.text_lines import Finding, answer_text, closing, fenced
from wearsim.study.judge.model import FittedConstant, JudgedLaw, Judgement

ASSUMPTIONS = (
    "wear is log-normal about a law, with one factor for each series and one for each reading",
    "bands include the uncertainty of the constants (sequential Monte Carlo)",
    "prior range of each constant: see docs/judge.md",
)


def judgement_text(found: Judgement, explain: bool = False) -> str:
    """Return the answer as ``wearsim judge`` prints it."""
    data, taken = found.data, found.simplest
    held = int(data.held_out.sum())
    rows = [
        Finding("Readings", f"{data.wear.size} in {len(data.names)} series; {held} held out for scoring"),
        Finding("Best law", _described(found.best)),
        Finding(
            "Tied with", ", ".join(found.ties[1:]) or "none: it scores clearly better than all other laws"
        ),
        *_preferred(found),
        *([Finding("Constants", "; ".join(map(_constant, taken.constants)))] if taken.constants else []),
        Finding("Scatter", "; ".join(map(_constant, taken.deviations)) + ", of ln(wear)"),
        Finding("Verdict", verdict(found)),
        *closing(ASSUMPTIONS, data.warnings, explain),
    ]
    return answer_text(*rows, "", laws_table(found))


def _preferred(found: Judgement) -> list[Finding]:
    if found.simplest is found.best:
        return []
    return [Finding("Preferred", f"{_described(found.simplest)}, the simplest of these")]


def verdict(found: Judgement) -> str:
    """Return in words whether the preferred law is good enough."""
    if found.objections:
        return "no law is good enough: " + "; ".join(found.objections)
    return f"{found.simplest.law} is good enough: its bands hold the expected share of readings"


def _described(one: JudgedLaw) -> str:
    return f"{one.law}, wear = {one.formula}, with {_SCATTERS[one.scatter]}"


_SCATTERS = {"factor": "a constant factor for each series", "walk": "a drifting factor for each series"}


def _constant(one: FittedConstant) -> str:
    return f"{one.name} = {one.middle:.3g} ({one.low:.3g} to {one.high:.3g})"


def judgement_json(found: Judgement, source: str) -> dict[str, Any]:
    """Return the answer as ``wearsim judge --json`` prints it."""
    data, laws = found.data, laws_table(found).records()
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
        "laws": [_law(one, numbers) for one, numbers in zip(found.laws, laws, strict=True)],
        "assumptions": list(ASSUMPTIONS),
        "warnings": list(data.warnings),
    }


def _law(one: JudgedLaw, numbers: Mapping[str, Any]) -> dict[str, Any]:
    constants = [vars(constant) for constant in (*one.constants, *one.deviations)]
    return {"law": one.law, "formula": one.formula, **numbers, "constants": constants}


def laws_table(found: Judgement) -> AnswerTable[JudgedLaw]:
    """Return a row for each law and kind of scatter."""
    return AnswerTable(
        [
            Column("law", lambda one: one.law, "law", side="<"),
            Column("scatter", lambda one: one.scatter, "scatter", side="<"),
            Column("score", lambda one: one.score, "score", "{:.2f}"),
            Column("behind", lambda one: one.behind, "behind", "{:.2f}"),
            Column("behind_error", lambda one: one.behind_error, "+-", "{:.2f}", missing="?"),
            Column("coverage_50", lambda one: one.coverage_50, "in 50 %", _percent, missing=""),
            Column("coverage_90", lambda one: one.coverage_90, "in 90 %", _percent, missing=""),
            Column("median_error", lambda one: one.median_error, "off by", _factor, missing=""),
            Column("tied", lambda one: one.tied),
        ],
        found.laws,
    )


def _factor(ln_error: float) -> str:
    return f"{math.exp(ln_error):.2f}"


def _percent(share: float) -> str:
    return f"{100 * share:.0f} %"


def constants_table(found: Judgement) -> pd.DataFrame:
    """Return the constants of all laws."""
    return pd.DataFrame(
        {"law": one.law, "scatter": one.scatter, **vars(constant)}
        for one in found.laws
        for constant in (*one.constants, *one.deviations)
    )


def forecasts_table(found: Judgement) -> pd.DataFrame:
    """Return every reading beside its forecast by the best law."""
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


def judgement_files(found: Judgement) -> dict[str, str]:
    """Return tables and summary, each as the content of a file."""
    return {
        "laws.csv": laws_table(found).csv(),
        "constants.csv": csv_of(constants_table(found)),
        "forecasts.csv": csv_of(forecasts_table(found)),
        "summary.md": fenced(judgement_text(found, explain=True)),
    }
