"""Numbers of an input file: plain floats, or strings with a unit, into the unit of the key."""

import math
from functools import cache
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import BeforeValidator, Field, ValidationInfo, WithJsonSchema

from wearsim.quantities import quantities

if TYPE_CHECKING:
    import pint


@cache
def _registry() -> "pint.UnitRegistry[Any]":
    import pint

    registry: pint.UnitRegistry[Any] = pint.UnitRegistry(autoconvert_offset_to_baseunit=True)
    registry.define("Nm = newton * meter")
    return registry


def convert(text: str, unit: str) -> float:
    """Convert a number with a unit, written as a string, into another unit.

    Parameters
    ----------
    text : str
        Such as ``"1 inch"``.
    unit : str
        Unit of the result.

    Returns
    -------
    float
        The number in that unit.

    Raises
    ------
    ValueError
        The text is not a number with a unit of the same kind.

    Examples
    --------
    >>> convert("1 inch", "mm")
    25.4
    >>> round(convert("20 Nm", "N*m"), 12)
    20.0
    """
    import pint

    if unit == "rpm" and "hz" in text.lower():
        raise ValueError(f"write a speed in rpm or rad/s, not in hertz, got {text!r}")
    try:
        quantity: pint.Quantity[Any] = _registry().Quantity(text)
        if quantity.unitless and not quantity.dimensionless:
            raise ValueError
        if str(quantity.units) == "dimensionless":
            raise ValueError(f"give a number without quotes, or with a unit such as '1 {unit}'")
        return float(quantity.to(unit).magnitude)
    except pint.DimensionalityError:
        raise ValueError(f"the unit must be one of the kind of {unit}") from None
    except ValueError:
        raise
    except Exception:
        raise ValueError(f"must be a number, or a string with a unit such as '1 {unit}'") from None


def _number(value: object, info: ValidationInfo) -> float:
    unit = quantities()[info.field_name or ""].unit
    if isinstance(value, str) and unit:
        value = convert(value, unit)
    if isinstance(value, bool) or not isinstance(value, int | float):
        hint = f", or a string with a unit such as '1 {unit}'" if unit else ""
        raise ValueError(f"must be a number{hint}")
    if not math.isfinite(value):
        raise ValueError("must be a finite number")
    return float(value)


def _schema(with_unit: bool, **limits: float) -> dict[str, Any]:
    number: dict[str, Any] = {"type": "number", **limits}
    if not with_unit:
        return number
    return {"anyOf": [number, {"type": "string", "pattern": r"^\s*[+-]?\.?\d.*[A-Za-z%]"}]}


Positive = Annotated[
    float,
    BeforeValidator(_number),
    Field(gt=0.0),
    WithJsonSchema(_schema(True, exclusiveMinimum=0.0)),
]
"""A quantity above zero, in the unit of its key."""

NotNegative = Annotated[
    float, BeforeValidator(_number), Field(ge=0.0), WithJsonSchema(_schema(True, minimum=0.0))
]
"""A quantity of at least zero, in the unit of its key."""

PositiveNumber = Annotated[
    float,
    BeforeValidator(_number),
    Field(gt=0.0),
    WithJsonSchema(_schema(False, exclusiveMinimum=0.0)),
]
"""A number above zero without a unit."""

Number = Annotated[float, BeforeValidator(_number), WithJsonSchema(_schema(False))]
"""A number without a unit."""
