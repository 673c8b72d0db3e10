"""What a gap's outline, new or worn, leaves of the teeth on both sides of it."""

import math

import numpy as np

from wearsim.geometry.profile import Vector


def tooth_thickness(x: Vector, y: Vector, teeth: int, radius: float) -> float:
    """Return the chordal thickness of a tooth between two gaps alike, on a circle.

    Parameters
    ----------
    x, y : numpy.ndarray
        Outline of the gap from its right tip through the bottom to its left tip [mm].
    teeth : int
        Number of gaps of the wheel.
    radius : float
        Radius of the circle [mm], held between the bottom and the lower of both tips.

    Returns
    -------
    float
        2 R sin((2 pi/z - w)/2), w the angle that the gap takes on the circle [mm];
        negative where the flanks of the tooth have met.

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

    Parameters
    ----------
    x, y : numpy.ndarray
        Outline of the gap from its right tip through the bottom to its left tip [mm].
    teeth : int
        Number of gaps of the wheel.

    Returns
    -------
    float
        Length along the tip circle [mm]; negative where the flanks have met below it.

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
