"""A life, or what is known of one that was not reached."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import date, timedelta
from typing import Any

from wearsim.errors import LimitNotReachedError
from wearsim.quantities import grouped


@dataclass(frozen=True)
class Life:
    """A life that was reached.

    Attributes
    ----------
    cycles : float
        Loading cycles of one gap.
    hours : float
        Running time [h], physics.md (13), of the source: cycles over those of an hour.
    """

    cycles: float
    hours: float

    @property
    def cycles_run(self) -> float:
        """Loading cycles that the run covers: those of the life."""
        return self.cycles

    @property
    def hours_run(self) -> float:
        """Running time that the run covers [h]: the life."""
        return self.hours


@dataclass(frozen=True)
class LowerBound:
    """A run that ended before any limit was met.

    Attributes
    ----------
    cycles_run : float
        Loading cycles that it covers.
    hours_run : float
        Running time that it covers [h].
    """

    cycles_run: float
    hours_run: float

    @property
    def cycles(self) -> float:
        """Raise: the life is not known.

        Raises
        ------
        LimitNotReachedError
            Always, with the bound.
        """
        raise LimitNotReachedError(self._message)

    @property
    def hours(self) -> float:
        """Raise: the life is not known.

        Raises
        ------
        LimitNotReachedError
            Always, with the bound.
        """
        raise LimitNotReachedError(self._message)

    @property
    def _message(self) -> str:
        return (
            f"life: no limit was met within {self.hours_run:g} h ({self.cycles_run:g} cycles), the "
            "life is longer: raise run.horizon_hours"
        )


def life_of(cycles: float, cycles_per_hour: float, reached: bool) -> Life | LowerBound:
    """Return the life that a run of so many cycles has shown.

    Examples
    --------
    >>> life_of(12000.0, 6000.0, True)
    Life(cycles=12000.0, hours=2.0)
    """
    hours = cycles / cycles_per_hour
    return Life(cycles, hours) if reached else LowerBound(cycles, hours)


def life_keys(name: str, life: Life | LowerBound | None) -> dict[str, float | None]:
    """Return a life as two plain numbers, one of which is None.

    Examples
    --------
    >>> life_keys("life_hours", Life(12000.0, 2.0))
    {'life_hours': 2.0, 'life_hours_at_least': None}
    >>> life_keys("life_hours", LowerBound(12000.0, 2.0))
    {'life_hours': None, 'life_hours_at_least': 2.0}
    """
    return {
        name: life.hours if isinstance(life, Life) else None,
        f"{name}_at_least": life.hours_run if isinstance(life, LowerBound) else None,
    }


def first_life(wear: Life | LowerBound, fatigue: Mapping[str, Life | LowerBound]) -> str | None:
    """Return which of the lives by wear and by contact fatigue ends first.

    Examples
    --------
    >>> first_life(Life(12000.0, 2.0), {"sprocket_fatigue": Life(9000.0, 1.5)})
    'sprocket_fatigue'
    >>> first_life(LowerBound(6000.0, 1.0), {"sprocket_fatigue": Life(9000.0, 1.5)})
    """
    reached = {name: life.hours for name, life in {"wear": wear, **fatigue}.items() if isinstance(life, Life)}
    first = min(reached, key=lambda name: reached[name], default=None)
    if first is None or reached[first] > wear.hours_run:
        return None
    return first


@dataclass(frozen=True)
class LimitState:
    """A limit and how near to it the drive is when its life ends."""

    name: str  # key of the limit with its unit
    limit: float  # its value
    value: float  # what the quantity has come to

    @property
    def left(self) -> float:
        """Distance to the limit, 0 where only rounding is left."""
        met = math.isclose(self.limit, self.value, rel_tol=1e-9)
        return 0.0 if met else abs(self.limit - self.value)


def hours(life: Life | LowerBound) -> str:
    """Return a life in hours, a bound with its sign."""
    if isinstance(life, Life):
        return f"{grouped(life.hours)} h"
    return f"> {grouped(life.hours_run)} h"


_FULL = 1e-6
"""Part of a day by which it may be short of full, as hours over hours a day are rounded."""


def day_after(start: date, days: float) -> str:
    """Return the day so many days later, the last one begun; empty where no calendar goes so far.

    Examples
    --------
    >>> day_after(date(2026, 3, 30), 2.9)
    '2026-04-01'
    """
    if not days <= (date.max - start).days:
        return ""
    return (start + timedelta(days=math.floor(days + _FULL))).isoformat()


def service_measures(inputs: Mapping[str, Any], hours: float, before: float = 0.0) -> dict[str, float | str]:
    """Return hours of running in the measures that a case gives factors for.

    Examples
    --------
    1000 h of 8 h a day are 125 days, of which 59 are in January and February:

    >>> table = {"km_per_hour": 30.0, "hours_per_day": 8.0, "start_date": "2026-01-01"}
    >>> service_measures({"service": table}, 1000.0)
    {'km': 30000.0, 'days': 125.0, 'date': '2026-05-06'}
    """
    table = inputs.get("service") or {}
    found: dict[str, float | str] = {
        name: hours * table[key]
        for name, key in (("km", "km_per_hour"), ("tonnes", "tonnes_per_hour"))
        if key in table
    }
    if "hours_per_day" in table:
        found["days"] = hours / table["hours_per_day"]
    if "start_date" in table:
        start = date.fromisoformat(table["start_date"])
        if day := day_after(start, (before + hours) / table["hours_per_day"]):
            found["date"] = day
    return found


def service_keys(
    inputs: Mapping[str, Any], life: Life | LowerBound, before: float = 0.0
) -> dict[str, dict[str, float | str]]:
    """Return a life in the measures of a machine in service under the key that says what it is."""
    if not inputs.get("service"):
        return {}
    key = "service" if isinstance(life, Life) else "service_at_least"
    return {key: service_measures(inputs, life.hours_run, before)}
