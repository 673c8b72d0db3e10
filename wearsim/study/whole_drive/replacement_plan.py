"""What is replaced when, as long as every new part lives like the first one."""

import math
from dataclasses import dataclass

from wearsim.result import Life
from wearsim.study.whole_drive.model import DriveLife

CHAINS, YEARS = 3, 10.0
"""A plan ends with this chain or after these years in service, whichever is sooner."""

_DAYS = 365.25
_SAME = 1e-9
"""Part of a life by which two replacements at the same time may differ."""


@dataclass(frozen=True)
class Replacement:
    """Parts that are replaced at the same time."""

    hours: float
    parts: tuple[str, ...]  # by their names, the chain first
    chain: int  # how many chains have run until then, the present one included


def plan_ends(found: DriveLife) -> dict[str, float]:
    """Return the hours in which a plan can end by what they are, those of the run where neither is known."""
    ends = {}
    if isinstance(found.chain, Life):
        ends[f"{CHAINS} chains"] = CHAINS * found.chain.hours
    service = found.drive.inputs.get("service") or {}
    if "hours_per_day" in service:
        ends[f"{YEARS:g} years"] = YEARS * _DAYS * service["hours_per_day"]
    return ends or {"all that the runs cover": max(life.hours_run for life in found.parts.values())}


def plan_hours(found: DriveLife) -> float:
    """Return how far a plan reaches: three chains, or ten years where the hours of a day are known."""
    return min(plan_ends(found).values())


def replacements(found: DriveLife) -> tuple[Replacement, ...]:
    """Return what is replaced within a plan, in the order of time."""
    until = plan_hours(found) * (1.0 + _SAME)
    at = sorted(
        (count * life.hours, place, name)
        for place, (name, life) in enumerate(found.parts.items())
        if isinstance(life, Life) and life.hours > 0.0
        for count in range(1, math.floor(until / life.hours) + 1)
    )
    rows: list[Replacement] = []
    for hours, _, name in at:
        if rows and hours <= rows[-1].hours * (1.0 + _SAME):
            rows[-1] = Replacement(rows[-1].hours, (*rows[-1].parts, name), rows[-1].chain)
        else:
            rows.append(Replacement(hours, (name,), chain_at(found, hours)))
    return tuple(rows)


def chain_at(found: DriveLife, hours: float) -> int:
    """Return the number of the chain that runs until a time."""
    if not isinstance(found.chain, Life):
        return 1
    return max(1, math.ceil(hours / found.chain.hours * (1.0 - _SAME)))
