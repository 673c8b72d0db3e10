"""Sprocket teeth of GOST 591-69, with and without displaced centres of the seat arcs."""

import math
from dataclasses import dataclass
from typing import ClassVar

from wearsim.errors import GeometryError
from wearsim.geometry.forms.concave import ConcaveTooth
from wearsim.geometry.gap import Gap, SeatCentre, seat_height

_TOOTH_HEIGHTS = ((1.50, 0.480), (1.60, 0.532), (1.70, 0.555), (1.80, 0.575), (2.00, 0.565))
"""Upper limit of lambda = t/D, which belongs to its interval, and the factor K there."""
_SMALLEST_RATIO = 1.40


def tooth_height_factor(pitch: float, roller_diameter: float) -> float:
    """Return the factor K of the outside diameter De = t (K + cot(180/z)).

    Parameters
    ----------
    pitch, roller_diameter : float
        t and D [mm]; lambda = t/D, rounded to nine decimals, must lie in (1.40, 2.00].

    Returns
    -------
    float
        K by lambda: 0.480 in (1.40, 1.50], 0.532 in (1.50, 1.60], 0.555 in (1.60, 1.70],
        0.575 in (1.70, 1.80] and 0.565 in (1.80, 2.00].

    Raises
    ------
    GeometryError
        The standard has no value for this chain.

    Examples
    --------
    9.525/6.35 is 1.5, which still belongs to the first interval:

    >>> tooth_height_factor(9.525, 6.35)
    0.48
    """
    ratio = round(pitch / roller_diameter, 9)
    if not _SMALLEST_RATIO < ratio <= _TOOTH_HEIGHTS[-1][0]:
        raise GeometryError(
            f"GOST 591: pitch over roller diameter must lie above 1.40 and not above 2.00, is "
            f"{ratio:g}: the standard has no tooth for this chain, give the tip diameter or use "
            "another standard"
        )
    return next(factor for limit, factor in _TOOTH_HEIGHTS if ratio <= limit)


@dataclass(frozen=True)
class GostTooth(ConcaveTooth):
    """Lengths and angles of a GOST 591 tooth; letters in brackets are the standard's.

    Attributes
    ----------
    pitch, roller_diameter : float
        t and D [mm], above 0.
    teeth : int
        z, six or more.

    Raises
    ------
    GeometryError
        Fewer than six teeth, or a chain that does not exist.

    Examples
    --------
    Chain PR-25.4, 25 teeth, r = 0.5025 * 15.88 + 0.05:

    >>> round(GostTooth(25.4, 15.88, 25).seat_radius, 4)
    8.0297
    """

    seat_allowance: ClassVar[float] = 0.05
    head_ratio: ClassVar[float] = 1.24

    @property
    def outside_diameter(self) -> float:
        """Diameter of the tip circle [mm] (De); the standard rounds it to 0.1 mm.

        Raises ``GeometryError`` where lambda = t/D lies outside (1.40, 2.00].
        """
        factor = tooth_height_factor(self.pitch, self.roller_diameter)
        return self.pitch * (factor + 1.0 / math.tan(math.pi / self.teeth))

    @property
    def root_diameter(self) -> float:
        """Diameter of the circle through the bottoms of the gaps, dd - 2 r [mm] (Di)."""
        return self.pitch_diameter - 2.0 * self.seat_radius

    @property
    def displacement(self) -> float:
        """Distance e = 0.03 t of the two seat centres of a displaced gap [mm]."""
        return 0.03 * self.pitch


def gost591_gap(
    pitch: float,
    roller_diameter: float,
    teeth: int,
    displaced: bool = False,
    seat_centre: SeatCentre = "pitch_circle",
    tip_diameter: float | None = None,
) -> Gap:
    """Return the gap of a GOST 591 sprocket.

    Parameters
    ----------
    pitch, roller_diameter : float
        t and D [mm]; the diameter of the bush where the chain has no roller.
    teeth : int
        z, six or more.
    displaced : bool
        Whether both halves are moved apart by e/2 = 0.015 t each, square to the centre
        line, with a flat bottom of the length e between them. That e is the distance of
        the two centres is a reading of the standard that its drawing has yet to confirm.
    seat_centre : str
        ``"pitch_circle"``, the standard's own: bottom diameter Di = dd - 2 r;
        ``"root_diameter"``: shifted outwards, so that it is dd - D.
    tip_diameter : float, optional
        Diameter of the tip circle [mm]; without it De = t (K + cot(180/z)).

    Returns
    -------
    Gap
        Flat bottom where displaced, seat, working arc, straight part and head.

    Raises
    ------
    GeometryError
        The tooth does not exist, or the standard has no tip diameter for the chain.

    Examples
    --------
    Di = 202.6597 - 2 * 8.0297:

    >>> gap = gost591_gap(25.4, 15.88, 25)
    >>> round(2.0 * gap.bottom_radius, 4)
    186.6003
    """
    tooth = GostTooth(pitch, roller_diameter, teeth)
    height = seat_height(seat_centre, 0.5 * tooth.pitch_diameter, tooth.seat_radius, 0.5 * roller_diameter)
    diameter = tooth.outside_diameter if tip_diameter is None else tip_diameter
    return Gap(
        segments=tooth.segments(height, tooth.displacement if displaced else 0.0),
        teeth=teeth,
        pitch_radius=0.5 * tooth.pitch_diameter,
        roller_radius=0.5 * roller_diameter,
        nominal_tip_radius=0.5 * diameter,
        form="GOST 591, displaced" if displaced else "GOST 591",
    )
