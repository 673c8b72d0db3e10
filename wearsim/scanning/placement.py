"""The wheel in its photograph: all gaps at once, by what does not wear."""

import math
from collections.abc import Callable
from copy import copy
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.signal import savgol_filter

from wearsim.geometry.profile_points import Vector
from wearsim.scanning.new_wheel import NewWheel, Stations, around
from wearsim.scanning.photograph import Photograph, bad_photograph
from wearsim.scanning.projection import NUMBERS, Projection, SeenStations, seen_stations
from wearsim.scanning.silhouette import Silhouette
from wearsim.scanning.subpixel_edges import Blur, EdgeImage

_TIP, _BIAS, _SIDES = NUMBERS, NUMBERS + 1, NUMBERS + 2
"""Places of the tip circle, of the bias of all edges and of the sides of teeth among the unknowns."""

SEARCH = 0.15
"""Distance over the pitch within which an edge is looked for."""

_SEARCH_AGAIN = 0.05
"""The same about the mean edge of all gaps, once that is known."""

_WINDOW = 0.06
"""Part of a gap's length over which depths are smoothed."""

_MOST_STATIONS = 320
_CORNER = 0.06
"""Part of the gap's half length at its tips that is left out: corners are rounded by blur and burrs."""

_TIP_TOLERANCE = 0.03
"""Standard deviation of the tip circle's radius over the pitch: standards leave it free within limits."""

_DISTORTION = 2e-3
"""Standard deviation of the distortion of a telephone's lens at half the smaller side of its picture."""

_EDGE_BIAS = 0.03
"""Standard deviation of what unknown tone curves move all edges by, over the blur."""

_MISFIT_BIAS = 5.0
"""How much farther bright rims and shadows move them, over the blur and what they change of the light."""
CHAMFER_ERROR = 0.25
"""Standard deviation of the thickness at the edges over that of the teeth: edges are chamfered."""

_ALIKE = 0.02
"""Standard deviation of what moves a stretch of the edge alike in all gaps: light, blur, pixels [px]."""

_STRETCHES = 8
"""Stretches of a gap in which that differs."""

_ONE_SIDE = 0.4
"""Depth of the flank that places the wheel over that of the loaded one, from which the other is tried."""

_LEAST_PITCH = 24.0
"""Pixels of a pitch from which teeth are measured; over the blur at least as many."""

_STEPS, _AGAIN = 8, 5
"""Steps once the loaded side is known, and again once the scale is."""

_UNWORN = 2.5
"""Standard errors by which the mean of all gaps may lack steel where it does not wear."""

Flags = NDArray[np.bool_]


class KnownScale(NamedTuple):
    """Pixels of a millimetre that are known from elsewhere."""

    scale: float  # [px/mm]
    error: float  # standard deviation, relative
    words: str  # where it is from
    remedy: str = "check both"  # where it differs from that of the teeth


@dataclass(frozen=True, eq=False)
class KnownCamera:
    """What is known of a camera and of the thickness of teeth beforehand."""

    distortion: float = 0.0
    distortion_error: float = _DISTORTION  # standard deviation
    second_distortion: float = 0.0
    half_thickness: float = 0.0  # of the teeth [mm], 0 where they are taken for flat
    sides_error: float = CHAMFER_ERROR  # standard deviation of what is seen of the sides of teeth, relative
    # returns where the camera is over the middle plane of a wheel [mm], shape (3,)
    place: Callable[[Projection], Vector] = lambda projection: np.array([0.0, 0.0, 1.0])

    def sides(self, projection: Projection, points: Vector, normals: Vector) -> Vector:
        """Return how far outside of their middle plane edges are seen [mm]: by the face nearer to there."""
        *below, height = self.place(projection)
        return np.asarray(self.half_thickness * np.abs(((points - below) * normals).sum(axis=-1)) / height)


ANY_CAMERA = KnownCamera()


@dataclass(frozen=True, eq=False)
class Edges:
    """Edges of all gaps and tips, beside where the placed wheel has them."""

    gaps: SeenStations  # of shape (teeth, stations)
    off: Vector  # how far outside of the new form the edge is [px], nan without one, shape (teeth, stations)
    tips: SeenStations  # of shape (teeth, tip stations)
    tips_off: Vector  # the same of the tips
    sides: Vector  # how far outside edges are seen by the thickness of the teeth [px], like `off`
    tips_sides: Vector


@dataclass(frozen=True, eq=False)
class Placement:
    """The new wheel where it fits its photograph, and how surely."""

    wheel: NewWheel
    stations: Stations
    projection: Projection
    edges: Edges
    bias: float  # by which all edges are found too far outside [px]
    tip_change: float  # of the tip circle's radius [mm]
    blur: float  # standard deviation of the blur of edges [px]
    edge_misfit: float  # how far their light is off a blurred step, over the contrast
    noise: float  # standard deviation of one edge [px]
    correlation: float  # edges that stand for one of their own
    covariance: Vector  # of all unknowns
    unworn: Flags  # stations that place the wheel
    left_worn: bool  # whether the gaps' left side is the loaded one
    known: KnownScale | None = None  # what the scale was known from, beside the form
    form_scale: float = math.nan  # the scale by the form alone, where it is known from elsewhere [px/mm]

    @property
    def scale(self) -> float:
        """Pixels of a millimetre."""
        return self.projection.scale

    @property
    def depth(self) -> Vector:
        """How deep the edge lies below the new form [mm], nan without one, shape (teeth, stations)."""
        return np.asarray((self.bias - self.edges.off) / self.edges.gaps.stretch)

    @property
    def away_share(self) -> float:
        """Greatest mean depth of the side that places the wheel, over that of the loaded one."""
        mean, side = _median(self.depth), self.stations.from_middle * (1.0 if self.left_worn else -1.0)
        inner = np.abs(side) < 1.0 - _CORNER
        loaded, away = (float(mean[inner & (sign * side > 0.1)].max()) for sign in (1.0, -1.0))
        return away / max(loaded, 1e-9)

    @property
    def lacks_on_one_side(self) -> bool:
        """Whether steel is missing on the loaded side alone, or nearly so."""
        return self.away_share < _ONE_SIDE

    @property
    def depth_by_unknowns(self) -> Vector:
        """Mean over all gaps of the derivatives of the depth by the unknowns, shape (stations, 12)."""
        points = around(self.stations.points, self.wheel.teeth)
        rows = _rows(self.projection, points, self.edges.gaps, self.edges.sides, tip=False)
        return np.asarray((rows / self.edges.gaps.stretch[..., None]).mean(axis=0))


def place_wheel(
    photograph: Photograph,
    wheel: NewWheel,
    seen: Silhouette,
    known: Callable[[Projection], KnownScale] | None = None,
    camera: KnownCamera = ANY_CAMERA,
) -> Placement:
    """Return the wheel placed in its photograph; of an asymmetric one the side that fits better.

    What the scale is known from is looked up in the wheel's plane, where the form alone has placed it.
    """
    image = edge_image(photograph, seen)
    start = first_projection(photograph, wheel, seen, camera)
    ways = [wheel] if wheel.symmetric else [wheel, wheel.mirrored]
    found = [_Fit(photograph.name, image, way, start, camera).placed() for way in ways]
    best, fit = min(found, key=lambda pair: pair[0].noise)
    if known is None:
        return best
    fit.known = known(best.projection)
    return replace(fit.settled(_AGAIN), known=fit.known, form_scale=best.scale)


def smoothing_window(stations: int) -> int:
    """Return how many stations of a gap are smoothed together."""
    return max(7, 2 * int(0.5 * _WINDOW * stations) + 1)


def edge_bias(blur: float, misfit: float) -> float:
    """Return the standard deviation of what moves all edges alike [px]."""
    return blur * math.hypot(_EDGE_BIAS, _MISFIT_BIAS * misfit)


def edge_image(photograph: Photograph, seen: Silhouette) -> EdgeImage:
    """Return the light of a photograph with the wheel as its dark side."""
    return EdgeImage(photograph.light if seen.light_ground else -photograph.light)


def first_projection(
    photograph: Photograph, wheel: NewWheel, seen: Silhouette, camera: KnownCamera
) -> Projection:
    """Return the projection that the silhouette tells."""
    upright = np.array([[1.0, 0.0], [0.0, -1.0]])
    turn = seen.gap_angle - 0.5 * math.pi
    turned = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    matrix = seen.spread @ upright @ turned
    matrix *= wheel.tip_radius * math.sqrt(seen.area / wheel.area / abs(np.linalg.det(matrix)))
    size = np.array([photograph.width, photograph.height], dtype=float)
    return Projection(
        matrix=matrix,
        centre=seen.centre,
        slant=np.zeros(2),
        distortion=camera.distortion,
        middle=0.5 * (size - 1.0),
        reach=0.5 * float(size.min()),
        radius=wheel.tip_radius,
        second_distortion=camera.second_distortion,
    )


def _rows(projection: Projection, points: Vector, seen: SeenStations, sides: Vector, tip: bool) -> Vector:
    """Return the derivatives of edges outwards [px] by the unknowns, shape (..., 12)."""
    by_numbers = np.einsum("...i,...ij->...j", seen.normals, projection.by_numbers(points))
    by_tip = seen.stretch if tip else np.zeros_like(seen.stretch)
    others = np.stack([by_tip, np.ones_like(by_tip), sides], axis=-1)
    return np.concatenate([by_numbers, others], axis=-1)


class _Fit:
    """Gauss-Newton steps on all edges, found anew after each of them."""

    def __init__(
        self, name: str, image: EdgeImage, wheel: NewWheel, start: Projection, camera: KnownCamera
    ) -> None:
        self.name, self.image, self.wheel, self.projection = name, image, wheel, start
        self.known: KnownScale | None = None
        self.camera = camera
        pixels = wheel.pitch * start.scale
        self.stations = wheel.stations(int(min(_MOST_STATIONS, max(60.0, 2.0 * pixels))))
        self.points = around(self.stations.points, wheel.teeth)
        self.normals = around(self.stations.normals, wheel.teeth)
        self.tip_points, self.tip_normals = _tips(wheel, int(max(3.0, 0.1 * pixels)))
        self.tip = self.bias = 0.0
        self.sides = 1.0
        self.blur, self.edge_misfit = 1.0, 0.0
        self.left_worn = True
        side = self.stations.from_middle
        self.inner = np.abs(side) < 1.0 - _CORNER
        self.expected = np.zeros(side.size)

    def placed(self) -> "tuple[Placement, _Fit]":
        """Return the wheel where it fits best, and the fit that goes on from there."""
        unworn = self.inner.copy()
        for _ in range(4):
            edges = self._edges(refined=False)
            self._step(edges, unworn)
        edges = self._edges(refined=False)
        self.blur, self.edge_misfit = self._blur(edges)
        self._check_resolution()
        for _ in range(2):
            self._step(self._edges(), unworn)
        left = self._lacks_more_on_left(self._edges())
        found = self._worn_on(left)
        if found[0].lacks_on_one_side:
            return found
        return min(found, self._worn_on(not left), key=lambda pair: pair[0].away_share)

    def _worn_on(self, left: bool) -> "tuple[Placement, _Fit]":
        """Return the wheel where it fits best by all but the left side of its gaps, or the right one."""
        fit = copy(self)
        fit.left_worn = left
        return fit.settled(_STEPS), fit

    def settled(self, steps: int) -> Placement:
        """Return the wheel where it fits best from where it is."""
        edges = self._edges()
        for count in range(steps):
            unworn = self._unworn(edges, first=count < 2)
            solved = self._step(edges, unworn)
            edges = self._edges()
        return Placement(
            wheel=self.wheel,
            stations=self.stations,
            projection=self.projection,
            edges=edges,
            bias=self.bias,
            tip_change=self.tip,
            blur=self.blur,
            edge_misfit=self.edge_misfit,
            noise=solved.noise,
            correlation=solved.correlation,
            covariance=solved.covariance,
            unworn=unworn,
            left_worn=self.left_worn,
        )

    def _edges(self, refined: bool = True) -> Edges:
        tip_points = self.tip_points * (1.0 + self.tip / self.wheel.tip_radius)
        gaps = seen_stations(self.projection, self.points, self.normals)
        tips = seen_stations(self.projection, tip_points, self.tip_normals)
        sides = gaps.stretch * self.camera.sides(self.projection, self.points, self.normals)
        tips_sides = tips.stretch * self.camera.sides(self.projection, tip_points, self.tip_normals)
        off = self._off(gaps, self.expected + self.sides * sides, refined) - self.sides * sides
        with np.errstate(all="ignore"):
            curvature = self._worn_curvature(np.nan_to_num(_median(off)) / gaps.stretch.mean(axis=0))
            # A blurred edge that is bent lies nearer to the middle of its curvature.
            off = off - 0.5 * self.blur**2 * curvature / gaps.stretch
            self.expected = np.nan_to_num(_median(off))
        tips_off = self._off(tips, self.sides * tips_sides, refined) - self.sides * tips_sides
        return Edges(gaps, off, tips, tips_off, sides, tips_sides)

    def _worn_curvature(self, outside: Vector) -> Vector:
        """Curvature of the mean edge, which lies so far outside of the new form [1/mm]."""
        step = float(self.stations.way[1] - self.stations.way[0])
        window = smoothing_window(outside.size)
        return self.stations.curvature + savgol_filter(outside, window, 2, deriv=2, delta=step)

    def _off(self, seen: SeenStations, expected: Vector, refined: bool) -> Vector:
        points, normals, there = seen.points.reshape(-1, 2), seen.normals.reshape(-1, 2), expected.ravel()
        pixels = self.wheel.pitch * self.projection.scale
        if not refined:
            found = self.image.crossings(points, normals, there, max(8.0, SEARCH * pixels))
            return found.reshape(seen.stretch.shape)
        about = points + there[:, None] * normals
        found = self.image.crossings(about, normals, np.zeros_like(there), max(8.0, _SEARCH_AGAIN * pixels))
        found = there + self.image.refined(about, normals, found, self.blur)
        return found.reshape(seen.stretch.shape)

    def _blur(self, edges: Edges) -> Blur:
        return self.image.blur(
            edges.gaps.points.reshape(-1, 2), edges.gaps.normals.reshape(-1, 2), edges.off.ravel()
        )

    def _check_resolution(self) -> None:
        pixels = self.wheel.pitch * self.projection.scale
        least = _LEAST_PITCH * max(1.0, self.blur)
        if pixels < least:
            raise bad_photograph(
                self.name,
                f"a pitch must be at least {least:.0f} pixels long, {_LEAST_PITCH:.0f} times the blur of "
                f"{self.blur:.1f} pixels, but has {pixels:.0f}: go closer, focus on the teeth, or use a "
                "camera with more pixels",
            )

    def _lacks_more_on_left(self, edges: Edges) -> bool:
        mean, side = _median(edges.off), self.stations.from_middle
        left, right = (float(np.nanmean(mean[self.inner & (sign * side > 0.15)])) for sign in (1.0, -1.0))
        return left < right

    def _unworn(self, edges: Edges, first: bool) -> Flags:
        """Return stations off the loaded side where the mean of all gaps lacks nothing of the new form."""
        side = self.stations.from_middle * (1.0 if self.left_worn else -1.0)
        away = self.inner & (side < 0.08)
        if first:
            return away
        off = edges.off - self.bias
        mean = _median(off)
        error = 1.4826 * _median(np.abs(off - mean)) / math.sqrt(self.wheel.teeth) + 0.015
        kept = away & (mean > -_UNWORN * error - 0.02)
        return kept if kept.sum() > 0.25 * away.sum() else away

    def _step(self, edges: Edges, unworn: Flags) -> "_Solved":
        """Move the wheel to where the edges are."""
        gap_rows = _rows(self.projection, self.points, edges.gaps, edges.sides, tip=False)[:, unworn]
        tip_rows = _rows(self.projection, self.tip_points, edges.tips, edges.tips_sides, tip=True)
        rows = np.concatenate([part.reshape(-1, _SIDES + 1) for part in (gap_rows, tip_rows)])
        off = np.concatenate([edges.off[:, unworn].ravel(), edges.tips_off.ravel()])
        solved = _solve(rows, off - self.bias, self._prior(), int(unworn.sum()), self.wheel.teeth)
        self.projection = self.projection.moved(solved.change[:NUMBERS])
        self.tip += float(solved.change[_TIP])
        self.bias += float(solved.change[_BIAS])
        self.sides += float(solved.change[_SIDES])
        return solved

    def _prior(self) -> "_Prior":
        """Return what is known of the unknowns beforehand: how far they are off that, and how surely."""
        bias = edge_bias(self.blur, self.edge_misfit)
        unit = np.eye(_SIDES + 1)
        rows = [
            unit[NUMBERS - 1] / self.camera.distortion_error,
            unit[_TIP] / (_TIP_TOLERANCE * self.wheel.pitch),
            unit[_BIAS] / bias,
            unit[_SIDES] / self.camera.sides_error,
        ]
        off = [
            (self.camera.distortion - self.projection.distortion) / self.camera.distortion_error,
            -self.tip / (_TIP_TOLERANCE * self.wheel.pitch),
            -self.bias / bias,
            (1.0 - self.sides) / self.camera.sides_error,
        ]
        if self.known is not None:
            by_numbers = np.concatenate([self.projection.scale_by_numbers, np.zeros(3)])
            rows.append(by_numbers / self.known.error)
            off.append(math.log(self.known.scale / self.projection.scale) / self.known.error)
        return _Prior(np.array(rows), np.array(off))


class _Prior(NamedTuple):
    rows: Vector  # in units of the standard deviations
    off: Vector


class _Solved(NamedTuple):
    change: Vector
    covariance: Vector
    noise: float
    correlation: float


def _solve(rows: Vector, off: Vector, prior: _Prior, stations: int, teeth: int) -> _Solved:
    """Return the change of the unknowns that fits best, with little weight for what is far off.

    Edges count for less than one of their own: neighbours share pixels, and what moves a stretch of the
    edge alike in all gaps does not go down with their number.
    """
    known = np.isfinite(off)
    rows, off = rows[known], off[known]
    change: Vector = np.zeros(rows.shape[1])
    shared = 1.0
    for _ in range(6):
        left = off - rows @ change
        noise = max(1.4826 * float(np.median(np.abs(left))), 1e-3)
        weight = np.clip(1.0 - (left / (4.7 * noise)) ** 2, 0.0, None) ** 2 / (noise**2 * shared)
        normal = (rows.T * weight) @ rows + prior.rows.T @ prior.rows
        change = np.asarray(np.linalg.solve(normal, (rows.T * weight) @ off + prior.rows.T @ prior.off))
        placed = np.full(known.size, np.nan)
        placed[known] = off - rows @ change
        correlation = _correlation(placed[: stations * teeth].reshape(teeth, stations), 4.7 * noise)
        shared = correlation + (_ALIKE / noise) ** 2 * teeth * stations / _STRETCHES
    return _Solved(change, np.asarray(np.linalg.inv(normal)), noise, correlation)


def _correlation(left: Vector, most: float) -> float:
    """Return how many neighbours along a gap say the same: the sum of their correlations."""
    left = np.where(np.abs(left) < most, left, np.nan)
    left = np.nan_to_num(left - np.nanmean(left))
    whole = float((left**2).sum())
    total = 1.0
    for lag in range(1, min(40, left.shape[1] - 1)):
        part = float((left[:, lag:] * left[:, :-lag]).sum()) / max(whole, 1e-12)
        if part < 0.05:
            break
        total += 2.0 * part
    return total


def _median(values: Vector) -> Vector:
    """Median over all gaps, 0 where no gap has an edge."""
    held = np.where(np.isfinite(values).any(axis=0), values, 0.0)
    return np.asarray(np.nanmedian(held, axis=0))


def _tips(wheel: NewWheel, count: int) -> tuple[Vector, Vector]:
    """Return points of the arcs over all tips [mm] and their normals, the corners left out."""
    start = math.atan2(*wheel.gap[-1][::-1])
    land = (math.atan2(*wheel.gap[0][::-1]) + math.tau / wheel.teeth - start) % math.tau
    angle = start + land * (np.linspace(0.25, 0.75, count) if land > 0.0 else np.full(count, 0.5))
    normals = np.column_stack([np.cos(angle), np.sin(angle)])
    return around(wheel.tip_radius * normals, wheel.teeth), around(normals, wheel.teeth)
