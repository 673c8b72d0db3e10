"""What a gap's outline, new or worn, leaves of the teeth on both sides of it."""

import math

import numpy as np

from wearsim.geometry.profile_points import Vector


def tooth_thickness(x: Vector, y: Vector, teeth: int, radius: float) -> float:
    """Return the chordal thickness of a tooth between two gaps alike, on a circle.

    Examples
    --------
    A gap with straight sides at +-1 mm takes 90 degrees of the circle of radius sqrt(2) mm.
    Of the 180 degrees to the next of two gaps a tooth of 90 remains, with a chord of 2 mm;
    of the 90 to the next of four gaps nothing remains.

    >>> import numpy as np
    >>> x, y = np.array([1.0, 1.0, 1.0, -1.0, -1.0]), np.array([3.0, 1.0, 0.5, 1.0, 3.0])
    >>> [abs(round(tooth_thickness(x, y, z, math.sqrt(2.0)), 12)) for z in (2, 4)]
    [2.0, 0.0]
    """
    distance, angle = np.hypot(x, y), np.arctan2(x, y)
    bottom = int(distance.argmin())
    radius = min(max(radius, float(distance[bottom])), float(min(distance[0], distance[-1])))
    right = np.interp(radius, distance[: bottom + 1][::-1], angle[: bottom + 1][::-1])
    left = np.interp(radius, distance[bottom:], angle[bottom:])
    return float(2.0 * radius * math.sin(math.pi / teeth - 0.5 * float(right - left)))


def tip_land(x: Vector, y: Vector, teeth: int) -> float:
    """Return the length of the tip between two gaps alike.

    Examples
    --------
    >>> import numpy as np
    >>> x, y = np.array([1.0, 0.0, -1.0]), np.array([1.0, 0.5, 1.0])
    >>> round(tip_land(x, y, 3) / math.sqrt(2.0), 12) == round(math.pi / 6.0, 12)
    True
    """
    radius = max(math.hypot(x[0], y[0]), math.hypot(x[-1], y[-1]))
    gap = math.atan2(x[0], y[0]) - math.atan2(x[-1], y[-1])
    return radius * (2.0 * math.pi / teeth - gap)


def measurement_over_pins(centre_radius: float, pin_diameter: float, teeth: int) -> float:
    """Return the measurement over pins M_R of a sprocket.

    Parameters
    ----------
    centre_radius : float
        Distance rc of the seated pins' centres from the sprocket's [mm]; d/2 for a new
        sprocket whose root diameter is d - d1.
    pin_diameter : float
        Diameter dR of the measuring pins [mm].
    teeth : int
        Number z.

    Returns
    -------
    float
        2 rc + dR for even z, 2 rc cos(90/z) + dR for odd z [mm].

    Examples
    --------
    Three pins of diameter 1 on a circle of radius 1: sqrt(3) + 1:

    >>> round(measurement_over_pins(1.0, 1.0, 3), 4)
    2.7321
    """
    across = math.cos(0.5 * math.pi / teeth) if teeth % 2 else 1.0
    return 2.0 * centre_radius * across + pin_diameter
