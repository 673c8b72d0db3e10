"""How it wears and when that ends: [wear], [material], [stop], [run] and [fatigue]."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema, WrapValidator, create_model, field_validator

from wearsim.catalogue.catalogues import (
    HARDNESSES,
    condition_name,
    materials,
    nearest,
    wear_conditions,
    wear_laws,
)
from wearsim.catalogue.own_wear_laws import own_constant_faults, own_wear_laws
from wearsim.contact.stop_limits import CHAIN_LIMITS, LimitKey
from wearsim.input.table import Finite, Table, known, others_of
from wearsim.input.units import Number, Positive, PositiveNumber
from wearsim.quantities import quantities


def _law_keys() -> dict[str, tuple[str, ...]]:
    """Keys of every law by its name, those of the program among them."""
    return {name: entry.keys for name, entry in wear_laws().items() if entry.kind == "law"}


def _known_law(value: Any, handler: Callable[[Any], Any]) -> Any:
    if not isinstance(value, str) or value in _KEYS:
        return handler(value)
    if value not in own_wear_laws():
        *most, last = map(repr, _KEYS)
        raise ValueError(
            f"must be {', '.join(most)} or {last}, or a law that this program has added with "
            f"wearsim.wear_law{nearest(value, list(_KEYS))}"
        )
    return value


def known_condition(value: str | None) -> str | None:
    """Return the present name of a wear condition, or raise with the nearest ones."""
    name = None if value is None else condition_name(value)
    return known(name, dict(wear_conditions()), "wear condition", "wearsim list wear-conditions")


_KEYS = {name: keys for name, keys in _law_keys().items() if name not in own_wear_laws()}
_TOGETHER = [entry.keys for entry in wear_laws().values() if entry.kind == "factor" and len(entry.keys) > 1]
if TYPE_CHECKING:
    _LawName = str
    _Hardness = str
else:
    _LawName = Annotated[Literal[tuple(_KEYS)], WrapValidator(_known_law)]
    _Hardness = Literal[HARDNESSES]


class _WearTable(Table):
    """All of [wear] but the keys of laws that are only above zero."""

    law: _LawName = "archard"
    condition: str | None = None
    tooth_hardness: _Hardness | None = None
    specific_wear_rate_mm2_per_N: Positive | None = None
    coefficient: PositiveNumber | None = None
    constants: dict[str, Finite] | None = None
    pressure_exponent: Annotated[PositiveNumber, Field(le=20.0)] | None = None
    hardness_MPa: Annotated[Positive, Field(ge=1e-3, le=1e6)] | None = None
    reference_speed_mm_per_s: Annotated[Positive, Field(ge=1e-6, le=1e9)] | None = None
    speed_exponent: Annotated[Number, Field(ge=-20.0, le=20.0)] | None = None
    friction_coefficient: Annotated[PositiveNumber, Field(le=2.0)] | None = None
    case_depth_mm: Positive | None = None
    core_factor: PositiveNumber | None = None
    roller_wear_ratio: Annotated[Number, Field(ge=0.0)] | None = None
    running_in_factor: Annotated[PositiveNumber, Field(ge=1.0)] | None = None
    running_in_distance_mm: Positive | None = None
    cycles_exponent: Annotated[PositiveNumber, Field(ge=0.05, le=1.0)] | None = None
    reference_hours: Positive | None = None
    pv_limit_MPa_mm_per_s: Positive | None = None
    severe_factor: Annotated[PositiveNumber, Field(ge=1.0, le=1e6)] | None = None
    band_factor: Annotated[PositiveNumber, Field(ge=1.0)] | None = None

    @classmethod
    def gives_way(cls, key: str, value: Any) -> tuple[str, ...]:
        """Return the keys whose place a new value of a key takes."""
        every = tuple(dict.fromkeys([*(key for keys in _KEYS.values() for key in keys), "constants"]))
        if key == "condition":
            return ("law", "tooth_hardness", *every)
        if key == "tooth_hardness":
            return ("condition", "law", *every)
        if key == "law":
            return (
                "condition",
                "tooth_hardness",
                *(other for other in every if other not in _law_keys().get(value, ())),
            )
        if key == "specific_wear_rate_mm2_per_N":
            return ("condition", "tooth_hardness", "law", *(other for other in every if other != key))
        return ("condition", "tooth_hardness", "specific_wear_rate_mm2_per_N") if key in every else ()

    @field_validator("condition")
    @classmethod
    def _known(cls, value: str | None) -> str | None:
        return known_condition(value)

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        wanted = _law_keys()[self.law]
        every = dict.fromkeys(key for keys in _KEYS.values() for key in keys)
        given = [key for key in every if getattr(self, key) is not None]
        found = [
            (key, f"does not belong to law = {self.law!r}: remove it") for key in given if key not in wanted
        ]
        own = own_wear_laws().get(self.law)
        found += own_constant_faults(own, self.constants or {})
        if self.condition is None and own is None:
            alternative = " (or condition)" if self.law == "archard" else ""
            found += [
                (key, f"law = {self.law!r} needs this key{alternative}") for key in wanted if key not in given
            ]
        elif self.condition is not None and self.law != "archard":
            message = f"a condition applies to law = 'archard' only: remove it or law = {self.law!r}"
            found.append(("condition", message))
        found += self._hardness_faults(given)
        for pair in _TOGETHER:
            missing = [key for key in pair if getattr(self, key) is None]
            if len(missing) == 1:
                other = pair[1 - pair.index(missing[0])]
                found.append((missing[0], f"{other} needs this key"))
        if self.cycles_exponent is not None and self.running_in_factor is not None:
            message = "describes running-in that never ends: remove it or running_in_factor"
            found.append(("cycles_exponent", message))
        return found

    def _hardness_faults(self, given: list[str]) -> list[tuple[str, str]]:
        """Return what is wrong with the hardness of the teeth, which goes with a lubricant."""
        if self.tooth_hardness is None:
            return []
        if self.condition is None:
            if given:
                return [
                    (
                        "tooth_hardness",
                        f"{given[0]} already sets how fast the teeth wear: remove one of the two",
                    )
                ]
            return [("tooth_hardness", "needs lubrication.lubricant: both give the wear rate of the teeth")]
        if self.condition.startswith(f"{self.tooth_hardness}, "):
            return []
        text = f"must be that of condition = {self.condition!r}: remove it, or name another lubricant"
        return [("tooth_hardness", f"{text} (got {self.tooth_hardness!r})")]


def _above_zero(key: str) -> Any:
    return Positive if quantities()[key].unit else PositiveNumber


if TYPE_CHECKING:

    class WearTable(_WearTable):
        """The wear law and its coefficient."""
else:
    WearTable = create_model(
        "WearTable",
        __base__=_WearTable,
        __doc__="The wear law and its coefficient.",
        __module__=__name__,
        **{
            key: (_above_zero(key) | None, None)
            for keys in _KEYS.values()
            for key in keys
            if key not in _WearTable.model_fields
        },
    )


class MaterialTable(Table):
    """A material of the table by its name, or by its elastic constants."""

    name: str | None = None
    youngs_modulus_MPa: Positive | None = None
    poissons_ratio: Annotated[Number, Field(gt=-1.0, lt=0.5)] | None = None

    @field_validator("name")
    @classmethod
    def _known(cls, value: str | None) -> str | None:
        return known(value, dict(materials()), "material", "wearsim list materials")

    @classmethod
    def gives_way(cls, key: str, value: Any) -> tuple[str, ...]:
        """Return the keys whose place a new value of a key takes."""
        return others_of(key, ("name", "youngs_modulus_MPa"), ("name", "poissons_ratio"))

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.name is None:
            return []
        return [
            (key, "the material's name already gives this: remove one of the two")
            for key in ("youngs_modulus_MPa", "poissons_ratio")
            if getattr(self, key) is not None
        ]


class MaterialsTable(Table):
    """The materials in contact."""

    sprocket: MaterialTable = MaterialTable()
    roller: MaterialTable = MaterialTable()


Depth = Annotated[Positive, Field(ge=1e-9)]
"""Wear depth: a value far below the size of an atom is a typing error."""


def _limit(row: LimitKey) -> Any:
    return Annotated[_above_zero(row.key), Field(ge=row.least, le=row.most)] | None, None


if TYPE_CHECKING:

    class StopTable(Table):
        """Limits; the first one met ends the life."""

        def __getattr__(self, key: str) -> float | None: ...
else:
    StopTable = create_model(
        "StopTable",
        __base__=Table,
        __doc__="Limits; the first one met ends the life.",
        __module__=__name__,
        **{row.key: _limit(row) for row in CHAIN_LIMITS},
    )


class RunTable(Table):
    """How the life is calculated."""

    method: Literal["advance", "per_cycle"] = "advance"
    cycles_per_update: Annotated[int, Field(ge=1)] | None = None
    life_tolerance: Annotated[PositiveNumber, Field(ge=1e-6, le=0.1)] | None = None
    horizon_hours: Annotated[Positive, Field(ge=1e-6)] = 1e6
    """At least some milliseconds, in which no tooth wears."""

    @classmethod
    def gives_way(cls, key: str, value: Any) -> tuple[str, ...]:
        """Return the keys whose place a new value of a key takes."""
        return ("cycles_per_update",) if (key, value) == ("method", "advance") else ()

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.cycles_per_update is None or self.method == "per_cycle":
            return []
        message = "belongs to method = 'per_cycle': remove it or change the method"
        return [("cycles_per_update", message)]


class FilmTable(Table):
    """The oil between the flanks and their roughness."""

    viscosity_mPa_s: Annotated[Positive, Field(ge=1e-2, le=1e7)]
    pressure_viscosity_per_GPa: Annotated[Positive, Field(ge=0.1, le=100.0)]
    roughness_um: Annotated[Positive, Field(ge=1e-3, le=1e3)]


Treatment = Literal[
    "normalised", "quenched_and_tempered", "through_hardened", "surface_hardened", "carburised", "nitrided"
]

AtLeastOne = Annotated[PositiveNumber, Field(ge=1.0, le=100.0)]
Stress = Annotated[Positive, Field(ge=1.0, le=1e5)]


def _mean(value: object) -> object:
    """Take the two ends of a band for its mean."""
    if not isinstance(value, list):
        return value
    ends = [end for end in value if type(end) in (int, float)]
    if len(value) != 2 or len(ends) != 2 or not 0.0 < ends[0] <= ends[1]:
        raise ValueError("must be a number, or the two ends of its band, such as [269, 302]")
    return 0.5 * (ends[0] + ends[1])


_BAND: dict[str, Any] = {
    "anyOf": [
        {"type": "number", "exclusiveMinimum": 0.0},
        {"type": "array", "items": {"type": "number", "exclusiveMinimum": 0.0}, "minItems": 2, "maxItems": 2},
    ]
}
Brinell = Annotated[PositiveNumber, Field(le=750.0), BeforeValidator(_mean), WithJsonSchema(_BAND)]
Rockwell = Annotated[PositiveNumber, Field(le=70.0), BeforeValidator(_mean), WithJsonSchema(_BAND)]

NITRIDED_LIMIT = (
    "contact_limit_MPa",
    "treatment = 'nitrided' needs this key, as its formula is missing in the source: textbooks use 1050 MPa",
)
"""The fault of nitrided flanks without an endurance limit."""


def one_hardness(brinell: float | None, rockwell: float | None) -> list[tuple[str, str]]:
    """Return the fault of flanks whose hardness is given in no scale or in both."""
    if (brinell is None) != (rockwell is None):
        return []
    got = "none" if brinell is None else "both"
    return [("hardness_HB", f"give exactly one of hardness_HB and hardness_HRC (got {got})")]


class FlankMaterialTable(Table):
    """Material of the flanks, for contact fatigue."""

    treatment: Treatment
    hardness_HB: Brinell | None = None
    hardness_HRC: Rockwell | None = None
    contact_limit_MPa: Stress | None = None
    contact_safety: AtLeastOne | None = None

    @classmethod
    def one_of(cls) -> tuple[tuple[str, ...], ...]:
        """Return groups of keys that exclude each other."""
        return (("hardness_HB", "hardness_HRC"),)

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        found = one_hardness(self.hardness_HB, self.hardness_HRC)
        if self.treatment == "nitrided" and self.contact_limit_MPa is None:
            found.append(NITRIDED_LIMIT)
        return found


class FatigueTable(Table):
    """Contact fatigue beside the wear."""

    load_factor: AtLeastOne = 1.0


class SprocketFatigueTable(FatigueTable):
    """Contact fatigue of a sprocket."""

    sprocket: FlankMaterialTable
