"""The table [wear]."""

from typing import Annotated, Literal

from pydantic import Field, field_validator

from wearsim.catalogue.catalogues import wear_conditions
from wearsim.input.schema.table import Table, known
from wearsim.input.units import Number, Positive, PositiveNumber

_KEYS = {
    "archard": ("specific_wear_rate_mm2_per_N",),
    "power": ("coefficient", "pressure_exponent"),
    "drozdov": (
        "coefficient",
        "pressure_exponent",
        "hardness_MPa",
        "reference_speed_mm_per_s",
        "speed_exponent",
    ),
}


class WearTable(Table):
    """The wear law and its coefficient."""

    law: Literal["archard", "power", "drozdov"] = "archard"
    condition: str | None = None
    specific_wear_rate_mm2_per_N: Positive | None = None
    coefficient: PositiveNumber | None = None
    pressure_exponent: Annotated[PositiveNumber, Field(le=20.0)] | None = None
    hardness_MPa: Annotated[Positive, Field(ge=1e-3, le=1e6)] | None = None
    reference_speed_mm_per_s: Annotated[Positive, Field(ge=1e-6, le=1e9)] | None = None
    speed_exponent: Annotated[Number, Field(ge=-20.0, le=20.0)] | None = None
    case_depth_mm: Positive | None = None
    core_factor: PositiveNumber | None = None
    roller_wear_ratio: Annotated[Number, Field(ge=0.0)] | None = None
    running_in_factor: Annotated[PositiveNumber, Field(ge=1.0)] | None = None
    running_in_distance_mm: Positive | None = None
    band_factor: Annotated[PositiveNumber, Field(ge=1.0)] | None = None

    @field_validator("condition")
    @classmethod
    def _known(cls, value: str | None) -> str | None:
        return known(value, dict(wear_conditions()), "wear condition", "wearsim list wear-conditions")

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        wanted = _KEYS[self.law]
        every = dict.fromkeys(key for keys in _KEYS.values() for key in keys)
        given = [key for key in every if getattr(self, key) is not None]
        found = [
            (key, f"does not belong to law = {self.law!r}: remove it") for key in given if key not in wanted
        ]
        if self.condition is None:
            alternative = " (or condition)" if self.law == "archard" else ""
            found += [
                (key, f"law = {self.law!r} needs this key{alternative}") for key in wanted if key not in given
            ]
        elif self.law != "archard" or given:
            other = f"or {', '.join(given)}" if given else f"or law = {self.law!r}"
            message = f"a condition gives the specific wear rate of law = 'archard': remove it {other}"
            found.append(("condition", message))
        for pair in (("case_depth_mm", "core_factor"), ("running_in_factor", "running_in_distance_mm")):
            missing = [key for key in pair if getattr(self, key) is None]
            if len(missing) == 1:
                other = pair[1 - pair.index(missing[0])]
                found.append((missing[0], f"{other} needs this key"))
        return found
