"""What a stored result must hold before it is believed: kinds of its values, shape of its tables."""

from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from wearsim.contact.stop_limits import LIMITS
from wearsim.geometry.profile_points import Vector
from wearsim.input.faults import validation_faults
from wearsim.input.mechanism_registry import MechanismEntry

_LARGEST = 1e100
"""No number of a run comes near; squares of it are still numbers."""

_Number = Annotated[float, Field(ge=-_LARGEST, le=_LARGEST)]
_Amount = Annotated[float, Field(ge=0.0, le=_LARGEST)]
_AboveZero = Annotated[float, Field(gt=0.0, le=_LARGEST)]


class _Model(BaseModel):
    model_config = ConfigDict(strict=True, extra="forbid", allow_inf_nan=False)


class _StoredLife(_Model):
    cycles: _Amount
    hours: _Amount


class _StoredBound(_Model):
    cycles_run: _Amount
    hours_run: _Amount


_AnyLife = _StoredLife | _StoredBound
_Band = Annotated[list[_AnyLife], Field(min_length=2, max_length=2)]


class _StoredLives(_Model):
    life: _AnyLife
    life_low: _AnyLife
    life_high: _AnyLife


class _StoredLimit(_Model):
    name: str
    limit: _Number
    value: _Number


class _StoredRating(_Model):
    model_config = ConfigDict(extra="ignore")

    name: str
    value: _Number
    limit: _Number
    unit: str
    source: str
    note: str
    at_least: bool
    load: str
    hours: _Amount | None


class _StoredRule(_Model):
    rule: str
    hours: _Amount | None
    trust: str
    source: str
    note: str


class _StoredOpinions(_Model):
    model_config = ConfigDict(extra="ignore")

    rules: list[_StoredRule]
    mean_hours: _Amount | None
    outside: str
    lubrication: str
    lubrication_factor: _Amount
    shock_factor: _Amount
    pressure_velocity_MPa_m_per_s: _Amount


class StoredResult(_Model):
    """The values of ``result.json`` that are read back."""

    model_config = ConfigDict(extra="ignore")

    case: str
    title: str
    band: str
    stop: str
    stop_value: _Number
    cycles_run: _AboveZero
    hours_run: _AboveZero
    speed_rpm: _Amount
    method: str
    updates: Annotated[int, Field(ge=0)]
    numerical_error: _Amount
    life_tolerance: _Amount
    lives: _StoredLives
    parts: dict[str, _AnyLife]
    bands: dict[str, _Band]
    practice: _StoredOpinions | None = None
    limits: list[_StoredLimit]
    ratings: list[_StoredRating] = []
    max_depth_mm: _Amount
    max_depth_arc_length_mm: _Number
    removed_area_mm2: _Number
    worn_area_mm2: _Number
    initial_peak_pressure_MPa: _Amount
    final_peak_pressure_MPa: _Amount
    assumptions: list[str]
    warnings: list[str]
    sha256: dict[str, str] | None = None


def check_values(file: str, values: Mapping[str, Any]) -> None:
    """Raise `ValueError` with the first value of a result that is missing or of another kind."""
    try:
        StoredResult.model_validate(values)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        key = ".".join(str(part) for part in first["loc"] if not str(part).startswith("_"))
        message = (
            first["msg"].replace("Input should be", "must be").replace("Field required", "must be given")
        )
        raise ValueError(f"{file}: {key} {message}") from None
    reached = "hours" in values["lives"]["life"]
    ends = LIMITS if reached else ("horizon_hours",)
    if values["stop"] not in ends:
        raise ValueError(f"{file}: stop must be {' or '.join(ends)}")


def check_parts(file: str, values: Mapping[str, Any], mechanism: MechanismEntry) -> None:
    """Raise `ValueError` where the parts of a result are not those that wear in its case."""
    worn = {"chain", "sprocket"} if "chain" in mechanism.history else set()
    given = {
        "parts": {name for name in values["parts"] if not name.endswith("_fatigue")},
        "bands": set(values["bands"]),
        "practice": {"chain", "sprocket"} if values.get("practice") else worn,
    }
    for key, names in given.items():
        if names != worn:
            raise ValueError(f"{file}: {key} must be those of the case in case.lock.toml")


def check_inputs(file: str, inputs: Mapping[str, Any], mechanism: MechanismEntry) -> None:
    """Raise `ValueError` where a value of a case is of another kind; keys of other releases may stand."""
    model: type[BaseModel] = mechanism.load("tables")
    try:
        model.model_validate(dict(inputs))
    except ValidationError as error:
        if any(fault["type"] != "extra_forbidden" for fault in error.errors(include_url=False)):
            key, message, _ = next(validation_faults(error, model))
            raise ValueError(f"{file}: {key} {message}") from None
    given = {"mechanism.kind": "kind" in inputs.get("mechanism", {}), "stop": "stop" in inputs}
    for key, there in given.items():
        if not there:
            raise ValueError(f"{file}: {key} must be given")


WHOLE = "node", "gap_kind"
"""Columns of whole numbers."""

_FINITE = (
    *(*WHOLE, "cycles", "time_hours", "max_depth_mm", "arc_length_mm", "x_mm", "y_mm", "depth_mm"),
    *("wheel_x_mm", "wheel_y_mm", "wheel_depth_mm"),
)
"""Columns without empty cells; others have some where nothing touches."""


def check_history(file: str, columns: Mapping[str, Vector]) -> None:
    """Raise `ValueError` where times do not rise or a cell holds no number."""
    _check_numbers(file, columns)
    for name in ("cycles", "time_hours"):
        _check_rising(file, name, columns[name])
    if not (np.diff(columns["cycles"]) > 0.0).all():
        raise ValueError(f"{file}: cycles must rise in every row")


def check_flank(file: str, columns: Mapping[str, Vector]) -> None:
    """Raise `ValueError` where the rows are not the same points at two times or more."""
    _check_numbers(file, columns)
    cycles = columns["cycles"]
    _check_rising(file, "cycles", cycles)
    times, sizes = np.unique(cycles, return_counts=True)
    named = [columns[name] for name in WHOLE if name in columns]
    alike = times.size > 1 and bool((sizes == sizes[0]).all())
    if not alike or any(np.ptp(rows.reshape(times.size, -1), axis=0).any() for rows in named):
        raise ValueError(f"{file}: must hold the same points at two or more times")


def _check_numbers(file: str, columns: Mapping[str, Vector]) -> None:
    for name, cells in columns.items():
        if (np.abs(cells) > _LARGEST).any() or (name in _FINITE and np.isnan(cells).any()):
            raise ValueError(f"{file}: {name} must be a finite number in every row")
        if name in WHOLE and (cells != np.trunc(cells)).any():
            raise ValueError(f"{file}: {name} must be a whole number in every row")


def _check_rising(file: str, name: str, cells: Vector) -> None:
    if cells[0] < 0.0 or (np.diff(cells) < 0.0).any():
        raise ValueError(f"{file}: {name} must rise from row to row, from 0 on")
