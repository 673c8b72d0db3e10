"""Numbers of an input file: plain floats, or strings with a unit, into the unit of the key."""

import math
import re
from collections.abc import Mapping
from functools import cache
from numbers import Integral, Real
from pathlib import PurePath
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import BeforeValidator, Field, ValidationInfo, WithJsonSchema

from wearsim.input.texts import check_characters
from wearsim.quantities import quantities

if TYPE_CHECKING:
    import pint


LEAST, MAX = 1e-30, 1e15
"""Sizes of a quantity between which numbers stay numbers in every formula."""

_NUMBER_AND_UNIT = re.compile(
    r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(?:/([1-9]\d*))?\s*([^\d\s.,].*?)\s*"
)
_POWER = re.compile(r"\b(mm|cm|m|in|inch|ft)([234])\b")
_RAISED = re.compile(r"(?<=[^\W\d_])(?:\d|\s*\*\*\s*(?:[+-]?\d|\([+-]?\d\)))(?!\d)")
"""A digit behind the name of a unit: of the name, or the power to which it is raised."""

_LONGEST = 100
"""Characters of a number and its unit."""

_ANGLES = ("revolution", "turn", "radian", "degree")


@cache
def _registry() -> "pint.UnitRegistry[Any]":
    import pint

    registry: pint.UnitRegistry[Any] = pint.UnitRegistry(
        autoconvert_offset_to_baseunit=True, on_redefinition="ignore"
    )
    registry.define("Nm = newton * meter")
    registry.define("@alias turn = rev")
    return registry


def convert(text: str, unit: str) -> float:
    """Convert a number with a unit, written as a string, into another unit.

    Examples
    --------
    >>> convert("1 inch", "mm")
    25.4
    >>> round(convert("20 Nm", "N*m"), 12)
    20.0
    >>> convert("3/4 inch", "mm")
    19.05
    >>> convert("897.5999999999999 N", "N")
    897.5999999999999
    """
    if len(text) > _LONGEST:
        raise ValueError(
            f"must be one number and its unit in at most {_LONGEST} characters, has {len(text)}: shorten it"
        )
    check_characters(text)
    if not text.strip(" +-.eE0123456789"):
        raise ValueError(f"give a number without quotes, or with a unit such as '1 {unit}'")
    found = _NUMBER_AND_UNIT.fullmatch(text)
    if not found:
        raise ValueError(f"must be one number and its unit, such as '1.5 {unit}'")
    number, divisor, given = found.groups()
    return _converted(float(number) / float(divisor or 1), given, unit)


def _converted(number: float, given: str, unit: str) -> float:
    import pint

    try:
        units = _registry().parse_units(_checked_powers(_POWER.sub(r"\1^\2", given)))
        converted = float(_registry().Quantity(number, units).to(unit).magnitude)
    except pint.DimensionalityError:
        needed = "one of force, such as N or kN" if unit == "N" else f"convertible to {unit}"
        raise ValueError(f"the unit must be {needed}") from None
    except Exception:
        raise ValueError(
            f"unknown unit {given!r}: must be a number, or a string such as '1 {unit}'"
        ) from None
    # pint takes 1/min and hertz for rad/min and rad/s.
    if unit == "rpm" and not any(angle in str(units) for angle in _ANGLES):
        raise ValueError(f"write a speed in rpm or rad/s, {given!r} may mean either")
    if units == _registry().parse_units(unit):
        return number
    # Fifteen digits, so that "0.0254 m" and 25.4 are the same number.
    return float(f"{converted:.15g}")


def _checked_powers(given: str) -> str:
    """Return a unit whose names are raised to whole numbers of one digit; raise for one with other numbers.

    A power of a power, or one of a number, may take for ever to calculate.
    """
    from pint.util import string_preprocessor

    if re.search(r"\d", _RAISED.sub("", string_preprocessor(given))):
        raise ValueError
    return given


def in_unit_of(key: str, value: Any) -> Any:
    """Return a text with a unit as the number that a key holds; any other value, and text of none, as it is.

    Examples
    --------
    >>> in_unit_of("load.tension_N", "6 kN"), in_unit_of("load.tension_N", 5), in_unit_of("wear.law", "power")
    (6000.0, 5, 'power')
    """
    quantity = quantities().get(key.rpartition(".")[2])
    if not isinstance(value, str) or quantity is None or not quantity.unit:
        return value
    try:
        return convert(value, quantity.unit)
    except ValueError:
        return value


def _number(value: object, info: ValidationInfo) -> float:
    unit = quantities()[info.field_name or ""].unit
    if isinstance(value, str) and unit:
        value = convert(value, unit)
    if isinstance(value, bool) or not isinstance(value, int | float):
        hint = f", or a string with a unit such as '1 {unit}'" if unit else ""
        raise ValueError(f"must be a number{hint}")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise ValueError("must be a finite number")
    if number and not LEAST <= abs(number) <= MAX:
        raise ValueError(f"must be 0 or from {LEAST:g} to {MAX:g} in size")
    return number


def _schema(with_unit: bool, **limits: float) -> dict[str, Any]:
    number: dict[str, Any] = {"type": "number", **limits}
    if not with_unit:
        return number
    return {"anyOf": [number, {"type": "string", "pattern": r"^\s*[+-]?\.?\d.*[A-Za-z%]"}]}


Positive = Annotated[
    float, BeforeValidator(_number), Field(gt=0.0), WithJsonSchema(_schema(True, exclusiveMinimum=0.0))
]
"""A quantity above zero, in the unit of its key."""

NotNegative = Annotated[
    float, BeforeValidator(_number), Field(ge=0.0), WithJsonSchema(_schema(True, minimum=0.0))
]
"""A quantity of at least zero, in the unit of its key."""

PositiveNumber = Annotated[
    float, BeforeValidator(_number), Field(gt=0.0), WithJsonSchema(_schema(False, exclusiveMinimum=0.0))
]
"""A number above zero without a unit."""

Signed = Annotated[float, BeforeValidator(_number), WithJsonSchema(_schema(True))]
"""A quantity of either sign, in the unit of its key."""


def _numbers(value: object, info: ValidationInfo) -> tuple[float, ...]:
    entries = value if isinstance(value, list | tuple) else [value]
    return tuple(_number(entry, info) for entry in entries)


Speed = Annotated[
    float, BeforeValidator(_number), Field(ge=1e-6), WithJsonSchema(_schema(True, minimum=1e-6))
]
"""Speed of a wheel that turns [rpm]: at least once in two years."""

Series = Annotated[
    tuple[float, ...],
    BeforeValidator(_numbers),
    WithJsonSchema({"anyOf": [*_schema(True)["anyOf"], {"type": "array", "items": _schema(True)}]}),
]
"""One quantity or a list of them, of either sign, in the unit of the key."""

Number = Annotated[float, BeforeValidator(_number), WithJsonSchema(_schema(False))]
"""A number without a unit."""


def plain_value(value: Any) -> Any:
    """Return a value as TOML would hold it: no numbers or arrays of numpy, no tuples, ranges or paths."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, list | tuple | range):
        return [plain_value(entry) for entry in value]
    if isinstance(value, PurePath):
        return str(value)
    if isinstance(value, bool) or not isinstance(value, Real):
        return value
    return int(value) if isinstance(value, Integral) else float(value)


def plain_tables(tables: Mapping[str, Any]) -> dict[str, Any]:
    """Return tables with all values as TOML would hold them.

    Examples
    --------
    >>> import numpy as np
    >>> plain_tables({"sprocket": [{"teeth": np.int64(17)}]})
    {'sprocket': [{'teeth': 17}]}
    """

    def plain(value: Any) -> Any:
        if isinstance(value, Mapping):
            return plain_tables(value)
        if isinstance(value, list | tuple):
            return [plain(entry) for entry in value]
        return plain_value(value)

    return {name: plain(value) for name, value in tables.items()}
