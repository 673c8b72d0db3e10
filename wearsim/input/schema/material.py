"""The tables [material.sprocket] and [material.roller]."""

from typing import Annotated

from pydantic import Field, field_validator

from wearsim.catalogue.catalogues import materials
from wearsim.input.schema.table import Table, known
from wearsim.input.units import Number, Positive


class MaterialTable(Table):
    """A material of the table by its name, or by its elastic constants."""

    name: str | None = None
    youngs_modulus_MPa: Positive | None = None
    poissons_ratio: Annotated[Number, Field(gt=-1.0, lt=0.5)] | None = None

    @field_validator("name")
    @classmethod
    def _known(cls, value: str | None) -> str | None:
        return known(value, dict(materials()), "material", "wearsim list materials")

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.name is None:
            return []
        return [
            (key, "the material's name gives this already: remove one of both")
            for key in ("youngs_modulus_MPa", "poissons_ratio")
            if getattr(self, key) is not None
        ]


class MaterialsTable(Table):
    """The materials in contact."""

    sprocket: MaterialTable = MaterialTable()
    roller: MaterialTable = MaterialTable()
