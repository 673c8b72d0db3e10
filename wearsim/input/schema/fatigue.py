"""The table of contact fatigue, and what flanks are made of."""

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema

from wearsim.input.schema.table import Table
from wearsim.input.units import Positive, PositiveNumber

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
    "treatment = 'nitrided' needs this key, its formula is lost in the source: textbooks take 1050 MPa",
)
"""The fault of nitrided flanks without an endurance limit."""


def one_hardness(brinell: float | None, rockwell: float | None) -> list[tuple[str, str]]:
    """Return the fault of flanks whose hardness is given in no scale or in both."""
    if (brinell is None) != (rockwell is None):
        return []
    got = "none" if brinell is None else "both"
    return [("hardness_HB", f"give exactly one of hardness_HB and hardness_HRC (got {got})")]


class FlankMaterialTable(Table):
    """What flanks are made of, against contact fatigue."""

    treatment: Treatment
    hardness_HB: Brinell | None = None
    hardness_HRC: Rockwell | None = None
    contact_limit_MPa: Stress | None = None
    contact_safety: AtLeastOne | None = None

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
