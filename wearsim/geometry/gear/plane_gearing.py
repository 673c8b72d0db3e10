"""Plane gearing: what a point of contact and the direction of the path of contact fix.

The source (D.T. Babichev and co-authors, Kharkov 2012, source document 000) survives in its
conclusions only: fields of indices over the plane of mesh, and two pairs of profiles for one
reduced curvature. The equations here are derived from the law of gearing and Euler-Savary.

The pitch point is (0, 0), the pinion's axis (0, -r1), the wheel's (0, r2). The pinion turns clockwise;
the contact lies at l (cos(alpha), sin(alpha)), l negative before the pitch point, and the common
normal is its line to the pitch point, so that alpha is the pressure angle there.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from wearsim.geometry.profile_points import Vector

Family = Literal[1, -1]
"""Of the two pairs of profiles for one reduced radius: 1 with great radii, -1 with small ones."""


@dataclass(frozen=True)
class PitchCircles:
    """The pitch circles of an external pair.

    Examples
    --------
    >>> pair = PitchCircles(centre_distance=135.0, gear_ratio=1.5)
    >>> pair.pinion_radius, pair.wheel_radius
    (54.0, 81.0)
    """

    centre_distance: float  # distance a_w of the axes [mm], above 0
    gear_ratio: float  # u, speed of the pinion over that of the wheel, above 0

    @property
    def pinion_radius(self) -> float:
        """Radius r1 = a_w/(1 + u) of the pinion's pitch circle [mm]."""
        return self.centre_distance / (1.0 + self.gear_ratio)

    @property
    def wheel_radius(self) -> float:
        """Radius r2 = u r1 of the wheel's pitch circle [mm]."""
        return self.gear_ratio * self.pinion_radius

    @property
    def curvature_sum(self) -> float:
        """A = 1/r1 + 1/r2 [1/mm]."""
        return 1.0 / self.pinion_radius + 1.0 / self.wheel_radius

    @property
    def curvature_bias(self) -> float:
        """B = (1/r2 - 1/r1)/2 [1/mm]."""
        return 0.5 * (1.0 / self.wheel_radius - 1.0 / self.pinion_radius)

    def pitch_point_radius(self, pressure_angle: ArrayLike) -> Vector:
        """Return the reduced radius of any regular pair of profiles that touches at the pitch point.

        s = sin(alpha)/A.
        """
        return np.sin(pressure_angle) / self.curvature_sum

    def turn(
        self,
        pitch_point_distance: ArrayLike,
        pressure_angle: ArrayLike,
        reduced_radius: ArrayLike,
        family: Family,
    ) -> Vector:
        """Return how fast the normal turns where the profiles have a given reduced radius.

        d(alpha)/d(phi1) = r1 (B - sin(alpha)/l + eps A R/(2 l)) with R^2 = l^2 + 4 s rho.

        Equations synthesise.md (9) times (1).

        Parameters
        ----------
        pitch_point_distance : array_like
            l [mm], not 0.
        pressure_angle : array_like
            alpha [rad].
        reduced_radius : array_like
            rho [mm], above 0.
        family : 1 or -1
            eps.

        Returns
        -------
        numpy.ndarray
            Radians per radian of the pinion; nan where no profiles have that radius (R^2 < 0,
            which takes alpha < 0).
        """
        l, radius = np.asarray(pitch_point_distance, float), np.asarray(reduced_radius, float)
        root = np.sqrt(l**2 + 4.0 * self.pitch_point_radius(pressure_angle) * radius)
        leaning = 0.5 * family * self.curvature_sum * root - np.sin(pressure_angle)
        return np.asarray(self.pinion_radius * (self.curvature_bias + leaning / l))

    def pitch_point_turn(self, pressure_angle: float, by_distance: float, by_angle: float) -> float:
        """Return how fast the normal turns at the pitch point itself, on the way through it.

        The limit of ``turn`` for the family 1 with rho = s at the pitch point:
        d(alpha)/d(phi1) = r1 cos(alpha) (2 B + A rho_l)/(3 cos(alpha) - A rho_alpha).

        Equations synthesise.md (13) times (1).

        Parameters
        ----------
        pressure_angle : float
            alpha at the pitch point [rad].
        by_distance, by_angle : float
            Partial derivatives rho_l and rho_alpha [mm] of the reduced radius asked for.

        Returns
        -------
        float
            Radians per radian of the pinion.
        """
        cosine, sum_ = np.cos(pressure_angle), self.curvature_sum
        slope = (2.0 * self.curvature_bias + sum_ * by_distance) / (3.0 * cosine - sum_ * by_angle)
        return float(self.pinion_radius * cosine * slope)


@dataclass(frozen=True, eq=False)
class Contacts:
    """Points of contact with the direction in which each moves.

    Examples
    --------
    An involute at 20 deg, 8 mm after the pitch point: l + r1 sin(alpha) and r2 sin(alpha) - l:

    >>> pair = PitchCircles(135.0, 1.5)
    >>> touch = Contacts(pair, np.array(8.0), np.radians(20.0), np.array(0.0))
    >>> print((1 / touch.pinion_curvature).round(6), (1 / touch.wheel_curvature).round(6))
    26.469088 19.703632
    """

    circles: PitchCircles  # the pair
    pitch_point_distance: Vector  # l [mm], any shape
    pressure_angle: Vector  # alpha [rad], same shape
    turn: Vector  # d(alpha)/d(phi1), radians per radian of the pinion; 0 on the involute

    @classmethod
    def of_radius(
        cls,
        circles: PitchCircles,
        pitch_point_distance: Vector,
        pressure_angle: Vector,
        reduced_radius: ArrayLike,
        family: Family,
    ) -> "Contacts":
        """Return contacts of profiles with a given reduced radius.

        Both families have the same one. With R of ``PitchCircles.turn`` the rolling of the
        pinion is (1 + 1/u)(eps R + l)/2 and that of the wheel (1 + 1/u)(eps R - l)/2: from one
        family to the other the two wheels change places.

        Equation synthesise.md (10).

        Parameters
        ----------
        circles : PitchCircles
            The pair.
        pitch_point_distance, pressure_angle : numpy.ndarray
            l [mm], not 0, and alpha [rad].
        reduced_radius : array_like
            rho [mm], above 0.
        family : 1 or -1
            With great radii or with small ones.

        Returns
        -------
        Contacts
            At those points; nan where no profiles have that radius.
        """
        turn = circles.turn(pitch_point_distance, pressure_angle, reduced_radius, family)
        return cls(circles, pitch_point_distance, pressure_angle, turn)

    @classmethod
    def of_direction(
        cls, circles: PitchCircles, pitch_point_distance: Vector, pressure_angle: Vector, direction: float
    ) -> "Contacts":
        """Return contacts that move at a given angle to the common normal.

        d(alpha)/d(phi1) = r1 cos(alpha) tan(mu)/l.

        Equation synthesise.md (2).

        Parameters
        ----------
        circles : PitchCircles
            The pair.
        pitch_point_distance, pressure_angle : numpy.ndarray
            l [mm], not 0, and alpha [rad].
        direction : float
            mu [rad], between -pi/2 and pi/2.

        Returns
        -------
        Contacts
            At those points.
        """
        turn = circles.pinion_radius * np.cos(pressure_angle) * np.tan(direction) / pitch_point_distance
        return cls(circles, pitch_point_distance, pressure_angle, turn)

    @property
    def points(self) -> Vector:
        """Points of contact beside the pitch point [mm], shape (..., 2)."""
        angle = self.pressure_angle
        return np.stack(
            [self.pitch_point_distance * np.cos(angle), self.pitch_point_distance * np.sin(angle)], axis=-1
        )

    @property
    def direction(self) -> Vector:
        """Angle mu of the path of contact to the common normal [rad], tan(mu) = l d(alpha)/dl.

        Equation synthesise.md (2).
        """
        advance = self.circles.pinion_radius * np.cos(self.pressure_angle)
        return np.arctan(self.pitch_point_distance * self.turn / advance)

    @property
    def slope(self) -> Vector:
        """Slope d(alpha)/dl of the path of contact [rad/mm]; dl/d(phi1) = r1 cos(alpha).

        Equation synthesise.md (1).
        """
        return self.turn / (self.circles.pinion_radius * np.cos(self.pressure_angle))

    @property
    def pinion_rolling(self) -> Vector:
        """Way of the contact along the pinion's profile, v_t1/w1 = r1 sin(alpha) + l (1 + a').

        Equation synthesise.md (6).
        """
        return self._foot + self.pitch_point_distance * (1.0 + self.turn)

    @property
    def wheel_rolling(self) -> Vector:
        """Way along the wheel's profile, v_t2/w1 = r1 sin(alpha) + l (a' - 1/u) [mm per rad].

        Equation synthesise.md (6).
        """
        return self._foot + self.pitch_point_distance * (self.turn - 1.0 / self.circles.gear_ratio)

    @property
    def sliding(self) -> Vector:
        """Way of sliding v_s/w1 = (v_t1 - v_t2)/w1 = (1 + 1/u) l [mm per rad of the pinion].

        Equation synthesise.md (7).
        """
        return (1.0 + 1.0 / self.circles.gear_ratio) * self.pitch_point_distance

    @property
    def pinion_specific_sliding(self) -> Vector:
        """Sliding over rolling of the pinion, theta1 = v_s/v_t1.

        Equation synthesise.md (7).
        """
        return self.sliding / self.pinion_rolling

    @property
    def wheel_specific_sliding(self) -> Vector:
        """Sliding over rolling of the wheel, theta2 = -v_s/v_t2.

        Equation synthesise.md (7).
        """
        return -self.sliding / self.wheel_rolling

    @property
    def pinion_curvature(self) -> Vector:
        """Curvature 1/rho1 of the pinion's profile [1/mm], convex positive.

        Euler-Savary: rho1 = l + p with p = r1 sin(alpha)/(1 + a'), so that 1/rho1 is what the
        normal turns in the pinion over the way of the contact along it; 0 is a straight profile.

        Equations synthesise.md (3) and (4).
        """
        return (1.0 + self.turn) / self.pinion_rolling

    @property
    def wheel_curvature(self) -> Vector:
        """Curvature 1/rho2 of the wheel's profile [1/mm], rho2 = r2 sin(alpha)/(1 - u a') - l.

        Equations synthesise.md (3) and (4).
        """
        return (1.0 / self.circles.gear_ratio - self.turn) / self.wheel_rolling

    @property
    def relative_curvature(self) -> Vector:
        """Sum 1/rho of both curvatures [1/mm]; at or below 0 the profiles interfere.

        Equation synthesise.md (4).
        """
        return self.pinion_curvature + self.wheel_curvature

    @property
    def _foot(self) -> Vector:
        """Distance of the pitch point from the foot of the pinion's perpendicular on the normal."""
        return self.circles.pinion_radius * np.sin(self.pressure_angle)
