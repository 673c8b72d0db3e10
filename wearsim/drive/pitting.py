"""Contact fatigue beside the wear of a case: hours until pitting, and a warning where it is first."""

from collections.abc import Sequence

from wearsim.case.model import Case, FatigueInput
from wearsim.fatigue.contact_fatigue import hardness_warnings
from wearsim.fatigue.endurance import EnduredHours
from wearsim.result import Life, LowerBound, life_of

Stresses = Sequence[tuple[float, float]]
"""Highest pressures on a new flank under the loads of a duty, with the load factor [MPa], each with
its share of the cycles."""


def fatigue_parts(
    case: Case,
    fatigue: FatigueInput,
    stresses: Stresses,
    life: Life | LowerBound,
    sprocket: Life | LowerBound,
) -> tuple[dict[str, Life | LowerBound], list[str]]:
    """Return the lives of a case until pitting."""
    rate = case.cycles_per_hour
    endured = case.drive.fatigue_lives(case, fatigue, stresses)
    warnings = hardness_warnings(fatigue.materials)
    first = min((found.hours for found in endured.values()), default=0.0)
    for name, found in endured.items():
        warnings += _early(name, found, found.hours == first < life.hours_run, sprocket)
    lives = {
        f"{name}_fatigue": life_of(found.hours * rate, rate, not found.bound)
        for name, found in endured.items()
    }
    return lives, warnings


def _early(name: str, found: EnduredHours, governs: bool, sprocket: Life | LowerBound) -> list[str]:
    if found.hours == 0.0:
        return [f"contact fatigue: the stress on the new flank is too high for the {name} from the start"]
    if found.bound or found.hours >= sprocket.hours_run:
        return []
    after = f"after {found.hours:.3g} h"
    if governs:
        return [f"contact fatigue of the {name} ends the life before wear, {after}: it governs"]
    return [f"contact fatigue of the {name} ends its life before wear, {after}"]
