"""The input of a life of a gear pair."""

from typing import Annotated, Literal

from pydantic import Field

from wearsim.case.schema.calculation import CalculationTables
from wearsim.case.schema.material import MaterialTable
from wearsim.case.schema.run import RunTable
from wearsim.case.schema.stop import Depth
from wearsim.case.schema.strength import (
    NITRIDED_LIMIT,
    AtLeastOne,
    Brinell,
    Rockwell,
    Stress,
    Treatment,
    one_hardness,
)
from wearsim.case.schema.table import Table
from wearsim.case.schema.wear import WearTable
from wearsim.case.units import Number, Positive, PositiveNumber

Teeth = Annotated[int, Field(ge=5, le=1000)]


class GearTable(Table):
    """The pair: involute spur gears without backlash."""

    pinion_teeth: Teeth
    wheel_teeth: Teeth
    module_mm: Positive
    pressure_angle_deg: Annotated[PositiveNumber, Field(ge=10.0, le=35.0)] = 20.0
    pinion_shift: Annotated[Number, Field(ge=-2.0, le=2.0)] = 0.0
    wheel_shift: Annotated[Number, Field(ge=-2.0, le=2.0)] = 0.0
    pinion_tip_radius_mm: Positive | None = None
    wheel_tip_radius_mm: Positive | None = None
    face_width_mm: Positive
    nodes: Annotated[int, Field(ge=21, le=2001)] | None = None


class GearMaterialsTable(Table):
    """The materials in contact."""

    pinion: MaterialTable = MaterialTable()
    wheel: MaterialTable = MaterialTable()


class GearMechanismTable(Table):
    """How pairs of teeth share the load."""

    kind: Literal["gear_pair"] = "gear_pair"
    load_sharing: Literal["elastic", "rigid"] = "elastic"
    pair_stiffness_N_per_mm_um: Positive | None = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.load_sharing == "elastic" or self.pair_stiffness_N_per_mm_um is None:
            return []
        return [
            ("pair_stiffness_N_per_mm_um", "does not belong to load_sharing = 'rigid': remove it")
        ]


class GearLoadTable(Table):
    """Torque and speed of the pinion."""

    torque_N_m: Positive
    speed_rpm: Positive


class GearWearTable(WearTable):
    """The wear law of the pinion, and the wheel's coefficient over its."""

    wheel_wear_ratio: PositiveNumber = 1.0

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        chains = {
            "condition": "wear conditions are those of sprockets: give specific_wear_rate_mm2_per_N",
            "roller_wear_ratio": "belongs to chains: remove it",
            "case_depth_mm": "a hardened layer is not told apart on gears: remove it",
            "core_factor": "a hardened layer is not told apart on gears: remove it",
        }
        found = [(key, text) for key, text in chains.items() if getattr(self, key) is not None]
        return found + [entry for entry in super().conflicts() if entry[0] not in chains]


class GearStopTable(Table):
    """Limits of the worn flanks; the first one met ends the life."""

    critical_depth_mm: Depth
    wheel_critical_depth_mm: Depth | None = None


class GearSideTable(Table):
    """Material of pinion or wheel against contact fatigue."""

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


class GearFatigueTable(Table):
    """Contact fatigue beside the wear."""

    load_factor: AtLeastOne = 1.0
    pinion: GearSideTable
    wheel: GearSideTable


class GearTables(CalculationTables):
    """The whole file."""

    title: str = ""
    gear: GearTable
    material: GearMaterialsTable = GearMaterialsTable()
    mechanism: GearMechanismTable = GearMechanismTable()
    load: GearLoadTable
    wear: GearWearTable
    fatigue: GearFatigueTable | None = None
    stop: GearStopTable
    run: RunTable = RunTable()
