"""Involute spur gears with profile shift: base circles, path of contact, flanks."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from wearsim.errors import GeometryError
from wearsim.geometry.gear.involute_function import angle_of_involute, involute_function
from wearsim.geometry.gear.mesh import Mesh, check_contact_ratio, check_tip
from wearsim.geometry.gear.plane_gearing import PitchCircles
from wearsim.geometry.profile_points import Profile, Vector


@dataclass(frozen=True)
class InvolutePair:
    """A pinion and a wheel with straight teeth that mesh without backlash.

    All along the path of contact is counted from the point where the path of contact leaves the
    base circle of the pinion: there the radius of curvature of the pinion's flank is the way
    itself, that of the wheel's what is left of ``line_length``. The pinion drives, so a tooth
    meets from the tip of the wheel, ``path_start``, to the tip of the pinion, ``path_end``
    (ISO 21771).

    Examples
    --------
    Without shift the working pressure angle is that of the rack:

    >>> pair = InvolutePair((20, 30), 3.0, math.radians(20.0), (0.0, 0.0), (33.0, 48.0))
    >>> round(math.degrees(pair.working_angle), 9), pair.centre_distance
    (20.0, 75.0)
    >>> round(pair.contact_ratio, 9)
    1.605176092
    """

    teeth: tuple[int, int]  # z1 and z2
    module: float  # m [mm]
    pressure_angle: float  # alpha of the basic rack [rad]
    profile_shift: tuple[float, float]  # x1 and x2, in modules
    tip_radius: tuple[float, float]  # ra1 and ra2 [mm]

    @property
    def ratio(self) -> float:
        """Gear ratio u = z2/z1."""
        return self.teeth[1] / self.teeth[0]

    @property
    def base_radius(self) -> tuple[float, float]:
        """Radii of the base circles rb1 and rb2 [mm]."""
        z1, z2 = self.teeth
        half = 0.5 * self.module * math.cos(self.pressure_angle)
        return z1 * half, z2 * half

    @property
    def base_pitch(self) -> float:
        """Distance of successive flanks along the path of contact, p_b = pi m cos(alpha) [mm]."""
        return math.pi * self.module * math.cos(self.pressure_angle)

    @cached_property
    def working_angle(self) -> float:
        """Working pressure angle [rad] from inv(alpha_w) = inv(alpha) + 2 tan(alpha) (x1+x2)/(z1+z2)."""
        shift = sum(self.profile_shift) / sum(self.teeth)
        wanted = involute_function(self.pressure_angle) + 2.0 * math.tan(self.pressure_angle) * shift
        if not wanted > 0.0:
            raise GeometryError(
                f"gear pair: inv(alpha_w) must be above 0, but is {wanted:.4g}: raise the sum of the "
                f"profile shifts, {sum(self.profile_shift):g}"
            )
        return angle_of_involute(wanted, 1e-16)

    @property
    def centre_distance(self) -> float:
        """Centre distance a [mm]."""
        return sum(self.base_radius) / math.cos(self.working_angle)

    @property
    def line_length(self) -> float:
        """Length of the path of contact between the base circles, a sin(alpha_w) [mm]."""
        return self.centre_distance * math.sin(self.working_angle)

    @property
    def pitch_point(self) -> float:
        """Place of the pitch point on the path, rb1 tan(alpha_w) [mm]."""
        return self.base_radius[0] * math.tan(self.working_angle)

    @property
    def path_start(self) -> float:
        """Place A where a tooth comes into contact, at the tip of the wheel [mm]."""
        return self.line_length - self._tip_tangent(1)

    @property
    def path_end(self) -> float:
        """Place E where it leaves, at the tip of the pinion [mm]."""
        return self._tip_tangent(0)

    @property
    def approach(self) -> float:
        """Length of the path before the pitch point [mm], to the wheel's tip or the pinion's base circle."""
        return self.pitch_point - max(self.path_start, 0.0)

    @property
    def recess(self) -> float:
        """Length of the path after the pitch point [mm], to the pinion's tip or the wheel's base circle."""
        return min(self.path_end, self.line_length) - self.pitch_point

    @property
    def contact_ratio(self) -> float:
        """Length of the path of contact over the base pitch."""
        return (self.approach + self.recess) / self.base_pitch

    def reduced_radius(self, place: Vector) -> Vector:
        """Return the reduced radius of curvature, xi (T1T2 - xi) / T1T2.

        Equation gears.md (1).

        Parameters
        ----------
        place : numpy.ndarray
            xi, on the path of contact [mm].

        Returns
        -------
        numpy.ndarray
            Radius [mm].
        """
        return place * (self.line_length - place) / self.line_length

    def _tip_tangent(self, wheel: int) -> float:
        """Length of the tangent from the tip circle to the base circle [mm]."""
        tip, base = self.tip_radius[wheel], self.base_radius[wheel]
        if not tip > base:
            raise GeometryError(
                f"gear pair: the tip radius of gear {wheel + 1} must be above its base radius "
                f"{base:.4g} mm, but is {tip:.4g} mm"
            )
        return math.sqrt(tip * tip - base * base)

    def check(self) -> None:
        """Raise where the pair cannot run."""
        for name, least, limit in (
            ("2", self.path_start, "path of contact starts"),
            ("1", self.line_length - self.path_end, "path of contact ends"),
        ):
            if not least > 0.0:
                raise GeometryError(
                    f"gear pair: the {limit} {-least:.4g} mm beyond the base circle, where there is no "
                    f"involute: lower the tip radius of gear {name} by shift or a shorter addendum"
                )
        check_contact_ratio(self.contact_ratio)
        for gear in (0, 1):
            check_tip(("pinion", "wheel")[gear], self.tip_width(gear))

    def tip_width(self, gear: int) -> float:
        """Return the thickness of a tooth on its tip circle.

        2 r_a (pi/(2 z) + 2 x tan(alpha)/z + inv(alpha) - inv(alpha_a)), cos(alpha_a) = r_b/r_a.
        """
        z, shift, tip = self.teeth[gear], self.profile_shift[gear], self.tip_radius[gear]
        at_tip = math.acos(self.base_radius[gear] / tip)
        half = (0.5 * math.pi + 2.0 * shift * math.tan(self.pressure_angle)) / z
        left = involute_function(self.pressure_angle) - involute_function(at_tip)
        return 2.0 * tip * (half + left)

    @property
    def circles(self) -> PitchCircles:
        """The pitch circles at which the gears work."""
        return PitchCircles(self.centre_distance, self.ratio)

    @property
    def pitch_point_angle(self) -> float:
        """Pressure angle at the pitch point, alpha_w [rad]."""
        return self.working_angle

    def mesh(self, points: int) -> Mesh:
        """Return the way of a pair of teeth through contact."""
        place = np.linspace(self.path_start, self.path_end, points)
        rest, (own, other) = self.line_length - place, self.base_radius
        lever = np.full(points, own)
        return Mesh(
            place=place,
            pitch=self.base_pitch,
            pitch_point_distance=place - self.pitch_point,
            lever=lever,
            rolling=np.array([place, rest / self.ratio]),
            curvature=1.0 / np.array([place, rest]),
            arc=0.5
            * np.array([place**2 - place[0] ** 2, rest[0] ** 2 - rest**2])
            / np.array([[own], [other]]),
            flank=self.flank(place),
            mate=self.mating_flank(place),
            gaps=self.separation(place + self.base_pitch * np.array([[1.0], [-1.0]])),
            levers=np.array([lever, lever]),
        )

    def separation(self, place: Vector) -> Vector:
        """Return how far a pair of teeth beyond the ends of the path is apart.

        Before A the corner of the wheel's tip is next to the pinion's flank, after E that of
        the pinion's to the wheel's; the gap is measured along the path of contact.
        """
        base, tips, line = self.base_radius, self.tip_radius, self.line_length
        before = _corner_gap(place, base, tips[1], line)
        after = _corner_gap(line - place, base[::-1], tips[0], line)
        gap = np.where(place < self.path_start, before, 0.0)
        return np.where(place > self.path_end, after, gap)

    def flank(self, place: Vector) -> Profile:
        """Return the points of the pinion's flank that touch at places of the path."""
        return _involute(self.base_radius[0], place)

    def mating_flank(self, place: Vector) -> Profile:
        """Return the points of the wheel's flank that touch at places of the path."""
        return _involute(self.base_radius[1], (self.line_length - place)[::-1])


def _involute(base_radius: float, tangent: Vector) -> Profile:
    roll = tangent / base_radius
    x = base_radius * (roll * np.cos(roll) - np.sin(roll))
    y = base_radius * (np.cos(roll) + roll * np.sin(roll))
    return Profile(x, y)


def _corner_gap(place: Vector, base: tuple[float, float], tip_radius: float, line: float) -> Vector:
    """Gap between a flank on the first base circle and the corner of a tip around the second.

    The first base circle touches the line at its origin from below, the second at ``line``
    from above. A flank starts on its base circle clockwise from there by its tangent over
    the base radius.
    """
    own, other = base
    tangent = math.sqrt(tip_radius**2 - other**2)
    start = -0.5 * math.pi - (line - place) / other
    corner = start + tangent / other - math.atan(tangent / other)
    x = line + tip_radius * np.cos(corner)
    y = own + other + tip_radius * np.sin(corner)
    inside = x * x + y * y - own * own
    reach = np.sqrt(np.maximum(inside, 0.0)) / own
    through = np.arctan2(y, x) + np.arctan(reach) - reach
    gap = own * (0.5 * math.pi - place / own - through)
    return np.where(inside > 0.0, gap, np.inf)
