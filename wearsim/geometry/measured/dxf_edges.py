"""The edges of a drawing: what is drawn in a DXF file, as points in mm."""

import math
import struct
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from wearsim.errors import GeometryError
from wearsim.files import check_given
from wearsim.geometry.profile_points import Vector

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.entities.circle import Circle
    from ezdxf.entities.dxfgfx import DXFGraphic
    from ezdxf.entities.ellipse import Ellipse
    from ezdxf.entities.lwpolyline import LWPolyline
    from ezdxf.entities.polyline import Polyline
    from ezdxf.entities.spline import Spline

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

_MOST_BYTES = 20_000_000
"""Of a drawing: of one sprocket, it has some hundred kilobytes."""

_MOST_CIRCLES, _MOST_EDGES, _MOST_AT_A_POINT = 1000, 20_000, 200
"""Whole circles, all edges, and edges that end at one point: far more than the drawing of a wheel has."""

_UNREADABLE = (
    *(OSError, ValueError, LookupError, TypeError, AttributeError),
    *(ArithmeticError, RecursionError, AssertionError, EOFError, StopIteration, struct.error),
)
"""What the reader of damaged files raises beside its own errors."""

_EDGES = frozenset({"LINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE"})


@dataclass(frozen=True, eq=False)
class DrawnEdges:
    """Edges of a drawing, each by the points of its curve."""

    points: list[Vector]  # of every edge, in its direction [mm], shape (n, 2)
    unit: float  # of the coordinates in the file [mm]


def edges_from_dxf(path: Path, layer: str | None, sagitta: float, notes: list[str]) -> DrawnEdges:
    """Return all lines, arcs, circles, ellipses, splines and polylines of the model space.

    Curves are flattened with all their vertices on them, chords within the sagitta [mm].
    """
    document = _document(path, notes)
    unit = _unit(document, path, notes)
    with np.errstate(all="ignore"):  # What overflows lies too far away.
        return DrawnEdges(_flattened(_entities(document, path, layer), unit, sagitta, path, notes), unit)


def _document(path: Path, notes: list[str]) -> "Drawing":
    from ezdxf import recover
    from ezdxf.filemanagement import readfile
    from ezdxf.lldxf.const import DXFError

    try:
        check_given(path, _MOST_BYTES)
        path.open("rb").close()
    except OSError as error:
        raise GeometryError(
            f"{path}: must be a DXF file, but cannot be opened ({error.strerror}): check the path"
        ) from None
    try:
        document = readfile(path)
        document.modelspace()  # A damaged file may hold none.
        return document
    except (DXFError, *_UNREADABLE):
        pass
    try:
        document, auditor = recover.readfile(path)
        document.modelspace()
    except (DXFError, *_UNREADABLE) as error:
        why = str(error) or "it ends too early"
        raise GeometryError(
            f"{path}: must be a DXF file, but cannot be read ({why}): export it anew"
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
    chosen = [e for e in everything if layer is None or e.dxf.get("layer", "0").lower() == layer.lower()]
    if not chosen and layer is not None:
        used = ", ".join(sorted({e.dxf.get("layer", "0") for e in everything})) or "none"
        raise GeometryError(
            f"{path}: the layer {layer!r} must hold the outline, but holds nothing: use one of the "
            f"layers in use ({used})"
        )
    circles = sum(entity.dxftype() == "CIRCLE" for entity in chosen)
    _check_count(path, circles, _MOST_CIRCLES, "circles")
    _check_count(path, len(chosen), _MOST_EDGES, "edges")
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
    ends = Counter(tuple(end) for points in edges for end in np.round(points[[0, -1]], 3).tolist())
    _check_count(path, max(ends.values()), _MOST_AT_A_POINT, "edges that end at one point")
    return edges


def _check_count(path: Path, count: int, most: int, what: str) -> None:
    if count > most:
        raise GeometryError(
            f"{path}: must be the outline of one wheel, with at most {most} {what}, but has {count}: "
            "export the outline alone"
        )


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
    return without_repeats(points)


def without_repeats(points: Vector) -> Vector:
    """Points without those that repeat the one before."""
    apart = np.hypot(*np.diff(points, axis=0).T) > 1e-9
    return points[np.concatenate([[True], apart])] if points.size else points
