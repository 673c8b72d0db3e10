"""The input of ``wearsim handbook wave-drive``: a wave drive and what each method allows."""

from typing import Annotated, Literal

from pydantic import Field

from wearsim.handbook.wave_drive.model import MethodComparison, flexspline_diameters
from wearsim.input.table import CalculationTables, Table
from wearsim.input.units import Positive, PositiveNumber

Formula = Literal["corrected", "printed"]


class WaveDriveTable(Table):
    """The drive."""

    gear_ratio: PositiveNumber
    output_torque_N_m: Positive
    life_hours: Positive = 10000.0
    generator_speed_rpm: Positive
    tooth_length_ratio: Annotated[PositiveNumber, Field(le=1.0)] = 0.2


class PublishedDiameterTable(Table):
    """Published diameter with which to compare the result of a method."""

    published_diameter_mm: Positive | None = None


class PressureTable(PublishedDiameterTable):
    """Pressure between the teeth."""

    allowable_pressure_MPa: Positive = 62.5
    load_nonuniformity: PositiveNumber = 1.5
    engaged_share: Annotated[PositiveNumber, Field(le=1.0)] = 0.235


class CrushingTable(PublishedDiameterTable):
    """Crushing of the flanks."""

    allowable_crushing_MPa: Positive = 20.0


class TorsionTable(PublishedDiameterTable):
    """Torsion of the rim."""

    allowable_shear_MPa: Positive = 75.0
    diameter_to_thickness: PositiveNumber = 90.0
    torsion_coefficient: PositiveNumber | None = None
    formula: Formula = "corrected"


class ToothWearTable(PublishedDiameterTable):
    """Wear of the teeth under shocks."""

    allowable_crushing_MPa: Positive = 15.0
    dynamic_factor: Annotated[PositiveNumber, Field(ge=1.0)] = 1.0


class FlankPressureTable(PublishedDiameterTable):
    """Wear of the teeth by the pressure on the flanks."""

    allowable_pressure_MPa: Positive = 22.5


class RimBendingTable(PublishedDiameterTable):
    """Endurance of the rim under its own bending and the torque."""

    endurance_limit_MPa: Positive = 450.0
    safety_factor: Annotated[PositiveNumber, Field(ge=1.0)] = 1.7
    stress_concentration: Annotated[PositiveNumber, Field(ge=1.0)] = 1.65
    tooth_form_factor: PositiveNumber = 1.35
    thickness_ratio: Annotated[PositiveNumber, Field(lt=1.0)] = 0.0125
    youngs_modulus_MPa: Positive = 2.1e5
    formula: Formula = "corrected"


class RimEnduranceTable(PublishedDiameterTable):
    """Endurance of the rim with the speed of the generator."""

    endurance_limit_MPa: Positive = 350.0
    safety_factor: Annotated[PositiveNumber, Field(ge=1.0)] = 1.65
    stress_concentration: Annotated[PositiveNumber, Field(ge=1.0)] | None = None


class GeneratorBearingTable(PublishedDiameterTable):
    """Load rating of the generator's bearing."""

    bearing_constant: PositiveNumber


class WaveDriveTables(CalculationTables):
    """The whole file."""

    wave_drive: WaveDriveTable
    pressure: PressureTable = PressureTable()
    crushing: CrushingTable = CrushingTable()
    torsion: TorsionTable = TorsionTable()
    tooth_wear: ToothWearTable = ToothWearTable()
    flank_pressure: FlankPressureTable = FlankPressureTable()
    rim_bending: RimBendingTable = RimBendingTable()
    rim_endurance: RimEnduranceTable = RimEnduranceTable()
    generator_bearing: GeneratorBearingTable | None = None

    def diameters(self) -> MethodComparison:
        """Return the diameter by each of the methods."""
        given = {name: table for name, table in self if isinstance(table, PublishedDiameterTable)}
        return flexspline_diameters(
            self.wave_drive.model_dump(),
            {
                name: table.model_dump(exclude={"published_diameter_mm", "formula"}, exclude_none=True)
                for name, table in given.items()
            },
            printed=[name for name, table in given.items() if getattr(table, "formula", "") == "printed"],
            published={
                name: table.published_diameter_mm
                for name, table in given.items()
                if table.published_diameter_mm is not None
            },
            required=self.model_fields_set & given.keys(),
        )
