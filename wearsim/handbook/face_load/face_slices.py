"""Load along the face of a wide mesh: slices on an elastic foundation.

Each slice of the face width has the mesh stiffness c per width and no coupling to its neighbours,
as in ISO 6336-1 method C, which is the closed form for a linear gap.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.optimize import brentq

from wearsim.geometry.profile_points import Vector


@dataclass(frozen=True, eq=False)
class WideMesh:
    """A face width cut into slices."""

    position: Vector  # of the slices from mid-face [mm]; the outer ones lie on the edges
    width: Vector  # of the slices [mm], half for the outer ones
    stiffness: float  # load per width over deflection [N/mm2]
    force: float  # on the whole face [N]

    @classmethod
    def of(cls, face_width: float, slices: int, stiffness: float, force: float) -> Self:
        """Cut a face width into equal slices."""
        width = np.full(slices + 1, face_width / slices)
        width[[0, -1]] *= 0.5
        position = face_width * np.linspace(-0.5, 0.5, slices + 1)
        return cls(position, width, stiffness, force)

    @property
    def face_width(self) -> float:
        """All slices together [mm]."""
        return float(self.width.sum())

    @property
    def mean_load(self) -> float:
        """Force over face width [N/mm]."""
        return self.force / self.face_width


def slice_loads(mesh: WideMesh, gap: Vector) -> Vector:
    """Load per width of every slice of a pinion that cannot tilt.

    q = c max(0, delta - g) with the approach delta for which the slices carry the force. Taken
    over the m slices of least gap, delta_m = (F/c + sum b_i g_i) / sum b_i; delta is the least of
    them all.

    Equation face-load.md (1).

    Parameters
    ----------
    mesh : WideMesh
        The mesh.
    gap : numpy.ndarray
        Gap of the unloaded flanks [mm], slices along the last axis.

    Returns
    -------
    numpy.ndarray
        q [N/mm], of the shape of the gap.

    Examples
    --------
    >>> mesh = WideMesh.of(face_width=2.0, slices=2, stiffness=10.0, force=20.0)
    >>> slice_loads(mesh, np.array([0.0, 0.5, 1.0])).tolist()
    [15.0, 10.0, 5.0]
    >>> slice_loads(mesh, np.array([0.0, 6.0, 12.0])).tolist()
    [40.0, 0.0, 0.0]
    """
    order = np.argsort(gap, axis=-1)
    width = mesh.width[order]
    opening = np.cumsum(width * np.take_along_axis(gap, order, axis=-1), axis=-1)
    approach = ((mesh.force / mesh.stiffness + opening) / np.cumsum(width, axis=-1)).min(axis=-1)
    loads: Vector = mesh.stiffness * np.maximum(0.0, approach[..., None] - gap)
    return loads


def load_moments(mesh: WideMesh, loads: Vector) -> Vector:
    """Moment of the load about mid-face."""
    turning: Vector = loads @ (mesh.width * mesh.position)
    return turning


def self_aligned_gap(mesh: WideMesh, gap: Vector, share: Vector, lever: float | None) -> Vector:
    """Gap after the pinion has tilted about its pivot at mid-face.

    The meshes that change rock the pinion into the position in which the mean moment vanishes. In
    a mesh whose moment there exceeds what friction in the pivot holds, F times the lever, the
    pinion tilts until it is just held.
    """
    steepest = float(np.abs(np.diff(gap) / np.diff(mesh.position)).max())
    if steepest == 0.0:
        return gap
    greatest = 2.0 * steepest  # beyond the steepest gap all load is on one side of mid-face

    def _moments(tilt: float, kind: int | slice) -> Vector:
        return load_moments(mesh, slice_loads(mesh, gap[kind] + tilt * mesh.position))

    every = slice(None)
    mean_tilt = _root(lambda tilt: float(share @ _moments(tilt, every)), -greatest, greatest)
    tilts = np.full(len(share), mean_tilt)
    if lever is not None:
        held = mesh.force * lever
        for kind, moment in enumerate(_moments(mean_tilt, every)):
            if abs(moment) > held:
                left = math.copysign(held, moment)

                def _excess(tilt: float, kind: int = kind, left: float = left) -> float:
                    return float(_moments(tilt, kind)) - left

                tilts[kind] = _root(_excess, mean_tilt, math.copysign(greatest, moment))
    return gap + tilts[:, None] * mesh.position


def _root(function: Callable[[float], float], start: float, end: float) -> float:
    return float(brentq(function, start, end, xtol=1e-13 * abs(end), rtol=1e-13))


def equivalent_misalignment(mesh: WideMesh, factor: float) -> float:
    """Linear gap that has a face load factor, the closed form solved for it.

    Equation face-load.md (2), solved for F_beta.

    Parameters
    ----------
    mesh : WideMesh
        The mesh.
    factor : float
        K_Hbeta, at least 1.

    Returns
    -------
    float
        F_beta [mm].
    """
    ratio = 2.0 * (factor - 1.0) if factor <= 2.0 else 0.5 * factor**2
    return ratio * mesh.mean_load / mesh.stiffness
