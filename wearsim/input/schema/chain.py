"""The table [chain]."""

from typing import Annotated

from pydantic import Field, field_validator

from wearsim.catalogue.catalogues import chain_name, chains, nearest_chain
from wearsim.input.schema.table import Table
from wearsim.input.units import Positive


class ChainTable(Table):
    """A chain of the catalogue by its designation, or one of one's own by its dimensions."""

    designation: str | None = None
    pitch_mm: Annotated[Positive, Field(ge=0.01, le=1e5)] | None = None
    """From below the finest chains to far beyond the largest; what is outside is a slip of units."""
    roller_diameter_mm: Positive | None = None
    inner_width_mm: Positive | None = None
    pin_diameter_mm: Positive | None = None
    bush_diameter_mm: Positive | None = None
    bearing_area_mm2: Positive | None = None
    mass_kg_per_m: Positive | None = None

    @field_validator("designation", mode="before")
    @classmethod
    def _text(cls, value: object) -> object:
        """A number is refused as its text is, with the chains that may be meant."""
        return str(value) if type(value) is int else value

    @field_validator("designation")
    @classmethod
    def _known(cls, value: str | None) -> str | None:
        if value is None or chain_name(value):
            return value
        raise ValueError(
            f"no such chain in the catalogue{nearest_chain(value)} (wearsim list chains shows them all)"
        )

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        own = ("pitch_mm", "roller_diameter_mm", "inner_width_mm")
        given = [key for key in own if getattr(self, key) is not None]
        if self.designation is not None:
            given += [key for key in self._known_by_designation() if getattr(self, key) is not None]
            return [(key, "a designation gives this already: remove one of both") for key in given]
        missing = [key for key in own if key not in given]
        if missing:
            message = (
                "give a designation, or pitch_mm, roller_diameter_mm and inner_width_mm "
                f"(missing: {', '.join(missing)})"
            )
            return [(missing[0], message)]
        assert self.roller_diameter_mm and self.pitch_mm
        if not self.roller_diameter_mm < self.pitch_mm:
            message = (
                f"the roller must be smaller than the pitch of {self.pitch_mm:g} mm "
                f"(got {self.roller_diameter_mm:g})"
            )
            return [("roller_diameter_mm", message)]
        inside = self.bush_diameter_mm or self.pin_diameter_mm
        if inside and inside > self.roller_diameter_mm:
            key = "bush_diameter_mm" if self.bush_diameter_mm else "pin_diameter_mm"
            message = f"must fit into the roller of {self.roller_diameter_mm:g} mm (got {inside:g})"
            return [(key, message)]
        return []

    def _known_by_designation(self) -> list[str]:
        chain = chains()[chain_name(self.designation or "") or ""]
        values = {
            "pin_diameter_mm": chain.pin_diameter,
            "bearing_area_mm2": chain.bearing_area,
            "mass_kg_per_m": chain.mass_per_length,
        }
        return [key for key, value in values.items() if value]
