"""Wear of a wide mesh slice by slice, with the part of the misalignment that it cannot follow.

A gap that is the same at every mesh is worn off by both flanks. A gap that changes from mesh to
mesh is seen by a tooth only as its mean, unless it turns with the tooth's own wheel: then every
tooth of that wheel sees always the same gap, and wears it off alone. Reconstruction; the source
(document 002) says no more than that part of the misalignment never runs in.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

from wearsim.geometry.profile_points import Vector
from wearsim.handbook.face_load.face_slices import WideMesh, slice_loads

_SETTLED = 1e-4
"""Greatest difference of the wear rate from its mean, over it, that counts as run in."""

_LONGEST = 1000.0
"""Time constants after which a mesh that still changes is left."""


@dataclass(frozen=True)
class WearRates:
    """How fast the flanks open the gap under load."""

    common: float  # by teeth that meet all kinds of mesh in turn, per load [mm2/N] and turn of the pinion
    own: float  # by teeth that meet always the same kind [mm2/N]
    turns_per_hour: float  # of the pinion

    @property
    def total(self) -> float:
        """By both together [mm2/N]."""
        return self.common + self.own

    def hours(self, stiffness: float, rate: float) -> float:
        """Time in which a rate wears off all but 1/e of a gap, while the whole face touches.

        1/(c a 60 n).

        Equation face-load.md (5), its time constants.

        Parameters
        ----------
        stiffness : float
            Of the mesh, c [N/mm2].
        rate : float
            Of the flanks that follow the gap, a [mm2/N].

        Returns
        -------
        float
            Time [h]; infinite where none does.
        """
        return 1.0 / (stiffness * rate * self.turns_per_hour) if rate else math.inf


def opening_rate(loads: Vector, share: Vector, rates: WearRates) -> Vector:
    """Rate at which wear opens the gap in each kind of mesh.

    Equation face-load.md (4).

    Parameters
    ----------
    loads : numpy.ndarray
        Load per width [N/mm], kinds by slices.
    share : numpy.ndarray
        Share of the meshes of each kind.
    rates : WearRates
        Of the flanks.

    Returns
    -------
    numpy.ndarray
        Of the shape of the loads [mm per turn of the pinion].
    """
    return rates.common * (share @ loads) + rates.own * loads


@dataclass(frozen=True, eq=False)
class FaceState:
    """A mesh at some running time."""

    name: str  # `new`, `after` (the time asked for) or `run_in`
    hours: float  # running time [h]
    loads: Vector  # load per width [N/mm], kinds of mesh by slices
    opening: Vector  # by how much wear has opened the gap, in the mean of all meshes [mm]
    factor: float  # K_Hbeta: greatest load per width of all meshes over the mean one


@dataclass(frozen=True, eq=False)
class FaceRunningIn:
    """How a mesh runs in."""

    states: tuple[FaceState, ...]  # new, after the time asked for, and run in
    hours: Vector  # running times [h]
    factors: Vector  # K_Hbeta at those
    settled: bool  # whether it was run in after a thousand time constants at most


def _untilted(gap: Vector) -> Vector:
    return gap


@dataclass(frozen=True, eq=False)
class WearingFace:
    """A mesh that wears; time is counted in time constants of a gap that never changes."""

    mesh: WideMesh  # the mesh
    gap: Vector  # of the unworn flanks [mm], kinds of mesh by slices
    share: Vector  # share of the meshes of each kind
    rates: WearRates  # of the flanks
    # from the gap to that after the pinion has tilted; by default it cannot
    aligned: Callable[[Vector], Vector] = _untilted

    def loads(self, opening: Vector) -> Vector:
        """Load per width after some wear."""
        return slice_loads(self.mesh, self.aligned(self.gap + opening))

    def run_in(self, hours: float) -> FaceRunningIn:
        """Wear the mesh until its load changes no more."""
        unit = self.rates.hours(self.mesh.stiffness, self.rates.total)
        requested = hours / unit
        opening, end, settled = self._opening()
        last = max(end, requested)
        times = np.append(0.0, np.geomspace(min(1e-3, 1e-3 * last), last, 60)).tolist()

        def _state(name: str, time: float) -> FaceState:
            opened = opening(min(time, end))
            loads = self.loads(opened)
            further = max(time - end, 0.0) * self.mesh.mean_load / self.mesh.stiffness
            factor = float(loads.max()) / self.mesh.mean_load
            return FaceState(name, time * unit, loads, self.share @ opened + further, factor)

        return FaceRunningIn(
            states=(_state("new", 0.0), _state("after", requested), _state("run_in", end)),
            hours=unit * np.array(times),
            factors=np.array([_state("", time).factor for time in times]),
            settled=settled,
        )

    def _opening(self) -> tuple[Callable[[float], Vector], float, bool]:
        """Return the opening over time, when it has run in, and whether it has by then."""
        flat = np.zeros(self.gap.size)
        if self._unevenness(0.0, flat) <= 0.0:
            return lambda time: np.zeros(self.gap.shape), 0.0, True

        def _uneven(time: float, flat: Vector) -> float:
            return self._unevenness(time, flat)

        _uneven.terminal = True  # type: ignore[attr-defined]
        solved = solve_ivp(
            self._rate,
            (0.0, _LONGEST),
            flat,
            events=_uneven,
            dense_output=True,
            rtol=1e-8,
            atol=1e-9 * self.mesh.mean_load / self.mesh.stiffness,
        )
        path = solved.sol
        assert path is not None
        return (
            lambda time: np.asarray(path(time)).reshape(self.gap.shape),
            float(solved.t[-1]),
            solved.status == 1,
        )

    def _rate(self, time: float, flat: Vector) -> Vector:
        turns = opening_rate(self.loads(flat.reshape(self.gap.shape)), self.share, self.rates)
        rate: Vector = (turns / (self.mesh.stiffness * self.rates.total)).ravel()
        return rate

    def _unevenness(self, time: float, flat: Vector) -> float:
        rate = self._rate(time, flat)
        return float(np.ptp(rate) / rate.mean()) - _SETTLED
