"""A circular arc in place of a curve."""

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from wearsim.geometry.gear.convex_concave_flank import ConvexConcaveFlank
from wearsim.geometry.profile_points import Vector


@dataclass(frozen=True)
class CircleFit:
    """The circle whose distances from some points are least in their squares."""

    radius: float  # radius [mm]
    centre: tuple[float, float]  # coordinates [mm]
    rms: float  # root of the weighted mean of the squared distances [mm]

    def distances(self, points: Vector) -> Vector:
        """Return the distances of points from the circle."""
        return np.asarray(np.hypot(*(points - self.centre).T) - self.radius)


def fit_circle(points: Vector, weights: Vector | None = None) -> CircleFit:
    """Fit a circle to points, by their distances from it.

    Examples
    --------
    >>> t = np.linspace(0.0, 1.0, 9)
    >>> found = fit_circle(np.column_stack([3.0 + 2.0 * np.cos(t), 2.0 * np.sin(t)]))
    >>> round(found.radius, 9), round(found.centre[0], 9)
    (2.0, 3.0)
    """
    w = np.full(len(points), 1.0) if weights is None else weights
    root, middle = np.sqrt(w / w.sum()), points.mean(axis=0)
    # The plain linear fit |p - middle|^2 = 2 c (p - middle) + d starts the fit by distances.
    near = points - middle
    start = np.linalg.lstsq(
        np.column_stack([2.0 * near, np.ones(len(near))]), (near**2).sum(axis=1), rcond=None
    )[0]

    def _left(v: Vector) -> Vector:
        return np.asarray(root * (np.hypot(*(near - v[:2]).T) - v[2]))

    def _slopes(v: Vector) -> Vector:
        across = near - v[:2]
        away = np.hypot(*across.T)[:, np.newaxis]
        return np.asarray(-root[:, np.newaxis] * np.hstack([across / away, np.ones_like(away)]))

    v0 = np.array([start[0], start[1], math.sqrt(start[2] + start[0] ** 2 + start[1] ** 2)])
    found = least_squares(_left, v0, _slopes, method="lm", xtol=1e-15, ftol=1e-15, gtol=1e-15)
    x, y, radius = (float(value) for value in found.x)
    return CircleFit(radius, (float(x + middle[0]), float(y + middle[1])), math.sqrt(2.0 * found.cost))


def rack_arc(flank: ConvexConcaveFlank, end: float) -> CircleFit:
    """Return the arc that replaces the rack's flank from the pitch point to its end.

    Squares are summed over the length of the flank (Gauss points; the flank turns with alpha,
    so that ds = rho d alpha).
    """
    nodes, weights = np.polynomial.legendre.leggauss(48)
    alpha = flank.pitch_point_angle + 0.5 * (end - flank.pitch_point_angle) * (nodes + 1.0)
    return fit_circle(flank.rack_points(alpha), weights * flank.rack_radius(alpha))
