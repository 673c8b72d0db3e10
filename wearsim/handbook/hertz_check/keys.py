"""The input of ``wearsim handbook hertz-check``: a contact at the pitch point, and published values."""

import math
from itertools import pairwise
from typing import Annotated

from pydantic import BeforeValidator, Field

from wearsim.handbook.hertz_check.model import HertzCheck, PublishedStresses, TeethOfPair, pitch_point_check
from wearsim.handbook.hertz_check.pitch_point_contact import PitchPointContact, combinations
from wearsim.input.table import CalculationTables, Table
from wearsim.input.units import Number, Positive, PositiveNumber
from wearsim.mechanisms.gear_pair.keys import Teeth


def _listed(value: object) -> object:
    """Take one value for a list of it."""
    values = tuple(value) if isinstance(value, list | tuple) else (value,)
    if not 1 <= len(values) <= _MAX:
        raise ValueError(f"must be 1 to {_MAX} values, but are {len(values)}")
    return values


_MAX = 20
_SEVERAL = (BeforeValidator(_listed), Field(json_schema_extra={"minItems": 1, "maxItems": _MAX}))
Several = Annotated[tuple[Positive, ...], *_SEVERAL]
SeveralNumbers = Annotated[tuple[PositiveNumber, ...], *_SEVERAL]
Mesh = Annotated[int, Field(ge=2, le=32)]
Percent = Annotated[PositiveNumber, Field(lt=100.0)]


class ContactTable(Table):
    """A pair of straight teeth that touch at the pitch point."""

    torque_N_m: Positive
    gear_ratio: PositiveNumber
    face_width_mm: Positive
    pinion_pitch_diameter_mm: Positive
    working_pressure_angle_deg: Annotated[PositiveNumber, Field(ge=10.0, le=45.0)] = 20.0
    load_factor: PositiveNumber = 1.0
    youngs_modulus_MPa: Positive = 2.1e5
    wheel_youngs_modulus_MPa: Positive | None = None
    poissons_ratio: Annotated[Number, Field(ge=0.0, lt=0.5)] = 0.3


class TeethTable(Table):
    """The teeth, for the contact ratio and to hold the gear ratio against."""

    pinion_teeth: Teeth
    wheel_teeth: Teeth
    module_mm: Positive


class CombinationsTable(Table):
    """Values to combine, each with each; the contact's own where a key is left out."""

    torque_N_m: Several | None = None
    gear_ratio: SeveralNumbers | None = None
    face_width_mm: Several | None = None


class StressesTable(Table):
    """A row of a published comparison; what is lost in it is left out."""

    contact_stress_MPa: Positive | None = None
    surface_von_mises_MPa: Positive | None = None
    depth_von_mises_MPa: Positive | None = None


class HertzStressesTable(StressesTable):
    """The row of Hertz' formula."""

    contact_stress_MPa: Positive


class DifferenceTable(Table):
    """The row of the differences between both methods, to a tenth of a percent."""

    contact_difference_percent: Percent | None = None
    surface_difference_percent: Percent | None = None
    depth_difference_percent: Percent | None = None


class PublishedStressTable(Table):
    """A published comparison of Hertz' formula with finite elements."""

    hertz: HertzStressesTable
    finite_elements: StressesTable = StressesTable()
    difference: DifferenceTable = DifferenceTable()

    def stresses(self) -> PublishedStresses:
        """Return the rows by their columns, without what is lost."""
        rows = (self.hertz, self.finite_elements, self.difference)
        return PublishedStresses(
            *(
                {key.partition("_")[0]: float(value) for key, value in row if value is not None}
                for row in rows
            )
        )


class FiniteElementsTable(Table):
    """The meshes of ``--fem``, and stresses that any program found."""

    elements_per_half_width: Annotated[tuple[Mesh, ...], *_SEVERAL] = (4, 8, 16)
    axis_file: str | None = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        meshes = self.elements_per_half_width
        if all(fine > coarse for coarse, fine in pairwise(meshes)):
            return []
        text = f"each mesh must be finer than the one before, but they are {list(meshes)}: sort them"
        return [("elements_per_half_width", text)]


class HertzCheckTables(CalculationTables):
    """The whole file."""

    contact: ContactTable
    teeth: TeethTable | None = None
    combinations: CombinationsTable | None = None
    published: PublishedStressTable | None = None
    finite_elements: FiniteElementsTable = FiniteElementsTable()

    def pitch_point(self) -> PitchPointContact:
        """Return the contact of the pair."""
        modulus = self.contact.youngs_modulus_MPa
        return PitchPointContact(
            torque=1e3 * self.contact.torque_N_m,
            gear_ratio=self.contact.gear_ratio,
            face_width=self.contact.face_width_mm,
            pitch_diameter=self.contact.pinion_pitch_diameter_mm,
            pressure_angle=math.radians(self.contact.working_pressure_angle_deg),
            load_factor=self.contact.load_factor,
            youngs_modulus=(modulus, self.contact.wheel_youngs_modulus_MPa or modulus),
            poissons_ratio=self.contact.poissons_ratio,
        )

    def check(self) -> HertzCheck:
        """Return everything that is asked for but finite elements."""
        contact, requested = self.pitch_point(), self.combinations
        literal = []
        if requested is not None:
            torques = [1e3 * torque for torque in requested.torque_N_m or ()]
            literal = combinations(
                contact, torques, requested.face_width_mm or (), requested.gear_ratio or ()
            )
        return pitch_point_check(
            contact,
            teeth=None if self.teeth is None else self.teeth.plain(TeethOfPair),
            literal=literal,
            published=None if self.published is None else self.published.stresses(),
        )
