"""Scales that are known beside the form of the teeth: a bore, two points, the dots of a scanner."""

import math
from collections.abc import Callable

import numpy as np

from wearsim.geometry.profile_points import Vector
from wearsim.scanning.photograph import Photograph, bad_photograph
from wearsim.scanning.placement import KnownScale, edge_image
from wearsim.scanning.projection import Projection, seen_stations
from wearsim.scanning.silhouette import Silhouette
from wearsim.scanning.subpixel_edges import EdgeImage

_INCH = 25.4

_DOTS_ERROR = 2e-3
"""Standard deviation of the feed of a flatbed scanner, relative."""

_POINT_ERROR = 1.0
"""Standard deviation of a point that is read off a picture, in each direction [px]."""

_BORE_ERROR = 0.02
"""Standard deviation of a bore's diameter as it is given [mm]."""

_DIRECTIONS = 360

LookUp = Callable[[Projection], KnownScale]


def by_dots(dpi: float) -> LookUp:
    """Return the scale of a scan of so many dots per inch."""

    def known(projection: Projection) -> KnownScale:
        return KnownScale(dpi / _INCH, _DOTS_ERROR, f"{dpi:g} dpi")

    return known


def by_points(photograph: Photograph, points: tuple[float, float, float, float], apart: float) -> LookUp:
    """Return the scale of two points of the picture that lie in the plane of the teeth so far apart [mm]."""
    ends = np.array(points, dtype=float).reshape(2, 2)
    size = np.array([photograph.width, photograph.height])
    if not ((ends >= 0.0) & (ends <= size)).all():
        text = (
            f"the points of the scale must lie in the picture of {size[0]} x {size[1]} pixels: "
            "read them again"
        )
        raise bad_photograph(photograph.name, text)
    pixels = math.dist(*ends)
    if pixels < 20.0:
        text = (
            f"the points of the scale must be well apart, but are {pixels:.0f} pixels: choose two "
            "farther apart"
        )
        raise bad_photograph(photograph.name, text)

    def known(projection: Projection) -> KnownScale:
        by_form = math.dist(*projection.behind(ends))
        error = math.sqrt(2.0) * _POINT_ERROR / pixels
        return KnownScale(projection.scale * by_form / apart, error, f"two points {apart:g} mm apart")

    return known


def by_bore(photograph: Photograph, seen: Silhouette, root_radius: float, bore: float) -> LookUp:
    """Return the scale of a bore of known diameter [mm], seen as a hole around the wheel's centre."""
    image = edge_image(photograph, seen)

    def known(projection: Projection) -> KnownScale:
        angle = np.linspace(0.0, math.tau, _DIRECTIONS, endpoint=False)
        outwards = np.column_stack([np.cos(angle), np.sin(angle)])
        rough = _first_edge(image, projection, outwards, root_radius)
        if rough is None or not 0.7 < 2.0 * rough / bore < 1.4:
            hole = "there is none"
            if rough is not None:
                hole = f"the hole found measures {2.0 * rough:.4g} mm by the pitch"
            raise bad_photograph(
                photograph.name,
                f"the bore must show as a hole of {bore:g} mm around the centre, but {hole}: check its "
                "diameter, the chain and the teeth, or leave it out",
            )
        radius = rough * np.ones(_DIRECTIONS)
        for _ in range(3):
            seen_ring = seen_stations(projection, radius[:, None] * outwards, -outwards)
            reach = max(6.0, 0.1 * rough * projection.scale)
            off = image.crossings(seen_ring.points, seen_ring.normals, np.zeros(_DIRECTIONS), reach)
            radius = _eccentric_circle(radius - off / seen_ring.stretch, angle)
        mean = float(radius.mean())
        error = math.hypot(_BORE_ERROR / bore, 0.1 / (2.0 * mean * projection.scale))
        return KnownScale(projection.scale * 2.0 * mean / bore, error, f"the bore of {bore:g} mm")

    return known


def _first_edge(
    image: EdgeImage, projection: Projection, outwards: Vector, root_radius: float
) -> float | None:
    """Radius at which the ground in the middle of the wheel ends [mm]; None where there is none."""
    ways = np.linspace(0.02, 0.95, 300) * root_radius
    seen = projection.seen(ways[:, None, None] * outwards[::6])
    across, down = (np.rint(axis).astype(int) for axis in (seen[..., 0], seen[..., 1]))
    profile = np.median(image.light[down, across], axis=1)
    level = 0.5 * (float(profile.max()) + float(profile.min()))
    if profile[0] < level:
        return None
    below = np.flatnonzero(profile < level)
    return float(ways[below[0]]) if below.size else None


def _eccentric_circle(radius: Vector, angle: Vector) -> Vector:
    """Circle beside the centre through radii by angle, as radii again; what is far off has no weight."""
    rows = np.column_stack([np.ones_like(angle), np.cos(angle), np.sin(angle)])
    known = np.isfinite(radius)
    for _ in range(4):
        factors, *_ = np.linalg.lstsq(rows[known], radius[known], rcond=None)
        off = np.abs(radius - rows @ factors)
        known = off <= 4.0 * float(np.nanmedian(off)) + 1e-9
    return np.asarray(rows @ factors)
