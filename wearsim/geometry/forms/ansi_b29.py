"""Sprocket teeth of ANSI/ASME B29.1, type II, from the standard's constants in inches."""

import math
from dataclasses import dataclass
from typing import ClassVar

from wearsim.geometry.forms.concave import ConcaveTooth
from wearsim.geometry.gap import Gap, SeatCentre, seat_height

INCH = 25.4


@dataclass(frozen=True)
class TypeIITooth(ConcaveTooth):
    """Lengths and angles of a type II tooth; letters in brackets are the standard's.

    Attributes
    ----------
    pitch, roller_diameter : float
        P and Dr [mm], above 0.
    teeth : int
        N, five or more.

    Raises
    ------
    GeometryError
        Fewer than five teeth, or a chain that does not exist.

    Examples
    --------
    ANSI 40, 20 teeth: Ds = 1.005 Dr + 0.003 in:

    >>> tooth = TypeIITooth(12.7, 0.3125 * 25.4, 20)
    >>> round(tooth.seating_diameter / 25.4, 7)
    0.3170625
    """

    seat_allowance: ClassVar[float] = 0.0015 * INCH
    head_ratio: ClassVar[float] = 1.4

    @property
    def seating_diameter(self) -> float:
        """Diameter of the seat arc, 1.005 Dr + 0.003 in [mm] (Ds)."""
        return 2.0 * self.seat_radius

    @property
    def outside_diameter(self) -> float:
        """Diameter of the tip circle for J = 0.3 P, P (0.6 + cot(180/N)) [mm] (OD)."""
        return self.pitch * (0.6 + 1.0 / math.tan(math.pi / self.teeth))

    def root_diameter(self, seat_centre: SeatCentre = "pitch_circle") -> float:
        """Return the diameter of the circle through the bottoms of the gaps."""
        return 2.0 * (self._height(seat_centre) - self.seat_radius)

    def _height(self, seat_centre: SeatCentre) -> float:
        return seat_height(
            seat_centre, 0.5 * self.pitch_diameter, self.seat_radius, 0.5 * self.roller_diameter
        )


def ansi_b29_gap(
    pitch: float,
    roller_diameter: float,
    teeth: int,
    seat_centre: SeatCentre = "pitch_circle",
    tip_diameter: float | None = None,
) -> Gap:
    """Return the gap of a type II sprocket.

    Parameters
    ----------
    pitch, roller_diameter : float
        P and Dr [mm].
    teeth : int
        N, five or more.
    seat_centre : str
        ``"pitch_circle"``: seat centred on the pitch circle, bottom diameter PD - Ds;
        ``"root_diameter"``: shifted outwards by (Ds - Dr)/2, so that it is PD - Dr.
    tip_diameter : float, optional
        Diameter of the tip circle [mm]; without it OD = P (0.6 + cot(180/N)).

    Returns
    -------
    Gap
        Seat, working arc, straight part and head.

    Raises
    ------
    GeometryError
        The tooth does not exist.

    Examples
    --------
    The bottom diameter of ANSI 40 with 17 teeth is PD - Dr = 2.72110 - 0.3125 in:

    >>> gap = ansi_b29_gap(12.7, 0.3125 * 25.4, 17, seat_centre="root_diameter")
    >>> round(2.0 * gap.bottom_radius / 25.4, 4)
    2.4086
    """
    tooth = TypeIITooth(pitch, roller_diameter, teeth)
    diameter = tooth.outside_diameter if tip_diameter is None else tip_diameter
    return Gap(
        segments=tooth.segments(tooth._height(seat_centre)),
        teeth=teeth,
        pitch_radius=0.5 * tooth.pitch_diameter,
        roller_radius=0.5 * roller_diameter,
        nominal_tip_radius=0.5 * diameter,
        form="ANSI B29.1 type II",
    )
