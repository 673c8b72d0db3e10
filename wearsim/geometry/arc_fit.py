"""Few arcs in place of a curve's many points, within a tolerance."""

import math
from dataclasses import replace

import numpy as np

from wearsim.geometry.outline import along_ways
from wearsim.geometry.outline_stretch import OutlineStretch
from wearsim.geometry.profile_points import Vector

_CHORDS = 0.1
"""Part of the tolerance that is left to the chords of the curve."""


def with_few_arcs(stretch: OutlineStretch, tolerance: float) -> OutlineStretch:
    """Return a curve by arcs, each as long as a tolerance [mm] allows; the rest as it is.

    Examples
    --------
    Nine points of a quarter of a circle of radius 1 are one arc, whose bulge is tan(90/4):

    >>> angle = np.linspace(0.0, 0.5 * math.pi, 9)
    >>> points = np.column_stack([np.cos(angle), np.sin(angle)])
    >>> arcs = with_few_arcs(OutlineStretch("flank", points, np.zeros(8), is_curve=True), 1e-2)
    >>> [round(math.degrees(4.0 * math.atan(bulge)), 6) for bulge in arcs.bulges]
    [90.0]
    """
    if not stretch.is_curve:
        return stretch
    starts, ends = stretch.vertices[:-1], stretch.vertices[1:]
    points, _ = along_ways(starts, ends, stretch.bulges, _CHORDS * tolerance)
    points = np.concatenate([points, ends[-1:]])
    kept, bulges = [0], []
    while kept[-1] < len(points) - 1:
        there = points[kept[-1] :]
        end = _farthest(there, (1.0 - _CHORDS) * tolerance)
        bulges.append(_arc(there[: end + 1])[0])
        kept.append(kept[-1] + end)
    return replace(stretch, vertices=points[kept], bulges=np.array(bulges))


def _farthest(points: Vector, tolerance: float) -> int:
    """Return the last point that an arc from the first one reaches within a tolerance of those between."""
    last, good, step = len(points) - 1, 1, 1
    while step and good < last:
        end = min(good + step, last)
        if _arc(points[: end + 1])[1] <= tolerance:
            good, step = end, 2 * step
        else:
            step //= 2
    return good


def _arc(points: Vector) -> tuple[float, float]:
    """Bulge of the arc through the first, the middle and the last point, and how far others lie off it."""
    chord = math.dist(points[0], points[-1])
    x, y = (points[-1] - points[0]) / chord
    # Along the chord, and to its right, where an arc of positive bulge lies.
    u, v = np.array([[x, y], [y, -x]]) @ (points[1:-1] - points[0]).T
    if not u.size:
        return 0.0, 0.0
    # From all points of an arc its ends are seen under one angle.
    middle = int(np.abs(u - 0.5 * chord).argmin())
    bulge = math.tan(0.5 * math.atan2(v[middle], u[middle]) + 0.5 * math.atan2(v[middle], chord - u[middle]))
    # Distance from the circle, all in its curvature 4 bulge / ((1 + bulge^2) chord), which may be 0.
    k, m = 4.0 * bulge / chord, 1.0 - bulge**2
    off = k * (u * (u - chord) + v**2) + 2.0 * m * v
    far = np.abs(off / (1.0 + bulge**2 + np.hypot(k * (u - 0.5 * chord), k * v + m))).max()
    # What the arc swings out between two neighbours comes on top.
    swing = np.square(np.diff(points, axis=0)).sum(axis=1).max() * abs(k) / (8.0 * (1.0 + bulge**2))
    return bulge, float(far + swing) if abs(bulge) <= 1.0 else math.inf
