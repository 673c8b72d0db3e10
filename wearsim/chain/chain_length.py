"""Chain length and centre distance of two sprockets, and back.

Two formulas join the number of links X to the centre distance. The *handbook* formula is the
one in use (ISO 606, ANSI, GOST practice): the first terms of a series. The *belt* formula is
exact for an open belt over both pitch circles. For 20 and 63 teeth at 36 pitches they give
114.801 and 114.805 links. Layouts use the handbook formula and its exact inverse.
"""

import math

from wearsim.errors import GeometryError
from wearsim.geometry.gap import pitch_diameter


def handbook_links(teeth_1: int, teeth_2: int, centre_in_pitches: float) -> float:
    """Return the number of links by the handbook formula.

    X = 2 a/p + (z1 + z2)/2 + ((z2 - z1)/(2 pi))^2 p/a. Short of `belt_links`, at a centre distance
    of 1.6 times the difference of the pitch diameters by 0.007 (17 and 34 teeth), 0.018 (20 and
    63) and 0.059 (9 and 150), and by less the longer the drive.

    Parameters
    ----------
    teeth_1, teeth_2 : int
        Gaps of both sprockets, in any order.
    centre_in_pitches : float
        Centre distance over pitch a/p, above 0.

    Returns
    -------
    float
        Links, in general no whole number.

    Examples
    --------
    >>> handbook_links(20, 20, 30.0)  # 2 * 30 + 20
    80.0
    """
    arc = ((teeth_2 - teeth_1) / (2.0 * math.pi)) ** 2
    return 2.0 * centre_in_pitches + 0.5 * (teeth_1 + teeth_2) + arc / centre_in_pitches


def handbook_centre(teeth_1: int, teeth_2: int, links: float) -> float:
    """Return the centre distance of a number of links, the exact inverse of `handbook_links`.

    a/p = (m + sqrt(m^2 - 8 ((z2 - z1)/(2 pi))^2))/4 with m = X - (z1 + z2)/2.

    Parameters
    ----------
    teeth_1, teeth_2 : int
        Gaps of both sprockets, in any order.
    links : float
        Links X.

    Returns
    -------
    float
        Centre distance over pitch a/p; the larger of the two solutions.

    Raises
    ------
    GeometryError
        No centre distance belongs to so few links.

    Examples
    --------
    >>> handbook_centre(20, 20, 80)
    30.0
    """
    spans = links - 0.5 * (teeth_1 + teeth_2)
    arc = 8.0 * ((teeth_2 - teeth_1) / (2.0 * math.pi)) ** 2
    if spans <= 0.0 or spans**2 < arc:
        least = 0.5 * (teeth_1 + teeth_2) + math.sqrt(arc)
        raise GeometryError(
            f"drive layout: sprockets of {teeth_1} and {teeth_2} teeth need more than {least:.6g} "
            f"links, are {links:g}: use more links"
        )
    return 0.25 * (spans + math.sqrt(spans**2 - arc))


def belt_links(teeth_1: int, teeth_2: int, centre_in_pitches: float) -> float:
    """Return the number of links of an open belt over both pitch circles.

    X = 2 (a/p) cos(b) + (z1 + z2)/2 + (z2 - z1) b/pi with sin(b) = (d2 - d1)/(2 a): exact for
    arcs that count z pitches a turn. The handbook formula is its series in b.

    Parameters
    ----------
    teeth_1, teeth_2 : int
        Gaps of both sprockets, in any order.
    centre_in_pitches : float
        Centre distance over pitch a/p, at least half the difference of the pitch diameters.

    Returns
    -------
    float
        Links, in general no whole number.

    Examples
    --------
    >>> belt_links(20, 20, 30.0)
    80.0
    """
    half = 0.5 * (pitch_diameter(1.0, teeth_2) - pitch_diameter(1.0, teeth_1))
    inclination = math.asin(half / centre_in_pitches)
    spans = 2.0 * centre_in_pitches * math.cos(inclination)
    return spans + 0.5 * (teeth_1 + teeth_2) + (teeth_2 - teeth_1) * inclination / math.pi


def belt_centre(teeth_1: int, teeth_2: int, links: float) -> float:
    """Return the centre distance of a number of links, the inverse of `belt_links`.

    Parameters
    ----------
    teeth_1, teeth_2 : int
        Gaps of both sprockets, in any order.
    links : float
        Links X.

    Returns
    -------
    float
        Centre distance over pitch a/p, within 1e-11.

    Raises
    ------
    GeometryError
        The chain does not reach around the larger sprocket.

    Examples
    --------
    >>> round(belt_centre(20, 20, 80), 9)
    30.0
    """
    half = 0.5 * abs(pitch_diameter(1.0, teeth_2) - pitch_diameter(1.0, teeth_1))
    if links <= max(teeth_1, teeth_2):
        raise GeometryError(
            f"drive layout: the links must exceed the {max(teeth_1, teeth_2)} teeth of the larger "
            f"sprocket, are {links:g}: use more links"
        )
    from scipy.optimize import brentq

    return float(
        brentq(
            lambda centre: belt_links(teeth_1, teeth_2, centre) - links, half + 1e-12, 0.5 * links, xtol=1e-12
        )
    )


def even_links(links: float) -> int:
    """Return the next even number of links, upwards: no offset link is needed.

    Parameters
    ----------
    links : float
        Links by calculation; an excess below 1e-9 counts as rounding.

    Returns
    -------
    int
        Even number of links.

    Examples
    --------
    >>> even_links(75.79), even_links(76.0), even_links(76.1)
    (76, 76, 78)
    """
    return 2 * math.ceil(0.5 * links - 1e-9)
