"""Chain length and centre distance of two sprockets, and back.

One formula joins the number of links X to the centre distance, however a drive is given: spans are
tangents of the pitch circles and count p a link, arcs count z links a turn, as `links_round` does for any
number of wheels. Rigid links make polygons, whose centre distance varies as a tooth passes: the formula is
its mean, and `polygon_swing` how far it goes to both sides. Handbooks (ISO 606, ANSI, GOST practice) print
the first terms of a series of this formula; for 12 and 82 teeth and 104 links that is 0.04 pitches too much.
"""

import math

from wearsim.errors import GeometryError
from wearsim.geometry.gap import pitch_diameter

STRETCH = 1e-4
"""Part of its length by which a new chain may be too short and still fits: its links stretch.

Polygons of links shorten and lengthen a drive by about as much, and ISO 606 lets a new chain be longer than
its nominal length by 15 times as much.
"""


def belt_links(teeth_1: int, teeth_2: int, centre_in_pitches: float) -> float:
    """Return the number of links of an open belt over both pitch circles.

    X = 2 (a/p) cos(b) + (z1 + z2)/2 + (z2 - z1) b/pi with sin(b) = (d2 - d1)/(2 a): exact for
    arcs that count z pitches a turn.

    Equation physics.md (D5) for two wheels.

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
    inclination = _inclination(teeth_1, teeth_2, centre_in_pitches)
    spans = 2.0 * centre_in_pitches * math.cos(inclination)
    return spans + 0.5 * (teeth_1 + teeth_2) + (teeth_2 - teeth_1) * inclination / math.pi


def _inclination(teeth_1: int, teeth_2: int, centre_in_pitches: float) -> float:
    """Return the angle of a span to the line of centres [rad]."""
    half = 0.5 * (pitch_diameter(1.0, teeth_2) - pitch_diameter(1.0, teeth_1))
    return math.asin(half / centre_in_pitches)


def belt_centre(teeth_1: int, teeth_2: int, links: float) -> float:
    """Return the centre distance of a number of links, the inverse of `belt_links`.

    By Newton's steps from a = (X - (z1 + z2)/2)/2, which is never too near: X grows with a by 2 cos(b), and
    the more the longer a is, so that all steps come from above.

    Parameters
    ----------
    teeth_1, teeth_2 : int
        Gaps of both sprockets, in any order.
    links : float
        Links X.

    Returns
    -------
    float
        Centre distance over pitch a/p, to 12 digits.

    Raises
    ------
    GeometryError
        The chain does not reach around the larger sprocket.

    Examples
    --------
    >>> round(belt_centre(20, 20, 80), 9)
    30.0
    """
    if links <= max(teeth_1, teeth_2):
        raise GeometryError(
            f"drive layout: the number of links must exceed the {max(teeth_1, teeth_2)} teeth of the larger "
            f"sprocket, is {links:g}: use more links"
        )
    centre, step = 0.5 * (links - 0.5 * (teeth_1 + teeth_2)), math.inf
    while step > 1e-12 * centre:
        growth = 2.0 * math.cos(_inclination(teeth_1, teeth_2, centre))
        step = (belt_links(teeth_1, teeth_2, centre) - links) / growth
        centre -= step
    return centre


def polygon_swing(teeth_1: int, teeth_2: int, links: int) -> float:
    """Return by how much the centre distance of a taut chain of rigid links varies as a tooth passes.

    It is farthest from `belt_centre` where all is symmetrical to the line of centres, once with an even and
    once with an odd number of links on a wheel. With k1 and k2 links on the wheels and n in either span,
    X = k1 + k2 + 2 n, the last joint on a wheel stands at the angle k pi/z from that line, and n p reaches
    from one to the other; of the numbers of a parity the one nearest to the wrap makes a convex polygon.

    Equation physics.md (D11).

    Parameters
    ----------
    teeth_1, teeth_2 : int
        Gaps of both sprockets, in any order.
    links : int
        Links X.

    Returns
    -------
    float
        The larger distance to `belt_centre` over pitch.

    Raises
    ------
    GeometryError
        The chain does not reach around the larger sprocket.

    Examples
    --------
    Spans of whole links between equal wheels shift with them, and do not vary:

    >>> round(polygon_swing(20, 20, 80), 9)
    0.0
    """
    radius_1, radius_2 = (0.5 * pitch_diameter(1.0, teeth) for teeth in (teeth_1, teeth_2))
    mean, swings = belt_centre(teeth_1, teeth_2, links), []
    tilt = _inclination(teeth_1, teeth_2, mean) / math.pi
    for parity in (0, 1):
        on_1 = _nearest(teeth_1 * (0.5 - tilt), parity)
        on_2 = _nearest(teeth_2 * (0.5 + tilt), links - parity)
        angle_1, angle_2 = math.pi * on_1 / teeth_1, math.pi * on_2 / teeth_2
        rise = radius_2 * math.sin(angle_2) - radius_1 * math.sin(angle_1)
        along = math.sqrt((0.5 * (links - on_1 - on_2)) ** 2 - rise**2)
        swings.append(abs(along - radius_1 * math.cos(angle_1) - radius_2 * math.cos(angle_2) - mean))
    return max(swings)


def _nearest(value: float, parity: int) -> int:
    """Return the whole number nearest to a value that is even or odd as the parity is."""
    return 2 * round(0.5 * (value - parity % 2)) + parity % 2


def even_links(links: float) -> int:
    """Return the next even number of links, upwards: no offset link is needed.

    Parameters
    ----------
    links : float
        Links by calculation; an excess up to `STRETCH` of them is taken up.

    Returns
    -------
    int
        Even number of links.

    Examples
    --------
    >>> even_links(75.79), even_links(76.007), even_links(76.1)
    (76, 76, 78)
    """
    return 2 * math.ceil(0.5 * links / (1.0 + STRETCH))


def odd_links_warning(links: int) -> str:
    """Return what an odd number of links means for the strength of a chain.

    Its offset link bears 35 % less than the chain against fatigue (Tsubaki, Complete Guide to Chain, 2.2).

    Examples
    --------
    >>> odd_links_warning(47)[:38]
    '47 links need a cranked (offset) link,'
    """
    return (
        f"{links} links need a cranked (offset) link, whose fatigue strength is about 35 % below that of "
        f"the rated chain: use {links - 1} or {links + 1} links if possible"
    )
