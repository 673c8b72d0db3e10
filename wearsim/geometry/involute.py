"""An involute pair of standard teeth, to hold other teeth against."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from wearsim.geometry.measuring import measurement_over_pins
from wearsim.geometry.profile import Vector


@dataclass(frozen=True)
class InvolutePair:
    """Two involute gears at the centre distance of their pitch circles.

    Attributes
    ----------
    module : float
        Module m [mm].
    teeth, mate_teeth : int
        Numbers of teeth of pinion and wheel.
    pressure_angle : float
        Pressure angle alpha [rad].
    addendum : float
        Height of the tips above the pitch circles [mm].

    Examples
    --------
    >>> pair = InvolutePair(4.5, 17, 34, math.radians(20.0), 4.5)
    >>> round(pair.contact_ratio, 10)
    1.597684835
    """

    module: float
    teeth: int
    mate_teeth: int
    pressure_angle: float
    addendum: float

    @property
    def recess(self) -> float:
        """Length of the path after the pole [mm], to the pinion's tip or the wheel's base circle."""
        return self._beyond_pole(self.teeth, self.mate_teeth)

    @property
    def approach(self) -> float:
        """Length of the path before the pole [mm], to the wheel's tip or the pinion's base circle."""
        return self._beyond_pole(self.mate_teeth, self.teeth)

    @property
    def contact_ratio(self) -> float:
        """Length of the path over the base pitch."""
        base_pitch = math.pi * self.module * math.cos(self.pressure_angle)
        return (self.recess + self.approach) / base_pitch

    def reduced_radius(self, path: ArrayLike) -> Vector:
        """Return the reduced radius of curvature along the path of contact.

        (r1 sin alpha + l) (r2 sin alpha - l) / ((r1 + r2) sin alpha).

        Parameters
        ----------
        path : array_like
            Distance l from the pole [mm], positive after it.

        Returns
        -------
        numpy.ndarray
            Radius [mm].
        """
        l, sin = np.asarray(path, dtype=float), math.sin(self.pressure_angle)
        r1, r2 = 0.5 * self.module * self.teeth, 0.5 * self.module * self.mate_teeth
        return (r1 * sin + l) * (r2 * sin - l) / ((r1 + r2) * sin)

    def _beyond_pole(self, teeth: int, mate_teeth: int) -> float:
        r, mate = 0.5 * self.module * teeth, 0.5 * self.module * mate_teeth
        base, sin = r * math.cos(self.pressure_angle), math.sin(self.pressure_angle)
        return min(math.sqrt((r + self.addendum) ** 2 - base**2) - r * sin, mate * sin)


def involute_over_pins(
    module: float, teeth: int, pressure_angle: float, pin_diameter: float, backlash: float = 0.0
) -> float:
    """Return the measurement over pins of an involute gear without profile shift.

    inv alpha_M = inv alpha + D / (m z cos alpha) - (pi m / 2 - j) / (m z), with the centre of
    the pin at r cos alpha / cos alpha_M.

    Parameters
    ----------
    module : float
        Module m [mm].
    teeth : int
        Number z.
    pressure_angle : float
        Pressure angle alpha [rad].
    pin_diameter : float
        Diameter D of the pins [mm].
    backlash : float
        What the teeth are thinner than half the pitch, along the pitch circle [mm].

    Returns
    -------
    float
        Measurement M [mm]; nan where the pin touches no involute.

    Examples
    --------
    >>> round(involute_over_pins(4.5, 17, math.radians(20.0), 8.0), 7)
    87.6143981
    """
    a = pressure_angle
    gap = 0.5 * math.pi * module + backlash
    target = math.tan(a) - a + (pin_diameter / math.cos(a) - gap) / (module * teeth)
    if not target > 0.0:
        return math.nan
    at = float(brentq(lambda t: math.tan(t) - t - target, 0.0, 1.5, xtol=1e-15))
    centre = 0.5 * module * teeth * math.cos(a) / math.cos(at)
    return measurement_over_pins(centre, pin_diameter, teeth)
