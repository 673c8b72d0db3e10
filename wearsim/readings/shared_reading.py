"""A reading of a worn sprocket with its conditions, in the form in which it is shared: ``reading.toml``."""

from collections.abc import Sequence
from datetime import date
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Field, field_validator

from wearsim.case.model import Case
from wearsim.catalogue.catalogues import chains
from wearsim.catalogue.chain_names import known_chain_name
from wearsim.errors import CaseError, Fault
from wearsim.geometry.profile_points import Vector
from wearsim.input.document import load_calculation
from wearsim.input.table import CalculationTables, Finite, Table
from wearsim.input.texts import SEEN, in_line
from wearsim.input.units import Positive, PositiveNumber

BAND = 2.0
"""Standard errors to either side of a reading that its band has."""

ANONYMOUS = "anonymous"

_MOST_POINTS = 60
"""Of a gap."""

_HEAD = (
    "Wear of a sprocket, in the form in which wearsim users share readings.",
    "Check the conditions, delete what you do not want to share, and add what you know.",
)


def _day(value: object) -> object:
    if type(value) is not date:  # a time of day is a date too
        raise ValueError("must be a day such as 2026-03-31, without quotes")
    return value


class ReadingTable(Table):
    """What was measured, when and by whom."""

    origin: Literal["photograph", "measured", "rendered"]
    contributor: Annotated[str, Field(min_length=1, max_length=200), SEEN] = ANONYMOUS
    date: Annotated[date, BeforeValidator(_day)]
    licence: Literal["CC0-1.0"]
    time_hours: Positive
    depth_mm: Positive
    depth_se_mm: Positive
    teeth_depth_mm: list[Finite] | None = None
    x_mm: list[Finite] | None = None
    y_mm: list[Finite] | None = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if len(self.x_mm or ()) == len(self.y_mm or ()):
            return []
        return [("y_mm", f"must have as many values as x_mm, {len(self.x_mm or ())}: correct both")]


class ConditionsTable(Table):
    """What the sprocket ran under."""

    designation: str | None = None
    pitch_mm: Positive | None = None
    roller_diameter_mm: Positive | None = None
    teeth: Annotated[int, Field(ge=5, le=150)]
    profile: str | None = None
    power_kW: Positive | None = None
    torque_N_m: Positive | None = None
    tension_N: Positive | None = None
    speed_rpm: Positive | None = None
    condition: str | None = None
    lubricant: str | None = None
    environment: str | None = None
    hardness_HRC: PositiveNumber | None = None

    @field_validator("designation")
    @classmethod
    def _known(cls, value: str | None) -> str | None:
        return None if value is None else known_chain_name(value)

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.designation is not None or self.pitch_mm is not None:
            return []
        return [("designation", "must be given, or the pitch_mm of the chain, but neither is: give one")]


class SharedReading(CalculationTables):
    """A reading and its conditions."""

    reading: ReadingTable
    conditions: ConditionsTable

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the tables."""
        depths, teeth = self.reading.teeth_depth_mm or (), self.conditions.teeth
        if len(depths) <= teeth:
            return []
        text = f"must have at most conditions.teeth = {teeth} values, but has {len(depths)}: correct one"
        return [("reading.teeth_depth_mm", text)]


def read_reading(path: Path) -> SharedReading:
    """Return a shared reading; raise CaseError for what is wrong with it."""
    return load_calculation(path, SharedReading)


def check_sprocket(found: SharedReading, case: Case, file: Path) -> None:
    """Raise where a reading is of another sprocket than that of a case."""
    given = case_conditions(case)
    faults = [
        Fault(f"must be that of the case, {given[key]}, but is {value}: give its case", key, str(file))
        for key in ("designation", "teeth")
        if key in given
        and (value := getattr(found.conditions, key)) is not None
        and _plain(key, value) != _plain(key, given[key])
    ]
    if faults:
        raise CaseError([Fault(one.message, f"conditions.{one.key}", one.file) for one in faults])


def _plain(key: str, value: Any) -> Any:
    """Return a value in one form: 08B is 08B-1."""
    return chains()[known_chain_name(value)].designation if key == "designation" else value


def case_conditions(case: Case) -> dict[str, Any]:
    """Return what a case says of the conditions of its sprocket."""
    tables = [case.inputs.get(name, {}) for name in ("chain", "sprocket", "load", "wear", "lubrication")]
    given = {key: value for table in tables for key, value in table.items() if value is not None}
    return {key: given[key] for key in ConditionsTable.model_fields if key in given}


def reading_toml(
    case: Case, hours: float, depth: float, error: float, teeth_depths: Sequence[float], gap: Vector
) -> str:
    """Return a reading of a photograph as the file in which it is shared; depths and points in mm."""
    import tomlkit  # takes a moment

    reading = tomlkit.table()
    reading.add("origin", "photograph")
    reading.add("contributor", ANONYMOUS)
    reading["contributor"].comment("who measured it, as you want to be named")
    reading.add("date", date.today())
    reading.add("licence", "CC0-1.0")
    reading["licence"].comment("whoever shares this file gives it to the public domain")
    reading.add("time_hours", hours)
    reading.add("depth_mm", round(depth, 6))
    reading.add("depth_se_mm", round(error, 6))
    reading.add("teeth_depth_mm", [round(one, 4) for one in teeth_depths if np.isfinite(one)])
    points = gap[:: -(-len(gap) // _MOST_POINTS)]
    for key, values in zip(("x_mm", "y_mm"), np.round(points, 4).T.tolist(), strict=True):
        reading.add(key, values)
    document = tomlkit.document()
    for line in _HEAD:
        document.add(tomlkit.comment(line))
    document.add("format_version", 1)
    document.add("title", in_line(case.title))
    document.add("reading", reading)
    document.add("conditions", tomlkit.item(case_conditions(case)))
    return tomlkit.dumps(document)
