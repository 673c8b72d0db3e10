"""Face load factor of a wide, misaligned pair of gears, new and run in.

B.V. Vinogradov and D.A. Fedin (2015; source document 002) study this for the open gears of mills,
but no formula of theirs is at hand: all of this is reconstruction.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from wearsim.errors import ABOVE_0, AT_LEAST_0, Allowed, Range, check_ranges
from wearsim.geometry.profile_points import Vector
from wearsim.handbook.face_load.face_slices import WideMesh, self_aligned_gap
from wearsim.handbook.face_load.face_wear import FaceRunningIn, WearingFace, WearRates

VariesWith = Literal["load", "wheel", "pinion"]

_PHASES = 8
"""Meshes from one extreme of a gap that turns with a wheel to the other."""


@dataclass(frozen=True)
class WidePair:
    """A wide pair of spur gears."""

    face_width: float  #: b [mm]
    pinion_pitch_diameter: float  #: [mm]
    gear_ratio: float  #: u
    mesh_stiffness: float = 2e4  #: of the mesh over the face width [N/mm2]
    slices: int = 200  #: of the face


@dataclass(frozen=True)
class FaceGaps:
    """Gap of the unloaded flanks over the face width [mm]."""

    fixed: float = 0.0  #: of one edge over the other, at every mesh
    varying: float = 0.0  #: the same of the part that changes, at most
    varies_with: VariesWith = "load"
    crown: float = 0.0  #: of both edges over mid-face


@dataclass(frozen=True)
class FlankWear:
    """What the flanks lose."""

    specific_wear_rate: float  #: of the pinion, k [mm2/N]
    slip_ratio: float  #: sliding speed over the speed of the contact along the flank, mean of both flanks
    hours: float  #: time at which the worn state is shown [h]
    wheel_wear_ratio: float = 1.0  #: wear rate of the wheel over that of the pinion


def gap_kinds(
    position: Vector, fixed: float, varying: float, varies_with: VariesWith, crown: float
) -> tuple[Vector, Vector]:
    """Gap of the unworn flanks in each kind of mesh.

    g = F_fix y/b + s F_var y/b + C (2 y/b)^2, where s is -1 and 1 in turn for a gap that varies
    with the load, and sin(phi) over a turn for one that varies with a wheel.

    Equation face-load.md (3).

    Parameters
    ----------
    position : numpy.ndarray
        Of the slices from mid-face to both edges, y [mm].
    fixed, varying : float
        Gap of one edge over the other: at every mesh, and at most of what changes [mm].
    varies_with : {"load", "wheel", "pinion"}
        What the changing part changes with.
    crown : float
        Gap of both edges over mid-face [mm].

    Returns
    -------
    tuple of numpy.ndarray
        Gap [mm], kinds by slices, and share of the meshes of each kind.
    """
    along = position / np.ptp(position)
    if varying == 0.0:
        change, share = np.zeros(1), np.ones(1)
    elif varies_with == "load":
        change, share = np.array([-1.0, 1.0]), np.full(2, 0.5)
    else:
        change = np.sin(np.linspace(-0.5, 0.5, _PHASES + 1) * np.pi)
        share = np.full(_PHASES + 1, 1.0 / _PHASES)
        share[[0, -1]] *= 0.5
    return (fixed + change[:, None] * varying) * along + crown * (2.0 * along) ** 2, share


def wear_rates(
    specific_wear_rate: float,
    wheel_wear_ratio: float,
    slip_ratio: float,
    gear_ratio: float,
    varies_with: VariesWith,
    turns_per_hour: float,
) -> WearRates:
    """Share out the wear of both flanks.

    A flank loses k q s in a mesh, by Archard over the passage of the contact; a tooth of the
    wheel is in mesh u times less often than one of the pinion.

    Equation face-load.md (4).

    Parameters
    ----------
    specific_wear_rate : float
        Of the pinion, k [mm2/N].
    wheel_wear_ratio : float
        That of the wheel over it.
    slip_ratio : float
        Sliding speed over the speed of the contact along the flank, s, as a mean of both flanks.
    gear_ratio : float
        Teeth of the wheel over those of the pinion, u.
    varies_with : {"load", "wheel", "pinion"}
        What the changing part of the gap changes with.
    turns_per_hour : float
        Of the pinion.

    Returns
    -------
    WearRates
        In common and by teeth of one's own.
    """
    pinion = specific_wear_rate * slip_ratio
    wheel = pinion * wheel_wear_ratio / gear_ratio
    own = {"load": 0.0, "wheel": wheel, "pinion": pinion}[varies_with]
    return WearRates(pinion + wheel - own, own, turns_per_hour)


@dataclass(frozen=True, eq=False)
class FaceLoad:
    """The load along the face of a wide pair."""

    mesh: WideMesh  #: slices, stiffness and force
    share: Vector  #: share of the meshes of each kind
    #: fixed_hours, varying_hours: time in which wear takes all but 1/e of a gap that is the same at every
    #: mesh, and of the part that changes [h], infinite where no flank follows it
    fixed_hours: float
    varying_hours: float
    #: friction lever of the pivot of a self-aligning pinion [mm]; None where it follows the mean gap only
    lever: float | None
    #: fixed, self_aligning: with a pinion that cannot tilt and with one that can
    fixed: FaceRunningIn
    self_aligning: FaceRunningIn


_RANGES: Mapping[str, Allowed] = {
    **dict.fromkeys(("face_width", "pinion_pitch_diameter", "mesh_stiffness"), ABOVE_0),
    **dict.fromkeys(("specific_wear_rate", "slip_ratio", "hours", "power", "pinion_speed"), ABOVE_0),
    **dict.fromkeys(("fixed", "varying", "crown", "wheel_wear_ratio"), AT_LEAST_0),
    **dict.fromkeys(("gear_ratio", "application_factor"), Range(least=1.0)),
    "pivot_friction_lever": Range(least=0.0, optional=True),
    "slices": Range(10, 2000, whole=True),
    "varies_with": ("load", "wheel", "pinion"),
}


def face_load_factors(
    pair: WidePair,
    gaps: FaceGaps,
    wear: FlankWear,
    *,
    power: float,
    pinion_speed: float,
    application_factor: float = 1.0,
    pivot_friction_lever: float | None = None,
) -> FaceLoad:
    """Return the load along the face of a pair, new, worn and run in, with K_Hbeta.

    Slices of the face share the load as springs over a gap, by face-load.md (1) to (5); wear takes off
    the part of the gap that is the same at every mesh. All of it is this project's reconstruction.

    Parameters
    ----------
    pair : WidePair
        The gears.
    gaps : FaceGaps
        Gap of the unloaded flanks over the face.
    wear : FlankWear
        What the flanks lose.
    power : float
        That the pair carries [kW], above 0.
    pinion_speed : float
        Of the pinion [rpm], above 0.
    application_factor : float, optional
        K_A on the load.
    pivot_friction_lever : float, optional
        Friction lever of the pivot of a self-aligning pinion [mm]; without friction if left out.

    Returns
    -------
    FaceLoad
        With a pinion that cannot tilt and with one that can.

    Raises
    ------
    GeometryError
        A number cannot be.

    Examples
    --------
    A gap of 0.02 mm over 100 mm, a stiffness of 2e4 N/mm2 and a mean load of 400 N/mm: the compliance gives
    0.02 mm as well, so the load grows in line from 0.5 to 1.5 of its mean:

    >>> found = face_load_factors(
    ...     WidePair(face_width=100.0, pinion_pitch_diameter=100.0, gear_ratio=3.0),
    ...     FaceGaps(fixed=0.02),
    ...     FlankWear(specific_wear_rate=1e-10, slip_ratio=0.1, hours=1000.0),
    ...     power=2.0 * math.pi / 60.0 * 2.0,
    ...     pinion_speed=1.0,
    ... )
    >>> round(found.fixed.states[0].factor, 2)
    1.5
    """
    drive = {
        "power": power,
        "pinion_speed": pinion_speed,
        "application_factor": application_factor,
        "pivot_friction_lever": pivot_friction_lever,
    }
    check_ranges("face load", {**vars(pair), **vars(gaps), **vars(wear), **drive}, _RANGES)
    speed = 2.0 * math.pi * pinion_speed / 60.0
    torque = 1e6 * power / speed
    force = application_factor * 2.0 * torque / pair.pinion_pitch_diameter
    mesh = WideMesh.of(pair.face_width, pair.slices, pair.mesh_stiffness, force)
    gap, share = gap_kinds(mesh.position, gaps.fixed, gaps.varying, gaps.varies_with, gaps.crown)
    rates = wear_rates(
        wear.specific_wear_rate,
        wear.wheel_wear_ratio,
        wear.slip_ratio,
        pair.gear_ratio,
        gaps.varies_with,
        60.0 * pinion_speed,
    )

    def _aligned(gap: Vector) -> Vector:
        return self_aligned_gap(mesh, gap, share, pivot_friction_lever)

    return FaceLoad(
        mesh,
        share,
        rates.hours(pair.mesh_stiffness, rates.total),
        rates.hours(pair.mesh_stiffness, rates.own),
        pivot_friction_lever,
        WearingFace(mesh, gap, share, rates).run_in(wear.hours),
        WearingFace(mesh, gap, share, rates, _aligned).run_in(wear.hours),
    )
