"""Head and foot of a convex-concave tooth: the flank that a circular path of contact gives.

M. Bosansky and co-authors, "Possibilities of AutoCAD in the design of new profiles" (2015;
source document 002, second fragment). The path of contact is made of two circular arcs that
touch each other at the pitch point C. Each arc belongs to the head of one gear and to the foot of
the other, so that both gears and their rack have flanks of the same form.

Printed eq. (1) has the sign of x in y as well; the listing beside it has the right one, and
it alone gives the roll angle. What stands here follows the listing.
"""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from wearsim.errors import GeometryError
from wearsim.geometry.profile_points import Vector

Part = Literal["head", "foot"]

_NEWTON_STEPS = 12


@dataclass(frozen=True)
class ConvexConcaveFlank:
    """The head or the foot of the flank of one gear.

    The gear's axis is the origin and the pitch point lies on +y. The flank passes through the pitch point
    with the tooth on the side of +x. Of every point the pressure angle alpha is known at which
    it is in contact; all functions take it as a number or as an array.

    Examples
    --------
    >>> head = ConvexConcaveFlank(38.25, 10.0, math.radians(20.0), "head")
    >>> head.points(math.radians(30.0)).round(6).tolist()
    [1.013578, 40.086625]
    """

    pitch_radius: float  # radius r of the pitch circle [mm]
    arc_radius: float  # radius r_k of the arc of the path of contact [mm]
    pitch_point_angle: float  # pressure angle alpha_C at the pitch point [rad]
    part: Part  # `head` or `foot`

    @property
    def side(self) -> float:
        """+1 on the head, -1 on the foot."""
        return 1.0 if self.part == "head" else -1.0

    def path_coordinate(self, alpha: ArrayLike) -> Vector:
        """Return the distance from the pitch point along the normal, l = +-2 r_k sin(alpha - alpha_C).

        Equation convex-concave.md (1).

        Parameters
        ----------
        alpha : array_like
            Pressure angle [rad].

        Returns
        -------
        numpy.ndarray
            l [mm], negative on the foot.
        """
        e = np.asarray(alpha, dtype=float) - self.pitch_point_angle
        return np.asarray(2.0 * self.side * self.arc_radius * np.sin(e))

    def rolled_length(self, alpha: ArrayLike) -> Vector:
        """Return the length that the pitch circles roll on each other from the pitch point.

        +-2 r_k ((alpha - alpha_C) cos alpha_C + sin alpha_C ln(cos alpha_C / cos alpha)), the
        integral of dl / cos alpha; it does not depend on the gear.

        Equation convex-concave.md (2).

        Parameters
        ----------
        alpha : array_like
            Pressure angle [rad], below a right angle.

        Returns
        -------
        numpy.ndarray
            Length [mm], negative on the foot.
        """
        a, c = np.asarray(alpha, dtype=float), self.pitch_point_angle
        rolled = (a - c) * math.cos(c) + math.sin(c) * np.log(math.cos(c) / np.cos(a))
        return np.asarray(2.0 * self.side * self.arc_radius * rolled)

    def angle_at_rolled_length(self, length: ArrayLike) -> Vector:
        """Return the pressure angle after so much rolling from the pitch point, by Newton's method.

        d(length)/d(alpha) = +-2 r_k cos(alpha - alpha_C)/cos(alpha) is above 0 and grows, so
        that it comes down to the root from above.
        """
        wanted = np.abs(np.asarray(length, dtype=float)) / (2.0 * self.arc_radius)
        angle = np.minimum(self.pitch_point_angle + wanted, 0.5 * math.pi - 1e-6)
        for _ in range(_NEWTON_STEPS):
            off = np.abs(self.rolled_length(angle)) / (2.0 * self.arc_radius) - wanted
            angle = angle - off * np.cos(angle) / np.cos(angle - self.pitch_point_angle)
        return np.asarray(angle)

    def turn(self, alpha: ArrayLike) -> Vector:
        """Return the change of the pressure angle over the turn of the gear.

        +-r cos alpha / (2 r_k cos(alpha - alpha_C)).

        Equation convex-concave.md (4).

        Parameters
        ----------
        alpha : array_like
            Pressure angle [rad].

        Returns
        -------
        numpy.ndarray
            Radians per radian of this gear.
        """
        a = np.asarray(alpha, dtype=float)
        change = self.pitch_radius * np.cos(a) / np.cos(a - self.pitch_point_angle)
        return np.asarray(0.5 * self.side * change / self.arc_radius)

    def roll_angle(self, alpha: ArrayLike) -> Vector:
        """Return the angle phi_r that the gear turns from contact at the pitch point."""
        return self.rolled_length(alpha) / self.pitch_radius

    def path_points(self, alpha: ArrayLike) -> Vector:
        """Return points of the path of contact."""
        a, l = np.asarray(alpha, dtype=float), self.path_coordinate(alpha)
        return np.stack([-l * np.cos(a), self.pitch_radius + l * np.sin(a)], axis=-1)

    def points(self, alpha: ArrayLike) -> Vector:
        """Return points of the flank, eq. (1) with the sign of y put right.

        x = -l cos(alpha + phi_r) + r sin phi_r, y = l sin(alpha + phi_r) + r cos phi_r.

        Equation convex-concave.md (3).

        Parameters
        ----------
        alpha : array_like
            Pressure angle [rad].

        Returns
        -------
        numpy.ndarray
            Coordinates [mm], shape (..., 2).
        """
        l, phi = self.path_coordinate(alpha), self.roll_angle(alpha)
        angle = np.asarray(alpha, dtype=float) + phi
        x = -l * np.cos(angle) + self.pitch_radius * np.sin(phi)
        y = l * np.sin(angle) + self.pitch_radius * np.cos(phi)
        return np.stack([x, y], axis=-1)

    def normals(self, alpha: ArrayLike) -> Vector:
        """Return the unit normals that point from the tooth into the gap."""
        angle = np.asarray(alpha, dtype=float) + self.roll_angle(alpha)
        return np.stack([-np.cos(angle), np.sin(angle)], axis=-1)

    def radius(self, alpha: ArrayLike) -> Vector:
        """Return the distance of the flank from the axis, r_y^2 = r^2 + l^2 + 2 r l sin alpha."""
        l, r = self.path_coordinate(alpha), self.pitch_radius
        return np.asarray(np.sqrt(r**2 + l**2 + 2.0 * r * l * np.sin(alpha)))

    def curvature(self, alpha: ArrayLike) -> Vector:
        """Return the curvature, convex positive.

        (1 + alpha') / (l (1 + alpha') + r sin alpha) with alpha' of ``turn``, by Euler and Savary.
        It jumps at the pitch point.

        Equation convex-concave.md (4).

        Parameters
        ----------
        alpha : array_like
            Pressure angle [rad].

        Returns
        -------
        numpy.ndarray
            Curvature [1/mm].
        """
        a, r, change = np.asarray(alpha, dtype=float), self.pitch_radius, self.turn(alpha)
        speed = self.path_coordinate(a) * (1.0 + change) + r * np.sin(a)
        return np.asarray((1.0 + change) / speed)

    def curvature_radius(self, alpha: ArrayLike) -> Vector:
        """Return the radius of curvature, convex positive."""
        with np.errstate(divide="ignore"):
            return 1.0 / self.curvature(alpha)

    def rack_points(self, alpha: ArrayLike) -> Vector:
        """Return the flank of the rack that this flank is in contact with."""
        a, l = np.asarray(alpha, dtype=float), self.path_coordinate(alpha)
        return np.stack([self.rolled_length(a) - l * np.cos(a), l * np.sin(a)], axis=-1)

    def rack_radius(self, alpha: ArrayLike) -> Vector:
        """Return the radius of curvature of the rack's flank without its sign.

        2 r_k (sin(alpha - alpha_C) + tan alpha cos(alpha - alpha_C)).
        """
        a = np.asarray(alpha, dtype=float)
        e = a - self.pitch_point_angle
        return np.asarray(2.0 * self.arc_radius * (np.sin(e) + np.tan(a) * np.cos(e)))

    @property
    def straight_angle(self) -> float:
        """Pressure angle at which the foot stops being concave [rad]; nan for a head.

        tan alpha = (r / (2 r_k) - cos alpha_C) / sin alpha_C. It exceeds alpha_C, so that the
        foot is concave from the pitch point on, where r_k < r cos(alpha_C) / 2.
        """
        if self.part == "head":
            return math.nan
        ratio, c = 0.5 * self.pitch_radius / self.arc_radius, self.pitch_point_angle
        return math.atan((ratio - math.cos(c)) / math.sin(c))

    @property
    def last_angle(self) -> float:
        """Pressure angle at which the flank ends, however high the tooth [rad].

        A right angle. On a foot, where that comes first, the cusp at tan(2 alpha - alpha_C) =
        r_k sin alpha_C / (r_k cos alpha_C - r), beyond which it would turn back: undercut.
        """
        r, k, c = self.pitch_radius, self.arc_radius, self.pitch_point_angle
        if self.part == "head":
            return 0.5 * math.pi
        cusp = 0.5 * (c + math.atan2(k * math.sin(c), k * math.cos(c) - r))
        return min(0.5 * math.pi, cusp)

    def angle_at_depth(self, depth: float) -> float:
        """Return the pressure angle of the rack's point at a distance from the pitch line.

        alpha = (alpha_C + arccos(cos alpha_C - h / r_k)) / 2, from h = |l| sin alpha.
        """
        reach = 2.0 * self.arc_radius * math.cos(self.pitch_point_angle)
        if not depth < reach:
            raise GeometryError(self._too_far("height", depth, reach))
        c = self.pitch_point_angle
        return 0.5 * (c + math.acos(math.cos(c) - depth / self.arc_radius))

    def angle_at_radius(self, radius: float) -> float:
        """Return the pressure angle at which the flank is at a distance from the axis.

        The distance changes monotonically with alpha up to the last angle of the flank.
        """
        r, c, end = self.pitch_radius, self.pitch_point_angle, self.last_angle
        beyond, reach = self.side * (radius - r), self.side * (float(self.radius(end)) - r)
        if not 0.0 <= beyond < reach:
            raise GeometryError(self._too_far("distance from the pitch circle", beyond, reach))
        return float(brentq(lambda a: float(self.radius(a)) - radius, c, end, xtol=1e-15))

    def _too_far(self, what: str, wanted: float, reach: float) -> str:
        return (
            f"{self.part} of the tooth: its {what} must be from 0 to below {reach:.6g} mm with an arc of "
            f"{self.arc_radius:g} mm in the line of action, is {wanted:.6g} mm: lower module_mm or "
            "addendum_ratio or raise the radius of the arc"
        )
