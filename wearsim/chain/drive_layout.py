"""Two sprockets and a closed chain: centre distance, wrap, speed, who meets whom."""

import math
from dataclasses import dataclass

from wearsim.chain.chain_length import STRETCH, belt_centre, belt_links, even_links, polygon_swing
from wearsim.errors import GeometryError
from wearsim.geometry.gap import pitch_diameter


def polygon_effect(teeth: int) -> float:
    """Return the fluctuation of the chain's speed over a tooth, 1 - cos(pi/z).

    Parameters
    ----------
    teeth : int
        Number of gaps of the driving sprocket.

    Returns
    -------
    float
        (v_max - v_min)/v_max of a long straight span.

    Examples
    --------
    >>> round(100 * polygon_effect(6), 4)  # 1 - cos(30 deg)
    13.3975
    """
    return 1.0 - math.cos(math.pi / teeth)


@dataclass(frozen=True)
class ToothMeetings:
    """Which tooth meets which roller.

    With g = gcd(z, X) the teeth fall into g classes that never share a roller: a tooth meets
    X/g of the X rollers, a roller z/g of the z teeth, and all repeats after X/g revolutions of
    the sprocket (lcm(z, X) engagements). With g = 1 the drive hunts: every tooth meets every
    roller and both wear evenly. With g even a tooth meets the same kind of link, inner or outer,
    for life.

    Examples
    --------
    >>> meetings = ToothMeetings(teeth=20, links=114)
    >>> meetings.classes, meetings.rollers_per_tooth
    (2, 57)
    """

    # teeth, links: z and X
    teeth: int
    links: int

    @property
    def classes(self) -> int:
        """Classes of teeth that never share a roller, g = gcd(z, X)."""
        return math.gcd(self.teeth, self.links)

    @property
    def rollers_per_tooth(self) -> int:
        """Different rollers that a tooth meets, X/g; also the revolutions until all repeats."""
        return self.links // self.classes

    @property
    def hunts(self) -> bool:
        """Whether every tooth meets every roller."""
        return self.classes == 1

    @property
    def same_link_kind(self) -> bool:
        """Whether a tooth meets only inner or only outer links."""
        return self.classes % 2 == 0


@dataclass(frozen=True)
class DriveLayout:
    """Two sprockets at a centre distance with a closed chain of so many links.

    Raises
    ------
    GeometryError
        A number is out of its range, the sprockets overlap or the chain is too short.

    Examples
    --------
    >>> layout = layout_with_links(pitch=10.0, teeth_1=20, teeth_2=20, links=80)
    >>> layout.centre_distance, layout.span, layout.engaged_1
    (300.0, 300.0, 10.0)
    """

    pitch: float  # chain pitch [mm], above 0
    # teeth_1, teeth_2: gaps of the driving and the driven sprocket, at least 5 each
    teeth_1: int
    teeth_2: int
    links: int  # links X of the chain
    # a [mm]; the tip circles, taken with the diameters p (0.6 + cot(pi/z)) of ANSI B29.1, must not overlap,
    # and the chain must reach. It may be less than that of the taut chain.
    centre_distance: float

    def __post_init__(self) -> None:
        _refuse_sprockets(self.pitch, self.teeth_1, self.teeth_2, self.centre_distance)
        needed = belt_links(self.teeth_1, self.teeth_2, self.centre_distance / self.pitch)
        if not self.links * (1.0 + STRETCH) >= needed:
            raise GeometryError(
                f"drive layout: a centre distance of {self.centre_distance:.6g} mm needs {needed:.7g} "
                f"links, has {self.links}: use {even_links(needed)}"
            )

    @property
    def all_teeth(self) -> tuple[int, ...]:
        """Teeth of both sprockets."""
        return self.teeth_1, self.teeth_2

    @property
    def rated_teeth(self) -> tuple[int, ...]:
        """Teeth of the sprockets by which a chain is rated."""
        return self.all_teeth

    @property
    def ratio(self) -> float:
        """Speed of sprocket 1 over that of sprocket 2, z2/z1."""
        return self.teeth_2 / self.teeth_1

    @property
    def needs_offset_link(self) -> bool:
        """Whether the number of links is odd, so that one link must be an offset (cranked) one."""
        return self.links % 2 == 1

    @property
    def pitch_diameter_1(self) -> float:
        """Pitch diameter of sprocket 1 [mm]."""
        return pitch_diameter(self.pitch, self.teeth_1)

    @property
    def pitch_diameter_2(self) -> float:
        """Pitch diameter of sprocket 2 [mm]."""
        return pitch_diameter(self.pitch, self.teeth_2)

    @property
    def polygon_swing(self) -> float:
        """Variation of the centre distance of the taut chain to both sides as a tooth passes [mm]."""
        return self.pitch * polygon_swing(self.teeth_1, self.teeth_2, self.links)

    @property
    def inclination(self) -> float:
        """Angle of a span to the line of centres, asin((d2 - d1)/(2 a)) [rad]."""
        half = 0.5 * (self.pitch_diameter_2 - self.pitch_diameter_1)
        return math.asin(half / self.centre_distance)

    @property
    def wrap_angle_1(self) -> float:
        """Wrap angle of sprocket 1, pi - 2 asin((d2 - d1)/(2 a)) [rad]."""
        return math.pi - 2.0 * self.inclination

    @property
    def wrap_angle_2(self) -> float:
        """Wrap angle of sprocket 2, pi + 2 asin((d2 - d1)/(2 a)) [rad]."""
        return math.pi + 2.0 * self.inclination

    @property
    def engaged_1(self) -> float:
        """Pitches on sprocket 1, wrap_1 z1/(2 pi)."""
        return self.wrap_angle_1 * self.teeth_1 / (2.0 * math.pi)

    @property
    def engaged_2(self) -> float:
        """Pitches on sprocket 2, wrap_2 z2/(2 pi)."""
        return self.wrap_angle_2 * self.teeth_2 / (2.0 * math.pi)

    @property
    def span(self) -> float:
        """Length of a straight span between the pitch circles, a cos(inclination) [mm]."""
        return self.centre_distance * math.cos(self.inclination)

    def chain_speed(self, angular_speed: float) -> float:
        """Return the mean speed of the chain, v = z1 p omega/(2 pi)."""
        return self.teeth_1 * self.pitch * angular_speed / (2.0 * math.pi)


def layout_with_links(pitch: float, teeth_1: int, teeth_2: int, links: int) -> DriveLayout:
    """Return the layout of a chain of given links, centre distance by `belt_centre`.

    Examples
    --------
    >>> round(layout_with_links(25.4, 27, 51, 100).centre_distance, 2)
    768.57
    """
    _refuse_numbers(pitch, teeth_1, teeth_2)
    centre = pitch * belt_centre(teeth_1, teeth_2, links)
    least = least_centre(pitch, teeth_1, teeth_2)
    if centre < least:
        needed = 2 * math.ceil(0.5 * belt_links(teeth_1, teeth_2, least / pitch))
        raise GeometryError(
            f"drive layout: the sprockets must not overlap, but {links} links give a centre "
            f"distance of {centre:.6g} mm of the {least:.6g} mm needed: use {needed} links or more"
        )
    return DriveLayout(pitch, teeth_1, teeth_2, links, centre)


def layout_with_centre(pitch: float, teeth_1: int, teeth_2: int, centre_distance: float) -> DriveLayout:
    """Return the layout nearest above a wished centre distance that has an even number of links.

    A wish within `STRETCH` of the chain above that of a taut one counts as met by it.

    Examples
    --------
    >>> layout = layout_with_centre(44.45, 17, 34, 25 * 44.45)
    >>> layout.links, round(layout.centre_distance / 44.45, 4)
    (76, 25.1041)
    """
    _refuse_sprockets(pitch, teeth_1, teeth_2, centre_distance)
    links = even_links(belt_links(teeth_1, teeth_2, centre_distance / pitch))
    if pitch * belt_centre(teeth_1, teeth_2, links) < least_centre(pitch, teeth_1, teeth_2):
        links += 2  # what stretch would take up is the room between the tips
    return layout_with_links(pitch, teeth_1, teeth_2, links)


def least_centre(pitch: float, teeth_1: int, teeth_2: int) -> float:
    """Return the centre distance at which the tip circles of ANSI B29.1 touch [mm].

    Examples
    --------
    >>> least_centre(10.0, 4, 4)  # p (0.6 + cot(45 deg))
    16.0
    """
    tips = sum(0.6 + 1.0 / math.tan(math.pi / teeth) for teeth in (teeth_1, teeth_2))
    return 0.5 * pitch * tips


def _refuse_numbers(pitch: float, teeth_1: int, teeth_2: int) -> None:
    if not pitch > 0.0:
        raise GeometryError(f"drive layout: the pitch must be above 0, is {pitch:g} mm: give the chain's")
    if min(teeth_1, teeth_2) < 5:
        raise GeometryError(
            f"drive layout: both sprockets need at least 5 teeth, have {teeth_1} and {teeth_2}: use more"
        )


def _refuse_sprockets(pitch: float, teeth_1: int, teeth_2: int, centre_distance: float) -> None:
    _refuse_numbers(pitch, teeth_1, teeth_2)
    least = least_centre(pitch, teeth_1, teeth_2)
    if not centre_distance >= least:
        raise GeometryError(
            "drive layout: the sprockets must not overlap, the centre distance is "
            f"{centre_distance:.6g} mm: use at least {math.ceil(1e3 * least) / 1e3:.10g} mm"
        )
