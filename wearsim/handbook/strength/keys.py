"""The input of ``wearsim handbook strength``: a gear pair, its life, its loads and what its teeth endure."""

import math
from typing import Annotated, Literal

from pydantic import Field

from wearsim.case.keys.drive_tables import Regime
from wearsim.case.keys.wear_tables import (
    NITRIDED_LIMIT,
    AtLeastOne,
    Brinell,
    Rockwell,
    Stress,
    Treatment,
    one_hardness,
)
from wearsim.fatigue.endurance import service_hours
from wearsim.handbook.strength.model import (
    GearMaterial,
    PairLoad,
    PairStrength,
    SpectrumStep,
    StrengthRules,
    pair_strength,
)
from wearsim.handbook.strength.spectrum import OVERLOAD_CYCLES
from wearsim.input.table import CalculationTables, Table
from wearsim.input.units import Number, Positive, PositiveNumber

_YIELDS = ("normalised", "quenched_and_tempered", "through_hardened")

Share = Annotated[PositiveNumber, Field(le=1.0)]
Factor = Annotated[PositiveNumber, Field(ge=0.01, le=100.0)]
Length = Annotated[Positive, Field(ge=0.01, le=1e5)]
BaseCycles = Annotated[PositiveNumber, Field(ge=1e3, le=1e12)]


class StrengthDriveTable(Table):
    """Speed, ratio, life and loading of the pair."""

    pinion_speed_rpm: Annotated[Positive, Field(le=1e6)]
    gear_ratio: AtLeastOne
    life_hours: Annotated[Positive, Field(le=1e7)] | None = None
    life_years: Annotated[PositiveNumber, Field(le=1000.0)] | None = None
    year_share: Share = 1.0
    day_share: Share = 1.0
    regime: Regime | None = None

    @property
    def hours(self) -> float:
        """Running time over the life [h]."""
        if self.life_hours is not None:
            return self.life_hours
        assert self.life_years is not None
        return service_hours(self.life_years, self.year_share, self.day_share)

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.life_hours is None and self.life_years is None:
            return [("life_hours", "give exactly one of life_hours and life_years (got none)")]
        if self.life_hours is None:
            return []
        return [
            (key, "life_hours gives the life already: remove one of the two")
            for key in ("life_years", "year_share", "day_share")
            if key in self.model_fields_set
        ]


class LoadSpectrumStep(Table):
    """A torque of the load spectrum with the time it acts."""

    relative_torque: Annotated[Number, Field(ge=0.0, le=1000.0)]
    share_of_time: Share | None = None
    overload_cycles: Annotated[PositiveNumber, Field(lt=OVERLOAD_CYCLES)] | None = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if (self.share_of_time is None) == (self.overload_cycles is None):
            got = "none" if self.share_of_time is None else "both"
            message = f"give exactly one of share_of_time and overload_cycles (got {got})"
            return [("share_of_time", message)]
        return []


class StrengthGearTable(Table):
    """Material of pinion or wheel; what is left out follows from the treatment."""

    treatment: Treatment
    hardness_HB: Brinell | None = None
    hardness_HRC: Rockwell | None = None
    core_hardness_HRC: Rockwell | None = None
    yield_strength_MPa: Stress | None = None
    youngs_modulus_MPa: Annotated[Positive, Field(ge=100.0, le=1e6)] = 2.1e5
    poissons_ratio: Annotated[Number, Field(gt=-1.0, lt=0.5)] = 0.3
    meshings_per_revolution: Annotated[int, Field(ge=1, le=100)] = 1
    contact_limit_MPa: Stress | None = None
    contact_base_cycles: BaseCycles | None = None
    contact_safety: AtLeastOne | None = None
    greatest_contact_life_factor: AtLeastOne | None = None
    greatest_contact_MPa: Stress | None = None
    roughness_factor: Factor = 1.0
    speed_factor: Factor = 1.0
    bending_limit_MPa: Stress | None = None
    bending_base_cycles: BaseCycles = 4e6
    bending_exponent: AtLeastOne | None = None
    bending_safety: AtLeastOne = 1.7
    greatest_bending_life_factor: AtLeastOne | None = None
    greatest_bending_MPa: Stress | None = None
    fillet_factor: Factor = 1.0
    reversal_factor: Annotated[PositiveNumber, Field(le=1.0)] = 1.0
    form_factor: Factor | None = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        found = one_hardness(self.hardness_HB, self.hardness_HRC)
        if self.yield_strength_MPa is not None:
            found += self._of_yield()
        return found + self._of_nitriding()

    def _of_yield(self) -> list[tuple[str, str]]:
        if self.treatment not in _YIELDS:
            message = f"belongs to treatment = {' or '.join(map(repr, _YIELDS))}: remove it"
            return [("yield_strength_MPa", message)]
        if self.greatest_contact_MPa is not None:
            message = "greatest_contact_MPa gives what this is for already: remove one of the two"
            return [("yield_strength_MPa", message)]
        return []

    def _of_nitriding(self) -> list[tuple[str, str]]:
        core = self.core_hardness_HRC is not None
        if self.treatment != "nitrided":
            message = "belongs to treatment = 'nitrided': remove it"
            return [("core_hardness_HRC", message)] if core else []
        found = []
        if self.contact_limit_MPa is None:
            found.append(NITRIDED_LIMIT)
        if core == (self.bending_limit_MPa is not None):
            message = (
                "treatment = 'nitrided' needs exactly one of bending_limit_MPa and core_hardness_HRC "
                f"(12 HRC + 290) (got {'both' if core else 'none'})"
            )
            found.append(("core_hardness_HRC", message))
        return found


class StrengthFatigueTable(Table):
    """Interpretation of the curve of contact fatigue."""

    base_cycles: Literal["gost", "source"] = "gost"
    long_life: Literal["constant", "gost"] = "constant"


class OverloadTable(Table):
    """The greatest torque, and the safety against it."""

    overload_ratio: AtLeastOne | None = None
    overload_frequency_factor: Annotated[PositiveNumber, Field(ge=1.0, le=1.3)] = 1.0
    static_safety: AtLeastOne = 1.75


class StrengthLoadTable(Table):
    """Actual load of the pair."""

    pinion_torque_N_m: Annotated[Positive, Field(ge=1e-6, le=1e9)]
    module_mm: Length
    pinion_teeth: Annotated[int, Field(ge=5, le=1000)]
    face_width_mm: Length
    pressure_angle_deg: Annotated[Positive, Field(ge=10.0, le=35.0)] = 20.0
    application_factor: Factor | None = None
    initial_face_load_factor: AtLeastOne
    running_in_share: Annotated[PositiveNumber, Field(le=1.0)]
    accuracy_grade: Annotated[int, Field(ge=5, le=9)] | None = None
    initial_transverse_load_factor: AtLeastOne | None = None
    contact_dynamic_factor: AtLeastOne
    bending_dynamic_factor: AtLeastOne
    formula: Literal["corrected", "printed"] = "corrected"

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if (self.accuracy_grade is None) == (self.initial_transverse_load_factor is None):
            got = "none" if self.accuracy_grade is None else "both"
            message = f"give exactly one of accuracy_grade and initial_transverse_load_factor (got {got})"
            return [("accuracy_grade", message)]
        return []


class StrengthTables(CalculationTables):
    """The whole file."""

    drive: StrengthDriveTable
    load_spectrum: list[LoadSpectrumStep] = Field(default_factory=list)
    pinion: StrengthGearTable
    wheel: StrengthGearTable
    fatigue: StrengthFatigueTable = StrengthFatigueTable()
    overload: OverloadTable = OverloadTable()
    load: StrengthLoadTable | None = None

    def strength(self) -> PairStrength:
        """Return the strength of the pair."""
        rules = {**self.fatigue.model_dump(), **self.overload.model_dump()}
        return pair_strength(
            self.pinion.plain(GearMaterial),
            self.wheel.plain(GearMaterial),
            pinion_speed=self.drive.pinion_speed_rpm,
            gear_ratio=self.drive.gear_ratio,
            hours=self.drive.hours,
            regime=self.drive.regime or "0",
            load_spectrum=[step.plain(SpectrumStep) for step in self.load_spectrum],
            rules=StrengthRules(**rules),
            load=None if self.load is None else self.load.plain(PairLoad),
        )

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the tables."""
        if not self.load_spectrum:
            return []
        found = []
        if self.drive.regime is not None:
            found.append(("drive.regime", "[[load_spectrum]] gives the loads already: remove one of the two"))
        total = math.fsum(step.share_of_time or 0.0 for step in self.load_spectrum)
        if abs(total - 1.0) > 1e-6:
            message = f"the shares of time must come to 1, come to {total:.6g}: correct them"
            found.append(("load_spectrum", message))
        return found
