"""Synthesis of the profiles of a gear pair with a prescribed contact stress, phase by phase."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from wearsim.contact.hertz import contact_modulus
from wearsim.contact.prescribed_stress import LineLoad, LoadedPair, StressProfile
from wearsim.errors import (
    ABOVE_0,
    AT_LEAST_0,
    POISSONS_RATIO,
    Allowed,
    GeometryError,
    Range,
    check_ranges,
    check_series,
)
from wearsim.geometry.gear.path_of_contact import PathOfContact, involute
from wearsim.geometry.gear.path_synthesis import PathSynthesis
from wearsim.geometry.gear.plane_gearing import Contacts, Family, PitchCircles
from wearsim.geometry.profile_points import Vector

_NEAREST = 1e-6
"""Distance from the pitch point down to which the inner end of a line is looked for, over its start's."""


@dataclass(frozen=True, eq=False)
class MeshPhase:
    """A synthesised path of contact."""

    family: Family  #: which of the two pairs of profiles
    line: PathOfContact  #: its points, from its first distance to its last
    involute: PathOfContact  #: the involute of the same pair at the same distances
    #: l [mm] and alpha [rad] where the line ends on the way from its start to the pitch point; none for a
    #: line through the pitch point, and for one with no end before it or before the last stress that is given
    inner_end: tuple[float, float] | None
    through_pitch_point: bool  #: whether it started from the pitch point


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


@dataclass(frozen=True)
class PhaseStart:
    """Where a path of contact runs: through the pitch point, or from a point beside it."""

    last_distance: float  #: signed distance of its last point from the pitch point [mm]
    first_distance: float | None = None  #: the same of the first, for a path through the pitch point
    start: tuple[float, float] | None = None  #: else distance [mm] and pressure angle [rad], above 0
    family: Family = 1  #: which of the two pairs of profiles
    nodes: int = 201


@dataclass(frozen=True)
class MeshPlane:
    """The part of the plane of mesh that fields cover [mm], with the pitch point at (0, 0)."""

    x: tuple[float, float]
    y: tuple[float, float]
    nodes: int = 81  #: along each side
    directions: tuple[float, ...] = ()  #: angles between path of contact and normal [deg]


_LOAD = Range(above=0.0, optional=True)
_PAIR: Mapping[str, Allowed] = {
    **dict.fromkeys(("centre_distance", "gear_ratio"), ABOVE_0),
    **dict.fromkeys(("load_per_width", "pinion_torque", "face_width"), _LOAD),
    "pinion_speed": AT_LEAST_0,
}
_NODES = Range(2, 20_001, whole=True)
_PHASE: Mapping[str, Allowed] = {
    "last_distance": Range(),
    "first_distance": Range(optional=True),
    "family": (1, -1),
    "nodes": _NODES,
}


def loaded_pair(
    *,
    centre_distance: float,
    gear_ratio: float,
    contact_stress: Sequence[float],
    pitch_point_distance: Sequence[float] | None = None,
    load_per_width: float | None = None,
    pinion_torque: float | None = None,
    face_width: float | None = None,
    pinion_speed: float = 0.0,
    youngs_modulus: tuple[float, float] = (2.06e5, 2.06e5),
    poissons_ratio: tuple[float, float] = (0.3, 0.3),
) -> LoadedPair:
    """Return a gear pair whose contact stress is prescribed along its path of contact.

    The stress is Hertz's, so it and the load fix the reduced radius at every place,
    Equation synthesise.md (2). Spur gears; one pair of teeth carries the load.

    Parameters
    ----------
    centre_distance, gear_ratio : float
        a [mm] and u of the pair, above 0.
    contact_stress : sequence of float
        sigma_H [MPa]: one for all places, or one at each of the distances.
    pitch_point_distance : sequence of float, optional
        Signed distances from the pitch point [mm], ascending.
    load_per_width : float, optional
        Constant normal load [N/mm]; or a constant torque by the two next.
    pinion_torque, face_width : float, optional
        T1 [N mm] and b [mm].
    pinion_speed : float, optional
        [rpm], for sliding speeds.
    youngs_modulus, poissons_ratio : tuple of float, optional
        Of pinion and wheel [MPa]; steel if left out.

    Returns
    -------
    LoadedPair
        In mm, N, MPa, rad/s.

    Raises
    ------
    GeometryError
        A number cannot be, or none or both of the loads are given.

    Examples
    --------
    Hertz: sigma^2 = q E*/(pi rho), so 100 N/mm at 500 MPa ask for rho = 100*113187/(pi*500^2) mm:

    >>> pair = loaded_pair(
    ...     centre_distance=90.0, gear_ratio=1.25, contact_stress=[500.0], load_per_width=100.0
    ... )
    >>> round(float(pair.reduced_radius(0.0, 0.35)), 4)
    14.4114
    """
    numbers = {
        "centre_distance": centre_distance,
        "gear_ratio": gear_ratio,
        "load_per_width": load_per_width,
        "pinion_torque": pinion_torque,
        "face_width": face_width,
        "pinion_speed": pinion_speed,
    }
    check_ranges("synthesis", numbers, _PAIR)
    check_series("synthesis", "youngs_modulus", youngs_modulus, ABOVE_0, 2)
    check_series("synthesis", "poissons_ratio", poissons_ratio, POISSONS_RATIO, 2)
    check_series("synthesis", "contact_stress", contact_stress, ABOVE_0)
    stress = np.array(contact_stress, dtype=float)
    if pitch_point_distance is not None:
        check_series("synthesis", "pitch_point_distance", pitch_point_distance, count=stress.size)
        _check_ascent("pitch_point_distance", pitch_point_distance)
    elif stress.size > 1:
        raise GeometryError("synthesis: pitch_point_distance must be given for several stresses: give it")
    circles = PitchCircles(centre_distance, gear_ratio)
    if load_per_width is not None and pinion_torque is None:
        line_load = LineLoad(float(load_per_width), 0)
    elif load_per_width is None and pinion_torque is not None and face_width is not None:
        line_load = LineLoad(pinion_torque / (face_width * circles.pinion_radius), 1)
    else:
        raise GeometryError(
            "synthesis: give load_per_width, or pinion_torque and face_width, and not both loads"
        )
    places = np.zeros_like(stress) if pitch_point_distance is None else np.array(pitch_point_distance)
    return LoadedPair(
        circles,
        contact_modulus(youngs_modulus, poissons_ratio),
        line_load,
        StressProfile(places, stress),
        2.0 * math.pi * pinion_speed / 60.0,
    )


def _check_ascent(name: str, values: Sequence[float]) -> None:
    if not all(one < other for one, other in pairwise(values)):
        shown = ", ".join(f"{value:g}" for value in values)
        raise GeometryError(f"synthesis: {name} must ascend, is {shown}: correct it")


def profile_phases(
    pair: LoadedPair, starts: Sequence[PhaseStart], compared_angle: float | None = None
) -> tuple[MeshPhase, ...]:
    """Return the paths of contact with the prescribed stress, each with an involute beside it.

    A path solves the differential equation Equation synthesise.md (5) from the pitch point or from a
    point beside it, where two pairs of profiles have the same stress (`family` 1 and -1).

    Parameters
    ----------
    pair : LoadedPair
        The pair with its stress.
    starts : sequence of PhaseStart
        Where the paths run.
    compared_angle : float, optional
        Pressure angle of the involute [rad], above 0; that of the path in its start if left out.

    Returns
    -------
    tuple of MeshPhase
        In their order.

    Raises
    ------
    GeometryError
        A number cannot be, a phase has no path with that stress, or the path ends within it.

    Examples
    --------
    The path through the pitch point meets it with the pressure angle whose radius the stress asks for:

    >>> pair = loaded_pair(
    ...     centre_distance=90.0, gear_ratio=1.25, contact_stress=[700.0], load_per_width=100.0
    ... )
    >>> (phase,) = profile_phases(pair, [PhaseStart(first_distance=-5.0, last_distance=5.0)])
    >>> middle = phase.line.contacts.pressure_angle[100]
    >>> round(float(pair.circles.pitch_point_radius(middle) / pair.reduced_radius(0.0, middle)), 9)
    1.0
    """
    angle = Range(above=0.0, below=0.5 * math.pi, optional=True)
    check_ranges("synthesis", {"compared_angle": compared_angle}, {"compared_angle": angle})
    found = []
    for number, start in enumerate(starts, start=1):
        _check_start(f"synthesis: phase {number}", start)
        try:
            found.append(_phase(pair, start, compared_angle))
        except GeometryError as error:
            raise GeometryError(f"phase {number}: {error}") from None
    return tuple(found)


def _check_start(place: str, given: PhaseStart) -> None:
    check_ranges(place, vars(given), _PHASE)
    if (given.start is None) == (given.first_distance is None):
        raise GeometryError(f"{place} must have one of first_distance and start: give one")
    if given.start is None:
        if given.family != 1:
            raise GeometryError(
                f"{place}: family must be 1 without start, the small radii never reach the pitch point: "
                "correct it"
            )
        return
    check_series(place, "start", given.start, count=2)
    distance, angle = given.start
    check_ranges(place, {"start[1]": angle}, {"start[1]": Range(above=0.0, below=0.5 * math.pi)})
    if not distance * given.last_distance > 0.0 or distance == given.last_distance:
        raise GeometryError(
            f"{place}: last_distance must be on the side of the start, {distance:g}, and not there, is "
            f"{given.last_distance:g}: correct it"
        )


def _phase(pair: LoadedPair, given: PhaseStart, compared: float | None) -> MeshPhase:
    synthesis = PathSynthesis(pair.circles, pair.radius_rule, given.family)
    if given.start is None:
        assert given.first_distance is not None
        if not given.first_distance < given.last_distance:
            raise GeometryError(
                "a path through the pitch point needs first_distance below last_distance: "
                f"{given.first_distance:g} and {given.last_distance:g} mm"
            )
        crossing = pair.pitch_point_crossing()
        along = np.linspace(given.first_distance, given.last_distance, given.nodes)
        line = synthesis.through_pitch_point(crossing, along)
        end, angle = None, crossing.pressure_angle
    else:
        along = np.linspace(given.start[0], given.last_distance, given.nodes)
        line = synthesis.from_point(given.start, along)
        end, angle = _inner_end(pair, synthesis, given.start), given.start[1]
    straight = involute(
        pair.circles, angle if compared is None else compared, line.contacts.pitch_point_distance
    )
    return MeshPhase(given.family, line, straight, end, given.start is None)


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


def stress_fields(pair: LoadedPair, part: MeshPlane) -> dict[Family, MeshField]:
    """Return the contacts with the prescribed stress over a part of the plane of mesh.

    Parameters
    ----------
    pair : LoadedPair
        The pair with its stress.
    part : MeshPlane
        The part of the plane.

    Returns
    -------
    dict
        By family.
    """
    plane = _Plane(part)
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


def direction_fields(pair: LoadedPair, part: MeshPlane) -> dict[float, MeshField]:
    """Return the contacts of paths of contact with given directions over a part of the plane.

    Parameters
    ----------
    pair : LoadedPair
        The pair; its prescribed stress does not matter.
    part : MeshPlane
        The part of the plane, with the angles between path of contact and normal.

    Returns
    -------
    dict
        By angle mu [deg].
    """
    plane = _Plane(part)
    found = {}
    with np.errstate(invalid="ignore", divide="ignore"):
        for mu in part.directions:
            contacts = Contacts.of_direction(pair.circles, plane.distance, plane.angle, math.radians(mu))
            meet = (contacts.relative_curvature > 0.0) & (plane.angle != 0.0)
            reasons = {"no torque": np.isnan(plane.distance), "interference": ~meet}
            found[mu] = plane.field(pair, contacts, reasons)
    return found


class _Plane:
    """Points over a part of the plane with their l and alpha; l is nan on the line of centres."""

    def __init__(self, part: MeshPlane) -> None:
        for name, side in (("x", part.x), ("y", part.y)):
            check_series("synthesis", name, side, count=2)
            _check_ascent(name, side)
        check_ranges("synthesis", {"nodes": part.nodes}, {"nodes": _NODES})
        if np.size(part.directions):
            check_series("synthesis", "directions", part.directions, Range(above=-90.0, below=90.0))
        self.x, self.y = np.meshgrid(np.linspace(*part.x, part.nodes), np.linspace(*part.y, part.nodes))
        central = np.abs(self.x) < 1e-9 * (part.x[1] - part.x[0])
        self.distance = np.where(central, math.nan, np.copysign(np.hypot(self.x, self.y), self.x))
        self.angle = np.arctan2(np.copysign(1.0, self.x) * self.y, np.abs(self.x))

    def field(self, pair: LoadedPair, contacts: Contacts, reasons: dict[str, NDArray[np.bool_]]) -> MeshField:
        infeasibility = np.select(list(reasons.values()), list(reasons), "")
        stress = np.where(infeasibility == "", pair.contact_stress(contacts), math.nan)
        return MeshField(self.x, self.y, contacts, stress, infeasibility)
