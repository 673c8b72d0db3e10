"""Where the outline of a drawing is open, and how that is said."""

import math
from collections.abc import Callable

import numpy as np

from wearsim.errors import GeometryError
from wearsim.geometry.measured.edge_chains import NEAR, Chain, Joint, bridged

MOST_JOINED = 0.1
"""Distance of open ends [mm] above which they are not joined: each moves by half of it."""

_TOLD = 3
"""Open places that are told one by one."""


def check_closed(
    outline: str, chains: list[Chain], is_outline: Callable[[Chain], bool], reach: float
) -> None:
    """Raise where ends must be joined, up to a distance [mm], for an outline.

    The distance is doubled until an outline is there, so that nothing is told that need not be joined.
    """
    far = NEAR
    while far < reach:
        far = min(2.0 * far, reach)
        for chain in bridged(chains, far):
            if chain.joints and is_outline(chain):
                raise GeometryError(open_text(outline, chain.joints))


def open_text(outline: str, places: tuple[Joint, ...]) -> str:
    """Return that an outline is open, where, by how much, and what to do.

    Examples
    --------
    >>> print(open_text("of the wheel", (Joint((40.0, 1.0), (40.0, 1.0015)),)))
    the outline of the wheel must be closed, but is open at 1 place: from (40, 1) to (40, 1.0015)
    mm, 0.0015 mm apart: join the ends in the drawing, or set sprocket.dxf_join_tolerance_mm = 0.0016
    """
    widest = sorted(places, key=lambda place: -place.width)
    told = "; ".join(
        f"from {place_text(place.end)} to {place_text(place.start)} mm, {place.width:.3g} mm apart"
        for place in widest[:_TOLD]
    )
    more = ", the widest" if len(widest) > _TOLD else ""
    width = widest[0].width
    if width <= MOST_JOINED:
        key = f"sprocket.dxf_join_tolerance_mm = {_rounded_up(width):g}"
        way = f"join the ends in the drawing, or set {key}"
    else:
        way = "draw what is missing there, or join the ends"
    count = f"{len(widest)} place{'s' if len(widest) > 1 else ''}"
    return f"the outline {outline} must be closed, but is open at {count}{more}: {told}: {way}"


def place_text(place: tuple[float, ...]) -> str:
    """Return coordinates as they are told.

    Examples
    --------
    >>> place_text((-6.0000004, 42.80788379))
    '(-6, 42.8079)'
    """
    x, y = (round(value, 4) + 0.0 for value in place)
    return f"({x:.7g}, {y:.7g})"


def longest_open(chains: list[Chain]) -> str:
    """Return between which ends the longest open chain runs, nothing where there is none."""
    open_ones = [chain.points for chain in chains if not chain.closed]
    if not open_ones:
        return ""
    points = max(open_ones, key=lambda points: float(np.hypot(*np.diff(points, axis=0).T).sum()))
    first, last = (tuple(points[i].tolist()) for i in (0, -1))
    apart = math.dist(first, last)
    places = f"{place_text(last)} to {place_text(first)} mm"
    return f", the longest of which is open from {places}, {apart:.3g} mm apart"


def _rounded_up(width: float) -> float:
    """A width up to two significant digits, a little more so that it holds after rounding."""
    digit = 10.0 ** (math.floor(math.log10(width)) - 1)
    return math.ceil(1.001 * width / digit) * digit
