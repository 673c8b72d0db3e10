"""Face load factor of a wide, misaligned pair of gears, new and run in.

B.V. Vinogradov and D.A. Fedin (2015; source document 002) study this for the open gears of mills,
but no formula of theirs is at hand: all of this is reconstruction.
"""

import math
from dataclasses import dataclass

import numpy as np

from wearsim.geometry.profile_points import Vector
from wearsim.handbook.face_load.face_slices import WideMesh, self_aligned_gap
from wearsim.handbook.face_load.face_wear import FaceRunningIn, WearingFace, WearRates
from wearsim.handbook.face_load.keys import FaceLoadTables, VariesWith

_PHASES = 8
"""Meshes from one extreme of a gap that turns with a wheel to the other."""


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

    mesh: WideMesh  # slices, stiffness and force
    share: Vector  # share of the meshes of each kind
    # fixed_hours, varying_hours: time in which wear takes all but 1/e of a gap that is the same at every
    # mesh, and of the part that changes [h], infinite where no flank follows it
    fixed_hours: float
    varying_hours: float
    # friction lever of the pivot of a self-aligning pinion [mm]; None where it follows the mean gap only
    lever: float | None
    # fixed, self_aligning: with a pinion that cannot tilt and with one that can
    fixed: FaceRunningIn
    self_aligning: FaceRunningIn


def face_load(tables: FaceLoadTables) -> FaceLoad:
    """Return the load along the face of a pair, new, worn and run in.

    Parameters
    ----------
    tables : FaceLoadTables
        The input.

    Returns
    -------
    FaceLoad
        Complete.
    """
    pair, load, gaps, wear = tables.pair, tables.load, tables.misalignment, tables.running_in
    speed = 2.0 * math.pi * load.pinion_speed_rpm / 60.0
    torque = 1e6 * load.power_kW / speed
    force = load.application_factor * 2.0 * torque / pair.pinion_pitch_diameter_mm
    stiffness = 1e3 * pair.mesh_stiffness_N_per_mm_um
    mesh = WideMesh.of(pair.face_width_mm, pair.slices, stiffness, force)
    fixed, varying, crown = (
        1e-3 * gaps.fixed_misalignment_um,
        1e-3 * gaps.varying_misalignment_um,
        1e-3 * gaps.crown_um,
    )
    gap, share = gap_kinds(mesh.position, fixed, varying, gaps.varies_with, crown)
    rates = wear_rates(
        wear.specific_wear_rate_mm2_per_N,
        wear.wheel_wear_ratio,
        wear.slip_ratio,
        pair.gear_ratio,
        gaps.varies_with,
        60.0 * load.pinion_speed_rpm,
    )
    lever = tables.self_aligning.pivot_friction_lever_mm

    def _aligned(gap: Vector) -> Vector:
        return self_aligned_gap(mesh, gap, share, lever)

    return FaceLoad(
        mesh,
        share,
        rates.hours(stiffness, rates.total),
        rates.hours(stiffness, rates.own),
        lever,
        WearingFace(mesh, gap, share, rates).run_in(wear.time_hours),
        WearingFace(mesh, gap, share, rates, _aligned).run_in(wear.time_hours),
    )
