"""A drive whose coefficients are those that its readings stand for."""

from pathlib import Path
from typing import Any

from wearsim.case.model import Case
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.wrap_life import wrap_of
from wearsim.lubrication.keys import SCHEDULES
from wearsim.readings.chain_state import ChainState
from wearsim.readings.teeth_as_read import Teeth
from wearsim.runner.scatter import coefficient_key


def drive_as_read(given: Case | DriveCase, state: ChainState, teeth: Teeth) -> Case | DriveCase:
    """Return a case or a drive with the median coefficient of its readings, and relubricated as they say."""
    first, factor = given.chain_case, state.factor
    here = wrap_of(first).referred_here
    changes: dict[str, Any] = {key: factor * value for key, value in here.wear_coefficients.items()}
    changes |= here.wear_settings
    changes["joint.source"] = f"readings in {Path(state.log.file).name}"
    if teeth == "chain":
        changes |= _of_teeth(given, factor)
    if state.log.times_relubricated:
        known = first.inputs.get("lubrication") or {}
        changes |= {f"lubrication.{key}": None for key in SCHEDULES if key in known}
        changes |= {f"lubrication.{key}": value for key, value in state.log.schedule.items()}
    return given.with_(changes)


def _of_teeth(given: Case | DriveCase, factor: float) -> dict[str, Any]:
    """Return coefficients of teeth times a factor; a wear condition stays, as its law does."""
    first = given.chain_case
    key = coefficient_key(first)
    found = {key: factor * first.wear.coefficient}
    wheels, cases = (given.wheels, given.single_cases) if isinstance(given, DriveCase) else ((), {})
    for number, wheel in enumerate(wheels, start=1):
        if wheel.table.wear is None:
            continue
        own = cases[wheel.parts[0]]
        found[f"sprocket.{number}.{coefficient_key(own)}"] = factor * own.wear.coefficient
    condition = (first.inputs.get("wear") or {}).get("condition")
    return {**found, **({"wear.condition": condition} if condition else {})}
