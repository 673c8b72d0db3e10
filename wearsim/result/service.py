"""A life in the measures of a machine in service: km, tonnes, days and a date."""

from collections.abc import Mapping
from datetime import date, timedelta
from typing import Any

from wearsim.result.lives import Life, LowerBound


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
        days = (before + hours) / table["hours_per_day"]
        start = date.fromisoformat(table["start_date"])
        if days <= (date.max - start).days:
            found["date"] = (start + timedelta(days=int(days))).isoformat()
    return found


def service_keys(
    inputs: Mapping[str, Any], life: Life | LowerBound, before: float = 0.0
) -> dict[str, dict[str, float | str]]:
    """Return a life in the measures of a machine in service under the key that says what it is."""
    if not inputs.get("service"):
        return {}
    key = "service" if isinstance(life, Life) else "service_at_least"
    return {key: service_measures(inputs, life.hours_run, before)}
