"""Contact stress of a plane gear pair, and the reduced radius of the profiles that it asks for."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from wearsim.contact.hertz import peak_pressure
from wearsim.errors import GeometryError
from wearsim.geometry.gear.line_synthesis import PoleCrossing
from wearsim.geometry.gear.plane_gearing import Contacts, PitchCircles
from wearsim.geometry.profile import Vector


@dataclass(frozen=True)
class LineLoad:
    """Normal load per face width, q = w/cos(alpha)^n.

    Attributes
    ----------
    base : float
        w [N/mm]; for a constant torque T1/(b r1).
    power : int
        n: 1 for a constant torque, 0 for a constant normal load.
    """

    base: float
    power: int

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
    def best_pole_angle(self) -> float:
        """Pressure angle with the greatest s/q in the pole [rad]: 45 deg, or 90 for n = 0."""
        return 0.5 * math.pi / (1 + self.power)


@dataclass(frozen=True, eq=False)
class StressLaw:
    """Contact stress over the distance from the pole: constant, or straight between points.

    Attributes
    ----------
    pole_distance : numpy.ndarray
        l of the points [mm], ascending; any for a single one.
    stress : numpy.ndarray
        sigma_H there [MPa].
    """

    pole_distance: Vector
    stress: Vector

    def at(self, pole_distance: ArrayLike) -> Vector:
        """Return the stress at some distances from the pole."""
        l = np.asarray(pole_distance, float)
        return np.asarray(np.interp(l, self.pole_distance, self.stress))

    def covers(self, pole_distance: ArrayLike) -> NDArray[np.bool_]:
        """Return where a stress is given."""
        l = np.asarray(pole_distance)
        within = (self.pole_distance[0] <= l) & (l <= self.pole_distance[-1])
        return np.asarray(within | (self.stress.size == 1))

    def pole_slope(self, side: int) -> float:
        """Return the slope beside the pole."""
        right = np.searchsorted(self.pole_distance, 0.0, "left" if side < 0 else "right")
        if not 0 < right < self.stress.size:
            return 0.0
        rise, run = np.diff(self.stress)[right - 1], np.diff(self.pole_distance)[right - 1]
        return float(rise / run)


@dataclass(frozen=True, eq=False)
class LoadedPair:
    """A gear pair with its load and the contact stress that it is to have.

    Attributes
    ----------
    circles : PitchCircles
        Its pitch circles.
    modulus : float
        Contact modulus E* [MPa].
    load : LineLoad
        What a pair of teeth carries.
    stress : StressLaw
        What is prescribed.
    speed : float
        Angular speed w1 of the pinion [rad/s].
    """

    circles: PitchCircles
    modulus: float
    load: LineLoad
    stress: StressLaw
    speed: float

    def reduced_radius(self, pole_distance: ArrayLike, pressure_angle: ArrayLike) -> Vector:
        """Return the reduced radius that has the prescribed stress.

        rho = q E*/(pi sigma_H^2).

        Equation synthesise.md (5).

        Parameters
        ----------
        pole_distance, pressure_angle : array_like
            l [mm] and alpha [rad].

        Returns
        -------
        numpy.ndarray
            rho [mm].
        """
        at_one = peak_pressure(self.load.at(pressure_angle), 1.0, self.modulus)
        return (at_one / self.stress.at(pole_distance)) ** 2

    def law(self, pole_distance: float, pressure_angle: float) -> float:
        """Return the reduced radius at one point."""
        return float(self.reduced_radius(pole_distance, pressure_angle))

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
    def least_pole_stress(self) -> float:
        """Least contact stress that profiles can have in the pole, where rho = sin(alpha)/A.

        Equation synthesise.md (12).
        """
        angle = self.load.best_pole_angle
        curvature = 1.0 / self.circles.pole_radius(angle)
        return float(peak_pressure(self.load.at(angle), curvature, self.modulus))

    def pole_crossing(self) -> PoleCrossing:
        """Return how the line of action with the prescribed stress goes through the pole.

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
            No profiles have a stress as low as this in the pole.
        """
        asked, least = float(self.stress.at(0.0)), self.least_pole_stress
        if not asked > least:
            raise GeometryError(
                f"contact_stress_MPa: must be above {least:.6g} in the pole, the least at any pressure "
                f"angle (it is that at {math.degrees(self.load.best_pole_angle):g} deg), but is "
                f"{asked:g}: raise it or lower the load (a phase of synthesise may start beside the pole)"
            )
        angle = math.asin((least / asked) ** 2) / (1 + self.load.power)
        radius = float(self.circles.pole_radius(angle))
        turns = [
            self.circles.pole_turn(
                angle,
                by_distance=-2.0 * radius * self.stress.pole_slope(side) / asked,
                by_angle=radius * self.load.growth(angle),
            )
            for side in (-1, 1)
        ]
        return PoleCrossing(angle, *turns)
