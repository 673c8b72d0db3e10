"""How contacts are lubricated, how that ages and what dirties it: [lubrication] and [[lubrication.phase]]."""

from itertools import pairwise
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, WithJsonSchema, field_validator

from wearsim.catalogue.catalogues import HARDNESSES, Lubricant, condition_of_teeth, environments, lubricants
from wearsim.input.table import Table, known, others_of
from wearsim.input.units import NotNegative, Number, Positive, PositiveNumber

UNITS = ("hours", "km", "sliding_m")
"""Ends of the keys of a way that a drive runs."""


def keys_of(name: str) -> tuple[str, ...]:
    """Return the keys of which at most one gives a way.

    Examples
    --------
    >>> keys_of("interval")
    ('interval_hours', 'interval_km', 'interval_sliding_m')
    """
    return tuple(f"{name}_{unit}" for unit in UNITS)


LASTS, FADES, INTERVAL = keys_of("lasts"), keys_of("fades_over"), keys_of("interval")
AT = ("at_hours", "at_km")
SCHEDULES = (*INTERVAL, *AT, "when_rate_exceeds", "phase")
"""Keys that say when contacts are relubricated: one of them, or times and an interval after the last one."""

APPLICATION = ("price_per_application", "minutes_per_application", "labour_cost_per_hour")
"""Keys of what a relubrication costs."""

SUPPLY = ("consumption_ml_per_hour", "price_per_litre")
"""Keys of what a lubricant costs that is supplied continuously."""

RATES = ("condition", "law", "specific_wear_rate_mm2_per_N", "coefficient")
"""Keys of [wear] that say how fast it wears."""


def with_wear_condition(tables: Any) -> Any:
    """Return tables with the wear condition of their lubricant, where they give no wear rate of their own."""
    given = tables.get("lubrication") if isinstance(tables, dict) else None
    name = given.get("lubricant") if isinstance(given, dict) else None
    if not isinstance(name, str):
        return tables
    # A name that is none is a fault of its own.
    row = lubricants().get(name, next(iter(lubricants().values())))
    sprockets = tables.get("sprocket")
    if isinstance(sprockets, list):
        tables = {**tables, "sprocket": [_with_own_condition(one, row) for one in sprockets]}
    return {**tables, "wear": _with_condition(tables.get("wear", {}), row)}


def _with_own_condition(sprocket: Any, row: Lubricant) -> Any:
    """Return a sprocket with the condition of the lubricant in its own table of wear, where it has one."""
    if not isinstance(sprocket, dict) or "wear" not in sprocket:
        return sprocket
    return {**sprocket, "wear": _with_condition(sprocket["wear"], row)}


def _with_condition(wear: Any, row: Lubricant) -> Any:
    """Return a table of wear with the condition of a lubricant on its teeth, unless it gives a rate."""
    if not isinstance(wear, dict) or any(key in wear for key in RATES if wear.get(key) != "archard"):
        return wear
    hardness = wear.get("tooth_hardness", HARDNESSES[0])
    condition = condition_of_teeth(row, hardness) if hardness in HARDNESSES else row.wear_condition
    return {"condition": condition, **wear}


Part = Annotated[Number, Field(ge=0.0, le=1.0)]
Hardness = Annotated[PositiveNumber, Field(le=10_000.0)]
Factor = Annotated[PositiveNumber, Field(ge=1.0, le=1e6)]


def _times(value: object) -> object:
    entries: list[Any] = value if isinstance(value, list) and value else [None]
    for entry in entries:
        if isinstance(entry, bool) or not isinstance(entry, int | float) or not 0.0 < entry < 1e12:
            raise ValueError("must be a list of numbers above 0 such as [100, 250]")
    if any(later <= earlier for earlier, later in pairwise(entries)):
        raise ValueError("must rise from one entry to the next")
    return tuple(float(entry) for entry in entries)


_SCHEMA: dict[str, Any] = {"type": "array", "items": {"type": "number", "exclusiveMinimum": 0}, "minItems": 1}
Times = Annotated[tuple[float, ...], BeforeValidator(_times), WithJsonSchema(_SCHEMA)]


class _Surroundings(Table):
    """Effect of dirt on the wear."""

    environment: str | None = None
    contamination_factor: Factor | None = None
    ageing_factor: Factor | None = None
    abrasive_hardness_HV: Hardness | None = None

    @field_validator("environment")
    @classmethod
    def _known(cls, value: str | None) -> str | None:
        return known(value, dict(environments()), "environment", "wearsim list environments")

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.environment == "clean" and self.contamination_factor not in (None, 1.0):
            text = "a clean environment has none: name another environment, or remove one of the two"
            return [("contamination_factor", text)]
        return []


class LubricationPhase(_Surroundings):
    """A part of a programme: how long it is, and how often contacts are relubricated and dirtied in it."""

    hours: Positive | None = None
    km: Positive | None = None
    relubrications: Annotated[int, Field(ge=0, le=10000)] = 0
    contaminations: Annotated[int, Field(ge=0, le=10000)] = 0

    @classmethod
    def gives_way(cls, key: str, value: Any) -> tuple[str, ...]:
        """Return the keys whose place a new value of a key takes."""
        return others_of(key, ("hours", "km"))

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        found = super().conflicts()
        if (self.hours is None) == (self.km is None):
            got = "none" if self.hours is None else "both"
            found.append(("hours", f"give exactly one of hours and km (got {got})"))
        dirt = self.contamination_factor or 1.0
        if self.contaminations and self.environment in (None, "clean") and dirt == 1.0:
            text = "needs an effect of dirt on the wear: give environment or contamination_factor too"
            found.append(("contaminations", text))
        return found


class _Lubricant(Table):
    """A lubricant, how long it lasts, and what it costs."""

    lubricant: str | None = None
    lasts_hours: NotNegative | None = None
    lasts_km: NotNegative | None = None
    lasts_sliding_m: NotNegative | None = None
    fades_over_hours: NotNegative | None = None
    fades_over_km: NotNegative | None = None
    fades_over_sliding_m: NotNegative | None = None
    dry_factor: Factor | None = None
    lasts_band_factor: Factor | None = None
    dry_band_factor: Factor | None = None
    completeness: Annotated[PositiveNumber, Field(le=1.0)] | None = None
    contamination_removed: Part | None = None
    minutes_per_application: NotNegative | None = None
    price_per_application: Annotated[Number, Field(ge=0.0)] | None = None
    consumption_ml_per_hour: NotNegative | None = None
    price_per_litre: Annotated[Number, Field(ge=0.0)] | None = None

    @field_validator("lubricant")
    @classmethod
    def _known_lubricant(cls, value: str | None) -> str | None:
        return known(value, dict(lubricants()), "lubricant", "wearsim list lubricants")

    @classmethod
    def gives_way(cls, key: str, value: Any) -> tuple[str, ...]:
        """Return the keys whose place a new value of a key takes."""
        return others_of(key, LASTS, FADES, SCHEDULES)

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        found = super().conflicts()
        for keys in (LASTS, FADES, SCHEDULES):
            given = [key for key in keys if getattr(self, key, None) not in (None, [])]
            goes_on = len(given) == 2 and given[0] in INTERVAL and given[1] in AT
            if len(given) > 1 and not goes_on:
                found.append((given[1], f"{given[0]} already gives this: remove one of the two"))
        return found


class LubricantOption(_Lubricant):
    """Another lubricant for the same drive: what differs from [lubrication]."""


class LubricationTable(_Lubricant, _Surroundings):
    """Lubricant of all contacts, its relubrication, and dirt."""

    interval_hours: Positive | None = None
    interval_km: Positive | None = None
    interval_sliding_m: Positive | None = None
    at_hours: Times | None = None
    at_km: Times | None = None
    when_rate_exceeds: Annotated[PositiveNumber, Field(gt=1.0)] | None = None
    contamination_band_factor: Factor | None = None
    surface_hardness_HV: Hardness | None = None
    labour_cost_per_hour: Annotated[Number, Field(ge=0.0)] | None = None
    phase: list[LubricationPhase] = Field(default_factory=list)
    option: list[LubricantOption] = Field(default_factory=list)

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        found = super().conflicts()
        phases = ((f"phase.{i}.", phase) for i, phase in enumerate(self.phase, start=1))
        given = [
            f"{place}abrasive_hardness_HV"
            for place, table in (("", self), *phases)
            if table.abrasive_hardness_HV is not None
        ]
        if given and self.surface_hardness_HV is None:
            found.append((given[0], "abrasion depends on its ratio to surface_hardness_HV: give that too"))
        if self.surface_hardness_HV is not None and not given:
            found.append(("surface_hardness_HV", "needs abrasive_hardness_HV too: give it, or remove this"))
        return found
