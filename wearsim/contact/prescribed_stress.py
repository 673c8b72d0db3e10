"""Contact stress of a plane gear pair, and the reduced radius of the profiles that it asks for."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from wearsim.contact.hertz import peak_pressure
from wearsim.errors import GeometryError
from wearsim.geometry.gear.path_synthesis import PitchPointCrossing
from wearsim.geometry.gear.plane_gearing import Contacts, PitchCircles
from wearsim.geometry.profile_points import Vector


@dataclass(frozen=True)
class LineLoad:
    """Normal load per face width, q = w/cos(alpha)^n."""

    base: float  # w [N/mm]; for a constant torque T1/(b r1)
    power: int  # n: 1 for a constant torque, 0 for a constant normal load

    def at(self, pressure_angle: ArrayLike) -> Vector:
        """Return the load at a pressure angle.

        Equation synthesise.md (5).

        Parameters
        ----------
        pressure_angle : array_like
            alpha [rad].

        Returns
        -------
        numpy.ndarray
            q [N/mm].
        """
        return np.asarray(self.base / np.cos(pressure_angle) ** self.power)

    def growth(self, pressure_angle: float) -> float:
        """Return d(ln q)/d(alpha)."""
        return self.power * math.tan(pressure_angle)

    @property
    def best_pitch_point_angle(self) -> float:
        """Pressure angle with the greatest s/q at the pitch point [rad]: 45 deg, or 90 for n = 0."""
        return 0.5 * math.pi / (1 + self.power)


@dataclass(frozen=True, eq=False)
class StressProfile:
    """Contact stress over the distance from the pitch point: constant, or straight between points."""

    pitch_point_distance: Vector  # l of the points [mm], ascending; any for a single one
    stress: Vector  # sigma_H there [MPa]

    def at(self, pitch_point_distance: ArrayLike) -> Vector:
        """Return the stress at some distances from the pitch point."""
        l = np.asarray(pitch_point_distance, float)
        return np.asarray(np.interp(l, self.pitch_point_distance, self.stress))

    def covers(self, pitch_point_distance: ArrayLike) -> NDArray[np.bool_]:
        """Return where a stress is given."""
        l = np.asarray(pitch_point_distance)
        within = (self.pitch_point_distance[0] <= l) & (l <= self.pitch_point_distance[-1])
        return np.asarray(within | (self.stress.size == 1))

    def pitch_point_slope(self, side: int) -> float:
        """Return the slope beside the pitch point."""
        right = np.searchsorted(self.pitch_point_distance, 0.0, "left" if side < 0 else "right")
        if not 0 < right < self.stress.size:
            return 0.0
        rise, run = np.diff(self.stress)[right - 1], np.diff(self.pitch_point_distance)[right - 1]
        return float(rise / run)


@dataclass(frozen=True, eq=False)
class LoadedPair:
    """A gear pair with its load and the contact stress that it is to have."""

    circles: PitchCircles  # its pitch circles
    modulus: float  # contact modulus E* [MPa]
    load: LineLoad  # what a pair of teeth carries
    stress: StressProfile  # what is prescribed
    speed: float  # angular speed w1 of the pinion [rad/s]

    def reduced_radius(self, pitch_point_distance: ArrayLike, pressure_angle: ArrayLike) -> Vector:
        """Return the reduced radius that has the prescribed stress.

        rho = q E*/(pi sigma_H^2).

        Equation synthesise.md (5).

        Parameters
        ----------
        pitch_point_distance, pressure_angle : array_like
            l [mm] and alpha [rad].

        Returns
        -------
        numpy.ndarray
            rho [mm].
        """
        at_one = peak_pressure(self.load.at(pressure_angle), 1.0, self.modulus)
        return (at_one / self.stress.at(pitch_point_distance)) ** 2

    def radius_rule(self, pitch_point_distance: float, pressure_angle: float) -> float:
        """Return the reduced radius at one point."""
        return float(self.reduced_radius(pitch_point_distance, pressure_angle))

    def contact_stress(self, contacts: Contacts) -> Vector:
        """Return the contact stress of profiles.

        sigma_H = sqrt(q E*/(pi rho)); with Z_E^2 = E*/pi the form of gear standards.

        Equation synthesise.md (5).

        Parameters
        ----------
        contacts : Contacts
            Where they touch.

        Returns
        -------
        numpy.ndarray
            sigma_H [MPa]; nan where they interfere.
        """
        curvature = contacts.relative_curvature
        curvature = np.where(curvature > 0.0, curvature, math.nan)
        return peak_pressure(self.load.at(contacts.pressure_angle), curvature, self.modulus)

    @property
    def least_pitch_point_stress(self) -> float:
        """Least contact stress that profiles can have at the pitch point, where rho = sin(alpha)/A.

        Equation synthesise.md (12).
        """
        angle = self.load.best_pitch_point_angle
        curvature = 1.0 / self.circles.pitch_point_radius(angle)
        return float(peak_pressure(self.load.at(angle), curvature, self.modulus))

    def pitch_point_crossing(self) -> PitchPointCrossing:
        """Return how the path of contact with the prescribed stress goes through the pitch point.

        sin(alpha) cos(alpha)^n is proportional to 1/sigma_H^2 there. Of the two angles under a
        constant torque this is the one below 45 deg, through which one line goes.

        Equation synthesise.md (12).

        Returns
        -------
        PoleCrossing
            Its pressure angle and how fast that changes.

        Raises
        ------
        GeometryError
            No profiles have a stress as low as this at the pitch point.
        """
        requested, least = float(self.stress.at(0.0)), self.least_pitch_point_stress
        if not requested > least:
            raise GeometryError(
                f"contact_stress_MPa: must be above {least:.6g} at the pitch point, the least at any "
                f"pressure angle (it is that at {math.degrees(self.load.best_pitch_point_angle):g} deg), "
                f"but is {requested:g}: raise it or lower the load (a phase of synthesise may start "
                "beside the pitch point)"
            )
        angle = math.asin((least / requested) ** 2) / (1 + self.load.power)
        radius = float(self.circles.pitch_point_radius(angle))
        turns = [
            self.circles.pitch_point_turn(
                angle,
                by_distance=-2.0 * radius * self.stress.pitch_point_slope(side) / requested,
                by_angle=radius * self.load.growth(angle),
            )
            for side in (-1, 1)
        ]
        return PitchPointCrossing(angle, *turns)
