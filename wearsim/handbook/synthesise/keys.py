"""The input of ``wearsim handbook synthesise``: gears, and the stress along their paths of contact."""

import math
from typing import Annotated, Literal

from pydantic import Field

from wearsim.case.keys.wear_tables import MaterialTable
from wearsim.catalogue.catalogues import materials
from wearsim.contact.prescribed_stress import LoadedPair
from wearsim.handbook.synthesise.model import MeshPhase, MeshPlane, PhaseStart, loaded_pair, profile_phases
from wearsim.input.table import CalculationTables, Table
from wearsim.input.units import Positive, PositiveNumber, Series, Signed
from wearsim.mechanisms.gear_pair.keys import listed, stress_conflicts


class SynthesisPairTable(Table):
    """The pair."""

    centre_distance_mm: Positive
    gear_ratio: PositiveNumber


class PairMaterialsTable(Table):
    """Material of the wheels; steel by default."""

    pinion: MaterialTable = MaterialTable()
    wheel: MaterialTable = MaterialTable()


class MeshLoadTable(Table):
    """Load of one pair of teeth: a constant torque, or a constant normal load."""

    pinion_torque_N_m: Positive | None = None
    face_width_mm: Positive | None = None
    load_per_width_N_per_mm: Positive | None = None
    pinion_speed_rpm: Positive

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        torque = ("pinion_torque_N_m", "face_width_mm")
        if self.load_per_width_N_per_mm is not None:
            message = "load_per_width_N_per_mm gives the load: remove one of the two"
            return [(key, message) for key in torque if getattr(self, key) is not None]
        message = "give pinion_torque_N_m and face_width_mm, or load_per_width_N_per_mm"
        return [(key, message) for key in torque if getattr(self, key) is None]


class StressTable(Table):
    """The contact stress: one for all, or one at each of some distances from the pitch point."""

    contact_stress_MPa: Series
    pitch_point_distance_mm: Series | None = None

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        names = ("contact_stress_MPa", "pitch_point_distance_mm")
        return stress_conflicts(self.contact_stress_MPa, self.pitch_point_distance_mm, names)


class PhaseTable(Table):
    """A path of contact: through the pitch point, or from a point beside it."""

    family: Literal[1, -1] = 1
    first_pitch_point_distance_mm: Signed | None = None
    last_pitch_point_distance_mm: Signed
    start_x_mm: Signed | None = None
    start_y_mm: Signed | None = None
    nodes: Annotated[int, Field(ge=11, le=20001)] = 201

    @property
    def start(self) -> tuple[float, float] | None:
        """Distance from the pitch point [mm] and pressure angle [rad] of the point it starts from."""
        if self.start_x_mm is None or self.start_y_mm is None:
            return None
        distance = math.copysign(math.hypot(self.start_x_mm, self.start_y_mm), self.start_x_mm)
        return distance, math.atan(self.start_y_mm / self.start_x_mm)

    @property
    def reach(self) -> tuple[float, float]:
        """Least and greatest distance from the pitch point [mm]."""
        first = self.start[0] if self.start else self.first_pitch_point_distance_mm
        last = self.last_pitch_point_distance_mm
        return (last, last) if first is None else (min(first, last), max(first, last))

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        if self.start_x_mm is None and self.start_y_mm is None:
            return self._pitch_point_conflicts()
        missing = [key for key in ("start_x_mm", "start_y_mm") if getattr(self, key) is None]
        if missing:
            return [(missing[0], "a point needs both coordinates: give it too")]
        found = []
        if self.first_pitch_point_distance_mm is not None:
            found.append(("first_pitch_point_distance_mm", "start_x_mm gives the start: remove one"))
        if not self.start_x_mm * self.start_y_mm > 0.0:  # type: ignore[operator]
            message = f"must have the sign of start_x_mm, {self.start_x_mm:g} (got {self.start_y_mm:g})"
            return [*found, ("start_y_mm", f"{message}: the pressure angle is above 0")]
        first, last = self.start[0], self.last_pitch_point_distance_mm  # type: ignore[index]
        if not first * last > 0.0 or first == last:
            message = f"must be on the side of the start, {first:g}, and not there (got {last:g})"
            found.append(("last_pitch_point_distance_mm", message))
        return found

    def _pitch_point_conflicts(self) -> list[tuple[str, str]]:
        if self.family == -1:
            message = "must be 1 without start_x_mm: the small radii never reach the pitch point (got -1)"
            return [("family", message)]
        first, last = self.first_pitch_point_distance_mm, self.last_pitch_point_distance_mm
        if first is None:
            return [("first_pitch_point_distance_mm", "give this, or start_x_mm and start_y_mm")]
        if not first < last:
            return [("last_pitch_point_distance_mm", f"must be above the first, {first:g} (got {last:g})")]
        return []


class InvoluteTable(Table):
    """The involute to compare with; by default that through the pitch point or the start of a phase."""

    pressure_angle_deg: Annotated[Positive, Field(lt=90.0)] | None = None


class MeshFieldTable(Table):
    """The part of the plane of mesh that fields are drawn over."""

    x_from_mm: Signed
    x_to_mm: Signed
    y_from_mm: Signed
    y_to_mm: Signed
    field_nodes: Annotated[int, Field(ge=11, le=401)] = 81
    directions_deg: Series = ()

    @property
    def plane(self) -> MeshPlane:
        """The same in plain numbers."""
        sides = (self.x_from_mm, self.x_to_mm), (self.y_from_mm, self.y_to_mm)
        return MeshPlane(*sides, self.field_nodes, tuple(self.directions_deg))

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the keys of this table."""
        found = [
            (f"{axis}_to_mm", f"must be above {axis}_from_mm, {low:g} (got {high:g})")
            for axis, low, high in (("x", self.x_from_mm, self.x_to_mm), ("y", self.y_from_mm, self.y_to_mm))
            if not low < high
        ]
        if not all(abs(angle) < 90.0 for angle in self.directions_deg):
            message = f"must be between -90 and 90 (got {listed(self.directions_deg)})"
            found.append(("directions_deg", message))
        return found


class SynthesisTables(CalculationTables):
    """The whole file."""

    gears: SynthesisPairTable
    material: PairMaterialsTable = PairMaterialsTable()
    load: MeshLoadTable
    stress: StressTable
    phase: Annotated[list[PhaseTable], Field(min_length=1)]
    involute: InvoluteTable = InvoluteTable()
    field: MeshFieldTable | None = None

    def pair(self) -> LoadedPair:
        """Return the pair with its stress."""
        load, (pinion, wheel) = self.load, (_elastic(self.material.pinion), _elastic(self.material.wheel))
        torque = load.pinion_torque_N_m
        return loaded_pair(
            centre_distance=self.gears.centre_distance_mm,
            gear_ratio=self.gears.gear_ratio,
            contact_stress=self.stress.contact_stress_MPa,
            pitch_point_distance=self.stress.pitch_point_distance_mm,
            load_per_width=load.load_per_width_N_per_mm,
            pinion_torque=None if torque is None else 1e3 * torque,
            face_width=load.face_width_mm,
            pinion_speed=load.pinion_speed_rpm,
            youngs_modulus=(pinion[0], wheel[0]),
            poissons_ratio=(pinion[1], wheel[1]),
        )

    def phases(self, pair: LoadedPair) -> tuple[MeshPhase, ...]:
        """Return the paths of contact that are asked for."""
        angle = self.involute.pressure_angle_deg
        starts = [
            PhaseStart(
                phase.last_pitch_point_distance_mm,
                phase.first_pitch_point_distance_mm,
                phase.start,
                phase.family,
                phase.nodes,
            )
            for phase in self.phase
        ]
        return profile_phases(pair, starts, None if angle is None else math.radians(angle))

    def conflicts(self) -> list[tuple[str, str]]:
        """Return what is wrong between the tables."""
        given = self.stress.pitch_point_distance_mm
        if given is None:
            return []
        return [
            (
                "stress.pitch_point_distance_mm",
                f"must reach from {low:.6g} to {high:.6g} as phase {number} does (got {given[0]:g} to "
                f"{given[-1]:g})",
            )
            for number, phase in enumerate(self.phase, start=1)
            for low, high in [_with_pitch_point(phase)]
            if not given[0] <= low <= high <= given[-1]
        ]


def _with_pitch_point(phase: PhaseTable) -> tuple[float, float]:
    """Return the reach of a phase with the pitch point, where that is what it starts from."""
    low, high = phase.reach
    return (low, high) if phase.start else (min(low, 0.0), max(high, 0.0))


def _elastic(table: MaterialTable) -> tuple[float, float]:
    """Return Young's modulus and Poisson's ratio, steel's where they are not given."""
    known = materials()[table.name or "steel"]
    modulus, ratio = table.youngs_modulus_MPa, table.poissons_ratio
    return (
        known.youngs_modulus if modulus is None else modulus,
        known.poissons_ratio if ratio is None else ratio,
    )
