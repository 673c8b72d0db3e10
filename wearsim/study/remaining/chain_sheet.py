"""The state of a chain as text, JSON, tables and a picture."""

from functools import partial
from itertools import starmap
from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped
from wearsim.readings.chain_readings import GAUGE, ChainReading
from wearsim.readings.chain_state import ChainNow, ChainState, Quantiles
from wearsim.readings.posterior import LEVELS
from wearsim.readings.relubrications import relubrication_rows
from wearsim.report.answer_table import AnswerTable, Column
from wearsim.report.text_lines import Finding, answer_text, closing, fenced

_DIGITS = {"elongation_percent": 3, "coefficient_factor": 3}
"""Digits of what is no time."""

_MEDIAN = len(LEVELS) // 2

_WORDS = {
    "remaining_km": ("In service", "{} km"),
    "remaining_hours_of_all": ("All chains", "{} h left together"),
    "end_date": ("Until", "{}"),
    "elongation_percent": ("Now", "{} % elongation"),
    "life_hours": ("Life", "{} h in total"),
    "coefficient_factor": ("Coefficient", "{} times the case's"),
}


def chain_text(found: ChainState, explain: bool = False) -> str:
    """Return the answer as ``wearsim remaining`` prints it with a table of readings."""
    left = found.of("remaining_hours")
    of_which, today = _chain(found), grouped(found.log.today)
    rows = [
        Finding("Remaining", f"{_shown(left)[2]} h of {of_which} after {today} h{_intervals(left)}"),
        *(
            Finding(label, form.format(_shown(one)[2]) + _intervals(one))
            for one in found.quantiles
            if one.name in _WORDS
            for label, form in [_WORDS[one.name]]
        ),
        *_chains(found),
        Finding("Readings", counted_readings(found)),
        *starmap(Finding, relubrication_rows(found.log.relubrications, found.log.times_relubricated)),
        *closing(found.assumptions, found.warnings, explain),
    ]
    return answer_text(found.case.title, *rows)


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
        "reading_hours": found.log.today,
        "life_hours": life.middle,
        "remaining_hours": left.middle,
        "remaining_hours_low": left.values[0],
        "remaining_hours_high": left.values[-1],
        "intervals": intervals_table(found).records(),
        "readings": readings_table(found).records(),
        "chains": chains_table(found).records(),
        "relubrications": found.log.times_relubricated,
        "error_scale": found.posterior.scale,
        "assumptions": list(found.assumptions),
        "warnings": list(found.warnings),
    }


def intervals_table(found: ChainState) -> AnswerTable[Quantiles]:
    """Return a row for each quantity that is told, with its quantiles."""
    names = ("p05", "p25", "p50", "p75", "p95")
    return AnswerTable(
        [
            Column("quantity", lambda one: one.name),
            *(Column(name, partial(_level, at)) for at, name in enumerate(names)),
        ],
        found.quantiles,
    )


def _chain(found: ChainState) -> str:
    rotation = found.log.rotation
    return "the chain" if rotation is None else f"chain {rotation.mounted}, which is on the drive,"


def _chains(found: ChainState) -> list[Finding]:
    """Return where each chain in rotation stands."""
    rows = []
    for name, one in _in_rotation(found):
        grown, left = Quantiles("elongation_percent", one.elongation), Quantiles("remaining_hours", one.left)
        after = f"{_shown(grown)[2]} % longer after {grouped(one.run)} h"
        rows.append(Finding(f"Chain {name}", f"{after}, {_shown(left)[2]} h left{_intervals(left)}"))
    return rows


def _in_rotation(found: ChainState) -> list[tuple[str, ChainNow]]:
    return list(found.chains.items()) if found.log.rotation else []


def chains_table(found: ChainState) -> AnswerTable[tuple[str, ChainNow]]:
    """Return a row for each chain in rotation; none of a single chain."""
    return AnswerTable(
        [
            Column("chain", lambda one: one[0]),
            Column("used_hours", lambda one: one[1].run),
            Column("elongation_percent", lambda one: one[1].elongation[_MEDIAN]),
            Column("remaining_hours", lambda one: one[1].left[_MEDIAN]),
        ],
        _in_rotation(found),
    )


def _level(at: int, one: Quantiles) -> float | str | None:
    """Return one of the quantiles, None of a day that no calendar has."""
    return None if one.values[at] == "" else one.values[at]


def readings_table(found: ChainState) -> AnswerTable[tuple[ChainReading, float]]:
    """Return each reading as an elongation, beside what the median coefficient says."""
    return AnswerTable(
        [
            Column("reading_row", lambda one: one[0].line),
            Column("time_hours", lambda one: one[0].hours),
            Column("quantity", lambda one: one[0].quantity),
            Column("elongation_percent", lambda one: one[0].mark),
            Column("result", lambda one: one[0].result),
            Column("error", lambda one: one[0].error),
            Column("predicted", lambda one: found.factor * one[1]),
        ],
        list(zip(found.log.readings, found.expected, strict=True)),
    )


def chain_files(found: ChainState) -> dict[str, str]:
    """Return tables and summary, each as the content of a file."""
    return {
        "intervals.csv": intervals_table(found).csv(),
        "readings.csv": readings_table(found).csv(),
        **({"chains.csv": chains_table(found).csv()} if found.log.rotation else {}),
        "summary.md": fenced(chain_text(found, explain=True)),
    }


def _intervals(one: Quantiles) -> str:
    p05, p25, _, p75, p95 = _shown(one)
    return f"   (50 %: {p25} to {p75}, 90 %: {p05} to {p95})"


def _shown(one: Quantiles) -> list[str]:
    digits = _DIGITS.get(one.name, 4)
    return [
        (value or "beyond the calendar") if isinstance(value, str) else grouped(value, digits)
        for value in one.values
    ]
