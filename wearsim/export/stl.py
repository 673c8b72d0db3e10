"""Extruded outlines as STL solids."""

from pathlib import Path

import numpy as np
from ezdxf.math import Vec2
from ezdxf.math.triangulation import mapbox_earcut_2d

from wearsim.geometry.profile_points import Vector

_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def prism(polygon: Vector, width: float) -> Vector:
    """Return the surface of a polygon extruded along z.

    Examples
    --------
    >>> prism(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), 2.0).shape
    (8, 3, 3)
    """
    corners = [Vec2(point) for point in polygon]
    flat = np.array([[(p.x, p.y) for p in three] for three in mapbox_earcut_2d(corners)])
    after = np.roll(polygon, -1, axis=0)
    a, b = _raised(polygon, 0.0), _raised(after, 0.0)
    c, d = _raised(after, width), _raised(polygon, width)
    return np.concatenate(
        [
            _raised(flat[:, ::-1], 0.0),
            _raised(flat, width),
            np.stack([a, b, c], axis=1),
            np.stack([a, c, d], axis=1),
        ]
    )


def _raised(points: Vector, height: float) -> Vector:
    return np.concatenate([points, np.full((*points.shape[:-1], 1), height)], axis=-1)


def write_stl(triangles: Vector, path: Path) -> None:
    """Write triangles as a binary STL file, in single precision as the format has it."""
    records = np.zeros(len(triangles), _RECORD)
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    records["normal"] = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    records["corners"] = triangles
    header = b"wearsim, mm".ljust(80)
    path.write_bytes(header + np.array(len(triangles), "<u4").tobytes() + records.tobytes())
