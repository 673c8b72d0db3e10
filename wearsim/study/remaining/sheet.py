"""What is left of a life, as text and as JSON."""

from collections.abc import Mapping
from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped
from wearsim.report.answer import service_text
from wearsim.report.text_lines import Finding, answer_text, closing
from wearsim.result import Life, life_keys
from wearsim.result.lives import hours, service_keys
from wearsim.study.remaining.model import RemainingLife

_WORDS = {
    "max_depth_mm": "{} mm worn off",
    "over_pins_mm": "{} mm loss over pins",
    "elongation_percent": "{} % elongation",
}


def remaining_text(found: RemainingLife, inputs: Mapping[str, Any], explain: bool = False) -> str:
    """Return the answer as ``wearsim remaining`` prints it."""
    reading = found.reading
    band = f"{hours(found.remaining_low)} to {hours(found.remaining_high)}"
    what = _WORDS[reading.quantity].format(f"{reading.value:g}")
    service = service_text(inputs, found.remaining, reading.hours)
    rows = [
        Finding(
            "Remaining", f"{hours(found.remaining)} of the {found.part} after {grouped(reading.hours)} h"
        ),
        Finding("Band", f"{band}   (reading: {what}, +- {reading.error:g})"),
        *([Finding("In service", service)] if service else []),
        Finding("Life", f"{hours(found.life)} of the {found.part} in total"),
        Finding(
            "Coefficient",
            f"{found.coefficient:.4g}, {found.factor:.3g} times that of the case, which reaches this "
            f"reading after {grouped(found.model_hours)} h",
        ),
        *closing(found.assumptions, found.warnings, explain),
    ]
    return answer_text(found.title, *rows)


def remaining_json(found: RemainingLife, inputs: Mapping[str, Any]) -> dict[str, Any]:
    """Return the answer as ``wearsim remaining --json`` prints it."""
    reading = found.reading
    content = {
        **ANSWER_HEAD,
        "case": found.case,
        "title": found.title,
        "part": found.part,
        "quantity": reading.quantity,
        "reading": reading.value,
        "reading_error": reading.error,
        "reading_hours": reading.hours,
        "model_hours": found.model_hours,
        "coefficient": found.coefficient,
        "coefficient_factor": found.factor,
        "life_reached": isinstance(found.life, Life),
        **life_keys("life_hours", found.life),
        **life_keys("remaining_hours", found.remaining),
        **life_keys("remaining_hours_low", found.remaining_low),
        **life_keys("remaining_hours_high", found.remaining_high),
        "hours_run": found.life.hours_run,
    }
    return {
        **content,
        **service_keys(inputs, found.remaining, reading.hours),
        "assumptions": list(found.assumptions),
        "warnings": list(found.warnings),
    }
