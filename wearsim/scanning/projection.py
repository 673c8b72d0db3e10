"""How the plane of a wheel is seen in a photograph: a homography and the distortion of a lens."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from wearsim.geometry.profile_points import Vector

_STEP = 1e-5
"""Over the size of a parameter, of differences that stand for derivatives."""

NUMBERS = 9
"""Parameters of a projection."""


@dataclass(frozen=True, eq=False)
class Projection:
    """Where points of a wheel's plane are in a picture.

    The plane is x to the right and y up as one sees it, in units of a radius; the picture counts
    pixels down.
    """

    matrix: Vector  # [px], shape (2, 2)
    centre: Vector  # of the wheel [px], shape (2,)
    slant: Vector  # what makes the far side smaller, shape (2,)
    distortion: float  # radial, at `reach` from the middle of the picture
    middle: Vector  # of the picture [px], shape (2,)
    reach: float  # [px]
    radius: float  # unit of the plane [mm]
    second_distortion: float = 0.0  # of the fourth power, known from elsewhere

    def seen(self, points: Vector) -> Vector:
        """Return points of the plane [mm] in the picture [px], shape (..., 2)."""
        flat = points / self.radius
        straight = (flat @ self.matrix.T + self.centre) / (1.0 + flat @ self.slant)[..., None]
        off = straight - self.middle
        square = (off**2).sum(axis=-1) / self.reach**2
        bent = 1.0 + self.distortion * square + self.second_distortion * square**2
        return np.asarray(self.middle + off * bent[..., None])

    def behind(self, seen: Vector) -> Vector:
        """Return the points of the plane [mm] that are seen somewhere in the picture [px], shape (n, 2)."""
        points = np.zeros_like(seen)
        for _ in range(20):
            off = seen - self.seen(points)
            points = points + np.einsum("nij,nj->ni", np.linalg.inv(self.by_place(points)), off)
        return points

    def by_numbers(self, points: Vector) -> Vector:
        """Return the derivatives of points in the picture by all parameters, shape (..., 2, 9)."""
        return np.stack(
            [
                (self.moved(step * unit).seen(points) - self.moved(-step * unit).seen(points)) / (2.0 * step)
                for unit, step in zip(np.eye(NUMBERS), _STEP * self._sizes, strict=True)
            ],
            axis=-1,
        )

    def by_place(self, points: Vector) -> Vector:
        """Return the derivatives of points seen by points of the plane [px/mm], shape (..., 2, 2)."""
        step = _STEP * self.radius
        return np.stack(
            [
                (self.seen(points + unit) - self.seen(points - unit)) / (2.0 * step)
                for unit in step * np.eye(2)
            ],
            axis=-1,
        )

    def moved(self, change: Vector) -> "Projection":
        """Return the projection with changed parameters."""
        return replace(
            self,
            matrix=self.matrix + change[:4].reshape(2, 2),
            centre=self.centre + change[4:6],
            slant=self.slant + change[6:8],
            distortion=self.distortion + float(change[8]),
        )

    @cached_property
    def _sizes(self) -> Vector:
        size = self.scale * self.radius
        return np.array([size] * 6 + [1.0] * 3)

    @property
    def scale(self) -> float:
        """Pixels of a millimetre at the wheel's centre."""
        return float(np.sqrt(abs(np.linalg.det(self.by_place(np.zeros(2))))))

    @property
    def scale_by_numbers(self) -> Vector:
        """Derivatives of the logarithm of the scale by all parameters."""
        scale = np.log(self.scale)
        steps = _STEP * self._sizes
        return np.array(
            [
                (np.log(self.moved(step * unit).scale) - scale) / step
                for unit, step in zip(np.eye(NUMBERS), steps, strict=True)
            ]
        )


@dataclass(frozen=True, eq=False)
class SeenStations:
    """Stations of all gaps in the picture."""

    points: Vector  # [px], shape (..., 2)
    normals: Vector  # out of the steel, shape (..., 2)
    stretch: Vector  # pixels across the edge that a millimetre across it makes, shape (...)


def seen_stations(projection: Projection, points: Vector, normals: Vector) -> SeenStations:
    """Return where points of edges are seen, and which way they face there."""
    inverse = np.linalg.inv(projection.by_place(points))
    facing = np.einsum("...ji,...j->...i", inverse, normals)
    length = np.hypot(facing[..., 0], facing[..., 1])
    return SeenStations(projection.seen(points), facing / length[..., None], 1.0 / length)


def homography(flat: Vector, points: Vector) -> Vector:
    """Return the matrix that takes points of a plane to points of a picture, shape (3, 3).

    Examples
    --------
    >>> square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    >>> expected = np.array([[2.0, 0.0, 1.0], [0.0, 2.0, 1.0], [0.0, 0.0, 1.0]])
    >>> np.allclose(homography(square, 2.0 * square + 1.0), expected)
    True
    """
    into, out = _normal(flat), _normal(points)
    ones = np.ones((len(flat), 1))
    here = np.hstack([flat, ones]) @ into.T
    there = np.hstack([points, ones]) @ out.T
    zero = np.zeros_like(here)
    rows = np.concatenate(
        [np.hstack([here, zero, -there[:, :1] * here]), np.hstack([zero, here, -there[:, 1:2] * here])]
    )
    found = np.linalg.inv(out) @ np.linalg.svd(rows)[2][-1].reshape(3, 3) @ into
    return np.asarray(found / found[2, 2])


def _normal(points: Vector) -> Vector:
    """Return the matrix that moves points about 0, at a mean distance of 1."""
    middle = points.mean(axis=0)
    size = float(np.hypot(*(points - middle).T).mean())
    return np.array(
        [[1.0 / size, 0.0, -middle[0] / size], [0.0, 1.0 / size, -middle[1] / size], [0.0, 0.0, 1.0]]
    )
