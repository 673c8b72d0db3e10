"""How many teeth of a gear pair with pitch errors touch, over the common period of both wheels.

V.A. Golubkov et al., "Modeling spectral characteristics of gear engagement stiffness" (2016;
source document 003) gives every tooth a rectangular pulse of contact, displaced by the pitch
error of the tooth, and counts contacts by the product of the pulses of both wheels. Angles are
those of the common period: both wheels return to the same teeth after ``pinion_turns`` turns of
the pinion and ``wheel_turns`` of the wheel.
"""

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from wearsim.errors import GeometryError

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

_FULL = 2.0 * math.pi
_NARROWEST = 1e-12
"""Angle below which an interval is the rounding of two edges that coincide."""


def contact_ratio(pinion_teeth: int, wheel_teeth: int, pressure_angle: float) -> float:
    """Contact ratio of standard spur gears without profile shift, as in the source.

    eps = (sqrt(z1^2/4 sin^2 a + z1 + 1) + sqrt(z2^2/4 sin^2 a + z2 + 1) - (z1 + z2)/2 sin a) /
    (pi cos a): the length of the path of contact between the tip circles over the base pitch.

    Equation stiffness-spectrum.md (1).

    Parameters
    ----------
    pinion_teeth, wheel_teeth : int
        z1 and z2.
    pressure_angle : float
        a [rad].

    Returns
    -------
    float
        eps; it counts the path beyond the base circles' tangent too, where there is no involute.

    Examples
    --------
    >>> round(contact_ratio(20, 30, math.radians(20)), 12)
    1.605176092139
    """
    sine = math.sin(pressure_angle)
    reach = sum(math.sqrt((z * sine / 2.0) ** 2 + z + 1.0) for z in (pinion_teeth, wheel_teeth))
    path = reach - (pinion_teeth + wheel_teeth) / 2.0 * sine
    return path / (math.pi * math.cos(pressure_angle))


@dataclass(frozen=True)
class Wheel:
    """A wheel whose teeth stand off their places by a sine over the tooth number."""

    teeth: int  # z
    error_angle: float  # beta, amplitude of the cumulative pitch error over the pitch radius [rad]
    error_order: int = 1  # kappa, waves of the error in a turn
    error_phase: float = 0.0  # psi, phase of the error at the first tooth [rad]

    @property
    def tooth_angles(self) -> Floats:
        """Angle at which each tooth is in mid contact: 2 pi i/z + beta sin(2 pi kappa i/z + psi).

        Equation stiffness-spectrum.md (2).
        """
        place = _FULL * np.arange(self.teeth) / self.teeth
        error = np.sin(self.error_order * place + self.error_phase)
        return np.asarray(place + self.error_angle * error)

    @property
    def greatest_error_angle(self) -> float:
        """The beta at which two neighbours would be in contact at the same time [rad]."""
        error = replace(self, error_angle=1.0).tooth_angles - replace(self, error_angle=0.0).tooth_angles
        return float(_FULL / self.teeth / np.max(error - np.roll(error, -1)))


@dataclass(frozen=True)
class GearPair:
    """Two wheels in mesh."""

    # pinion, wheel: the first and the second wheel
    pinion: Wheel
    wheel: Wheel
    contact_ratio: float  # eps; above 1, as it is for all teeth and pressure angles that an input may have

    @property
    def pinion_turns(self) -> int:
        """R1, turns of the pinion in the common period."""
        return self.wheel.teeth // math.gcd(self.pinion.teeth, self.wheel.teeth)

    @property
    def wheel_turns(self) -> int:
        """R2, turns of the wheel in it."""
        return self.pinion.teeth // math.gcd(self.pinion.teeth, self.wheel.teeth)

    @property
    def meshes(self) -> int:
        """Teeth that pass in it, z1 R1 = z2 R2: the harmonic of the tooth frequency."""
        return self.pinion.teeth * self.pinion_turns

    @property
    def without_error(self) -> "GearPair":
        """The same with teeth in their places."""
        return replace(
            self, pinion=replace(self.pinion, error_angle=0.0), wheel=replace(self.wheel, error_angle=0.0)
        )


@dataclass(frozen=True, eq=False)
class StepFunction:
    """A function of period 2 pi that is constant between its edges."""

    edges: Floats  # ascending, in [0, 2 pi)
    values: Floats  # from each edge to the next; the last one holds across 2 pi up to the first edge

    @property
    def widths(self) -> Floats:
        """Length of each interval; the lengths sum to 2 pi."""
        return np.diff(self.edges, append=self.edges[0] + _FULL)

    @property
    def mean(self) -> float:
        """Mean value, the coefficient S_0."""
        return float(self.values @ self.widths) / _FULL

    @property
    def variance(self) -> float:
        """Mean square about the mean: the sum of 2 |S_h|^2 over all h > 0 (Parseval)."""
        return float((self.values - self.mean) ** 2 @ self.widths) / _FULL

    def at(self, angles: ArrayLike) -> Floats:
        """Return values at angles."""
        place = np.searchsorted(self.edges, np.mod(angles, _FULL), side="right")
        return np.asarray(self.values[place - 1])

    def coefficients(self, harmonics: ArrayLike) -> Complexes:
        """Return two-sided Fourier coefficients, exact but for rounding.

        S_h = (1/2 pi) integral f(x) e^(-jhx) dx = sum of (jump at e) e^(-jhe) / (2 pi j h); the
        real line at h > 0 is 2 |S_h| cos(h x + arg S_h), so 2 |S_h| is its one-sided amplitude.

        Equation stiffness-spectrum.md (3).

        Parameters
        ----------
        harmonics : array_like of int
            h.

        Returns
        -------
        ndarray of complex
            S_h.

        Examples
        --------
        >>> half = StepFunction(np.array([0.0, np.pi]), np.array([1.0, 0.0]))
        >>> [round(float(abs(s)), 6) for s in half.coefficients([0, 1, 2, 3])]
        [0.5, 0.31831, 0.0, 0.106103]
        """
        jumps = self.values - np.roll(self.values, 1)
        return np.array(
            [
                np.exp(-1j * h * self.edges) @ jumps / (2j * math.pi * h) if h else self.mean
                for h in np.asarray(harmonics, dtype=int).tolist()
            ],
            dtype=complex,
        )


def pulses(starts: Floats, ends: Floats) -> StepFunction:
    """Count the pulses that are on."""
    across = np.count_nonzero(np.mod(starts, _FULL) > np.mod(ends, _FULL))
    starts, ends = (np.sort(np.mod(angles, _FULL)) for angles in (starts, ends))
    edges, middles = _edges(np.concatenate((starts, ends)))
    begun, over = (np.searchsorted(angles, middles, side="right") for angles in (starts, ends))
    return StepFunction(edges, (across + begun - over).astype(float))


def _edges(angles: Floats) -> tuple[Floats, Floats]:
    """Return different edges in order and, of the intervals after them, the middles in [0, 2 pi)."""
    angles = np.sort(angles)
    edges = angles[np.diff(angles, append=angles[0] + _FULL) > _NARROWEST]
    return edges, np.mod(edges + 0.5 * np.diff(edges, append=edges[0] + _FULL), _FULL)


def wheel_contacts(wheel: Wheel, ratio: float, turns: int = 1) -> StepFunction:
    """Count the teeth of one wheel that are in their contact pulse.

    Tooth i is on while its angle is within pi eps/z of ``tooth_angles``.
    """
    turn = _FULL * np.arange(turns)[:, np.newaxis]
    centres = ((wheel.tooth_angles + turn) / turns).ravel()
    half = math.pi * ratio / (wheel.teeth * turns)
    return pulses(centres - half, centres + half)


def contact_number(pair: GearPair, model: Literal["pairs", "double_sum"]) -> StepFunction:
    """Count contacts of a gear pair over the common period."""
    pinion, wheel = pair.pinion, pair.wheel
    if model == "double_sum":
        first = wheel_contacts(pinion, pair.contact_ratio, pair.pinion_turns)
        second = wheel_contacts(wheel, pair.contact_ratio, pair.wheel_turns)
        edges, middles = _edges(np.concatenate((first.edges, second.edges)))
        return StepFunction(edges, first.at(middles) * second.at(middles))
    mesh = np.arange(pair.meshes)
    centres = [
        (one.tooth_angles[mesh % one.teeth] + _FULL * (mesh // one.teeth)) / turns
        for one, turns in ((pinion, pair.pinion_turns), (wheel, pair.wheel_turns))
    ]
    half = math.pi * pair.contact_ratio / pair.meshes
    starts, ends = np.maximum(*centres) - half, np.minimum(*centres) + half
    return pulses(starts[ends > starts], ends[ends > starts])


def check_order(wheel: Wheel, place: str, pitch_radius: float) -> None:
    """Raise where the pitch error puts a tooth before the one ahead of it."""
    limit = wheel.greatest_error_angle
    if wheel.error_angle >= limit:
        raise GeometryError(
            f"{place}: pitch_error_mm must be below {limit * pitch_radius:.4g} mm, where two teeth would "
            f"swap places, but is {wheel.error_angle * pitch_radius:g} mm: lower it"
        )
