"""Synthesis of the profiles of a gear pair with a prescribed contact stress, phase by phase."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wearsim.catalogue.catalogues import materials
from wearsim.contact.hertz import contact_modulus
from wearsim.contact.prescribed_stress import LineLoad, LoadedPair, StressProfile
from wearsim.errors import GeometryError
from wearsim.geometry.gear.path_of_contact import PathOfContact, involute
from wearsim.geometry.gear.path_synthesis import PathSynthesis
from wearsim.geometry.gear.plane_gearing import Contacts, Family, PitchCircles
from wearsim.geometry.profile_points import Vector
from wearsim.handbook.synthesise.keys import MeshFieldTable, MeshLoadTable, PhaseTable, SynthesisTables
from wearsim.input.schema.wear_tables import MaterialTable

_NEAREST = 1e-6
"""Distance from the pitch point down to which the inner end of a line is looked for, over its start's."""


@dataclass(frozen=True, eq=False)
class MeshPhase:
    """A synthesised path of contact."""

    family: Family  # which of the two pairs of profiles
    line: PathOfContact  # its points, from its first distance to its last
    involute: PathOfContact  # the involute of the same pair at the same distances
    # l [mm] and alpha [rad] where the line ends on the way from its start to the pitch point; none for a line
    # through the pitch point, and for one with no end before it or before the last stress that is given
    inner_end: tuple[float, float] | None
    through_pitch_point: bool  # whether it started from the pitch point


@dataclass(frozen=True, eq=False)
class MeshField:
    """Contacts over a part of the plane of mesh; rows are y, columns x."""

    # x, y: points from the pitch point [mm]
    x: Vector
    y: Vector
    contacts: Contacts  # with the prescribed stress, or with one direction of the path of contact
    contact_stress: NDArray[np.float64]  # sigma_H [MPa]; nan where infeasible
    # empty, or why there are no such profiles: "complex" (no real radii), "interference" (rho not above 0),
    # "no rolling" (pressure angle 0, where the contact stands still on a profile), "no stress" (none is given
    # for that distance), "no torque" (the normal runs along the line of centres)
    infeasibility: NDArray[np.str_]


def loaded_pair(tables: SynthesisTables) -> LoadedPair:
    """Return the pair of an input.

    Parameters
    ----------
    tables : SynthesisTables
        The input.

    Returns
    -------
    LoadedPair
        In mm, N, MPa, rad/s.
    """
    circles = PitchCircles(tables.gears.centre_distance_mm, tables.gears.gear_ratio)
    pinion, wheel = _elastic(tables.material.pinion), _elastic(tables.material.wheel)
    stress = np.array(tables.stress.contact_stress_MPa)
    distance = tables.stress.pitch_point_distance_mm
    return LoadedPair(
        circles,
        contact_modulus((pinion[0], wheel[0]), (pinion[1], wheel[1])),
        _line_load(tables.load, circles.pinion_radius),
        StressProfile(np.zeros_like(stress) if distance is None else np.array(distance), stress),
        2.0 * math.pi * tables.load.pinion_speed_rpm / 60.0,
    )


def _line_load(table: MeshLoadTable, pinion_radius: float) -> LineLoad:
    if table.pinion_torque_N_m is not None and table.face_width_mm is not None:
        return LineLoad(1e3 * table.pinion_torque_N_m / (table.face_width_mm * pinion_radius), 1)
    return LineLoad(float(table.load_per_width_N_per_mm or 0.0), 0)


def _elastic(table: MaterialTable) -> tuple[float, float]:
    """Return Young's modulus and Poisson's ratio, steel's where they are not given."""
    known = materials()[table.name or "steel"]
    modulus, ratio = table.youngs_modulus_MPa, table.poissons_ratio
    return (
        known.youngs_modulus if modulus is None else modulus,
        known.poissons_ratio if ratio is None else ratio,
    )


def phases(pair: LoadedPair, tables: SynthesisTables) -> tuple[MeshPhase, ...]:
    """Return the paths of contact that an input asks for.

    Parameters
    ----------
    pair : LoadedPair
        The pair.
    tables : SynthesisTables
        The input.

    Returns
    -------
    tuple of Phase
        In its order.

    Raises
    ------
    GeometryError
        A phase has no line with that stress, or the line ends within it.
    """
    given = tables.involute.pressure_angle_deg
    compared = None if given is None else math.radians(given)
    found = []
    for number, table in enumerate(tables.phase, start=1):
        try:
            found.append(_phase(pair, table, compared))
        except GeometryError as error:
            raise GeometryError(f"phase {number}: {error}") from None
    return tuple(found)


def _phase(pair: LoadedPair, table: PhaseTable, compared: float | None) -> MeshPhase:
    synthesis = PathSynthesis(pair.circles, pair.radius_rule, table.family)
    if table.start is None:
        crossing = pair.pitch_point_crossing()
        line = synthesis.through_pitch_point(crossing, np.linspace(*table.reach, table.nodes))
        end, angle = None, crossing.pressure_angle
    else:
        along = np.linspace(table.start[0], table.last_pitch_point_distance_mm, table.nodes)
        line = synthesis.from_point(table.start, along)
        end, angle = _inner_end(pair, synthesis, table.start), table.start[1]
    straight = involute(
        pair.circles, angle if compared is None else compared, line.contacts.pitch_point_distance
    )
    return MeshPhase(table.family, line, straight, end, table.start is None)


def _inner_end(
    pair: LoadedPair, synthesis: PathSynthesis, start: tuple[float, float]
) -> tuple[float, float] | None:
    """Return where a line ends on the way to the pitch point, or to the last stress before it."""
    last = _NEAREST * start[0]
    if not pair.stress.covers(last):
        last = float(pair.stress.pitch_point_distance[0 if start[0] > 0.0 else -1])
    if last == start[0]:
        return None
    end = synthesis.end(start, last)
    return None if math.isclose(end[0], last, rel_tol=1e-12) else end


def stress_fields(pair: LoadedPair, table: MeshFieldTable) -> dict[Family, MeshField]:
    """Return the contacts with the prescribed stress over a part of the plane of mesh.

    Parameters
    ----------
    pair : LoadedPair
        The pair with its stress.
    table : MeshFieldTable
        The part of the plane.

    Returns
    -------
    dict
        By family.
    """
    plane = _Plane(table)
    families: tuple[Family, Family] = (1, -1)
    with np.errstate(invalid="ignore", divide="ignore"):
        known = pair.stress.covers(plane.distance)
        radius = np.where(known, pair.reduced_radius(plane.distance, plane.angle), math.nan)
        found = {}
        for family in families:
            contacts = Contacts.of_radius(pair.circles, plane.distance, plane.angle, radius, family)
            reasons = {
                "no torque": np.isnan(plane.distance),
                "no stress": ~known,
                "complex": np.isnan(contacts.turn),
                "no rolling": plane.angle == 0.0,
            }
            found[family] = plane.field(pair, contacts, reasons)
    return found


def direction_fields(pair: LoadedPair, table: MeshFieldTable) -> dict[float, MeshField]:
    """Return the contacts of paths of contact with given directions over a part of the plane.

    Parameters
    ----------
    pair : LoadedPair
        The pair; its prescribed stress does not matter.
    table : MeshFieldTable
        The part of the plane, with the angles between path of contact and normal.

    Returns
    -------
    dict
        By angle mu [deg].
    """
    plane = _Plane(table)
    found = {}
    with np.errstate(invalid="ignore", divide="ignore"):
        for mu in table.directions_deg:
            contacts = Contacts.of_direction(pair.circles, plane.distance, plane.angle, math.radians(mu))
            meet = (contacts.relative_curvature > 0.0) & (plane.angle != 0.0)
            reasons = {"no torque": np.isnan(plane.distance), "interference": ~meet}
            found[mu] = plane.field(pair, contacts, reasons)
    return found


class _Plane:
    """Points over a part of the plane with their l and alpha; l is nan on the line of centres."""

    def __init__(self, table: MeshFieldTable) -> None:
        self.x, self.y = np.meshgrid(
            np.linspace(table.x_from_mm, table.x_to_mm, table.field_nodes),
            np.linspace(table.y_from_mm, table.y_to_mm, table.field_nodes),
        )
        central = np.abs(self.x) < 1e-9 * (table.x_to_mm - table.x_from_mm)
        self.distance = np.where(central, math.nan, np.copysign(np.hypot(self.x, self.y), self.x))
        self.angle = np.arctan2(np.copysign(1.0, self.x) * self.y, np.abs(self.x))

    def field(self, pair: LoadedPair, contacts: Contacts, reasons: dict[str, NDArray[np.bool_]]) -> MeshField:
        infeasibility = np.select(list(reasons.values()), list(reasons), "")
        stress = np.where(infeasibility == "", pair.contact_stress(contacts), math.nan)
        return MeshField(self.x, self.y, contacts, stress, infeasibility)
