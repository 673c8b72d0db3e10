"""The gap between two standard teeth: exact arcs and lines first, points from them.

The sprocket's centre is the origin and the gap's centre line is +y; only the right half
is stored, its mirror image is the left one. Every point of it belongs to the angle theta
from the inward radius to the roller's contact there; it is also the direction of travel
from bottom to tip.
"""

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from wearsim.errors import GeometryError
from wearsim.geometry.profile_points import Profile, Vector
from wearsim.geometry.segments import ArcSegment, Point, Segment, points_along

SeatCentre = Literal["pitch_circle", "root_diameter"]


def pitch_diameter(pitch: float, teeth: int) -> float:
    """Return the diameter of the circle through the roller centres, d = p / sin(180/z).

    Equation physics.md (W1).

    Parameters
    ----------
    pitch : float
        p [mm], above 0.
    teeth : int
        z, three or more.

    Returns
    -------
    float
        d [mm].

    Raises
    ------
    GeometryError
        Pitch or number of teeth out of range.

    Examples
    --------
    Six links of the pitch 1 form a hexagon of radius 1:

    >>> round(pitch_diameter(1.0, 6), 12)
    2.0
    """
    if not (pitch > 0.0 and teeth >= 3):
        raise GeometryError(
            f"sprocket: needs a pitch above 0 and three or more teeth, got {pitch:g} mm and "
            f"{teeth}: give a pitch and a number of teeth that exist"
        )
    return pitch / math.sin(math.pi / teeth)


def seat_height(
    seat_centre: SeatCentre, pitch_radius: float, seat_radius: float, roller_radius: float
) -> float:
    """Return the distance of the seat arc's centre from the sprocket's centre.

    Parameters
    ----------
    seat_centre : str
        ``"pitch_circle"``: on the pitch circle, the bottom is d/2 - r.
        ``"root_diameter"``: shifted outwards by r - d1/2, the bottom is d/2 - d1/2.
    pitch_radius, seat_radius, roller_radius : float
        d/2, r and d1/2 [mm].

    Returns
    -------
    float
        Distance [mm].

    Raises
    ------
    GeometryError
        Neither of the two conventions, or a seat that does not take the roller.

    Examples
    --------
    >>> seat_height("root_diameter", 30.0, 4.5, 4.25)
    30.25
    """
    if not seat_radius > roller_radius > 0.0:
        raise GeometryError(
            f"seat: its radius must exceed the roller's, got {seat_radius:g} and "
            f"{roller_radius:g} mm: give a smaller roller or a wider seat"
        )
    if seat_centre == "pitch_circle":
        return pitch_radius
    if seat_centre == "root_diameter":
        return pitch_radius + (seat_radius - roller_radius)
    raise GeometryError(
        f"seat centre: must be 'pitch_circle' or 'root_diameter', got {seat_centre!r}: give one of the two"
    )


def head_arc(centre: Point, radius: float, theta: float) -> ArcSegment:
    """Return a convex arc from where its normal has the angle theta up to its top.

    Parameters
    ----------
    centre : tuple of float
        Coordinates of the centre, in the tooth on the gap's right [mm].
    radius : float
        Radius [mm], above 0.
    theta : float
        Direction of travel at the start [rad].

    Returns
    -------
    Arc
        Ends at its greatest distance from the origin.

    Raises
    ------
    GeometryError
        The radius is not positive.

    Examples
    --------
    >>> round(math.degrees(head_arc((3.0, 3.0), 1.0, 0.5).last), 12)
    45.0
    """
    if not radius > 0.0:
        raise GeometryError(
            f"tooth head: its radius must be above 0, is {radius:g} mm: use more teeth, or "
            "check pitch and roller diameter"
        )
    return ArcSegment(centre, radius, 0.5 * math.pi + theta, math.atan2(centre[1], centre[0]))


@dataclass(frozen=True)
class Gap:
    """The gap between two teeth, cut off at the tip circle or where the tooth is pointed.

    Raises
    ------
    GeometryError
        No tooth between two seats, or a tip circle below the seat's end or above the
        tooth's top.
    """

    # right half of the outline from the bottom on the centre line to the tip. Given up to the top of the last
    # one; what lies beyond the tip is cut off.
    segments: tuple[Segment, ...]
    teeth: int  # z of the sprocket
    # pitch_radius, roller_radius: d/2 and d1/2 [mm]
    pitch_radius: float
    roller_radius: float
    nominal_tip_radius: float  # radius of the tip circle that is asked for [mm]
    form: str  # name of the standard and of its form
    # radius at which the two flanks of a tooth meet [mm]; infinite where they do not, because the tooth has a
    # rounded top
    pointed_radius: float = field(init=False)

    def __post_init__(self) -> None:
        kept, pointed = self._up_to(
            [segment.length_to_ray(math.pi / self.teeth) for segment in self.segments]
        )
        pointed_radius = math.hypot(*pointed) if pointed else math.inf
        object.__setattr__(self, "pointed_radius", pointed_radius)
        if not self.truncated:
            kept, tip = self._up_to(
                [segment.length_to_circle(self.nominal_tip_radius) for segment in self.segments]
            )
            if not tip:
                raise GeometryError(
                    f"{self.form}, z = {self.teeth}: the tip diameter must lie between the "
                    f"bottom {2.0 * self.bottom_radius:g} and the tooth's top "
                    f"{2.0 * math.hypot(*self.segments[-1].end):g} mm, is "
                    f"{2.0 * self.nominal_tip_radius:g} mm: give one in between"
                )
        seat = next(n for n, part in enumerate(self.segments) if isinstance(part, ArcSegment))
        if len(kept) <= seat + 1:
            raise GeometryError(
                f"{self.form}, z = {self.teeth}: no flank is left above the seat: use more "
                "teeth or a larger tip diameter, or check pitch and roller diameter"
            )
        object.__setattr__(self, "segments", kept)

    def _up_to(self, ways: list[float]) -> tuple[tuple[Segment, ...], Point | None]:
        """Segments up to the first crossing, and the point of it (None: no crossing)."""
        for number, way in enumerate(ways):
            if way < math.inf:
                last = self.segments[number].shortened(way)
                return (*self.segments[:number], last), last.end
        return self.segments, None

    @property
    def truncated(self) -> bool:
        """Whether the tooth is pointed below the tip circle that is asked for."""
        return self.pointed_radius < self.nominal_tip_radius

    @property
    def seat_centre(self) -> float:
        """Distance of the seat arc's centre from the sprocket's axis along +y [mm]."""
        return next(part.centre[1] for part in self.segments if isinstance(part, ArcSegment))

    @property
    def bottom_radius(self) -> float:
        """Distance of the bottom from the sprocket's centre [mm]."""
        return self.segments[0].start[1]

    @property
    def tip_radius(self) -> float:
        """Radius at which the outline ends: the tip circle's or the pointed one [mm]."""
        return min(self.nominal_tip_radius, self.pointed_radius)

    @property
    def tip_land(self) -> float:
        """Length of the tip circle's arc over a tooth [mm], 0 where it is pointed."""
        if self.truncated:
            return 0.0
        x, y = self.segments[-1].end
        return 2.0 * self.tip_radius * (math.pi / self.teeth - math.atan2(x, y))

    @cached_property
    def half_length(self) -> float:
        """Length of the outline from bottom to tip [mm]."""
        return math.fsum(segment.length for segment in self.segments)

    def pressure_angle(self, theta: ArrayLike) -> Vector:
        """Return the pressure angle phi = 90 deg - theta - 180 deg/z.

        Equation physics.md (W2).

        Parameters
        ----------
        theta : array_like
            Angle of the contact from the inward radius [rad]; the direction of travel
            along the segments.

        Returns
        -------
        numpy.ndarray
            Angle between the link of an unstretched chain and the contact's normal [rad].
        """
        return 0.5 * math.pi - np.asarray(theta, dtype=float) - math.pi / self.teeth

    def outline(self, nodes: int) -> Profile:
        """Return the whole gap, from the tip on its right through the bottom to the other tip."""
        way = self.half_length * np.linspace(1.0, -1.0, nodes)[: nodes // 2]
        x, y = points_along(self.segments, way).T
        bottom = nodes % 2
        return Profile(
            np.concatenate([x, np.zeros(bottom), -x[::-1]]),
            np.concatenate([y, np.full(bottom, self.bottom_radius), y[::-1]]),
        )

    def roller_path(self) -> tuple[Segment, ...]:
        """Return where the centre of a roller is that touches the right half."""
        return tuple(segment.offset(self.roller_radius) for segment in self.segments)
