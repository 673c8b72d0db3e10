"""The input of ``wearsim handbook stiffness-spectrum``: a gear pair with pitch errors."""

import math
from typing import Annotated, Literal

from pydantic import Field

from wearsim.handbook.stiffness_spectrum.mesh_statics import LoadedTeeth
from wearsim.handbook.stiffness_spectrum.model import (
    SpectrumChoice,
    StiffnessSpectrum,
    ToothErrors,
    mesh_spectrum,
)
from wearsim.input.table import CalculationTables, Table
from wearsim.input.units import NotNegative, Positive, PositiveNumber

Model = Literal["pairs", "double_sum"]
SeriesFormula = Literal["corrected", "printed", "printed_argument", "printed_sums", "printed_amplitude"]


class WheelTable(Table):
    """One of the two wheels and its pitch error, a sine over the tooth number."""

    teeth: Annotated[int, Field(ge=5, le=300)]
    pitch_error_mm: NotNegative
    error_order: Annotated[int, Field(ge=1)] = 1
    error_phase_deg: Annotated[NotNegative, Field(le=360.0)] = 0.0

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if 2 * self.error_order > self.teeth:
            message = (
                f"must be at most half the teeth, {self.teeth // 2}, is {self.error_order}: the teeth "
                "cannot represent more waves"
            )
            return [("error_order", message)]
        if 2 * self.error_order == self.teeth and self.error_phase_deg % 180.0 == 0.0:
            message = (
                "must not be a multiple of 180 for an error_order of half the teeth, because all teeth "
                "would be at zeros of the error: use 90"
            )
            return [("error_phase_deg", message)]
        return []


class SpectrumPairTable(Table):
    """Common data of both wheels: standard teeth without profile shift."""

    module_mm: Positive
    pressure_angle_deg: Annotated[Positive, Field(ge=10.0, le=35.0)] = 20.0
    pinion_speed_rpm: Positive | None = None


class SpectrumTable(Table):
    """Definition of contact, and the lines to compute."""

    model: Model = "pairs"
    tooth_harmonics: Annotated[int, Field(ge=1, le=20)] = 3
    sideband_order: Annotated[int, Field(ge=0, le=5)] = 2
    lines_shown: Annotated[int, Field(ge=1, le=1000)] = 16
    formula: SeriesFormula | None = None
    series_harmonics: Annotated[int, Field(ge=10, le=100_000)] | None = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.model == "double_sum":
            return []
        message = 'belongs to the closed form of model = "double_sum": remove it or set that model'
        return [(key, message) for key in ("formula", "series_harmonics") if getattr(self, key) is not None]


class StaticsTable(Table):
    """Load and bodies for the deflection: what turns contacts into a stiffness."""

    force_N: Positive | None = None
    pinion_torque_N_m: Positive | None = None
    pinion_curvature_radius_mm: Positive
    wheel_curvature_radius_mm: Positive
    youngs_modulus_MPa: Positive = 2.1e5
    poissons_ratio: Annotated[PositiveNumber, Field(lt=0.5)] = 0.3
    energy_exponent: Annotated[PositiveNumber, Field(ge=1.5, le=4.0)] = 2.5
    formula: Literal["corrected", "printed"] | None = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        found = []
        if (self.force_N is None) == (self.pinion_torque_N_m is None):
            given = "none" if self.force_N is None else "both"
            message = f"give exactly one of force_N, pinion_torque_N_m (got {given})"
            found.append(("pinion_torque_N_m", message))
        if self.formula is not None and self.pinion_torque_N_m is None:
            found.append(("formula", "belongs to pinion_torque_N_m: remove it"))
        return found


class StiffnessSpectrumTables(CalculationTables):
    """The whole file."""

    gear_pair: SpectrumPairTable
    pinion: WheelTable
    wheel: WheelTable
    spectrum: SpectrumTable = SpectrumTable()
    statics: StaticsTable | None = None

    def answer(self) -> StiffnessSpectrum:
        """Return the spectrum of the pair."""
        return mesh_spectrum(
            self.pinion.plain(ToothErrors),
            self.wheel.plain(ToothErrors),
            module=self.gear_pair.module_mm,
            pressure_angle=math.radians(self.gear_pair.pressure_angle_deg),
            pinion_speed=self.gear_pair.pinion_speed_rpm,
            choice=self.spectrum.plain(SpectrumChoice),
            load=None if self.statics is None else self.statics.plain(LoadedTeeth),
        )
