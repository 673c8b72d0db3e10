"""What is shown of a calibration: text, JSON, tables, and the case with the fitted values."""

from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import pandas as pd

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped
from wearsim.readings.relubrications import relubrication_rows
from wearsim.report.study_files import plain
from wearsim.report.text_lines import numbered_assumptions, row
from wearsim.result.folder import with_files
from wearsim.study.calibrate.calibration import Calibration, FittedCoefficient, PartLife
from wearsim.study.calibrate.least_squares import ConfidenceInterval


def calibration_text(found: Calibration) -> str:
    """Return the answer as ``wearsim calibrate`` prints it."""
    share = f"{100 * found.options.confidence:g} %"
    rows = []
    for part in found.parts:
        rows += [
            (
                "Remaining",
                f"{_hours(part.remaining)} of the {part.name} after {_hours(part.hours)}   "
                f"({share}: {_ends(part.band, grouped)} h)",
            ),
            (
                "Life",
                f"{_hours(part.life)} of the {part.name} in all   "
                f"({share}: {_ends(part.interval, grouped)} h)",
            ),
        ]
    rows += [
        (
            "Fitted",
            f"{value.key} = {value.value:.4g}   ({share}: {_ends(value.interval, _digits)}), "
            f"{value.value / value.in_case:.3g} times the case's"
            + (value.holds_at and f"; {value.holds_at}"),
        )
        for value in found.values
    ]
    widened = f", errors taken {found.scale:.3g} times as large" if found.scale > 1.0 else ""
    rows += [
        (
            "Fit",
            f"{found.readings} readings, chi-square {found.chi_square:.4g} with {found.freedom} degrees "
            f"of freedom{widened}",
        ),
        *relubrication_rows(found.relubrications),
        *(
            ("Moved", f"profile of line {line} by {turn:.3g} rad, {x:.3g} and {y:.3g} mm")
            for line, turn, x, y in found.moves
        ),
        ("Assumes", numbered_assumptions(found.assumptions)),
        ("Warnings", "; ".join(found.warnings) or "none"),
    ]
    return "\n".join([found.case.title, *(row(label, text) for label, text in rows)])


def calibration_json(found: Calibration) -> dict[str, Any]:
    """Return the answer as ``wearsim calibrate --json`` prints it."""
    return {
        **ANSWER_HEAD,
        "case": found.case.name,
        "title": found.case.title,
        "confidence": found.options.confidence,
        "values": [{name: plain(value) for name, value in _value(one).items()} for one in found.values],
        "parts": [_part(part) for part in found.parts],
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


def readings_table(found: Calibration) -> pd.DataFrame:
    """Return every value beside its prediction."""
    return pd.DataFrame(
        {
            "reading_row": one.row,
            "time_hours": one.hours,
            "quantity": one.quantity,
            "arc_length_mm": one.arc_length,
            "value": one.value,
            "predicted": one.predicted,
            "error": one.error,
            "standard_residual": one.residual,
        }
        for one in found.shown
    )


def values_table(found: Calibration) -> pd.DataFrame:
    """Return the fitted values."""
    return pd.DataFrame([_value(one) for one in found.values])


def write_calibration(found: Calibration, place: Path) -> None:
    """Write tables, pictures and the case with the fitted values into a folder."""
    from wearsim.report.figures import save_figure
    from wearsim.study.calibrate.figure import calibration_figures

    readings_table(found).to_csv(place / "fit.csv", index=False)
    values_table(found).to_csv(place / "fitted_values.csv", index=False)
    summary = f"```\n{calibration_text(found)}\n```\n"
    (place / "summary.md").write_text(summary, encoding="utf-8")
    (place / "calibrated.toml").write_text(_case(found), encoding="utf-8")
    for path in found.case.files:
        (place / "inputs").mkdir(exist_ok=True)
        (place / "inputs" / path.name).write_bytes(path.read_bytes())
    for name, figure in calibration_figures(found).items():
        save_figure(figure, place, name)


def _case(found: Calibration) -> str:
    import tomlkit

    document = tomlkit.document()
    document.add(tomlkit.comment(f"{found.case.name} calibrated by wearsim"))
    for key, value in with_files(found.tables, "inputs").items():
        document.add(key, value)
    return tomlkit.dumps(document)


def _value(one: FittedCoefficient) -> Mapping[str, Any]:
    known = _known(one.interval)
    return {
        "key": one.key,
        "value": one.value,
        "given": one.in_case,
        "low": known["low"],
        "high": known["high"],
        "holds_at": one.holds_at,
    }


def _part(part: PartLife) -> Mapping[str, Any]:
    left, life = _known(part.band), _known(part.interval)
    return {
        "part": part.name,
        "reading_hours": part.hours,
        "life_hours": part.life,
        "life_hours_low": life["low"],
        "life_hours_high": life["high"],
        "remaining_hours": part.remaining,
        "remaining_hours_low": left["low"],
        "remaining_hours_high": left["high"],
    }


def _known(interval: ConfidenceInterval) -> dict[str, float | None]:
    ends = asdict(interval)
    return {end: ends[end] if ends[f"{end}_known"] else None for end in ("low", "high")}


def _hours(value: float) -> str:
    return f"{grouped(value)} h"


def _digits(value: float) -> str:
    return f"{value:.4g}"


def _ends(interval: ConfidenceInterval, shown: Any) -> str:
    low = shown(interval.low) if interval.low_known else "?"
    high = shown(interval.high) if interval.high_known else "?"
    return f"{low} to {high}"
