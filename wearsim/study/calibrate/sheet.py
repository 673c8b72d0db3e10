"""What is shown of a calibration: text, JSON, tables, and the case with the fitted values."""

from itertools import starmap
from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped
from wearsim.readings.relubrications import relubrication_rows
from wearsim.report.answer_table import AnswerTable, Column
from wearsim.report.text_lines import Finding, answer_text, closing, fenced
from wearsim.result.folder import with_files
from wearsim.study.calibrate.calibration import Calibration, FittedCoefficient, PartLife
from wearsim.study.calibrate.least_squares import ConfidenceInterval
from wearsim.study.calibrate.observations import ReadingResidual


def calibration_text(found: Calibration, explain: bool = False) -> str:
    """Return the answer as ``wearsim calibrate`` prints it."""
    share = f"{100 * found.options.confidence:g} %"
    rows = []
    for part in found.parts:
        rows += [
            Finding(
                "Remaining",
                f"{_hours(part.remaining)} of the {part.name} after {_hours(part.hours)}   "
                f"({share}: {_ends(part.band, grouped)} h)",
            ),
            Finding(
                "Life",
                f"{_hours(part.life)} of the {part.name} in total   "
                f"({share}: {_ends(part.interval, grouped)} h)",
            ),
        ]
    rows += [
        Finding(
            "Fitted",
            f"{value.key} = {value.value:.4g}   ({share}: {_ends(value.interval, _digits)}), "
            f"{value.value / value.in_case:.3g} times the case's"
            + (value.holds_at and f"; {value.holds_at}"),
        )
        for value in found.values
    ]
    widened = f", errors taken {found.scale:.3g} times as large" if found.scale > 1.0 else ""
    rows += [
        Finding(
            "Fit",
            f"{found.readings} readings, chi-square {found.chi_square:.4g} with {found.freedom} degrees "
            f"of freedom{widened}",
        ),
        *starmap(Finding, relubrication_rows(found.relubrications, len(found.relubrications.hours))),
        *(
            Finding("Moved", f"profile of line {line} by {turn:.3g} rad, {x:.3g} and {y:.3g} mm")
            for line, turn, x, y in found.moves
        ),
        *closing(found.assumptions, found.warnings, explain),
    ]
    return answer_text(found.case.title, *rows)


def calibration_json(found: Calibration) -> dict[str, Any]:
    """Return the answer as ``wearsim calibrate --json`` prints it."""
    return {
        **ANSWER_HEAD,
        "case": found.case.name,
        "title": found.case.title,
        "confidence": found.options.confidence,
        "values": values_table(found).records(),
        "parts": parts_table(found).records(),
        "moves": [
            dict(zip(("reading_row", "turn_rad", "shift_x_mm", "shift_y_mm"), one, strict=True))
            for one in found.moves
        ],
        "readings": found.readings,
        "relubrications": len(found.relubrications.hours),
        "chi_square": found.chi_square,
        "degrees_of_freedom": found.freedom,
        "error_scale": found.scale,
        "runs": found.runs,
        "assumptions": list(found.assumptions),
        "warnings": list(found.warnings),
    }


def readings_table(found: Calibration) -> AnswerTable[ReadingResidual]:
    """Return every value beside its prediction."""
    return AnswerTable(
        [
            Column("reading_row", lambda one: one.row),
            Column("time_hours", lambda one: one.hours),
            Column("quantity", lambda one: one.quantity),
            Column("arc_length_mm", lambda one: one.arc_length),
            Column("value", lambda one: one.value),
            Column("predicted", lambda one: one.predicted),
            Column("error", lambda one: one.error),
            Column("standard_residual", lambda one: one.residual),
        ],
        found.shown,
    )


def values_table(found: Calibration) -> AnswerTable[FittedCoefficient]:
    """Return the fitted values."""
    return AnswerTable(
        [
            Column("key", lambda one: one.key),
            Column("value", lambda one: one.value),
            Column("given", lambda one: one.in_case),
            Column("low", lambda one: _known(one.interval)[0]),
            Column("high", lambda one: _known(one.interval)[1]),
            Column("holds_at", lambda one: one.holds_at),
        ],
        found.values,
    )


def parts_table(found: Calibration) -> AnswerTable[PartLife]:
    """Return life and hours left of each part."""
    return AnswerTable(
        [
            Column("part", lambda one: one.name),
            Column("reading_hours", lambda one: one.hours),
            Column("life_hours", lambda one: one.life),
            Column("life_hours_low", lambda one: _known(one.interval)[0]),
            Column("life_hours_high", lambda one: _known(one.interval)[1]),
            Column("remaining_hours", lambda one: one.remaining),
            Column("remaining_hours_low", lambda one: _known(one.band)[0]),
            Column("remaining_hours_high", lambda one: _known(one.band)[1]),
        ],
        found.parts,
    )


def calibration_files(found: Calibration) -> dict[str, str]:
    """Return tables, summary and the case with the fitted values, each as the content of a file."""
    return {
        "fit.csv": readings_table(found).csv(),
        "fitted_values.csv": values_table(found).csv(),
        "summary.md": fenced(calibration_text(found, explain=True)),
        "calibrated.toml": _case(found),
    }


def _case(found: Calibration) -> str:
    import tomlkit

    document = tomlkit.document()
    document.add(tomlkit.comment(f"{found.case.name} calibrated by wearsim"))
    for key, value in with_files(found.tables, "inputs").items():
        document.add(key, value)
    return tomlkit.dumps(document)


def _known(interval: ConfidenceInterval) -> tuple[float | None, float | None]:
    """Return the ends of an interval that the data give."""
    return interval.low if interval.low_known else None, interval.high if interval.high_known else None


def _hours(value: float) -> str:
    return f"{grouped(value)} h"


def _digits(value: float) -> str:
    return f"{value:.4g}"


def _ends(interval: ConfidenceInterval, shown: Any) -> str:
    low = shown(interval.low) if interval.low_known else "?"
    high = shown(interval.high) if interval.high_known else "?"
    return f"{low} to {high}"
