"""A gear with convex-concave teeth: tip, thickness and the measurement over rollers."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.optimize import brentq

from wearsim.errors import GeometryError
from wearsim.geometry.gear.convex_concave_flank import ConvexConcaveFlank, Part
from wearsim.geometry.profile_points import Vector
from wearsim.geometry.worn_tooth import measurement_over_pins

_TOUCHING = 1e-9
"""Depth [mm] up to which a roller only touches."""


@dataclass(frozen=True)
class MeasuringRoller:
    """A roller in a gap, and what a gauge finds over two of them."""

    diameter: float  # diameter D [mm]
    part: Part  # `head` or `foot`: where it rests
    alpha: float  # pressure angle of the point where it rests [rad]
    centre_radius: float  # distance R_c of its centre from the axis [mm]
    over: float  # measurement M over rollers in the most opposite gaps [mm]


@dataclass(frozen=True)
class ConvexConcaveGear:
    """Pinion or wheel of a convex-concave pair.

    The working flank passes through the pitch point on +y where the tooth is half a pitch thick. A
    thinner tooth has both flanks turned about the axis towards its centre line, which keeps
    them conjugate; the x-shift of the source (XBV in its listing) is right for the rack only.

    Raises
    ------
    GeometryError
        The foot is undercut, the tooth pointed below its tip, or the gap above the foot's end.

    Examples
    --------
    >>> gear = ConvexConcaveGear(17, 4.5, math.radians(20.0), 10.0, 10.0, 4.5)
    >>> round(gear.tip_thickness, 7)
    1.0241877
    >>> round(gear.over_rollers(8.0).over, 6)
    87.609417
    """

    teeth: int  # number z
    module: float  # module m [mm]
    pitch_point_angle: float  # pressure angle alpha_C at the pitch point [rad]
    # head_arc, foot_arc: radii r_k of the arcs of the path of contact that head and foot belong to [mm]
    head_arc: float
    foot_arc: float
    addendum: float  # height of the tip above the pitch circle, and of the flank below it [mm]
    thinning: float = 0.0  # what the tooth is thinner than half the pitch, along the pitch circle [mm]

    def __post_init__(self) -> None:
        if not self.foot_angle < self.foot.last_angle:
            raise GeometryError(
                f"foot of the tooth: z = {self.teeth} is undercut, its foot turns back at a pressure "
                f"angle of {math.degrees(self.foot.last_angle):.4g} deg and must go on to "
                f"{math.degrees(self.foot_angle):.4g} deg: lower the radius of its arc or addendum_ratio"
            )
        for what, width in (
            ("tooth: its thickness at the tip", self.tip_thickness),
            ("gap: its width at the end of the flank", self.foot_gap),
        ):
            if not width > 0.0:
                raise GeometryError(
                    f"{what} must be above 0 mm, is {width:.4g} mm with z = {self.teeth}: lower "
                    "addendum_ratio or pitch_point_angle_deg, or change the radii of the arcs"
                )

    @property
    def pitch_radius(self) -> float:
        """Radius r = m z / 2 of the pitch circle [mm]."""
        return 0.5 * self.module * self.teeth

    @property
    def tip_radius(self) -> float:
        """Radius r_a of the tip circle [mm]."""
        return self.pitch_radius + self.addendum

    @cached_property
    def head(self) -> ConvexConcaveFlank:
        """Flank outside the pitch circle."""
        return ConvexConcaveFlank(self.pitch_radius, self.head_arc, self.pitch_point_angle, "head")

    @cached_property
    def foot(self) -> ConvexConcaveFlank:
        """Flank inside the pitch circle."""
        return ConvexConcaveFlank(self.pitch_radius, self.foot_arc, self.pitch_point_angle, "foot")

    @cached_property
    def tip_angle(self) -> float:
        """Pressure angle at the tip [rad]."""
        return self.head.angle_at_radius(self.tip_radius)

    @cached_property
    def foot_angle(self) -> float:
        """Pressure angle at the end of the foot [rad], which a rack of the same addendum reaches."""
        return self.foot.angle_at_depth(self.addendum)

    def flanks(self) -> tuple[tuple[ConvexConcaveFlank, float], tuple[ConvexConcaveFlank, float]]:
        """Return head and foot, each with the pressure angle at which it ends."""
        return (self.head, self.tip_angle), (self.foot, self.foot_angle)

    @property
    def turn(self) -> float:
        """Angle by which a thinner tooth's flank is turned towards its centre line [rad]."""
        return 0.5 * self.thinning / self.pitch_radius

    @property
    def half_tooth(self) -> float:
        """Angle from the flank at the pitch circle to the centre line of the tooth [rad]."""
        return 0.5 * math.pi / self.teeth - self.turn

    @property
    def half_gap(self) -> float:
        """Angle from the flank at the pitch circle to the centre line of the gap [rad]."""
        return 0.5 * math.pi / self.teeth + self.turn

    @property
    def tip_thickness(self) -> float:
        """Chord of the tip between the two flanks [mm]."""
        x, y = self.head.points(self.tip_angle)
        return 2.0 * self.tip_radius * math.sin(self.half_tooth - math.atan2(x, y))

    @property
    def foot_gap(self) -> float:
        """Chord of the gap between the ends of the feet of two teeth [mm]."""
        return 2.0 * float(self.foot.points(self.foot_angle) @ self._across_gap)

    @property
    def _across_gap(self) -> Vector:
        """Direction across the gap, from its centre line to the flank."""
        return np.array([math.cos(self.half_gap), math.sin(self.half_gap)])

    def seated_diameter(self, flank: ConvexConcaveFlank, alpha: float) -> float:
        """Return the diameter of the roller that rests on a point of the flank in the gap's middle.

        With the gap's centre line under an angle theta to the radius through the flank at the
        pitch circle and P + n D / 2 on it: D = 2 P u / cos(alpha + phi_r + theta),
        u = (cos theta, sin theta).
        """
        u = self._across_gap
        return float(-2.0 * (flank.points(alpha) @ u) / (flank.normals(alpha) @ u))

    def _clear(self, centre: Vector) -> float:
        """Least distance of the flank from a point."""
        points = [flank.points(np.linspace(self.pitch_point_angle, end, 201)) for flank, end in self.flanks()]
        return float(np.hypot(*(np.concatenate(points) - centre).T).min())

    def over_rollers(self, diameter: float) -> MeasuringRoller:
        """Return the measurement over two rollers.

        2 R_c cos(90 deg / z) + D for odd z, 2 R_c + D for even z.
        """
        (head, tip), (foot, end) = self.flanks()
        least, greatest = self.seated_diameter(foot, end), self.seated_diameter(head, tip)
        if not least < greatest:
            raise GeometryError(
                f"roller_diameters_mm: no diameter is possible, rollers need flanks that face the middle of "
                f"the gap up to the tip, but those of z = {self.teeth} turn away from it: raise the number "
                "of teeth or lower addendum_ratio"
            )
        if not least <= diameter <= greatest:
            raise GeometryError(
                f"roller_diameters_mm: must be from {least:.5g} to {greatest:.5g} mm to rest on the flanks "
                f"of z = {self.teeth}, is {diameter:g} mm: take a diameter between"
            )
        c = self.pitch_point_angle
        on_foot = diameter < self.seated_diameter(foot, c)
        flank, last = (foot, end) if on_foot else (head, tip)
        alpha = float(brentq(lambda a: self.seated_diameter(flank, a) - diameter, c, last, xtol=1e-15))
        centre = flank.points(alpha) + 0.5 * diameter * flank.normals(alpha)
        if self._clear(centre) < 0.5 * diameter - _TOUCHING:
            raise GeometryError(
                f"roller_diameters_mm: {diameter:g} mm is larger than the hollow of the feet of "
                f"z = {self.teeth} and must rest in one place: take another diameter or raise the radius "
                "of the arc of the foot"
            )
        radius = math.hypot(*centre)
        over = measurement_over_pins(radius, diameter, self.teeth)
        return MeasuringRoller(diameter, flank.part, alpha, radius, over)
