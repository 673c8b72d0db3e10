"""A pair of gears with convex-concave teeth after Bosansky.

The path of contact is an S of two circular arcs through the pitch point C (source document 002, second
fragment; see :mod:`wearsim.geometry.gear.convex_concave_flank`). In zone a, after the pitch point, the
pinion's head runs on the wheel's foot; in zone b, before it, the pinion's foot on the wheel's
head. Curvatures follow from Euler and Savary; the source gives only their signs, (2) to (5).
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from wearsim.geometry.gear.convex_concave_flank import ConvexConcaveFlank
from wearsim.geometry.gear.convex_concave_gear import ConvexConcaveGear
from wearsim.geometry.gear.mesh import Mesh, mesh_on
from wearsim.geometry.gear.path_of_contact import PathOfContact
from wearsim.geometry.gear.plane_gearing import Contacts, PitchCircles
from wearsim.geometry.profile_points import Vector


@dataclass(frozen=True)
class Zone:
    """One arc of the path of contact and the two flanks that meet on it."""

    name: str  # `a` (pinion's head on wheel's foot) or `b` (pinion's foot on wheel's head)
    # pinion, wheel: the flanks, each in the frame of its gear; the same pressure angle is the same contact
    pinion: ConvexConcaveFlank
    wheel: ConvexConcaveFlank
    end: float  # pressure angle at which contact ends [rad]: at the tip of the gear whose head it is

    def angles(self, count: int) -> Vector:
        """Return pressure angles from the pitch point to the end of contact."""
        return np.linspace(self.pinion.pitch_point_angle, self.end, count)

    def reduced_radius(self, alpha: ArrayLike) -> Vector:
        """Return the reduced radius of curvature, 1 / (1/rho_1 + 1/rho_2).

        Equation convex-concave.md (5).

        Parameters
        ----------
        alpha : array_like
            Pressure angle [rad].

        Returns
        -------
        numpy.ndarray
            Radius [mm].
        """
        return 1.0 / (self.pinion.curvature(alpha) + self.wheel.curvature(alpha))


@dataclass(frozen=True)
class SignCondition:
    """One of the source's conditions (2) to (5) on the curvature of a flank."""

    number: int  # of the equation
    radius: str  # the radius of curvature that it is about
    flank: ConvexConcaveFlank  # whose radius that is
    end: float  # pressure angle up to which it must hold [rad]

    @property
    def holds(self) -> bool:
        """Whether it holds from the pitch point to the end of contact; a head is always convex."""
        return self.flank.part == "head" or self.flank.straight_angle > self.end

    @property
    def arc_limit(self) -> float:
        """What the radius of the arc must be below to hold at the pitch point [mm]: r cos(alpha_C) / 2.

        inf for a head, which is convex with every arc.
        """
        if self.flank.part == "head":
            return math.inf
        return 0.5 * self.flank.pitch_radius * math.cos(self.flank.pitch_point_angle)


@dataclass(frozen=True)
class ConvexConcave:
    """A pinion that drives a wheel.

    Examples
    --------
    >>> pair = ConvexConcave(4.5, 17, 34, math.radians(20.0), 10.0, 10.0, 4.5)
    >>> round(pair.contact_ratio, 10)
    1.0987962846
    >>> round(float(pair.zones[0].reduced_radius(pair.pitch_point_angle)), 10)
    8.7215136548
    """

    module: float  # module m [mm]
    # pinion_teeth, wheel_teeth: numbers z1 and z2
    pinion_teeth: int
    wheel_teeth: int
    pitch_point_angle: float  # pressure angle alpha_C at the pitch point [rad]
    # head_arc, foot_arc: radii r_kh and r_kd of the arcs on which head and foot of the pinion are in contact
    # [mm]
    head_arc: float
    foot_arc: float
    addendum: float  # height of the tips above the pitch circles [mm]
    # circumferential backlash on the pitch circles [mm]; half of it thins the teeth of each gear
    backlash: float = 0.0

    @cached_property
    def pinion(self) -> ConvexConcaveGear:
        """The driving gear."""
        return self._gear(self.pinion_teeth, self.head_arc, self.foot_arc)

    @cached_property
    def wheel(self) -> ConvexConcaveGear:
        """The driven gear, whose head runs on the pinion's foot.

        In a frame of its own, turned half round, so that its flank passes the pitch point on +y too.
        """
        return self._gear(self.wheel_teeth, self.foot_arc, self.head_arc)

    def _gear(self, teeth: int, head_arc: float, foot_arc: float) -> ConvexConcaveGear:
        return ConvexConcaveGear(
            teeth, self.module, self.pitch_point_angle, head_arc, foot_arc, self.addendum, 0.5 * self.backlash
        )

    @property
    def teeth(self) -> tuple[int, int]:
        """Numbers of teeth z1 and z2."""
        return self.pinion_teeth, self.wheel_teeth

    @property
    def circles(self) -> PitchCircles:
        """The pitch circles."""
        return PitchCircles(self.centre_distance, self.wheel_teeth / self.pinion_teeth)

    @property
    def centre_distance(self) -> float:
        """Distance of the axes [mm]."""
        return self.pinion.pitch_radius + self.wheel.pitch_radius

    @cached_property
    def zones(self) -> tuple[Zone, Zone]:
        """The zones a and b."""
        pinion, wheel = self.pinion, self.wheel
        return (
            Zone("a", pinion.head, wheel.foot, pinion.tip_angle),
            Zone("b", pinion.foot, wheel.head, wheel.tip_angle),
        )

    @property
    def recess_ratio(self) -> float:
        """Part of the contact ratio after the pitch point."""
        return self._ratio(self.zones[0])

    @property
    def approach_ratio(self) -> float:
        """Part of the contact ratio before the pitch point."""
        return self._ratio(self.zones[1])

    @property
    def contact_ratio(self) -> float:
        """Turn of the pinion during the contact of one tooth over its angular pitch."""
        return self.recess_ratio + self.approach_ratio

    def _ratio(self, zone: Zone) -> float:
        return abs(float(zone.pinion.rolled_length(zone.end))) / (math.pi * self.module)

    @property
    def sign_conditions(self) -> tuple[SignCondition, ...]:
        """The source's conditions (2) to (5), whose index a or b is the zone.

        (5) is printed with the index 2h for the wheel's head, 2b in the count of the others.
        """
        a, b = self.zones
        return (
            SignCondition(2, "rho_1b < 0", b.pinion, b.end),
            SignCondition(3, "rho_1a > 0", a.pinion, a.end),
            SignCondition(4, "rho_2a < 0", a.wheel, a.end),
            SignCondition(5, "rho_2b > 0", b.wheel, b.end),
        )

    def line(self, points: int) -> PathOfContact:
        """Return the path of contact at points that are evenly turned."""
        after, before = (zone.pinion for zone in self.zones)
        last, first = (float(zone.pinion.rolled_length(zone.end)) for zone in self.zones)
        rolled = np.linspace(first, last, points)
        columns = []
        for flank, part in ((before, rolled[rolled < 0.0]), (after, rolled[rolled >= 0.0])):
            alpha = flank.angle_at_rolled_length(part)
            columns.append((flank.path_coordinate(alpha), alpha, flank.turn(alpha)))
        l, alpha, turn = (np.concatenate(parts) for parts in zip(*columns, strict=True))
        return PathOfContact(Contacts(self.circles, l, alpha, turn), rolled / self.pinion.pitch_radius)

    def mesh(self, points: int) -> Mesh:
        """Return the way of a pair of teeth through contact."""
        return mesh_on(self.line(points), self.teeth)
