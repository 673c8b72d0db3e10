"""The camera over a marker sheet: perspective and lens from the dots, and how high it was."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import OptimizeResult, least_squares

from wearsim.geometry.profile_points import Vector
from wearsim.scanning.marker_grid import Numbers, dot_points
from wearsim.scanning.projection import NUMBERS, Projection, homography

_UNIT = 100.0
"""Unit of the sheet's plane [mm]."""

_LENS = (0.1, 0.05)
"""Standard deviations of the distortion by the second and the fourth power, before the dots are seen."""

_FAR_OFF = 5.0
"""Standard deviations from which a dot is taken for partly covered."""

_USUAL = 50.0
"""Focal length of a camera of 24 x 36 mm that a telephone is like, if none is noted [mm]: 26 mm plain, and
up to 120 mm zoomed in from afar, as the instructions say.
"""

_FOCAL_ERRORS = (0.5, 0.05)
"""Standard deviations of its logarithm, and of one that is noted."""

_OFF_MIDDLE = 0.01
"""Standard deviation of the lens's axis from the middle of the picture, over the larger side."""

_STRETCH = 2e-3
"""Standard deviation of what a printer stretches one direction more than the other, relative."""


@dataclass(frozen=True, eq=False)
class SheetCamera:
    """How a sheet is seen, and from where; lengths in mm of the sheet as it was drawn."""

    projection: Projection  # of the sheet's plane, its origin that of the dots
    covariance: Vector  # of its numbers and the second distortion
    noise: float  # standard deviation of a dot in each direction [px]
    focal_length: float  # [px]
    position: Vector  # of the camera: across, up and above the sheet, shape (3,)
    height_error: float  # standard deviation of its height above the sheet, relative
    tilt: float  # of the line of sight against the normal of the sheet [rad]
    tilt_error: float  # standard deviation of that [rad]

    @property
    def height(self) -> float:
        """Height of the camera above the sheet."""
        return float(self.position[2])

    @property
    def distortion_error(self) -> float:
        """Standard deviation of the distortion."""
        return math.sqrt(self.covariance[NUMBERS - 1, NUMBERS - 1])

    def scale(self, point: Vector) -> float:
        """Pixels of a millimetre at a point of the sheet."""
        return float(np.sqrt(abs(np.linalg.det(self.projection.by_place(point)))))

    def scale_error(self, point: Vector) -> float:
        """Relative standard deviation of that by the scatter of the dots."""
        return self.error_of(lambda projection: replace(self, projection=projection).scale(point))

    def error_of(self, measured: Callable[[Projection], float]) -> float:
        """Relative standard deviation of what is measured by the projection, by the scatter of the dots."""
        numbers, steps = _numbers(self.projection), _steps(self.projection)
        slopes = [
            math.log(measured(_with(self.projection, numbers + step)))
            - math.log(measured(_with(self.projection, numbers - step)))
            for step in steps
        ]
        slope = np.array(slopes) / (2.0 * steps.diagonal())
        return math.sqrt(slope @ self.covariance @ slope)


def sheet_camera(dots: Numbers, points: Vector, size: tuple[int, int], noted: float | None) -> SheetCamera:
    """Return the camera that sees dots at points of a picture.

    The focal length that the camera noted [px] helps with its height above the sheet.
    """
    flat = dot_points(dots)
    start = _start(flat, points, size)
    numbers, kept = _numbers(start), np.ones(len(points), dtype=bool)
    for _ in range(3):
        fitted = _fit(start, numbers, flat[kept], points[kept])
        numbers = fitted.x
        off = np.hypot(*(_with(start, numbers).seen(flat) - points).T)
        kept = off < _FAR_OFF * max(float(np.median(off)) / 1.177, 0.01)
    noise = math.sqrt(float((off[kept] ** 2).sum()) / max(2 * int(kept.sum()) - len(numbers), 1))
    rows, prior = np.split(np.asarray(fitted.jac), [-2])
    covariance = np.linalg.inv(rows.T @ rows / noise**2 + prior.T @ prior)
    projection = _with(start, numbers)
    return SheetCamera(projection, covariance, noise, *_pose(projection, max(size), noted))


def _start(flat: Vector, points: Vector, size: tuple[int, int]) -> Projection:
    seen = homography(flat / _UNIT, points)
    sides = np.array(size, dtype=float)
    return Projection(
        matrix=seen[:2, :2],
        centre=seen[:2, 2],
        slant=seen[2, :2],
        distortion=0.0,
        middle=0.5 * (sides - 1.0),
        reach=0.5 * float(sides.min()),
        radius=_UNIT,
    )


def _numbers(projection: Projection) -> Vector:
    return np.concatenate(
        [
            projection.matrix.ravel(),
            projection.centre,
            projection.slant,
            [projection.distortion, projection.second_distortion],
        ]
    )


def _with(projection: Projection, numbers: Vector) -> Projection:
    return replace(
        projection,
        matrix=numbers[:4].reshape(2, 2),
        centre=numbers[4:6],
        slant=numbers[6:8],
        distortion=float(numbers[8]),
        second_distortion=float(numbers[9]),
    )


def _steps(projection: Projection) -> Vector:
    """Return a small change of each number, as rows."""
    size = math.sqrt(abs(np.linalg.det(projection.matrix)))
    return np.diag(1e-5 * np.array([size] * 6 + [1.0] * 4))


def _fit(start: Projection, numbers: Vector, flat: Vector, points: Vector) -> OptimizeResult:
    sizes = _steps(start).diagonal()

    def off(changed: Vector) -> Vector:
        seen = _with(start, changed).seen(flat)
        return np.concatenate([(seen - points).ravel(), changed[8:] / _LENS])

    return least_squares(off, numbers, x_scale=1e5 * sizes)


def _pose(
    projection: Projection, larger: int, noted: float | None
) -> tuple[float, Vector, float, float, float]:
    """Return focal length [px], place of the camera [mm], relative error of its height, tilt and its error.

    Both axes of the sheet must be square and of one scale, which tells the focal length where the camera is
    tilted.
    """
    usual = _USUAL * math.hypot(*(2.0 * projection.middle + 1.0)) / math.hypot(24.0, 36.0)
    middle, width = math.log(noted or usual), _FOCAL_ERRORS[noted is not None]
    axis = _OFF_MIDDLE * larger

    def off(unknown: Vector) -> Vector:
        first, second, _ = _axes(projection, unknown).T
        lengths = np.linalg.norm(first), np.linalg.norm(second)
        return np.array(
            [
                first @ second / (lengths[0] * lengths[1]) / _STRETCH,
                math.log(lengths[0] / lengths[1]) / _STRETCH,
                (unknown[0] - middle) / width,
                *(unknown[1:] / axis),
            ]
        )

    found = least_squares(off, np.array([middle, 0.0, 0.0]), x_scale=(width, axis, axis))
    rows = np.asarray(found.jac)
    covariance = np.linalg.inv(rows.T @ rows)
    position, tilt = _place(_axes(projection, found.x))
    slopes = []
    for step in np.diag([1e-4, 1e-4 * axis, 1e-4 * axis]):
        (higher, more), (lower, less) = (
            _place(_axes(projection, found.x + sign * step)) for sign in (1.0, -1.0)
        )
        change = np.array([math.log(higher[2] / lower[2]), more - less])
        slopes.append(change / (2.0 * step.max()))
    height_error, tilt_error = np.sqrt(np.einsum("ki,kl,li->i", slopes, covariance, slopes))
    return math.exp(found.x[0]), position, float(height_error), tilt, float(tilt_error)


def _axes(projection: Projection, unknown: Vector) -> Vector:
    """Return both axes of the sheet and its origin as the camera sees them, as columns."""
    focal_length = math.exp(unknown[0])
    homogeneous = np.vstack(
        [np.column_stack([projection.matrix / _UNIT, projection.centre]), [*(projection.slant / _UNIT), 1.0]]
    )
    to_axis = np.array(
        [
            [1.0, 0.0, -projection.middle[0] - unknown[1]],
            [0.0, 1.0, -projection.middle[1] - unknown[2]],
            [0.0, 0.0, focal_length],
        ]
    )
    return np.asarray(to_axis @ homogeneous / focal_length)


def _place(axes: Vector) -> tuple[Vector, float]:
    """Return the camera's place over the sheet [mm] and its tilt [rad]."""
    first, second, origin = axes.T
    size = math.sqrt(float(np.linalg.norm(first) * np.linalg.norm(second)))
    first, second, origin = first / size, second / size, origin / size
    normal = np.cross(first, second)
    normal /= np.linalg.norm(normal)
    place = -np.array([first @ origin, second @ origin, normal @ origin])
    return np.array([*place[:2], abs(place[2])]), math.acos(min(1.0, abs(float(normal[2]))))
