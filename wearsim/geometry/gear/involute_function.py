"""The involute function, its inverse, and the measurement over pins that follows from it."""

import math

from wearsim.geometry.worn_tooth import measurement_over_pins


def involute_function(angle: float) -> float:
    """Return inv(alpha) = tan(alpha) - alpha.

    Parameters
    ----------
    angle : float
        Pressure angle [rad], 0 to below pi/2.

    Returns
    -------
    float
        The involute function [rad].

    Examples
    --------
    >>> round(involute_function(math.radians(20.0)), 9)
    0.014904384
    """
    return math.tan(angle) - angle


def angle_of_involute(value: float, tolerance: float) -> float:
    """Return the angle whose involute function has a value.

    Parameters
    ----------
    value : float
        Above 0 [rad].
    tolerance : float
        Of the angle [rad].

    Returns
    -------
    float
        Angle [rad], up to 1.5.

    Examples
    --------
    >>> round(math.degrees(angle_of_involute(0.014904383867, 1e-16)), 7)
    20.0
    """
    from scipy.optimize import brentq  # takes 0.1 s, and most cases are not of gears

    return float(brentq(lambda angle: involute_function(angle) - value, 0.0, 1.5, xtol=tolerance))


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
    target = involute_function(a) + (pin_diameter / math.cos(a) - gap) / (module * teeth)
    if not target > 0.0:
        return math.nan
    at = angle_of_involute(target, 1e-15)
    centre = 0.5 * module * teeth * math.cos(a) / math.cos(at)
    return measurement_over_pins(centre, pin_diameter, teeth)
