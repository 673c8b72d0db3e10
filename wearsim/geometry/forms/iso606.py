"""Sprocket teeth of ISO 606 (DIN 8196-1, GB/T 1243, BS 228, JIS B 1801): convex flanks.

The standard covers 9 to 150 teeth; the construction also exists outside that range.
"""

import math
from dataclasses import dataclass
from functools import partial
from typing import Literal

from wearsim.errors import GeometryError
from wearsim.geometry.gap import Gap, SeatCentre, head_arc, pitch_diameter, seat_height
from wearsim.geometry.segments import ArcSegment


@dataclass(frozen=True)
class GapForm:
    """The three numbers that make a gap of ISO 606."""

    flank_radius: float  # re of the convex flank [mm]
    seat_radius: float  # ri of the seat [mm], above d1/2
    seating_angle: float  # alpha [rad]


def re_small(roller_diameter: float, teeth: int) -> float:
    """Return the smaller of the two flank radii, 0.12 d1 (z + 2).

    Sources swap the words minimum and maximum for the two radii; it is the smaller one
    for every z, as 0.008 (z^2 + 180) > 0.12 (z + 2) has no real root.

    Parameters
    ----------
    roller_diameter : float
        Diameter d1 [mm].
    teeth : int
        Number z.

    Returns
    -------
    float
        Radius [mm].

    Examples
    --------
    >>> round(re_small(10.0, 18), 12)
    24.0
    """
    return 0.12 * roller_diameter * (teeth + 2)


def re_large(roller_diameter: float, teeth: int) -> float:
    """Return the larger of the two flank radii, 0.008 d1 (z^2 + 180).

    Parameters
    ----------
    roller_diameter : float
        Diameter d1 [mm].
    teeth : int
        Number z.

    Returns
    -------
    float
        Radius [mm].

    Examples
    --------
    >>> round(re_large(10.0, 20), 12)
    46.4
    """
    return 0.008 * roller_diameter * (teeth**2 + 180)


def gap_form(name: Literal["min", "max"], roller_diameter: float, teeth: int) -> GapForm:
    """Return the gap with the least or the most room for the roller.

    Parameters
    ----------
    name : str
        ``"min"``: re 0.12 d1 (z + 2), ri 0.505 d1, alpha 140 - 90/z deg; ``"max"``:
        re 0.008 d1 (z^2 + 180), ri 0.505 d1 + 0.069 cbrt(d1), alpha 120 - 90/z deg.
    roller_diameter : float
        Diameter d1 [mm].
    teeth : int
        Number z.

    Returns
    -------
    GapForm
        Flank radius, seat radius and seating angle.

    Raises
    ------
    GeometryError
        Neither of the two names, or a roller that does not exist.

    Examples
    --------
    >>> form = gap_form("max", 8.0, 18)
    >>> round(form.seat_radius, 6), round(math.degrees(form.seating_angle), 6)
    (4.178, 115.0)
    """
    if not roller_diameter > 0.0:
        raise GeometryError(
            f"roller: its diameter must be above 0, is {roller_diameter:g} mm: give the "
            "diameter of the chain's roller or bush"
        )
    if name == "min":
        return GapForm(
            re_small(roller_diameter, teeth), 0.505 * roller_diameter, math.radians(140.0 - 90.0 / teeth)
        )
    if name == "max":
        return GapForm(
            re_large(roller_diameter, teeth),
            0.505 * roller_diameter + 0.069 * math.cbrt(roller_diameter),
            math.radians(120.0 - 90.0 / teeth),
        )
    raise GeometryError(f"ISO 606 form: must be 'min' or 'max', got {name!r}: give one of the two")


def root_diameter(pitch: float, roller_diameter: float, teeth: int) -> float:
    """Return the diameter of the circle through the bottoms of the gaps, df = d - d1.

    Parameters
    ----------
    pitch, roller_diameter : float
        p and d1 [mm].
    teeth : int
        Number z.

    Returns
    -------
    float
        Diameter [mm].

    Examples
    --------
    >>> round(root_diameter(10.0, 6.0, 6), 12)
    14.0
    """
    return pitch_diameter(pitch, teeth) - roller_diameter


def tip_diameter_limits(pitch: float, roller_diameter: float, teeth: int) -> tuple[float, float]:
    """Return the smallest and the largest tip diameter.

    Parameters
    ----------
    pitch, roller_diameter : float
        p and d1 [mm].
    teeth : int
        Number z.

    Returns
    -------
    tuple of float
        d + p (1 - 1.6/z) - d1 and d + 1.25 p - d1 [mm]. The teeth of the maximum form
        are pointed below the second one.

    Examples
    --------
    >>> low, high = tip_diameter_limits(10.0, 6.0, 16)
    >>> round(high - low, 12)  # 1.25 p - 0.9 p
    3.5
    """
    root = root_diameter(pitch, roller_diameter, teeth)
    return root + pitch * (1.0 - 1.6 / teeth), root + 1.25 * pitch


def iso606_gap(
    pitch: float,
    roller_diameter: float,
    teeth: int,
    form: Literal["min", "max"] | GapForm = "min",
    seat_centre: SeatCentre = "pitch_circle",
    tip_diameter: float | None = None,
) -> Gap:
    """Return the gap of an ISO 606 sprocket.

    Parameters
    ----------
    pitch, roller_diameter : float
        p and d1 [mm].
    teeth : int
        Number z.
    form : str or GapForm
        ``"min"`` or ``"max"``, or any gap in between.
    seat_centre : str
        ``"pitch_circle"``: seat centred on the pitch circle, bottom diameter d - 2 ri;
        ``"root_diameter"``: shifted outwards by ri - d1/2, so that it is df = d - d1.
    tip_diameter : float, optional
        Diameter of the tip circle [mm]. Without it halfway between da_min and what limits
        it above, da_max or the diameter at which the tooth is pointed.

    Returns
    -------
    Gap
        Seat and flank; cut off where the tooth is pointed below the tip circle.

    Raises
    ------
    GeometryError
        The tooth does not exist.

    Examples
    --------
    The bottom diameter is d - d1 = 24 - 6 mm:

    >>> gap = iso606_gap(12.0, 6.0, 6, form="max", seat_centre="root_diameter")
    >>> round(2.0 * gap.bottom_radius, 12)
    18.0
    """
    pitch_radius = 0.5 * pitch_diameter(pitch, teeth)
    chosen = form if isinstance(form, GapForm) else gap_form(form, roller_diameter, teeth)
    r, flank_radius = chosen.seat_radius, chosen.flank_radius
    theta = 0.5 * chosen.seating_angle
    height = seat_height(seat_centre, pitch_radius, r, 0.5 * roller_diameter)
    apart = r + flank_radius
    flank_centre = (apart * math.sin(theta), height - apart * math.cos(theta))
    segments = (
        ArcSegment((0.0, height), r, -0.5 * math.pi, -0.5 * math.pi + theta),
        head_arc(flank_centre, flank_radius, theta),
    )
    name = "ISO 606" if isinstance(form, GapForm) else f"ISO 606 {form} form"
    build = partial(Gap, segments, teeth, pitch_radius, 0.5 * roller_diameter, form=name)
    if tip_diameter is not None:
        return build(nominal_tip_radius=0.5 * tip_diameter)
    low, high = tip_diameter_limits(pitch, roller_diameter, teeth)
    highest = build(nominal_tip_radius=0.5 * high)
    return build(nominal_tip_radius=0.5 * (0.5 * low + highest.tip_radius))
