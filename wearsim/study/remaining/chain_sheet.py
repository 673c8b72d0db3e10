"""The state of a chain as text, JSON, tables and a picture."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped
from wearsim.readings.chain_readings import GAUGE
from wearsim.readings.relubrications import relubrication_rows
from wearsim.report.text_lines import numbered_assumptions, row
from wearsim.study.remaining.chain_state import ChainState, Quantiles

_DIGITS = {"elongation_percent": 3, "coefficient_factor": 3}
"""Digits of what is no time."""

_WORDS = {
    "remaining_km": ("In service", "{} km"),
    "end_date": ("Until", "{}"),
    "elongation_percent": ("Now", "{} % longer"),
    "life_hours": ("Life", "{} h in all"),
    "coefficient_factor": ("Coefficient", "{} times the case's"),
}


def chain_text(found: ChainState) -> str:
    """Return the answer as ``wearsim remaining`` prints it with a table of readings."""
    left = found.of("remaining_hours")
    today = grouped(found.log.relubrications.today)
    rows = [
        ("Remaining", f"{_shown(left)[2]} h of the chain after {today} h{_intervals(left)}"),
        *(
            (label, form.format(_shown(one)[2]) + _intervals(one))
            for one in found.quantiles
            if one.name in _WORDS
            for label, form in [_WORDS[one.name]]
        ),
        ("Readings", counted_readings(found)),
        *relubrication_rows(found.log.relubrications),
        ("Assumes", numbered_assumptions(found.assumptions)),
        ("Warnings", "; ".join(found.warnings) or "none"),
    ]
    return "\n".join([found.case.title, *(row(label, text) for label, text in rows)])


def counted_readings(found: ChainState) -> str:
    """Return how many readings of each kind there are."""
    gauges = sum(one.quantity == GAUGE for one in found.log.readings)
    measured = len(found.log.readings) - gauges
    widened = found.posterior.scale
    return f"{measured} measured, {gauges} by a gauge" + (
        f", errors taken {widened:.3g} times as large" if widened > 1.0 else ""
    )


def chain_json(found: ChainState) -> dict[str, Any]:
    """Return the answer as ``wearsim remaining --json`` prints it with a table of readings."""
    left, life = found.of("remaining_hours"), found.of("life_hours")
    return {
        **ANSWER_HEAD,
        "case": found.case.name,
        "title": found.case.title,
        "part": "chain",
        "reading_hours": found.log.relubrications.today,
        "life_hours": life.middle,
        "remaining_hours": left.middle,
        "remaining_hours_low": left.values[0],
        "remaining_hours_high": left.values[-1],
        "intervals": interval_rows(found),
        "readings": reading_rows(found),
        "relubrications": len(found.log.relubrications.hours),
        "error_scale": found.posterior.scale,
        "assumptions": list(found.assumptions),
        "warnings": list(found.warnings),
    }


def interval_rows(found: ChainState) -> list[dict[str, Any]]:
    """Return a row for each quantity that is told, with its quantiles."""
    names = ("p05", "p25", "p50", "p75", "p95")
    return [
        {"quantity": one.name, **dict(zip(names, _plain(one.values), strict=True))} for one in found.quantiles
    ]


def reading_rows(found: ChainState) -> list[dict[str, Any]]:
    """Return each reading as an elongation, beside what the median coefficient says."""
    factor = found.of("coefficient_factor").middle
    assert isinstance(factor, float)
    return [
        {
            "reading_row": one.line,
            "time_hours": one.hours,
            "quantity": one.quantity,
            "elongation_percent": one.mark,
            "result": one.result,
            "error": one.error,
            "predicted": factor * expected,
        }
        for one, expected in zip(found.log.readings, found.expected, strict=True)
    ]


def write_chain(found: ChainState, place: Path) -> None:
    """Write tables, summary and picture into a folder."""
    import pandas as pd

    from wearsim.report.figures import save_figure
    from wearsim.study.remaining.figure import chain_figure

    pd.DataFrame(interval_rows(found)).to_csv(place / "intervals.csv", index=False)
    pd.DataFrame(reading_rows(found)).to_csv(place / "readings.csv", index=False)
    (place / "summary.md").write_text(f"```\n{chain_text(found)}\n```\n", encoding="utf-8")
    save_figure(chain_figure(found), place, "readings")


def _intervals(one: Quantiles) -> str:
    p05, p25, _, p75, p95 = _shown(one)
    return f"   (50 %: {p25} to {p75}, 90 %: {p05} to {p95})"


def _shown(one: Quantiles) -> list[str]:
    digits = _DIGITS.get(one.name, 4)
    return [
        (value or "beyond the calendar") if isinstance(value, str) else grouped(value, digits)
        for value in one.values
    ]


def _plain(values: Iterable[float | str]) -> list[float | str | None]:
    return [None if value == "" else value for value in values]
