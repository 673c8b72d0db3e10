"""Extruded outlines as STL solids."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import shapely
from ezdxf.math import Vec2
from ezdxf.math.triangulation import mapbox_earcut_2d

from wearsim.geometry.profile_points import Vector
from wearsim.geometry.wheel_outline import State, WheelShape

_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])

SURFACE_TOLERANCE = 1e-3
"""Distance [mm] of the surface of a wheel from its arcs and curves."""


def stl_bytes(shapes: Sequence[WheelShape], states: Sequence[State]) -> bytes:
    """Return wheels of one state as the content of an STL file."""
    (state,) = states
    return _content(np.concatenate([_wheel_surface(shape, state) for shape in shapes]))


def _wheel_surface(shape: WheelShape, state: State) -> Vector:
    (chain,) = shape.chains(state)
    ring = shapely.LinearRing(chain.outline.polygon(0.2 * SURFACE_TOLERANCE))
    outline = shapely.get_coordinates(ring.simplify(0.8 * SURFACE_TOLERANCE))[:-1]
    bore, hub = (
        None if one is None else one.polygon(SURFACE_TOLERANCE) for one in (shape.bore, shape.hub_outline)
    )
    return prism(outline, shape.width, bore, hub, shape.hub.hub_length)


def prism(
    polygon: Vector, width: float, bore: Vector | None = None, hub: Vector | None = None, length: float = 0.0
) -> Vector:
    """Return the surface of a polygon extruded along z, of a bore through it and of a hub on its end.

    All of them run counterclockwise, the bore within the hub and the hub within the polygon.

    Examples
    --------
    >>> triangle = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    >>> prism(triangle, 2.0).shape
    (8, 3, 3)

    Another triangle as the bore: both ends are rings of six triangles, and it has a wall of six.

    >>> prism(triangle, 2.0, bore=0.2 + 0.2 * triangle).shape
    (24, 3, 3)
    """
    end, holes = width + length, () if bore is None else (bore,)
    parts = [_flat(polygon, holes, 0.0)[:, ::-1], _flat(polygon, holes if hub is None else (hub,), width)]
    parts += _wall(polygon, 0.0, width)
    if hub is not None:
        parts += [*_wall(hub, width, end), _flat(hub, holes, end)]
    if bore is not None:
        parts += _wall(bore[::-1], 0.0, end)
    return np.concatenate(parts)


def _flat(polygon: Vector, holes: Sequence[Vector], height: float) -> Vector:
    """Triangles of a polygon with holes, seen from above counterclockwise."""
    corners, inner = [Vec2(point) for point in polygon], [[Vec2(point) for point in hole] for hole in holes]
    flat = [[(p.x, p.y) for p in three] for three in mapbox_earcut_2d(corners, inner)]
    return _raised(np.array(flat), height)


def _wall(polygon: Vector, low: float, high: float) -> list[Vector]:
    """Triangles between a polygon and the same above it, seen from outside counterclockwise."""
    after = np.roll(polygon, -1, axis=0)
    a, b = _raised(polygon, low), _raised(after, low)
    c, d = _raised(after, high), _raised(polygon, high)
    return [np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]


def _raised(points: Vector, height: float) -> Vector:
    return np.concatenate([points, np.full((*points.shape[:-1], 1), height)], axis=-1)


def write_stl(triangles: Vector, path: Path) -> None:
    """Write triangles as a binary STL file."""
    path.write_bytes(_content(triangles))


def _content(triangles: Vector) -> bytes:
    """Triangles as a binary STL file has them, in single precision."""
    records = np.zeros(len(triangles), _RECORD)
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    records["normal"] = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    records["corners"] = triangles
    header = b"wearsim, mm".ljust(80)
    return header + np.array(len(triangles), "<u4").tobytes() + records.tobytes()
