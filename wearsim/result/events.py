"""What happens to a drive when: bedding-in, elongations, ends of parts, relubrications, with their days."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from wearsim.geometry.profile_points import Vector
from wearsim.quantities import grouped
from wearsim.result.ends import CHAIN, JOINT_WEAR, TOOTH_WEAR, PartEnd
from wearsim.result.lives import service_measures

BEDDING_IN_HOURS = 20.0
"""Running time in which a new chain beds in by up to 0.1 %, not counted in the life (Tsubaki)."""

_TOLD = {1.0: "1 %", 1.5: "1.5 %, limit of fixed centres; wear often accelerates from here on"}
"""Elongations [%] that are told on the way to the limit."""


@dataclass(frozen=True)
class Event:
    """Something that happens to a part."""

    hours: float | None  # of running; None where they are not known
    part: str
    event: str
    date: str = ""  # empty where no day is known to begin


def drive_events(
    inputs: Mapping[str, Any],
    history: Mapping[str, Vector],
    limit: float,
    ends: Sequence[PartEnd],
    replaced: Mapping[str, float] | None = None,
) -> tuple[Event, ...]:
    """Return what happens to a chain drive until its parts are replaced first, in the order of time.

    Parameters
    ----------
    inputs : mapping
        Tables of the case; [service] gives days, [lubrication] relubrications.
    history : mapping
        Columns of the history of a sprocket, of which the first chain is read.
    limit : float
        Elongation at which a chain is worn out [%].
    ends : sequence of PartEnd
        What may end the parts, that which comes first at the head.
    replaced : mapping, optional
        Hours at which a plan replaces parts first.
    """
    first = {end.part: end for end in reversed(ends) if end.ends}
    gone = {name: end.hours or 0.0 for name, end in first.items()} | dict(replaced or {})
    found: list[tuple[float | None, str, str]] = [
        (hours, CHAIN, text)
        for hours, text in _of_the_first_chain(inputs, history, limit, ends)
        if hours < gone.get(CHAIN, math.inf)
    ]
    for name, hours in gone.items():
        found.append((hours, name, _end_text(first[name], limit, None if replaced is None else hours)))
    found += _relubrications(inputs)
    return tuple(
        Event(hours, part, text, str(service_measures(inputs, hours).get("date", "")) if hours else "")
        for hours, part, text in sorted(found, key=lambda one: (one[0] is None, one))
    )


def _of_the_first_chain(
    inputs: Mapping[str, Any], history: Mapping[str, Vector], limit: float, ends: Sequence[PartEnd]
) -> Iterator[tuple[float, str]]:
    """Give when the first chain has bedded in and grown so much, as far as its run goes."""
    given = inputs["wear"].get("running_in_factor")
    counted = "counted by running_in_factor" if given else "not counted in the life"
    yield BEDDING_IN_HOURS, f"end of bedding-in: up to 0.1 % of elongation, {counted}"
    own = history["chain"] == 1
    hours, grown = history["time_hours"][own], history["elongation_percent"][own]
    worn = next((end.hours for end in ends if end.mode == JOINT_WEAR and end.ends), None)
    if worn is not None:
        hours, grown = np.append(hours, worn), np.append(grown, limit)
    for elongation, text in _TOLD.items():
        if elongation < limit and elongation <= grown[-1]:
            yield float(np.interp(elongation, grown, hours)), f"elongation {text}"


def _end_text(end: PartEnd, limit: float, replaced: float | None) -> str:
    """Return in words what a part comes to at its end, and that it is replaced then or before."""
    worn = {JOINT_WEAR: f"elongation {limit:.3g} %", TOOTH_WEAR: "teeth worn to their limit"}
    what, at = worn.get(end.mode, end.mode), end.hours or 0.0
    if replaced is None:
        return f"{what}: {'worn out' if end.mode in worn else 'at its end'}"
    return f"{what}: replace it" if math.isclose(replaced, at) else f"replace it; {what} at {grouped(at)} h"


def _relubrications(inputs: Mapping[str, Any]) -> Iterator[tuple[float | None, str, str]]:
    """Give the times of relubrication, and how often they come from then on."""
    table = inputs.get("lubrication") or {}
    per_hour = (inputs.get("service") or {}).get("km_per_hour", math.nan)
    times = [*table.get("at_hours", ()), *(km / per_hour for km in table.get("at_km", ()))]
    for hours in times:
        yield hours, "drive", "relubrication"
    every = table.get("interval_hours") or table.get("interval_km", 0.0) / per_hour
    if every > 0.0:
        yield max(times, default=0.0) + every, "drive", f"relubrication, then every {grouped(every)} h"
    if "interval_sliding_m" in table:
        yield None, "drive", f"relubrication every {grouped(table['interval_sliding_m'])} m of sliding"
    if "when_rate_exceeds" in table:
        rate = grouped(table["when_rate_exceeds"])
        yield None, "drive", f"relubrication as soon as the contacts wear {rate} times as fast"


EVENT_HEAD = ("at", "day", "part", "event")
"""Heads of `event_rows`."""


def event_rows(events: Sequence[Event]) -> list[tuple[str, str, str, str]]:
    """Return hours, day, part and what happens in words."""
    return [
        ("-" if one.hours is None else f"{grouped(one.hours)} h", one.date or "-", one.part, one.event)
        for one in events
    ]


def events_json(events: Sequence[Event]) -> list[dict[str, Any]]:
    """Return events as JSON."""
    return [asdict(one) for one in events]
