"""What an optimisation may change: keys between two ends or from a list, as numbers of a box."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic.fields import FieldInfo

from wearsim.case.keys.study_tables import ParameterRange
from wearsim.errors import CaseError, Fault
from wearsim.geometry.profile_points import Vector
from wearsim.input.keys import parts, schema_fields, schema_of, words
from wearsim.input.table import without_numbers
from wearsim.runner.design import NAMES_FILE
from wearsim.runner.samples import unit_samples

_DIGITS = 7
"""Of a value between two ends: what a drawing can hold, and twice the same is found again."""

_NEAR_END = 1e-3
"""Part of a range within which a value lies on its end."""

_MAX_WHOLE = 100_000
"""Whole numbers of a range."""

_NOT_OF_A_DESIGN = {
    **dict.fromkeys(
        ("run", "optimise", "uncertainty", "maintenance", "service", "title"),
        "must be a key of the design, not of how it is calculated or shown",
    ),
    "format_version": "tells how the file is read, and is no part of the design",
    **dict.fromkeys(
        ("sprocket.nodes", "gear.nodes", "mechanism.phases"),
        "tells how finely a design is calculated: its best value would be that of the greatest error",
    ),
}
"""Tables and keys that are none of a design, and why."""


@dataclass(frozen=True)
class Parameter:
    """A key that may change."""

    key: str  # its dotted name
    low: float  # ends; of a list its first and last place, from 0
    high: float  # ends; of a list its first and last place, from 0
    # values of a list; empty where any value between the ends is allowed
    choices: tuple[Any, ...] = ()

    def value(self, part: float) -> Any:
        """Return the value at a part of the way from the low end to the high one.

        Examples
        --------
        >>> Parameter("sprocket.face_width_mm", 10.0, 20.0).value(0.25)
        12.5
        >>> Parameter("sprocket.teeth", 0.0, 2.0, (18, 19, 20)).value(0.6)
        19
        """
        at = self.low + part * (self.high - self.low)
        if self.choices:
            return self.choices[round(at)]
        return min(max(float(f"{at:.{_DIGITS}g}"), self.low), self.high)

    def part(self, value: Any) -> float | None:
        """Return the part of the way at which a value lies."""
        if self.choices:
            return self.choices.index(value) / self.high if value in self.choices else None
        if isinstance(value, bool) or not isinstance(value, int | float):
            return None
        inside = self.low <= value <= self.high
        return (value - self.low) / (self.high - self.low) if inside else None

    def end_of(self, value: Any) -> str:
        """Return on which end of its range a value lies."""
        part = self.part(value)
        if part is None or not all(isinstance(choice, int | float) for choice in self.choices):
            return ""
        return "low" if part < _NEAR_END else "high" if part > 1.0 - _NEAR_END else ""


@dataclass(frozen=True)
class SearchSpace:
    """All that may change."""

    parameters: tuple[Parameter, ...]  # the keys

    @property
    def keys(self) -> tuple[str, ...]:
        """Dotted names."""
        return tuple(parameter.key for parameter in self.parameters)

    @property
    def whole(self) -> NDArray[np.bool_]:
        """Whether each parameter has a list of values."""
        return np.array([bool(parameter.choices) for parameter in self.parameters])

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is doubtful about changing some keys."""
        return tuple(
            f"{key} is a limit of wear: where it changes the limit moves and not the drive, and a life "
            "gained by it is no better design"
            for key in self.keys
            if key.startswith("stop.")
        )

    def values(self, point: Sequence[float] | Vector) -> tuple[Any, ...]:
        """Return the values at a point of the unit cube."""
        return tuple(
            parameter.value(float(part)) for parameter, part in zip(self.parameters, point, strict=True)
        )

    def point(self, values: Sequence[Any]) -> Vector | None:
        """Return the point of the unit cube at which values lie."""
        found = [parameter.part(value) for parameter, value in zip(self.parameters, values, strict=True)]
        return None if None in found else np.array(found, dtype=float)

    def start(self, count: int, seed: int, values: Sequence[Any]) -> Vector:
        """Return points to start from."""
        points = unit_samples(len(self.parameters), count, seed, "sobol")
        own = self.point(values)
        if own is not None:
            points[0] = own
        return points


def search_space(tables: Mapping[str, Any], parameters: Mapping[str, Any]) -> SearchSpace:
    """Return what may change of a case."""
    fields = {key.replace("[]", ""): field for key, field in schema_fields(schema_of(tables))}
    found, faults = [], []
    for key, given in parameters.items():
        plain = without_numbers(key)
        text = _unfit(plain, given, fields.get(plain))
        if text:
            faults.append(Fault(text, f'optimise.parameters."{key}"'))
        else:
            found.append(_parameter(key, given, fields.get(plain)))
    if faults:
        raise CaseError(faults)
    return SearchSpace(tuple(found))


def _unfit(key: str, given: Any, field: FieldInfo | None) -> str:
    reason = _NOT_OF_A_DESIGN.get(key) or _NOT_OF_A_DESIGN.get(key.partition(".")[0])
    if reason:
        return f"{reason}: remove it"
    if key in NAMES_FILE:
        named = isinstance(given, list) and all(isinstance(name, str) for name in given)
        return "" if named else "takes names of files: give a list of them"
    if field is None or not isinstance(given, ParameterRange):
        return ""
    return _unfit_range(given, field)


def _unfit_range(given: ParameterRange, field: FieldInfo) -> str:
    if bool in parts(field.annotation):
        return "takes true or false, not a range: give the list [true, false]"
    if words(field):
        shown = json.dumps(words(field), ensure_ascii=False)
        return f"takes words, not a range: give a list such as {shown}"
    if not _is_whole(field):
        return ""
    if not (isinstance(given.low, int) and isinstance(given.high, int)):
        return f"takes whole numbers: give low and high as such, not {given.low:g} and {given.high:g}"
    count = given.high - given.low + 1
    too_many = f"may hold at most {_MAX_WHOLE} whole numbers, holds {count}: give nearer ends"
    return too_many if count > _MAX_WHOLE else ""


def _parameter(key: str, given: Any, field: FieldInfo | None) -> Parameter:
    if isinstance(given, ParameterRange) and not (field is not None and _is_whole(field)):
        return Parameter(key, float(given.low), float(given.high))
    whole = range(int(given.low), int(given.high) + 1) if isinstance(given, ParameterRange) else given
    choices = tuple(whole)
    return Parameter(key, 0.0, float(len(choices) - 1), choices)


def _is_whole(field: FieldInfo) -> bool:
    kinds = set(map(id, parts(field.annotation)))
    return id(int) in kinds and id(float) not in kinds
