"""A chain that lies beside the wheel on its side: how much longer it is than new, by pins that look alike."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter, map_coordinates, spline_filter

from wearsim.catalogue.catalogues import Chain
from wearsim.geometry.profile_points import Vector
from wearsim.scanning.photograph import Photograph, bad_photograph
from wearsim.scanning.projection import Projection
from wearsim.scanning.sheet_placement import SeenSheet

Mask = NDArray[np.bool_]

_STEP = 2
"""Links from a pin to the next one that looks like it: inner and outer links take turns."""

_AROUND = 0.38
"""Radius of what is looked at around a pin, over the pitch: no more than the end of a plate."""

_INSIDE = 0.6
"""Least distance of a pin from the edge of the picture, over the pitch."""

_SEARCH = 0.3
"""How far a pin may be from where it is expected, along and across, over the pitch."""

_TOP = (0.98, 0.02)
"""Height of pin heads and upper plates over the width over the pins, and its standard deviation."""

_ALIKE = 0.6
"""Correlation with the mean pin below which something else is there."""

_COARSE, _FINE = 24, 100
"""Most samples of a pitch in the search for pins, and in their alignment."""

_REACH = round(_SEARCH * _COARSE)
"""The same of the search, in its samples."""

_LEAST_ERROR = 0.05
"""Standard deviation of a pin along the chain that no scatter of pins makes smaller [px]."""

_WIDTHS = (1.8, 3.3)
"""Width over the pins of one strand over its inner width: 1.94 (12B) to 3.09 (081) by ISO 606."""

_WIDEST = 0.2
"""Largest width of a chain over the height of the camera."""

_BENT = math.radians(4.0)
"""Angle between two links and the next two from which a chain is not straight [rad]."""

_USUAL = (-0.5, 5.0)
"""Elongation that a chain in service has [%]."""


@dataclass(frozen=True)
class ChainBeside:
    """Where a chain lies in a picture, and how many links of it are to be measured."""

    ends: tuple[float, float, float, float]  # two pins: x1, y1, x2, y2 [px]
    links: int  # between them, even
    width: float  # over the ends of a pin [mm]


@dataclass(frozen=True, eq=False)
class SeenChain:
    """The length of a chain in a picture."""

    links: int
    length: float  # of them [mm]
    new_length: float  # of so many pitches [mm]
    length_error: float  # standard error of the length [mm]
    pins: Vector  # every second one, in the picture [px], shape (n, 2)
    outline: Vector  # of what the chain may cover, to the edges of the picture [px], shape (4, 2)
    bend: float  # largest angle between two links and the next two [rad]

    @property
    def assumption(self) -> str:
        """What the length rests on."""
        return (
            "the chain lies flat on its side, on the sheet or on the same table, pulled straight; its pins "
            f"are seen at {_TOP[0]:.0%} of its width over them"
        )

    @property
    def elongation(self) -> float:
        """How much longer it is than new [%]."""
        return 100.0 * (self.length / self.new_length - 1.0)

    @property
    def elongation_error(self) -> float:
        """Standard error of the elongation [%]."""
        return 100.0 * self.length_error / self.new_length

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is doubtful about it."""
        return tuple(self._doubts())

    def _doubts(self) -> Iterator[str]:
        if self.bend > _BENT:
            yield "the chain is not straight, so its links may not be pulled apart: lay it along a ruler"
        low, high = _USUAL
        if not low - 2.0 * self.elongation_error < self.elongation < high:
            yield (
                f"the chain is {self.elongation:+.1f} % longer than new, which no chain in service is: check "
                "its designation, its width over the pins, and the ruler of the sheet"
            )


@dataclass(frozen=True, eq=False)
class _Plane:
    """The plane of the chain's upper plates, above the sheet and parallel to it; lengths in mm."""

    sheet: SeenSheet
    shrink: float  # height of the camera above the plane over that above the sheet

    def points(self, seen: Vector, projection: Projection | None = None) -> Vector:
        """Return the points of the plane that are seen somewhere in the picture [px], shape (n, 2)."""
        camera, below = self.sheet.camera, self.sheet.camera.position[:2]
        on_sheet = (projection or camera.projection).behind(seen)
        return np.asarray((below + (on_sheet - below) * self.shrink) * self.sheet.stretch)

    def seen(self, points: Vector) -> Vector:
        """Return points of the plane in the picture [px], shape (..., 2)."""
        camera, below = self.sheet.camera, self.sheet.camera.position[:2]
        return camera.projection.seen(below + (points / self.sheet.stretch - below) / self.shrink)


def measure_chain(
    photograph: Photograph, sheet: SeenSheet | None, chain: Chain, asked: ChainBeside
) -> SeenChain:
    """Return the length of a chain that lies on its side, on the sheet or beside it.

    The picture around every second pin is moved onto the mean of them all, so the pins may look like
    anything, as long as they look alike. The length is the sum of the distances between them.

    Only the round ends of plates are looked at, as what lies lower is seen beside them in other places.

    Raises CaseError where there is no sheet or the height of the camera is not known, and where the pins are
    not in the picture, do not look alike, or are not as many links apart.
    """
    if sheet is None:
        raise bad_photograph(
            photograph.name,
            "a marker sheet must be visible if a chain beside the wheel is to be measured, but too few dots "
            "were found: print one with --sheet, and lay the wheel on it",
        )
    if asked.links % _STEP:
        raise bad_photograph(
            photograph.name,
            f"the number of links between the two pins of the chain must be even, as inner and outer links "
            f"take turns (got {asked.links}): choose pins that look alike",
        )
    if not sheet.height_known:
        raise bad_photograph(
            photograph.name,
            "the height of the camera must be known if a chain is to be measured, but the picture states no "
            "focal length and is hardly tilted: use the original file from the camera, not a copy without "
            "its metadata",
        )
    height = sheet.height
    if not asked.width < _WIDEST * height:
        raise bad_photograph(
            photograph.name,
            f"the chain must be narrower than {_WIDEST * height:.0f} mm below a camera {height:.0f} mm above "
            f"the sheet, but {asked.width:g} mm is given: correct its width",
        )
    check_width(photograph, chain, asked.width)
    pitch = chain.pitch
    plane = _Plane(sheet, 1.0 - _TOP[0] * asked.width / height)
    ends = np.array(asked.ends, dtype=float).reshape(2, 2)
    first, last = plane.points(ends)
    _check_ends(photograph, plane, first, last, pitch, asked.links)
    outline = _outline(photograph, plane, first, last, pitch)
    light = _ChainLight(photograph, plane, first, last, pitch)
    first, last = light.centred(first, last), light.centred(last, first)
    places = light.walked(first, last)
    found = _STEP * (len(places) - 1)
    if found != asked.links:
        raise bad_photograph(
            photograph.name,
            f"there must be {asked.links} links between the two pins of the chain as given, but {found} of "
            f"{pitch:g} mm are seen: give the middles of the pins, and count the links between them again",
        )
    places, alike = light.aligned(places)
    if not (alike > _ALIKE and math.dist(places[-1], last) < _SEARCH * pitch):
        raise bad_photograph(
            photograph.name,
            "every second pin of the chain must look alike, but one does not: lay the chain on its side, "
            "light it evenly, and choose pins at least one link from the ends of the chain",
        )
    pins = plane.seen(places)
    length, new_length = _length(places), asked.links * pitch
    changes = np.diff(np.hypot(*np.diff(places, axis=0).T))
    scatter = math.sqrt(float((changes**2).mean()) / 6.0) if changes.size else 0.0
    error = length * math.hypot(
        sheet.print_error,
        sheet.camera.error_of(lambda projection: _length(plane.points(pins, projection))),
        _TOP[0] * asked.width / height * sheet.camera.height_error,
        _TOP[1] * asked.width / height,
        math.sqrt(2.0) * max(scatter, _LEAST_ERROR / light.scale) / length,
    )
    ways = np.diff(places, axis=0)
    turns = np.abs(np.diff(np.unwrap(np.arctan2(ways[:, 1], ways[:, 0]))))
    return SeenChain(
        asked.links, length, new_length, error, pins, outline, bend=float(turns.max(initial=0.0))
    )


def _outline(photograph: Photograph, plane: _Plane, first: Vector, last: Vector, pitch: float) -> Vector:
    """Return the corners of a strip along the chain that reaches beyond the picture [px]."""
    way = (last - first) / math.dist(first, last)
    aside = 0.65 * pitch * np.array([-way[1], way[0]])
    start, end, left, right = plane.seen(np.array([first, last, first + aside, first - aside]))
    far = (end - start) / math.dist(start, end) * (photograph.width + photograph.height)
    left, right = left - start, right - start
    return np.array([start - far + left, start + far + left, start + far + right, start - far + right])


def check_width(photograph: Photograph, chain: Chain, width: float) -> None:
    """Raise for a width that no chain of this inner width has over its pins."""
    if chain.strands > 1 and not chain.transverse_pitch:
        return
    others = (chain.strands - 1) * chain.transverse_pitch
    low, high = (round(part * chain.inner_width + others, 1) for part in _WIDTHS)
    if not low <= width <= high:
        raise bad_photograph(
            photograph.name,
            f"a chain whose inner width is {chain.inner_width:g} mm must be {low:g} to {high:g} mm wide over "
            f"the ends of a pin, but {width:g} mm is given: measure it with a calliper, or correct the chain",
        )


def _check_ends(
    photograph: Photograph, plane: _Plane, first: Vector, last: Vector, pitch: float, links: int
) -> None:
    """Raise where pins are not in the picture, or not about so many links apart."""
    size = np.array([photograph.width, photograph.height])
    around = _INSIDE * pitch * np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
    seen = plane.seen(np.concatenate([first + around, last + around]))
    if not ((seen >= 0.0) & (seen <= size)).all():
        raise bad_photograph(
            photograph.name,
            f"both pins of the chain must lie well inside the picture of {size[0]} x {size[1]} pixels: read "
            "them again, or choose others",
        )
    apart = math.dist(first, last)
    if not 0.7 < apart / (links * pitch) < 1.4:
        raise bad_photograph(
            photograph.name,
            f"the two pins of the chain must be {links} links of {pitch:g} mm apart, but lie {apart:.0f} mm "
            "apart: give the middles of the pins, and count the links between them again",
        )


def _length(places: Vector) -> float:
    return float(np.hypot(*np.diff(places, axis=0).T).sum())


@dataclass(frozen=True, eq=False)
class _Pattern:
    """What a pin looks like."""

    mean: Vector  # light around it, rows across the chain and columns along it
    solution: Vector  # what turns a difference of light into millimetres along and across


class _ChainLight:
    """The light of a chain by places of its plane."""

    def __init__(
        self, photograph: Photograph, plane: _Plane, first: Vector, last: Vector, pitch: float
    ) -> None:
        self._plane, self._pitch = plane, pitch
        middle = 0.5 * (first + last)
        near = plane.seen(middle + np.array([[0.0, 0.0], [1.0, 0.0]]))
        self.scale = math.dist(*near)
        """Pixels of a millimetre."""
        self._step, self._coarse = max(1.0 / self.scale, pitch / _FINE), pitch / _COARSE
        reach = 1.5 * pitch * self.scale
        corners = plane.seen(np.array([first, last]))
        size = np.array([photograph.width, photograph.height])
        (left, top), (right, bottom) = (
            np.clip(np.rint(at), 0, size).astype(int)
            for at in (corners.min(axis=0) - reach, corners.max(axis=0) + reach)
        )
        self._corner = np.array([left, top])
        light = photograph.light[top:bottom, left:right].astype(float)
        self._fine = spline_filter(light)
        self._smooth = spline_filter(gaussian_filter(light, 0.4 * self._coarse * self.scale))

    def centred(self, place: Vector, towards: Vector) -> Vector:
        """Return the middle of a pin near a place: turned by half a turn it looks the same."""
        frame = _frame(towards - place)
        windows = self._windows(place, frame)
        off = windows - windows.mean(axis=-1, keepdims=True)
        spread = off.std(axis=-1)
        alike = (off * off[..., ::-1]).mean(axis=-1) / np.maximum(spread, 0.2 * spread.max()) ** 2
        return place + self._way_to(alike) @ frame

    def walked(self, first: Vector, last: Vector) -> Vector:
        """Return every second pin from one to the other, each where it looks like the first one."""
        way = _STEP * self._pitch * (last - first) / math.dist(first, last)
        places, frame = [first], _frame(way)
        pattern = self._pattern([first], [frame])
        while math.dist(places[-1], last) > 0.5 * _STEP * self._pitch:
            expected = places[-1] + way
            if (expected - last) @ way > 0.5 * _STEP * self._pitch * math.hypot(*way):
                break
            near = expected + self._off(places[-1], expected, frame) @ frame
            found = self._moved(near, frame, pattern)
            way, places = found - places[-1], [*places, found]
            frame = _frame(way)
        return np.array(places)

    def _off(self, known: Vector, expected: Vector, frame: Vector) -> Vector:
        """Return how far along and across from a place it looks most like around a known one [mm]."""
        pattern = _normed(self._around(known, frame, self._smooth, self._coarse))
        windows = self._windows(expected, frame)
        spread = np.maximum(windows.std(axis=-1), 1e-12)
        return self._way_to((windows * pattern[_disc(len(pattern))]).mean(axis=-1) / spread)

    def _windows(self, place: Vector, frame: Vector) -> Vector:
        """Return the light around all places near one, by their way across the chain and along it."""
        inside = _disc(2 * self._count(self._coarse) + 1)
        wide = self._around(place, frame, self._smooth, self._coarse, _REACH)
        return np.asarray(sliding_window_view(wide, inside.shape)[..., inside])

    def _way_to(self, alike: Vector) -> Vector:
        """Return the way along and across to what of the windows is most alike [mm]."""
        across, along = np.unravel_index(int(alike.argmax()), alike.shape)
        return self._coarse * np.array([along - _REACH, across - _REACH], dtype=float)

    def aligned(self, places: Vector) -> tuple[Vector, float]:
        """Return pins moved onto the mean of them all, and the least correlation with it."""
        for _ in range(3):
            frames = [_frame(way) for way in np.asarray(np.gradient(places, axis=0))]
            pattern = self._pattern(places, frames)
            places = np.array([self._moved(*at, pattern) for at in zip(places, frames, strict=True)])
        inside = _disc(len(pattern.mean))
        taken = [self._fine_around(*at)[inside] for at in zip(places, frames, strict=True)]
        mean = pattern.mean[inside]
        return places, min(float((mean * one).mean() / mean.std()) for one in taken)

    def _pattern(self, places: Iterable[Vector], frames: Iterable[Vector]) -> _Pattern:
        """Return what some pins look like in the mean."""
        mean = np.mean([self._fine_around(*at) for at in zip(places, frames, strict=True)], axis=0)
        inside = _disc(len(mean))
        slopes = [np.gradient(mean, self._step, axis=axis)[inside] for axis in (1, 0)]
        rows = np.column_stack([*slopes, np.ones(slopes[0].size), mean[inside]])
        return _Pattern(mean, np.linalg.pinv(rows)[:2])

    def _moved(self, place: Vector, frame: Vector, pattern: _Pattern) -> Vector:
        """Return the place nearby that looks like a pattern, but for its level and contrast."""
        farthest, inside = 0.1 * self._pitch, _disc(len(pattern.mean))
        for _ in range(15):
            # What is taken too far along shows what the pattern shows there.
            off = pattern.solution @ (self._fine_around(place, frame) - pattern.mean)[inside]
            place = place - np.clip(off, -farthest, farthest) @ frame
            if math.hypot(*off) < 1e-3 / self.scale:
                break
        return place

    def _fine_around(self, place: Vector, frame: Vector) -> Vector:
        return _normed(self._around(place, frame, self._fine, self._step))

    def _count(self, step: float) -> int:
        """Return the samples from a pin to the end of what is looked at."""
        return round(_AROUND * self._pitch / step)

    def _around(self, place: Vector, frame: Vector, spline: Vector, step: float, more: int = 0) -> Vector:
        """Return the light around a place, rows across the chain and columns along it."""
        count = self._count(step) + more
        way = step * np.arange(-count, count + 1)
        points = place + np.stack(np.meshgrid(way, way), axis=-1) @ frame
        x, y = np.moveaxis(self._plane.seen(points) - self._corner, -1, 0)
        return np.asarray(map_coordinates(spline, [y, x], order=3, mode="nearest", prefilter=False))


def _frame(way: Vector) -> Vector:
    """Return unit vectors along and across a way, as rows."""
    x, y = way / math.hypot(*way)
    return np.array([[x, y], [-y, x]])


@cache
def _disc(size: int) -> Mask:
    """Return what of a square of so many samples lies in the circle in it."""
    way = np.linspace(-1.0, 1.0, size)
    return np.asarray(np.hypot(way[:, None], way) <= 1.0)


def _normed(light: Vector) -> Vector:
    """Return light around a pin about its mean, over its standard deviation."""
    inside = light[_disc(len(light))]
    return np.asarray((light - inside.mean()) / max(float(inside.std()), 1e-12))
