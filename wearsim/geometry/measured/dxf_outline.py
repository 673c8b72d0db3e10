"""The outline of a gap from a DXF drawing of a whole wheel or of one gap."""

import math
import struct
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import shapely
from numpy.typing import NDArray

from wearsim.errors import GeometryError
from wearsim.geometry.profile_points import Vector

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.entities.circle import Circle
    from ezdxf.entities.dxfgfx import DXFGraphic
    from ezdxf.entities.ellipse import Ellipse
    from ezdxf.entities.lwpolyline import LWPolyline
    from ezdxf.entities.polyline import Polyline
    from ezdxf.entities.spline import Spline

OFF_CENTRE = 1e-3
"""Distance [mm] of a wheel's centroid from the origin that is taken as none."""

ALIKE = 1e-2
"""Difference between gaps [mm] up to which a wheel's centroid counts as its centre."""

_TIP_CUT = 1e-3
_LINE_STEP = 0.1
_SHARP = 0.5
_FLAT = 1e-5
_SHALLOWEST = 0.01
_MILLIMETRES = {
    1: ("inches", 25.4),
    2: ("feet", 304.8),
    4: ("mm", 1.0),
    5: ("cm", 10.0),
    6: ("m", 1000.0),
    8: ("microinches", 25.4e-6),
    9: ("mils", 25.4e-3),
    10: ("yards", 914.4),
    13: ("microns", 1e-3),
    14: ("dm", 100.0),
}
_FARTHEST = 1e6
"""Distance of edges from the origin, and length of curves [mm], beyond which nothing is a sprocket's."""

_MAX_PARTS = 2000.0
"""Into which an edge is cut."""

_UNREADABLE = (
    *(OSError, ValueError, LookupError, TypeError, AttributeError),
    *(ArithmeticError, RecursionError, AssertionError, EOFError, struct.error),
)
"""What the reader of damaged files raises beside its own errors."""

_EDGES = frozenset({"LINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE"})


@dataclass(frozen=True)
class _Chain:
    """Edges of a drawing joined end to end; the first point of a closed one is not repeated."""

    points: Vector
    closed: bool


@dataclass(frozen=True)
class _Gap:
    """A gap between the two tips beside it, turned onto +y, with the angle it had."""

    points: Vector
    angle: float


def outline_from_dxf(
    path: Path,
    teeth: int,
    *,
    layer: str | None = None,
    centre: tuple[float, float] | None = None,
    sagitta: float = 1e-5,
    tolerance: float = 1e-3,
) -> tuple[Vector, list[str]]:
    """Return the outline of one gap of a drawn sprocket.

    Lines, arcs, circles, ellipses, splines and polylines of the model space are flattened
    with all their vertices on the curves and joined into chains. Lines get points every
    0.1 mm, except where many short ones are the chords of a curve. The largest closed chain
    with as many gaps as the sprocket has teeth is the wheel, and its gap nearest +y the one
    returned; bores, keyways and construction circles are passed over. Without a wheel, the
    one open chain that dips towards the origin between two tips is the gap. Either is
    turned onto +y by the mean angle of its two flanks over their common radii and cut
    where it comes within 1e-3 mm of its tips, so that it holds no tip land.

    Examples
    --------
    >>> outline_from_dxf(Path("no-such.dxf"), 17)
    Traceback (most recent call last):
    wearsim.errors.GeometryError: no-such.dxf: must be a DXF file, but cannot be opened (No such
    file or directory): check the path
    """
    notes: list[str] = []
    document = _document(path, notes)
    factor = _unit(document, path, notes)
    with np.errstate(all="ignore"):  # What overflows lies too far away.
        edges = _flattened(_entities(document, path, layer), factor, sagitta, path, notes)
    chains, junctions = _joined(edges, tolerance, notes)
    chains = [_Chain(_filled(chain), chain.closed) for chain in chains]
    outline = _wheel_gap(chains, teeth, centre, path, notes)
    if outline is None:
        outline = _single_gap(chains, teeth, centre, notes)
    if outline is None:
        raise GeometryError(f"{path}: {_nothing_found(chains, junctions, teeth, layer)}")
    if not shapely.LineString(outline).is_simple:
        raise GeometryError(f"{path}: the outline of the gap must not cross itself, but does: redraw it")
    return outline, notes


def _document(path: Path, notes: list[str]) -> "Drawing":
    from ezdxf import recover
    from ezdxf.filemanagement import readfile
    from ezdxf.lldxf.const import DXFError

    try:
        document = readfile(path)
        document.modelspace()  # A damaged file may hold none.
        return document
    except (FileNotFoundError, IsADirectoryError, PermissionError) as error:
        raise GeometryError(
            f"{path}: must be a DXF file, but cannot be opened ({error.strerror}): check the path"
        ) from None
    except (DXFError, *_UNREADABLE):
        pass
    try:
        document, auditor = recover.readfile(path)
        document.modelspace()
    except (DXFError, *_UNREADABLE) as error:
        raise GeometryError(
            f"{path}: must be a DXF file, but cannot be read ({error}): export it anew"
        ) from None
    notes.append(f"the file was damaged; repaired with {len(auditor.fixes)} changes")
    return document


def _unit(document: "Drawing", path: Path, notes: list[str]) -> float:
    unit = int(document.header.get("$INSUNITS", 0))
    if unit == 0:
        notes.append("the drawing names no unit: taken as mm")
        return 1.0
    if unit not in _MILLIMETRES:
        raise GeometryError(
            f"{path}: the unit of the drawing ($INSUNITS) must be one of length between microns and "
            f"metres, is number {unit}: set it to mm"
        )
    name, factor = _MILLIMETRES[unit]
    if factor != 1.0:
        notes.append(f"converted from {name} to mm")
    return factor


def _entities(document: "Drawing", path: Path, layer: str | None) -> "list[DXFGraphic]":
    everything = list(document.modelspace())
    if layer is None:
        return everything
    chosen = [e for e in everything if e.dxf.get("layer", "0").lower() == layer.lower()]
    if not chosen:
        used = ", ".join(sorted({e.dxf.get("layer", "0") for e in everything})) or "none"
        raise GeometryError(
            f"{path}: the layer {layer!r} must hold the outline, but holds nothing: use one of the "
            f"layers in use ({used})"
        )
    return chosen


def _flattened(
    entities: "Iterable[DXFGraphic]", factor: float, sagitta: float, path: Path, notes: list[str]
) -> list[Vector]:
    """Points of every edge [mm], its vertices on the curve."""
    from ezdxf.entities.lwpolyline import LWPolyline
    from ezdxf.entities.polyline import Polyline

    edges, unknown = [], Counter[str]()
    for entity in entities:
        kind = entity.dxftype()
        try:
            if kind in _EDGES:
                edges.append(_points(entity, factor, sagitta))
            elif isinstance(entity, LWPolyline) or (
                isinstance(entity, Polyline) and (entity.is_2d_polyline or entity.is_3d_polyline)
            ):
                if entity.has_arc:
                    edges += [_points(part, factor, sagitta) for part in entity.virtual_entities()]
                else:
                    edges.append(_vertices(entity, factor))
            else:
                unknown[kind] += 1
        except (ValueError, ArithmeticError) as error:
            raise GeometryError(
                f"{path}: every {kind} must be a curve of a wheel, but #{entity.dxf.handle} is not "
                f"({error}): remove it"
            ) from None
    found = ", ".join(f"{number} {kind}" for kind, number in sorted(unknown.items()))
    if found:
        notes.append(f"passed over what is no edge: {found}")
    edges = [points for points in edges if points.shape[0] > 1]
    if not edges:
        raise GeometryError(
            f"{path}: lines, arcs, circles, ellipses, splines or polylines must be in the model space, "
            f"but there are none (found: {found or 'nothing'}): explode blocks and export the outline"
        )
    return edges


def _points(entity: "DXFGraphic", factor: float, sagitta: float) -> Vector:
    from ezdxf.entities.circle import Circle
    from ezdxf.entities.ellipse import Ellipse
    from ezdxf.entities.line import Line
    from ezdxf.entities.spline import Spline

    if isinstance(entity, Line):
        points = np.array([entity.dxf.start, entity.dxf.end])[:, :2] * factor
    elif isinstance(entity, Circle | Ellipse | Spline):
        length = _length(entity) * factor
        if not length <= _FARTHEST:
            raise ValueError(f"{length:.3g} mm long, of a wheel at most {_FARTHEST:g} mm")
        vertices = [(vertex.x, vertex.y) for vertex in entity.flattening(sagitta / factor)]
        points = np.array(vertices, dtype=float).reshape(-1, 2) * factor
    else:
        raise ValueError(f"{entity.dxftype()} in a polyline")
    return _near(points)


def _length(entity: "Circle | Ellipse | Spline") -> float:
    """Length of a curve in the unit of the drawing, that of its frame where it is not known."""
    from ezdxf.entities.arc import Arc
    from ezdxf.entities.circle import Circle
    from ezdxf.entities.ellipse import Ellipse

    if isinstance(entity, Circle):
        ends = (entity.dxf.start_angle, entity.dxf.end_angle) if isinstance(entity, Arc) else (0.0, 0.0)
        return float(abs(entity.dxf.radius) * math.radians((ends[1] - ends[0]) % 360.0 or 360.0))
    if isinstance(entity, Ellipse):
        turn = (entity.dxf.end_param - entity.dxf.start_param) % math.tau
        return float(entity.dxf.major_axis.magnitude) * (turn or math.tau)
    frame = np.array(entity.control_points if len(entity.control_points) else entity.fit_points)
    return float(np.hypot(*np.diff(frame[:, :2], axis=0).T).sum())


def _vertices(entity: "LWPolyline | Polyline", factor: float) -> Vector:
    """Vertices of a polyline without arcs, the first one again at the end of a closed one."""
    from ezdxf.entities.polyline import Polyline

    rows = entity.points_in_wcs() if isinstance(entity, Polyline) else entity.vertices_in_wcs()
    points = np.array([(vertex.x, vertex.y) for vertex in rows]).reshape(-1, 2) * factor
    return _near(np.concatenate([points, points[:1]]) if entity.is_closed else points)


def _near(points: Vector) -> Vector:
    """Points without repeats that lie where a sprocket can."""
    if not (np.abs(points) <= _FARTHEST).all():
        raise ValueError(f"it must lie within {_FARTHEST:g} mm of the origin")
    return _without_repeats(points)


def _without_repeats(points: Vector) -> Vector:
    apart = np.hypot(*np.diff(points, axis=0).T) > 1e-9
    return points[np.concatenate([[True], apart])] if points.size else points


def _joined(
    edges: list[Vector], tolerance: float, notes: list[str]
) -> tuple[list[_Chain], list[tuple[float, float]]]:
    """Chains of edges, and the places where more than two edges meet."""
    from ezdxf import edgeminer

    chains, links, seen = [], [], set()
    for points in edges:
        box = (*points.min(axis=0), *points.max(axis=0))
        if max(box[2] - box[0], box[3] - box[1]) < tolerance:
            continue
        ends = sorted(map(tuple, np.round(points[[0, -1]] / tolerance)))
        key = (*ends, *np.round(np.array(box) / tolerance))
        if key in seen:
            continue
        seen.add(key)
        if math.dist(points[0], points[-1]) <= tolerance:
            chains.append(_Chain(points[:-1], closed=True))
        else:
            links.append(edgeminer.make_edge(points[0], points[-1], payload=points))
    if len(edges) > len(seen):
        notes.append(f"{len(edges) - len(seen)} edges drawn twice or too short: passed over")
    if not links:
        return chains, []
    deposit = edgeminer.Deposit(links, gap_tol=tolerance)
    widest, junctions = 0.0, set()
    for chain in edgeminer.find_all_simple_chains(deposit):
        rows = [e.payload[::-1] if e.is_reverse else e.payload for e in chain]
        first, last = rows[0][0], rows[-1][-1]
        closed = math.dist(first, last) <= tolerance
        following = rows[1:] + rows[:1] if closed else rows[1:]
        gaps = [math.dist(a[-1], b[0]) for a, b in zip(rows, following, strict=False)]
        widest = max([widest, *gaps])
        chains.append(_Chain(_end_to_end(rows, closed), closed))
        junctions |= {
            (round(float(x), 3), round(float(y), 3)) for x, y in (first, last) if deposit.degree((x, y)) > 2
        }
    if widest > 1e-6:
        notes.append(f"ends of edges up to {widest:.2g} mm apart were joined")
    return chains, sorted(junctions)


def _end_to_end(rows: list[Vector], closed: bool) -> Vector:
    """Rows of points one after the other, with the middle of the two ends at every joint."""
    rows = [row.copy() for row in rows]
    for before, after in zip(rows, rows[1:] + rows[:1] if closed else rows[1:], strict=False):
        before[-1] = after[0] = 0.5 * (before[-1] + after[0])
    points = _without_repeats(np.concatenate(rows))
    return points[:-1] if closed else points


def _filled(chain: _Chain) -> Vector:
    """Points of a chain with more of them on its long edges.

    Between two corners that are not sharp an edge is the chord of a curve if it turns at both
    ends and is not much longer than both edges beside it; beyond a sharp corner nothing is
    known. A chord is cut as finely as the edges mostly are, with the new points on an arc of
    the lesser of the curvatures at its ends. All other edges are straight.
    """
    points = np.concatenate([chain.points, chain.points[:1]]) if chain.closed else chain.points
    way = np.diff(points, axis=0)
    # The edges beside the first and the last one; an open chain has only one of each.
    around = way[[-1, 0]] if chain.closed else way[[1, -2]] if len(way) > 1 else way[[0, 0]]
    padded = np.concatenate([around[:1], way, around[1:]])
    heading, lengths = np.arctan2(padded[:, 1], padded[:, 0]), np.hypot(*padded.T)
    turn = np.remainder(np.diff(heading) + math.pi, 2.0 * math.pi) - math.pi
    if not chain.closed:
        turn[[0, -1]] *= -1.0
    sharp = np.abs(turn) > _SHARP
    curvature = np.where(sharp, math.inf, 2.0 * turn / (lengths[:-1] + lengths[1:]))
    before, after = curvature[:-1], curvature[1:]
    bent = np.where(np.abs(before) < np.abs(after), before, after)
    length = lengths[1:-1]
    beside = np.maximum(lengths[:-2] * ~sharp[:-1], lengths[2:] * ~sharp[1:])
    is_straight = (np.abs(bent) * length**2 < 8.0 * _FLAT) | (length > 3.0 * beside)
    bent[is_straight] = 0.0
    fine = np.ceil(np.minimum(length / _LINE_STEP, _MAX_PARTS))
    alike = (length // max(_LINE_STEP, float(np.median(length)))).clip(1.0, _MAX_PARTS)
    steps = np.where(is_straight, fine, alike).astype(int)
    edge = np.repeat(np.arange(steps.size), steps)
    share = (np.arange(edge.size) - np.repeat(np.cumsum(steps) - steps, steps)) / steps[edge]
    aside = 0.5 * (bent * length)[edge] * share * (1.0 - share)
    outwards = way[edge] @ np.array([[0.0, -1.0], [1.0, 0.0]])
    filled = points[edge] + share[:, None] * way[edge] + aside[:, None] * outwards
    return filled if chain.closed else np.concatenate([filled, points[-1:]])


def _wheel_gap(
    chains: list[_Chain], teeth: int, centre: tuple[float, float] | None, path: Path, notes: list[str]
) -> Vector | None:
    """The gap nearest +y of the largest loop with the right number of gaps."""
    loops = sorted((c.points for c in chains if c.closed), key=_area, reverse=True)
    for number, points in enumerate(loops):
        polygon = shapely.Polygon(points)
        middle = np.array(centre if centre else polygon.centroid.coords[0])
        if _dips(points - middle).size != teeth:
            continue
        if not polygon.is_valid:
            raise GeometryError(
                f"{path}: the outline of the wheel must not cross itself: "
                f"{shapely.is_valid_reason(polygon)}: redraw it there"
            )
        if len(loops) > 1:
            notes.append(f"{len(loops) - 1} other closed outlines passed over, {number} of them larger")
        if not polygon.exterior.is_ccw:
            points = points[::-1]
        off = math.hypot(*middle)
        if centre is None and off <= OFF_CENTRE:
            middle = np.zeros(2)
        gaps = _gaps(points - middle)
        nearest = min(gaps, key=lambda gap: abs(gap.angle))
        differ = _difference(gaps, nearest)
        spacing = _spacing_error(gaps) * float(np.hypot(*nearest.points[0]))
        if centre is None and off > OFF_CENTRE:
            where = f"({middle[0]:.6g}, {middle[1]:.6g}) mm"
            if max(differ, spacing) > ALIKE:
                raise GeometryError(
                    f"{path}: the centre of the wheel must be at the origin, but its centroid is at "
                    f"{where}, about which the gaps differ by {max(differ, spacing):.3g} mm: move the "
                    "wheel, or give its centre"
                )
            notes.append(f"the wheel is drawn about {where}: moved to the origin")
        notes.append(
            f"the {teeth} gaps differ by at most {differ:.2g} mm in shape and {spacing:.2g} mm in spacing "
            f"at the tips; the one drawn {_degrees(nearest.angle):g} degrees from +y is taken"
        )
        return nearest.points
    return None


def _single_gap(
    chains: list[_Chain], teeth: int, centre: tuple[float, float] | None, notes: list[str]
) -> Vector | None:
    """The only open chain that dips between two tips, turned onto +y."""
    found = []
    for chain in chains:
        if chain.closed:
            continue
        points = chain.points - np.array(centre or (0.0, 0.0))
        angle = np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
        sweep = float(angle[-1] - angle[0])
        if not 1e-3 < abs(sweep) < 1.2 * 2.0 * math.pi / teeth:
            continue
        radius = np.hypot(*points.T)
        low = radius < 0.5 * (radius.min() + min(radius[0], radius[-1]))
        if np.count_nonzero(np.diff(low)) == 2 and not low[0] and _is_deep(radius):
            found.append(points if sweep > 0.0 else points[::-1])
    if len(found) != 1:
        return None
    gap = _between_tips(found[0], int(np.hypot(*found[0].T).argmin()))
    if len(chains) > 1:
        notes.append(f"{len(chains) - 1} other chains of edges passed over")
    if abs(gap.angle) > 1e-6:
        notes.append(f"the gap is turned by {_degrees(-gap.angle):g} degrees onto +y")
    return gap.points


def _nothing_found(
    chains: list[_Chain], junctions: list[tuple[float, float]], teeth: int, layer: str | None
) -> str:
    loops = sorted((c.points for c in chains if c.closed), key=_area, reverse=True)
    middles = [shapely.Polygon(points).centroid.coords[0] for points in loops[:5]]
    counts = [
        str(_dips(points - np.array(middle)).size) for points, middle in zip(loops, middles, strict=False)
    ]
    closed = f"with {', '.join(counts)} gaps" if counts else "none"
    message = (
        f"a closed outline with {teeth} gaps, or one open chain of edges around one gap with the "
        f"sprocket's centre at the origin, must be drawn, but there are {len(loops)} closed outlines "
        f"({closed}) and {len(chains) - len(loops)} open chains"
    )
    if junctions:
        x, y = junctions[0]
        message += f"; more than two edges meet at {len(junctions)} places, such as ({x:g}, {y:g}) mm"
    return (
        f"{message}: check the number of teeth"
        + (", put the outline on a layer of its own and name it" if layer is None else "")
        + ", or join edges with a larger tolerance"
    )


def _area(points: Vector) -> float:
    return abs(float(shapely.Polygon(points).area))


def _is_deep(radius: Vector) -> bool:
    return bool(radius.max() - radius.min() > _SHALLOWEST * radius.max())


def _dips(ring: Vector) -> NDArray[np.intp]:
    """Indices where a closed outline dips below the middle of its radii."""
    radius = np.hypot(*ring.T)
    low = radius < 0.5 * (radius.min() + radius.max())
    return np.flatnonzero(low & ~np.roll(low, 1)) if _is_deep(radius) else np.empty(0, dtype=np.intp)


def _gaps(ring: Vector) -> list[_Gap]:
    """All gaps of a wheel around the origin that is run through counterclockwise."""
    ring = np.roll(ring, -int(np.hypot(*ring.T).argmax()), axis=0)
    ring = np.concatenate([ring, ring[:1]])
    radius = np.hypot(*ring.T)
    starts = _dips(ring[:-1])
    bounds = np.append(starts, radius.size)
    bottoms = [a + int(radius[a:b].argmin()) for a, b in pairwise(bounds)]
    tips = [a + int(radius[a:b].argmax()) for a, b in pairwise(bottoms)]
    tips = [0, *tips, radius.size - 1]
    # A tip land may fall to either of its gaps here: the cut takes it off.
    return [
        _between_tips(ring[first : last + 1], bottom - first)
        for first, bottom, last in zip(tips, bottoms, tips[1:], strict=False)
    ]


def _between_tips(points: Vector, bottom: int) -> _Gap:
    """A gap from just below its right tip to just below its left one, turned onto +y."""
    left = _up_to_tip(points[bottom:])
    right = _up_to_tip(points[: bottom + 1][::-1])
    top = min(math.hypot(*left[-1]), math.hypot(*right[-1]))
    low = math.hypot(*points[bottom])
    radii = np.linspace(low + 0.2 * (top - low), top, 50)
    upwards = math.atan2(points[bottom, 1], points[bottom, 0])
    angles = []
    for side in (left, right):
        angle = np.arctan2(side[:, 1], side[:, 0]) - upwards
        angle = np.angle(np.exp(1j * angle))
        angles.append(np.interp(radii, np.maximum.accumulate(np.hypot(*side.T)), angle))
    middle = upwards + 0.5 * float(np.mean(angles[0] + angles[1]))
    turn = 0.5 * math.pi - middle
    cosine, sine = math.cos(turn), math.sin(turn)
    outline = np.concatenate([right[::-1], left[1:]])
    rotated = outline @ np.array([[cosine, sine], [-sine, cosine]])
    return _Gap(rotated, math.remainder(-turn, 2.0 * math.pi))


def _up_to_tip(side: Vector) -> Vector:
    """A side of a gap from its bottom to where it comes within the cut of its tip.

    Its tip is the first top near its greatest radius: the other end of a tip land that is
    drawn as a straight line may lie a little higher.
    """
    radius = np.hypot(*side.T)
    near = int(np.flatnonzero(radius >= radius.max() - ALIKE)[0])
    falls = np.flatnonzero(np.diff(radius[near:]) < 0.0)
    level = radius[near + falls[0] if falls.size else -1] - _TIP_CUT
    last = int(np.flatnonzero(radius >= level)[0])
    share = (level - radius[last - 1]) / (radius[last] - radius[last - 1])
    end = side[last - 1] + share * (side[last] - side[last - 1])
    return _without_repeats(np.concatenate([side[:last], end[None]]))


def _difference(gaps: list[_Gap], reference: _Gap) -> float:
    """Greatest distance of the points of any gap from the reference [mm]."""
    line = shapely.LineString(reference.points)
    shapely.prepare(line)
    everything = np.concatenate([gap.points for gap in gaps])
    return float(shapely.distance(shapely.points(everything), line).max())


def _spacing_error(gaps: list[_Gap]) -> float:
    """Range of the gaps' angles about even spacing [rad]."""
    even = 2.0 * math.pi / len(gaps)
    angles = np.sort([gap.angle for gap in gaps])
    return float(np.ptp(angles - even * np.arange(len(gaps))))


def _degrees(angle: float) -> float:
    return round(math.degrees(angle), 4) + 0.0
