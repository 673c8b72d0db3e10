"""The input of a life of a gear pair."""

import itertools
from typing import Annotated, Any, Literal

from pydantic import Field

from wearsim.case.keys.study_tables import OptimiseTable, Uncertainty
from wearsim.case.keys.wear_tables import (
    Depth,
    FatigueTable,
    FilmTable,
    FlankMaterialTable,
    MaterialTable,
    RunTable,
    WearTable,
)
from wearsim.input.table import CalculationTables, Table
from wearsim.input.units import Number, Positive, PositiveNumber, Series, Signed, Speed
from wearsim.lubrication.keys import LubricationTable

Teeth = Annotated[int, Field(ge=5, le=1000)]


_KEYS = {
    "involute": (
        "pressure_angle_deg",
        "pinion_shift",
        "wheel_shift",
        "pinion_tip_radius_mm",
        "wheel_tip_radius_mm",
    ),
    "convex_concave": (
        "pitch_point_angle_deg",
        "addendum_arc_radius_mm",
        "dedendum_arc_radius_mm",
        "addendum_ratio",
    ),
    "prescribed_stress": (
        "contact_stress_MPa",
        "stress_pitch_point_distance_mm",
        "design_torque_N_m",
        "first_pitch_point_distance_mm",
        "last_pitch_point_distance_mm",
    ),
}
_NEEDED = (
    "addendum_arc_radius_mm",
    "contact_stress_MPa",
    "first_pitch_point_distance_mm",
    "last_pitch_point_distance_mm",
)


class GearTable(Table):
    """The pair: spur gears without backlash, of a profile with its own keys."""

    profile: Literal["involute", "convex_concave", "prescribed_stress"] = "involute"
    pinion_teeth: Teeth
    wheel_teeth: Teeth
    module_mm: Positive
    face_width_mm: Positive
    nodes: Annotated[int, Field(ge=21, le=2001)] | None = None
    pressure_angle_deg: Annotated[PositiveNumber, Field(ge=10.0, le=35.0)] | None = None
    pinion_shift: Annotated[Number, Field(ge=-2.0, le=2.0)] | None = None
    wheel_shift: Annotated[Number, Field(ge=-2.0, le=2.0)] | None = None
    pinion_tip_radius_mm: Positive | None = None
    wheel_tip_radius_mm: Positive | None = None
    pitch_point_angle_deg: Annotated[Positive, Field(lt=45.0)] | None = None
    addendum_arc_radius_mm: Positive | None = None
    dedendum_arc_radius_mm: Positive | None = None
    addendum_ratio: PositiveNumber | None = None
    contact_stress_MPa: Series | None = None
    stress_pitch_point_distance_mm: Series | None = None
    design_torque_N_m: Positive | None = None
    first_pitch_point_distance_mm: Annotated[Signed, Field(lt=0.0)] | None = None
    last_pitch_point_distance_mm: Annotated[Signed, Field(gt=0.0)] | None = None

    @classmethod
    def gives_way(cls, key: str, value: Any) -> tuple[str, ...]:
        """Return the keys whose place a new value of a key takes."""
        others = (keys for owner, keys in _KEYS.items() if key == "profile" and owner != value)
        return tuple(name for keys in others for name in keys)

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        found = [
            (key, f"belongs to profile = {owner!r}: remove it")
            for owner, keys in _KEYS.items()
            if owner != self.profile
            for key in keys
            if getattr(self, key) is not None
        ]
        found += [
            (key, f"profile = {self.profile!r} needs this key")
            for key in _KEYS[self.profile]
            if key in _NEEDED and getattr(self, key) is None
        ]
        if self.contact_stress_MPa is not None:
            stress, distance = self.contact_stress_MPa, self.stress_pitch_point_distance_mm
            names = ("contact_stress_MPa", "stress_pitch_point_distance_mm")
            found += stress_conflicts(stress, distance, names)
        if not found and self.stress_pitch_point_distance_mm is not None:
            given, ends = self.stress_pitch_point_distance_mm, self.reach
            if not given[0] <= ends[0] < ends[1] <= given[-1]:
                message = f"must reach from {ends[0]:g} to {ends[1]:g} as contact does"
                found.append(
                    ("stress_pitch_point_distance_mm", f"{message} (got {given[0]:g} to {given[-1]:g})")
                )
        return found

    @property
    def reach(self) -> tuple[float, float]:
        """Distances from the pitch point at which contact starts and ends [mm]."""
        return self.first_pitch_point_distance_mm or 0.0, self.last_pitch_point_distance_mm or 0.0


class GearMaterialsTable(Table):
    """The materials in contact."""

    pinion: MaterialTable = MaterialTable()
    wheel: MaterialTable = MaterialTable()


class GearMechanismTable(Table):
    """How pairs of teeth share the load."""

    kind: Literal["gear_pair"] = "gear_pair"
    load_sharing: Literal["elastic", "rigid"] = "elastic"
    pair_stiffness_N_per_mm_um: Annotated[Positive, Field(le=1000.0)] | None = None

    @classmethod
    def gives_way(cls, key: str, value: Any) -> tuple[str, ...]:
        """Return the keys whose place a new value of a key takes."""
        return ("pair_stiffness_N_per_mm_um",) if (key, value) == ("load_sharing", "rigid") else ()

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.load_sharing == "elastic" or self.pair_stiffness_N_per_mm_um is None:
            return []
        return [("pair_stiffness_N_per_mm_um", "does not belong to load_sharing = 'rigid': remove it")]


class GearLoadTable(Table):
    """Torque and speed of the pinion."""

    torque_N_m: Positive
    speed_rpm: Speed


class GearWearTable(WearTable):
    """The wear law of the pinion, and the wheel's coefficient over its."""

    wheel_wear_ratio: Annotated[PositiveNumber, Field(ge=1e-4, le=1e4)] = 1.0

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        chains = {
            "condition": "wear conditions are those of sprockets: give specific_wear_rate_mm2_per_N",
            "roller_wear_ratio": "belongs to chains: remove it",
            "case_depth_mm": "a hardened layer is not modelled on gears: remove it",
            "core_factor": "a hardened layer is not modelled on gears: remove it",
        }
        found = [(key, text) for key, text in chains.items() if getattr(self, key) is not None]
        return found + [entry for entry in super().conflicts() if entry[0] not in chains]


class GearStopTable(Table):
    """Limits of the worn flanks; the first one met ends the life."""

    critical_depth_mm: Depth
    wheel_critical_depth_mm: Depth | None = None


class GearFatigueTable(FatigueTable):
    """Contact fatigue of both gears."""

    pinion: FlankMaterialTable
    wheel: FlankMaterialTable


class GearLubricationTable(LubricationTable):
    """The lubricant of both flanks."""

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        rows = "the rows of the catalogue are for chains: give"
        chains = {
            "lubricant": f"{rows} lasts_hours and dry_factor",
            "environment": f"{rows} contamination_factor",
            **dict.fromkeys(
                ("interval_km", "at_km", "lasts_km", "fades_over_km"), "gears run no km: give hours"
            ),
        }
        found = [(key, text) for key, text in chains.items() if getattr(self, key) is not None]
        for number, phase in enumerate(self.phase, start=1):
            found += [
                (f"phase.{number}.{key}", chains[of])
                for key, of in (("environment", "environment"), ("km", "at_km"))
                if getattr(phase, key) is not None
            ]
        return found + super().conflicts()


class GearTables(CalculationTables):
    """The whole file."""

    gear: GearTable
    material: GearMaterialsTable = GearMaterialsTable()
    mechanism: GearMechanismTable = GearMechanismTable()
    load: GearLoadTable
    lubrication: GearLubricationTable | None = None
    wear: GearWearTable
    film: FilmTable | None = None
    fatigue: GearFatigueTable | None = None
    stop: GearStopTable
    run: RunTable = RunTable()
    uncertainty: Uncertainty | None = None
    optimise: OptimiseTable | None = None


def stress_conflicts(
    stress: tuple[float, ...], distance: tuple[float, ...] | None, names: tuple[str, str]
) -> list[tuple[str, str]]:
    """Return what is wrong with stresses and the distances from the pitch point at which they are given."""
    found = []
    if not all(value > 0.0 for value in stress) or not stress:
        found.append((names[0], f"must be above 0 (got {listed(stress)})"))
    if distance is None:
        if len(stress) > 1:
            found.append((names[1], "several stresses need one distance for each"))
        return found
    if len(distance) != len(stress):
        message = f"must have one entry for each stress, {len(stress)} (got {len(distance)})"
        found.append((names[1], message))
    if not all(a < b for a, b in itertools.pairwise(distance)):
        found.append((names[1], f"must ascend (got {listed(distance)})"))
    return found


def listed(values: tuple[float, ...]) -> str:
    """Return numbers as a fault names them."""
    return ", ".join(f"{value:g}" for value in values) or "nothing"
