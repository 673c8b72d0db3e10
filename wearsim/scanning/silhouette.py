"""Where a wheel is in a photograph, how it is tilted and how many teeth it has: roughly, to start from."""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from wearsim.geometry.profile_points import Vector
from wearsim.scanning.photograph import Light, Photograph, bad_photograph

_COARSE = 1000
"""Pixels of the larger side of the picture in which the wheel is looked for."""

_LEAST_CONTRAST = 0.08
"""Difference of ground and wheel, over the brighter one, from which there is an edge."""

_LEAST_AREA = 0.02
"""Part of the picture that a wheel must fill."""

_SECOND = 0.25
"""Area of another thing over that of the wheel from which it is a second one."""

_LEAST_ROUND = 0.8
"""Smaller diameter over the larger one, above which a picture is roughly along the axis."""

_RAYS = 4096
_MOST_TEETH = 150

_PERIODIC = 0.6
"""Part of what the radius varies by that must repeat from tooth to tooth."""

Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Silhouette:
    """The wheel as it is first seen, in pixels of the photograph."""

    teeth: int
    centre: Vector  # shape (2,)
    spread: Vector  # symmetric: turns a circle of radius 1 into the ellipse that is seen, shape (2, 2)
    area: float  # of the filled outline [px2]
    gap_angle: float  # direction of a gap, counterclockwise as one sees it, before `spread` [rad]
    light_ground: bool  # whether the wheel is darker than what lies behind it

    @property
    def roundness(self) -> float:
        """Smaller diameter over the larger one."""
        least, most = np.linalg.eigvalsh(self.spread)
        return float(least / most)


class _Shape(NamedTuple):
    """A wheel without its holes."""

    filled: Mask
    light_ground: bool


def find_silhouette(photograph: Photograph) -> Silhouette:
    """Return the wheel in a photograph; raise CaseError where there is none, or more than one."""
    step = max(1, math.ceil(max(photograph.light.shape) / _COARSE))
    shape = _find_shape(reduced(photograph.light, step), photograph.name)
    down, across = np.nonzero(shape.filled)
    centre = np.array([across.mean(), down.mean()])
    second = np.cov(np.vstack([across, down]))
    # A disc of radius R has the second moment R^2/4 in every direction.
    values, axes = np.linalg.eigh(second)
    spread = (axes * 2.0 * np.sqrt(values)) @ axes.T
    if math.sqrt(values[0] / values[1]) < _LEAST_ROUND:
        raise bad_photograph(
            photograph.name,
            "the wheel must be photographed along its axis, but its outline is "
            f"{math.sqrt(values[0] / values[1]):.2f} times as high as wide: lay the wheel flat and hold the "
            "camera straight above its bore",
        )
    radii = _radii(shape.filled, centre, spread)
    teeth, angle = _count_teeth(radii, photograph.name)
    return Silhouette(
        teeth=teeth,
        centre=step * (centre + 0.5) - 0.5,
        spread=step * spread,
        area=float(across.size) * step**2,
        gap_angle=angle,
        light_ground=shape.light_ground,
    )


def reduced(light: Light, step: int) -> Light:
    """Means of squares of pixels."""
    height, width = (step * (side // step) for side in light.shape)
    squares = light[:height, :width].reshape(height // step, step, width // step, step)
    return np.asarray(squares.mean(axis=(1, 3)))


def _find_shape(light: Light, name: str) -> _Shape:
    smooth = np.asarray(ndimage.gaussian_filter(light, 1.0))
    dark = _dark_side(smooth, name)
    border = np.concatenate([dark[0], dark[-1], dark[:, 0], dark[:, -1]])
    light_ground = bool(border.mean() < 0.5)
    wheel = dark if light_ground else ~dark
    return _Shape(_largest(ndimage.binary_opening(wheel), name), light_ground)


def _dark_side(smooth: Light, name: str) -> Mask:
    """Pixels on the dark side of Otsu's threshold, light that falls off across the picture evened out."""
    dark = smooth < _otsu(smooth)
    bright, low = (float(np.median(smooth[part])) if part.any() else 0.0 for part in (~dark, dark))
    if not dark.any() or bright - low < _LEAST_CONTRAST * bright:
        raise bad_photograph(
            name,
            "the wheel must contrast with its background, but the picture has no two shades: lay it on "
            "white paper, or on black cloth if it is bright",
        )
    border = np.concatenate([dark[0], dark[-1], dark[:, 0], dark[:, -1]])
    ground = ndimage.binary_erosion(~dark if border.mean() < 0.5 else dark, iterations=3)
    even = smooth / np.maximum(_trend(smooth, ground), 1e-3 * bright)
    return np.asarray(even < _otsu(np.clip(even, 0.0, 3.0)))


def _trend(smooth: Light, ground: Mask) -> Light:
    """Light of the ground as a quadratic across the picture, over its mean."""
    height, width = smooth.shape
    down, across = (
        axis.astype(np.float32) for axis in np.mgrid[-1.0 : 1.0 : height * 1j, -1.0 : 1.0 : width * 1j]
    )
    terms = np.stack([np.ones_like(across), across, down, across**2, across * down, down**2], axis=-1)
    some = np.flatnonzero(ground)[:: max(1, int(ground.sum()) // 20_000)]
    if some.size < 100:
        return np.ones_like(smooth)
    factors, *_ = np.linalg.lstsq(terms.reshape(-1, 6)[some], smooth.ravel()[some], rcond=None)
    return np.asarray(terms @ factors / smooth.ravel()[some].mean())


def _otsu(values: Light) -> float:
    """Threshold that parts values into two classes of least variance.

    Examples
    --------
    >>> 0.2 < _otsu(np.array([0.1, 0.2, 0.15, 0.8, 0.9], dtype=np.float32)) < 0.8
    True
    """
    counts, edges = np.histogram(values, 512)
    middle = 0.5 * (edges[1:] + edges[:-1])
    below = np.cumsum(counts)[:-1]
    above = counts.sum() - below
    sums = np.cumsum(counts * middle)
    with np.errstate(invalid="ignore", divide="ignore"):
        between = below * above * ((sums[-1] - sums[:-1]) / above - sums[:-1] / below) ** 2
    between = np.nan_to_num(between)
    best = np.flatnonzero(between == between.max())
    return float(edges[1:][best].mean())


def _largest(wheel: Mask, name: str) -> Mask:
    """Return the largest thing in a picture without its holes, if it is there whole and alone."""
    labels, count = ndimage.label(wheel)
    areas = np.bincount(labels.ravel(), minlength=2)[1:]
    first = int(areas.argmax()) + 1
    filled = np.asarray(ndimage.binary_fill_holes(labels == first))
    area = int(filled.sum())
    if count == 0 or area < _LEAST_AREA * wheel.size:
        raise bad_photograph(
            name,
            f"a wheel must fill at least {100 * _LEAST_AREA:.0f} % of the picture, but nothing of that size "
            "was found: go closer, or crop the picture to the wheel",
        )
    others = np.where(np.arange(1, areas.size + 1) == first, 0, areas)
    inside = np.unique(labels[filled])
    others[inside[inside > 0] - 1] = 0
    if others.max() > _SECOND * area:
        raise bad_photograph(
            name,
            "one wheel must be in the picture, but there are two objects of its size: crop it to one wheel",
        )
    if filled[0].any() or filled[-1].any() or filled[:, 0].any() or filled[:, -1].any():
        raise bad_photograph(
            name,
            "all teeth must be in the picture with some background around them, but the outline reaches its "
            "edge: go farther away, or remove anything that touches the wheel",
        )
    return filled


def _radii(filled: Mask, centre: Vector, spread: Vector) -> Vector:
    """Radius of the outline over the mean one, counterclockwise from the right as one sees it."""
    angle = np.linspace(0.0, math.tau, _RAYS, endpoint=False)
    way = np.linspace(0.3, 1.8, 1200)
    ray = spread @ np.vstack([np.cos(angle), -np.sin(angle)])
    at = centre[:, None, None] + ray[:, :, None] * way
    inside = ndimage.map_coordinates(filled.astype(np.float32), at[::-1], order=1) > 0.5
    last = way.size - 1 - inside[:, ::-1].argmax(axis=1)
    return np.asarray(way[last])


def _count_teeth(radii: Vector, name: str) -> tuple[int, float]:
    """Return how often the radius repeats itself, and the direction of a gap [rad]."""
    waves = np.fft.rfft(radii - radii.mean())
    power = np.abs(waves[: 8 * _MOST_TEETH]) ** 2
    power[:3] = 0.0
    teeth = int(power[:_MOST_TEETH].argmax())
    periodic = float(power[teeth::teeth].sum() / power.sum()) if power.sum() > 0.0 else 0.0
    height = 4.0 * abs(waves[teeth]) / radii.size
    above = radii > radii.mean()
    crossings = int(np.count_nonzero(above != np.roll(above, 1)))
    if height < 0.02 or periodic < _PERIODIC or teeth < 5:
        raise bad_photograph(
            name,
            "a toothed wheel must be in the picture, but the outline found has no repeating teeth: lay the "
            "wheel alone on a plain background, without its chain, and photograph it along its axis",
        )
    if crossings != 2 * teeth:
        raise bad_photograph(
            name,
            f"the teeth must be countable, but the outline repeats {teeth} times and has {crossings // 2} "
            "teeth: remove the chain and anything at the teeth, clean the wheel, and avoid shadows",
        )
    return teeth, float(-np.angle(waves[teeth]) + math.pi) / teeth
