"""Lives of the sprockets of a chosen drive, by wear of both of them on its chains."""

from collections.abc import Callable, Mapping
from typing import Any

from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_drive
from wearsim.quantities import grouped
from wearsim.result import Life, life_keys

_HORIZON = 2.0
"""Hours that the runs cover over those that the drive must live."""


def part_lives(
    tables: Mapping[str, Any], required: float, progress: Callable[[float], None]
) -> dict[str, Any]:
    """Return the lives of the chain and of both sprockets, and whether they are as long as required."""
    drive = load_drive({**tables, "run": {"horizon_hours": _HORIZON * required}})
    found = drive_life(drive, progress).complete()
    return {
        "parts": [{"name": name, **life_keys("life_hours", life)} for name, life in found.parts.items()],
        "long_enough": all(
            not isinstance(life, Life) or life.hours >= required for life in found.parts.values()
        ),
    }


def lives_text(verified: Mapping[str, Any]) -> str:
    """Return the lives of a drive in a line."""
    title = verified["title"]
    if "error" in verified:
        return f"{title}: wear calculation failed: {verified['error']}"
    parts = ", ".join(f"{part['name']} {_hours(part)} h" for part in verified["parts"])
    return f"{title}: {parts}" + ("" if verified["long_enough"] else "; NOT LONG ENOUGH")


def _hours(part: Mapping[str, Any]) -> str:
    known = part["life_hours"]
    return grouped(known) if known is not None else f"> {grouped(part['life_hours_at_least'])}"
