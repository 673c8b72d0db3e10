"""How near every stop limit is when the life ends."""

from dataclasses import dataclass

import numpy as np

from wearsim.case.model import Case
from wearsim.contact.stop_limits import LIMITS
from wearsim.quantities import grouped
from wearsim.report.answer import JUMPING, limit_name, limit_state, slack_needed
from wearsim.result import WearResult


@dataclass(frozen=True)
class Margin:
    """A limit and what is left to it."""

    name: str  # the limit in words, of jumping with its margin, and its unit
    unit: str  # the limit in words, of jumping with its margin, and its unit
    limit: str  # its value, what the quantity has come to, and how far that is from the limit
    value: str  # its value, what the quantity has come to, and how far that is from the limit
    left: str  # its value, what the quantity has come to, and how far that is from the limit
    used: float  # part of the way from new to the limit that is gone, from 0 to 1
    ended: bool  # whether it ended the life


def margins(result: WearResult, case: Case) -> list[Margin]:
    """Return every limit of a result and how far its quantity is from it."""
    found = []
    for state in result.limits:
        name, unit = limit_name(state.name)
        value = grouped(state.value, 3)
        if state.name == JUMPING:
            name, _, _ = limit_state(state, result.inputs).partition(" (")
            value = slack_needed(state.value, state.limit)
        start = _when_new(state.name, case)
        way = state.limit - start
        used = (state.value - start) / way if way else 1.0
        found.append(
            Margin(
                name=name,
                unit=unit,
                limit=grouped(state.limit, 3),
                value=value,
                left=grouped(state.left, 3),
                used=float(np.clip(used, 0.0, 1.0)),
                ended=state.name == result.stop,
            )
        )
    return found


def _when_new(name: str, case: Case) -> float:
    """What the quantity of a limit is on new teeth; 0 of all that grow."""
    row = LIMITS.get(name)
    return row.new(case.drive) if row and row.new and case.drive.has_tooth else 0.0
