"""The input of ``wearsim handbook face-load``: a wide pair of gears, its misalignment and its wear."""

from typing import Annotated

from pydantic import Field

from wearsim.handbook.face_load.model import (
    FaceGaps,
    FaceLoad,
    FlankWear,
    VariesWith,
    WidePair,
    face_load_factors,
)
from wearsim.input.table import CalculationTables, Table
from wearsim.input.units import NotNegative, Positive, PositiveNumber


class WidePairTable(Table):
    """The pair."""

    face_width_mm: Positive
    pinion_pitch_diameter_mm: Positive
    gear_ratio: Annotated[PositiveNumber, Field(ge=1.0)]
    mesh_stiffness_N_per_mm_um: Positive = 20.0
    slices: Annotated[int, Field(ge=10, le=2000)] = 200


class PairLoadTable(Table):
    """Load of the pair."""

    power_kW: Positive
    pinion_speed_rpm: Positive
    application_factor: Annotated[PositiveNumber, Field(ge=1.0)] = 1.0


class MisalignmentTable(Table):
    """The gap between the unloaded flanks over the face width."""

    fixed_misalignment_um: NotNegative = 0.0
    varying_misalignment_um: NotNegative = 0.0
    varies_with: VariesWith = "load"
    crown_um: NotNegative = 0.0


class RunningInTable(Table):
    """Wear of the flanks."""

    specific_wear_rate_mm2_per_N: Positive
    wheel_wear_ratio: NotNegative = 1.0
    slip_ratio: PositiveNumber
    time_hours: Positive


class SelfAligningTable(Table):
    """A pinion that tilts freely in the plane of action, to be compared with a fixed one."""

    pivot_friction_lever_mm: NotNegative | None = None


class FaceLoadTables(CalculationTables):
    """The whole file."""

    pair: WidePairTable
    load: PairLoadTable
    misalignment: MisalignmentTable
    running_in: RunningInTable
    self_aligning: SelfAligningTable = SelfAligningTable()

    def factors(self) -> FaceLoad:
        """Return the load along the face of the pair."""
        gaps, wear = self.misalignment, self.running_in
        return face_load_factors(
            self.pair.plain(WidePair, mesh_stiffness=1e3 * self.pair.mesh_stiffness_N_per_mm_um),
            FaceGaps(
                fixed=1e-3 * gaps.fixed_misalignment_um,
                varying=1e-3 * gaps.varying_misalignment_um,
                varies_with=gaps.varies_with,
                crown=1e-3 * gaps.crown_um,
            ),
            wear.plain(
                FlankWear, specific_wear_rate=wear.specific_wear_rate_mm2_per_N, hours=wear.time_hours
            ),
            power=self.load.power_kW,
            pinion_speed=self.load.pinion_speed_rpm,
            application_factor=self.load.application_factor,
            pivot_friction_lever=self.self_aligning.pivot_friction_lever_mm,
        )
