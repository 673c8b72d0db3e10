"""What happens to a drive when: bedding-in, elongations, ends of parts, relubrications, with their days."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from wearsim.geometry.profile_points import Vector
from wearsim.quantities import grouped
from wearsim.result import Life, LowerBound
from wearsim.result.service import service_measures

BEDDING_IN_HOURS = 20.0
"""Running time in which a new chain beds in by up to 0.1 %, which no life counts (Tsubaki)."""

_TOLD = {1.0: "1 %", 1.5: "1.5 %, limit of fixed centres; wear often goes faster from here on"}
"""Elongations [%] that are told on the way to the limit."""


@dataclass(frozen=True)
class Event:
    """Something that happens to a part."""

    hours: float  # of running
    part: str
    event: str
    date: str = ""  # empty where no day is known to begin


def drive_events(
    inputs: Mapping[str, Any],
    history: Mapping[str, Vector],
    chain: Life | LowerBound,
    limit: float,
    sprockets: Mapping[str, Life | LowerBound],
) -> tuple[Event, ...]:
    """Return what happens to a chain drive until its parts are replaced first, in the order of time.

    Parameters
    ----------
    inputs : mapping
        Tables of the case; [service] gives days, [lubrication] relubrications.
    history : mapping
        Columns of the history of a sprocket, of which the first chain is read.
    chain : Life or LowerBound
        Life of a chain.
    limit : float
        Elongation at which that ends [%].
    sprockets : mapping
        Lives of the sprockets by their names.
    """
    found = [(BEDDING_IN_HOURS, "chain", "bedding-in over: up to 0.1 % of elongation, which no life counts")]
    for elongation, text in _TOLD.items():
        if elongation < limit:
            found.append((_hours_at(elongation, history, chain, limit), "chain", f"grown by {text}"))
    if isinstance(chain, Life):
        found.append((chain.hours, "chain", f"grown by {limit:.3g} %: replace it"))
    found += [
        (life.hours, name, "teeth worn to their limit: replace it")
        for name, life in sprockets.items()
        if isinstance(life, Life)
    ]
    found += _relubrications(inputs)
    return tuple(
        Event(hours, part, text, str(service_measures(inputs, hours).get("date", "")))
        for hours, part, text in sorted(found)
    )


def _hours_at(
    elongation: float, history: Mapping[str, Vector], chain: Life | LowerBound, limit: float
) -> float:
    """Return when the first chain has grown so much [h]."""
    first = history["chain"] == 1
    hours, grown = history["time_hours"][first], history["elongation_percent"][first]
    if isinstance(chain, Life):
        hours, grown = np.append(hours, chain.hours), np.append(grown, limit)
    return float(np.interp(elongation, grown, hours))


def _relubrications(inputs: Mapping[str, Any]) -> list[tuple[float, str, str]]:
    """Return the first relubrication, and how often they come."""
    table = inputs.get("lubrication") or {}
    per_hour = (inputs.get("service") or {}).get("km_per_hour", 0.0)
    times = [*table.get("at_hours", ()), *(km / per_hour for km in table.get("at_km", ()) if per_hour)]
    every = table.get("interval_hours") or (table.get("interval_km", 0.0) / per_hour if per_hour else 0.0)
    if times:
        return [(hours, "drive", "relubrication") for hours in times]
    return [(every, "drive", f"relubrication, then every {grouped(every)} h")] if every else []


EVENT_HEAD = ("at", "day", "part", "event")
"""Heads of `event_rows`."""


def event_rows(events: Sequence[Event]) -> list[tuple[str, str, str, str]]:
    """Return hours, day, part and what happens in words."""
    return [(f"{grouped(one.hours)} h", one.date or "-", one.part, one.event) for one in events]


def events_json(events: Sequence[Event]) -> list[dict[str, Any]]:
    """Return events as JSON."""
    return [asdict(one) for one in events]
