"""The outline of a gap from a DXF drawing of a whole wheel or of one gap."""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
import shapely

from wearsim.errors import GeometryError
from wearsim.geometry.measured.drawing_doubts import (
    ALIKE,
    EFFECT,
    OFF_CENTRE,
    degrees,
    eccentric,
    gaps_text,
    rounding_step,
    rounding_text,
)
from wearsim.geometry.measured.dxf_edges import edges_from_dxf
from wearsim.geometry.measured.edge_chains import NEAR, Chain, Joint, bridged, filled, joined
from wearsim.geometry.measured.wheel_gaps import Gap, agreement, between_tips, dips, gaps_around, is_deep
from wearsim.geometry.profile_points import Vector

_ALIKE_TIPS = 0.1
"""Part of the depth of a gap by which its two tips may differ in height."""


class DrawnGap(NamedTuple):
    """The outline of one gap as it was drawn."""

    points: Vector  # from just below the right tip to just below the left one, on +y [mm], shape (n, 2)
    notes: list[str]  # what was found and done
    warnings: list[str]  # what is doubtful


class _Wheel(NamedTuple):
    chain: Chain
    ring: Vector  # its points, run through counterclockwise, about its own centre [mm]
    centre: Vector  # in the drawing [mm]
    gaps: list[Gap]


def outline_from_dxf(
    path: Path, teeth: int, *, layer: str | None = None, sagitta: float = 1e-5, tolerance: float = NEAR
) -> DrawnGap:
    """Return the outline of one gap of a drawn sprocket.

    Lines, arcs, circles, ellipses, splines and polylines of the model space are flattened
    with all their vertices on the curves and joined into chains, ends up to a tolerance apart.
    Lines get points every 0.1 mm, except where many short ones are the chords of a curve. The
    largest closed chain with as many gaps as the sprocket has teeth is the wheel, and its gap
    nearest +y the one returned; bores, keyways and construction circles are passed over. All
    its gaps are compared with their mean. Without a wheel, the one open chain that dips
    towards the origin between two tips is the gap. Either is turned onto +y by the mean angle
    of its two flanks over their common radii and cut where it comes within 1e-3 mm of its
    tips, so that it holds no tip land.

    Raises
    ------
    GeometryError
        The file cannot be read, the outline is open, crosses itself or has another number of
        gaps, or its gaps differ by more than those of a made wheel.

    Examples
    --------
    >>> outline_from_dxf(Path("no-such.dxf"), 17)
    Traceback (most recent call last):
    wearsim.errors.GeometryError: no-such.dxf: must be a DXF file, but cannot be opened (No such
    file or directory): check the path
    """
    notes: list[str] = []
    warnings: list[str] = []
    doubts: list[str] = []
    edges = edges_from_dxf(path, layer, sagitta, notes)
    chains, junctions = joined(edges.points, min(tolerance, NEAR), notes)
    chains = _bridged(chains, tolerance, notes, warnings)
    try:
        wheel = _wheel(chains, teeth)
        if wheel is None:
            chain, outline = _single_gap(chains, junctions, teeth, layer, notes)
        else:
            chain, outline = wheel.chain, _gap_of(wheel, chains, notes, warnings, doubts)
    except GeometryError as error:
        raise GeometryError(f"{path}: {error}") from None
    if step := rounding_step(chain.points, edges.unit):
        doubts.append(rounding_text(step))
    if doubts:
        warnings.append(f"{'; '.join(doubts)}: {EFFECT}")
    if not shapely.LineString(outline).is_simple:
        raise GeometryError(f"{path}: the outline of the gap must not cross itself, but does: redraw it")
    return DrawnGap(outline, notes, warnings)


def _bridged(chains: list[Chain], tolerance: float, notes: list[str], warnings: list[str]) -> list[Chain]:
    """Chains whose ends lie apart by more than usual are joined too, up to the tolerance given."""
    if tolerance <= NEAR:
        return chains
    found = bridged(chains, tolerance)
    widths = [joint.width for chain in found for joint in chain.joints]
    if widths:
        text = f"{len(widths)} open places of up to {max(widths):.2g} mm were joined"
        (warnings if max(widths) > 2.0 * ALIKE else notes).append(
            f"{text}: the ends of the edges moved by half of that"
        )
    return [replace(chain, joints=()) for chain in found]


def _wheel(chains: list[Chain], teeth: int) -> _Wheel | None:
    """The largest loop with the right number of gaps."""
    for chain in sorted((c for c in chains if c.closed), key=_area, reverse=True):
        ring = filled(chain)
        polygon = shapely.Polygon(ring)
        if not polygon.exterior.is_ccw:
            ring = ring[::-1]
        centroid = np.array(polygon.centroid.coords[0])
        middles = [centroid] if math.hypot(*centroid) > OFF_CENTRE else []
        centres = [at for at in (np.zeros(2), *middles) if dips(ring - at).size == teeth]
        if not centres:
            continue
        if not polygon.is_valid:
            raise GeometryError(
                "the outline of the wheel must not cross itself: "
                f"{shapely.is_valid_reason(polygon)}: redraw it there"
            )
        wheels = [_Wheel(chain, ring - at, at, gaps_around(ring - at)) for at in centres]
        return min(wheels, key=_difference) if len(wheels) > 1 else wheels[0]
    return None


def _difference(wheel: _Wheel) -> float:
    """Mean difference of the gaps [mm], about the origin halved: it stays the centre unless far worse."""
    found = agreement(wheel.gaps, wheel.gaps[0]).mean
    return found if wheel.centre.any() else 0.5 * found


def _gap_of(
    wheel: _Wheel, chains: list[Chain], notes: list[str], warnings: list[str], doubts: list[str]
) -> Vector:
    """The gap of a wheel that is nearest +y, the others held against it."""
    others = [filled(chain) for chain in chains if chain.closed and chain is not wheel.chain]
    if others:
        larger = sum(_area(chain) > _area(wheel.chain) for chain in chains if chain.closed)
        notes.append(f"{len(others)} other closed outlines passed over, {larger} of them larger")
    if wheel.centre.any():
        x, y = wheel.centre
        notes.append(f"the wheel is drawn about ({x:.6g}, {y:.6g}) mm: moved to the origin")
    root = float(np.hypot(*wheel.ring.T).min())
    if doubt := eccentric(wheel.centre, root, others):
        warnings.append(doubt)
    taken = min(wheel.gaps, key=lambda gap: abs(gap.angle))
    notes.append(gaps_text(wheel.gaps, taken, doubts))
    return taken.points


def _single_gap(
    chains: list[Chain], junctions: list[tuple[float, float]], teeth: int, layer: str | None, notes: list[str]
) -> tuple[Chain, Vector]:
    """The only open chain that dips between two tips, turned onto +y; raise where it is none or open."""

    def is_wheel(chain: Chain) -> bool:
        return chain.closed and _wheel([chain], teeth) is not None

    def is_gap(chain: Chain) -> bool:
        return _gap(chain, teeth) is not None

    everywhere = float(np.ptp(np.concatenate([chain.points for chain in chains]), axis=0).max())
    check_closed("of the wheel", chains, is_wheel, everywhere)
    check_closed("of the gap", chains, is_gap, MOST_JOINED)
    found = [(chain, gap) for chain in chains if (gap := _gap(chain, teeth)) is not None]
    if len(found) != 1:
        check_closed("of the gap", chains, is_gap, everywhere)
        raise GeometryError(_nothing_found(chains, junctions, teeth, layer))
    ((chain, gap),) = found
    if len(chains) > 1:
        notes.append(f"{len(chains) - 1} other chains of edges passed over")
    if abs(gap.angle) > 1e-6:
        notes.append(f"the gap is turned by {degrees(-gap.angle):g} degrees onto +y")
    return chain, gap.points


def _gap(chain: Chain, teeth: int) -> Gap | None:
    """The gap that an open chain runs around from tip to tip, None where it does not."""
    if chain.closed:
        return None
    points = filled(chain)
    angle = np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
    sweep = float(angle[-1] - angle[0])
    if not 1e-3 < abs(sweep) < 1.2 * 2.0 * math.pi / teeth:
        return None
    radius = np.hypot(*points.T)
    depth = min(radius[0], radius[-1]) - radius.min()
    low = radius < radius.min() + 0.5 * depth
    dips_once = np.count_nonzero(np.diff(low)) == 2 and not low[0] and is_deep(radius)
    if not dips_once or abs(radius[0] - radius[-1]) > _ALIKE_TIPS * depth:
        return None
    points = points if sweep > 0.0 else points[::-1]
    return between_tips(points, int(np.hypot(*points.T).argmin()))


def _nothing_found(
    chains: list[Chain], junctions: list[tuple[float, float]], teeth: int, layer: str | None
) -> str:
    loops = sorted((chain for chain in chains if chain.closed), key=_area, reverse=True)
    counts = [str(_dips_about_its_middle(loop)) for loop in loops[:5]]
    closed = f"with {', '.join(counts)} gaps" if counts else "none"
    message = (
        f"a closed outline with {teeth} gaps, or one open chain of edges around one gap with the "
        f"sprocket's centre at the origin, must be drawn, but there are {len(loops)} closed outlines "
        f"({closed}) and {len(chains) - len(loops)} open chains{longest_open(chains)}"
    )
    if junctions:
        x, y = junctions[0]
        message += f"; more than two edges meet at {len(junctions)} places, such as ({x:g}, {y:g}) mm"
    return f"{message}: check the number of teeth" + (
        ", put the outline on a layer of its own and name it" if layer is None else ""
    )


def _dips_about_its_middle(loop: Chain) -> int:
    ring = filled(loop)
    return int(dips(ring - np.array(shapely.Polygon(ring).centroid.coords[0])).size)


def _area(chain: Chain) -> float:
    return abs(float(shapely.Polygon(chain.points).area))


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
