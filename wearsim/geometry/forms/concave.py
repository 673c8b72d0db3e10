"""The tooth with a concave working flank that ANSI B29.1 type II and GOST 591 share."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from wearsim.errors import GeometryError
from wearsim.geometry.gap import head_arc, pitch_diameter
from wearsim.geometry.segments import ArcSegment, LineSegment, Point, Segment


@dataclass(frozen=True)
class ConcaveTooth:
    """Seat arc, concave working arc, straight part and convex head, each tangent to the next.

    The two standards differ in two numbers, given by the class of each. Coordinates are
    those of the right half of the gap, from the seat's centre, y outwards.

    Raises
    ------
    GeometryError
        Working arc and head overlap.
    """

    # pitch, roller_diameter: p and d1 [mm], above 0
    pitch: float
    roller_diameter: float
    teeth: int  # z; below 5 (ANSI) or 6 (GOST) the straight part has no length

    seat_allowance: ClassVar[float]
    """Part of the seat radius that does not depend on the roller [mm]."""
    head_ratio: ClassVar[float]
    """Distance of the head's centre from the seat's in roller diameters."""

    def __post_init__(self) -> None:
        if not self.roller_diameter > 0.0:
            raise GeometryError(
                f"roller: its diameter must be above 0, is {self.roller_diameter:g} mm: give the "
                "diameter of the chain's roller or bush"
            )
        if not (self.pitch_diameter > 0.0 and self.straight_length > 0.0):
            raise GeometryError(
                f"tooth flank, z = {self.teeth}: working arc and head overlap, the straight part "
                f"between them would be {self.straight_length:g} mm long: use more teeth"
            )

    @cached_property
    def pitch_diameter(self) -> float:
        """Diameter of the circle through the roller centres [mm] (ANSI PD, GOST dd)."""
        return pitch_diameter(self.pitch, self.teeth)

    @property
    def seat_half_angle(self) -> float:
        """Angle of the seat arc from the centre line, 55 - 60/z deg [rad] (ANSI 90 - A)."""
        return math.radians(55.0 - 60.0 / self.teeth)

    @property
    def working_angle(self) -> float:
        """Angle of the working arc, 18 - 56/z deg [rad] (ANSI B, GOST beta)."""
        return math.radians(18.0 - 56.0 / self.teeth)

    @property
    def half_tooth_angle(self) -> float:
        """Angle of the straight part to the tooth's centre line, 17 - 64/z deg [rad]."""
        return math.radians(17.0 - 64.0 / self.teeth)

    @property
    def seat_radius(self) -> float:
        """Radius of the seat arc, 0.5025 d1 + allowance [mm] (ANSI R, GOST r)."""
        return 0.5025 * self.roller_diameter + self.seat_allowance

    @property
    def working_radius(self) -> float:
        """Radius of the concave working arc, 1.3025 d1 + allowance [mm] (ANSI E, GOST r1)."""
        return 1.3025 * self.roller_diameter + self.seat_allowance

    @property
    def working_centre(self) -> Point:
        """Centre of the working arc [mm] (ANSI (-M, T), GOST (-x1, y1))."""
        offset = 0.8 * self.roller_diameter
        return -offset * math.sin(self.seat_half_angle), offset * math.cos(self.seat_half_angle)

    @property
    def straight_length(self) -> float:
        """Length of the straight part [mm] (ANSI yz, GOST FC)."""
        return self.roller_diameter * (
            self.head_ratio * math.sin(self.half_tooth_angle) - 0.8 * math.sin(self.working_angle)
        )

    @property
    def head_centre(self) -> Point:
        """Centre of the head [mm] (ANSI (W, -V), GOST (x2, -y2))."""
        offset = self.head_ratio * self.roller_diameter
        half_pitch = math.pi / self.teeth
        return offset * math.cos(half_pitch), -offset * math.sin(half_pitch)

    @property
    def head_radius(self) -> float:
        """Radius of the convex head [mm] (ANSI F, GOST r2)."""
        return (
            self.roller_diameter
            * (
                self.head_ratio * math.cos(self.half_tooth_angle)
                + 0.8 * math.cos(self.working_angle)
                - 1.3025
            )
            - self.seat_allowance
        )

    def segments(self, seat_height: float, bottom_width: float = 0.0) -> tuple[Segment, ...]:
        """Return the right half of the gap from the bottom to the top of the head."""
        aside = 0.5 * bottom_width
        seat_end = self.seat_half_angle
        working_end = seat_end + self.working_angle
        seat = (aside, seat_height)
        centre = (aside + self.working_centre[0], seat_height + self.working_centre[1])
        head = (aside + self.head_centre[0], seat_height + self.head_centre[1])
        down = -0.5 * math.pi
        working = ArcSegment(centre, self.working_radius, down + seat_end, down + working_end)
        flank = (
            ArcSegment(seat, self.seat_radius, down, down + seat_end),
            working,
            LineSegment(working.end, working_end, self.straight_length),
            head_arc(head, self.head_radius, working_end),
        )
        bottom = LineSegment((0.0, seat_height - self.seat_radius), 0.0, aside)
        return (bottom, *flank) if aside > 0.0 else flank
