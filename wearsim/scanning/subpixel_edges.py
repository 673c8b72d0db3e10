"""Edges to a part of a pixel: where light changes along the normals of an expected outline."""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy import ndimage
from scipy.special import ndtr

from wearsim.geometry.profile_points import Vector
from wearsim.scanning.photograph import Light

_STEP = 0.5
"""Between samples [px]."""

_LEAST_CONTRAST = 0.35
"""Contrast of an edge over the usual one, below which it is none of the wheel's."""

_BLURS = np.geomspace(0.45, 9.0, 28)
"""Standard deviations of a blur that are tried [px]."""

_PROFILES = 1500
"""Edges that the blur is found from."""


class Blur(NamedTuple):
    """How light goes over from steel to ground."""

    deviation: float  # standard deviation of the blur [px]
    misfit: float  # how far the light is off a blurred step, root mean square, over the contrast


@dataclass(frozen=True, eq=False)
class EdgeImage:
    """Light as edges are looked for in it."""

    light: Light  # brighter on the ground than on the wheel

    def along(self, points: Vector, normals: Vector, ways: Vector) -> Vector:
        """Return the light along normals, shape (n, ways)."""
        at = points[:, :, None] + normals[:, :, None] * ways
        return np.asarray(
            ndimage.map_coordinates(self.light, at[:, ::-1].swapaxes(0, 1), order=1, mode="nearest"),
            dtype=float,
        )

    def crossings(self, points: Vector, normals: Vector, expected: Vector, reach: float) -> Vector:
        """Return how far outside of points light is half way from steel to ground [px]; nan without an edge.

        The crossing nearest to the expected one is taken.
        """
        ways = np.arange(-reach, reach + _STEP, _STEP)
        profile = self.along(points, normals, ways)
        low, high = np.percentile(profile, (12.0, 88.0), axis=1)
        level = 0.5 * (low + high)[:, None]
        rises = (profile[:, :-1] < level) & (profile[:, 1:] >= level)
        with np.errstate(invalid="ignore", divide="ignore"):
            part = (level - profile[:, :-1]) / np.diff(profile, axis=1)
            at = np.where(rises, ways[:-1] + _STEP * part, np.inf)
        which = np.abs(at - expected[:, None]).argmin(axis=1)
        found = np.take_along_axis(at, which[:, None], axis=1)[:, 0]
        clear = high - low > _LEAST_CONTRAST * np.median(high - low)
        return np.where(np.isfinite(found) & clear, found, np.nan)

    def refined(self, points: Vector, normals: Vector, start: Vector, blur: float) -> Vector:
        """Return crossings again, by the step of light that is blurred so and fits best [px].

        Linear in level, contrast and place, with samples about the place found last.
        """
        ways, solution = _step_solution(blur)
        found = start.copy()
        known = np.isfinite(start)
        for _ in range(3):
            profile = self.along(points[known] + found[known, None] * normals[known], normals[known], ways)
            _, contrast, moved = solution @ profile.T
            with np.errstate(invalid="ignore", divide="ignore"):
                change = -moved / contrast
            lost = ~(np.abs(change) < 2.0 * blur + 1.0)
            found[known] += np.where(lost, np.nan, change)
            known = np.isfinite(found)
        return found

    def blur(self, points: Vector, normals: Vector, start: Vector) -> "Blur":
        """Return the blur that fits the median of edges best."""
        some = np.flatnonzero(np.isfinite(start))
        some = some[:: max(1, some.size // _PROFILES)]
        misfits = []
        for blur in _BLURS:
            place = self.refined(points[some], normals[some], start[some], blur)
            sharp = np.isfinite(place)
            ways = np.arange(-6.0, 6.01, _STEP) * max(1.0, 0.5 * blur)
            at = points[some][sharp] + place[sharp, None] * normals[some][sharp]
            mean = np.median(self.along(at, normals[some][sharp], ways), axis=0)
            basis = np.column_stack([np.ones_like(ways), ndtr(ways / blur)])
            factors, *_ = np.linalg.lstsq(basis, mean, rcond=None)
            misfits.append(float(np.sqrt(np.mean((mean - basis @ factors) ** 2)) / abs(factors[1])))
        best = int(np.argmin(misfits))
        return Blur(float(_BLURS[best]), misfits[best])


def _step_solution(blur: float) -> tuple[Vector, Vector]:
    """Return ways about an edge, and what turns light there into level, contrast and contrast times place."""
    reach = 2.5 * blur + 1.0
    ways = np.linspace(-reach, reach, 2 * math.ceil(reach / _STEP) + 1)
    slope = np.exp(-0.5 * (ways / blur) ** 2) / (blur * math.sqrt(math.tau))
    return ways, np.linalg.pinv(np.column_stack([np.ones_like(ways), ndtr(ways / blur), slope]))
