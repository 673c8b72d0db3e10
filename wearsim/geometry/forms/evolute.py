"""The evolute flank: conjugate to the rollers of a straight strand.

The source's equations (1) to (9) are lost. This is a reconstruction from
Euler-Savary (Bobillier's construction), chosen because it leads to the direction of
wear that the source prints.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from wearsim.errors import GeometryError
from wearsim.geometry.profile_points import Profile, Vector

_GAUSS_POINTS, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(6)


@dataclass(frozen=True)
class Strand:
    """A sprocket and the straight line of roller centres that runs past it.

    The sprocket turns clockwise about the origin, the strand moves along +x, the pitch point
    is (0, centrode radius); a roller is called by its distance x before the line of the pitch point.

    Examples
    --------
    >>> line = Strand(centrode_radius=100.0, roller_radius=8.0, offset=6.0)
    >>> float(line.flank_radius(8.0))  # 8 + 10**3 / (100 * 6 + 10**2)
    9.428571428571429
    """

    centrode_radius: float  # R = p z / (2 pi engaged_every) [mm]
    roller_radius: float  # r = d1 / 2 [mm]
    offset: float  # evolute offset h [mm], 0 < h < R: the line of roller centres is y = R - h

    @property
    def height(self) -> float:
        """Height of the line of roller centres above the sprocket's axis, R - h [mm]."""
        return self.centrode_radius - self.offset

    def pitch_point_distance(self, x: ArrayLike) -> Vector:
        """Return the distance l = sqrt(x^2 + h^2) of the roller centre from the pitch point.

        Equation physics.md (S1).

        Parameters
        ----------
        x : array_like
            Distance of the roller centre before the line of the pitch point [mm].

        Returns
        -------
        numpy.ndarray
            Distance [mm].
        """
        return np.hypot(x, self.offset)

    def pressure_angle(self, x: ArrayLike) -> Vector:
        """Return the pressure angle alpha = atan2(h, x).

        Equation physics.md (S1).

        Parameters
        ----------
        x : array_like
            Distance of the roller centre before the line of the pitch point [mm].

        Returns
        -------
        numpy.ndarray
            Angle of the common normal to the strand [rad].
        """
        return np.arctan2(self.offset, x)

    def flank_radius(self, x: ArrayLike) -> Vector:
        """Return the radius of curvature of the conjugate flank, r + l^3 / (R h + l^2).

        Equation physics.md (S4).

        Parameters
        ----------
        x : array_like
            Distance of the roller centre before the line of the pitch point [mm].

        Returns
        -------
        numpy.ndarray
            Radius of the concave flank [mm] (Euler-Savary).
        """
        distance = self.pitch_point_distance(x)
        return self.roller_radius + distance**3 / (self.centrode_radius * self.offset + distance**2)

    def roller_path(self, x: ArrayLike) -> Vector:
        """Return the roller centre in the sprocket's frame."""
        x = np.asarray(x, dtype=float)
        return self._rotated(-x, np.full_like(x, self.height), x)

    def conjugate_points(self, x: ArrayLike) -> Vector:
        """Return the points of the conjugate flank in the sprocket's frame, in closed form.

        Equation physics.md (S2).

        Parameters
        ----------
        x : array_like
            Distance of the roller centre before the line of the pitch point at contact [mm].

        Returns
        -------
        numpy.ndarray
            Coordinates [mm], shape (n, 2).
        """
        x = np.asarray(x, dtype=float)
        distance = self.pitch_point_distance(x)
        return self._rotated(
            -x - self.roller_radius * x / distance,
            self.height - self.roller_radius * self.offset / distance,
            x,
        )

    def evolute_points(self, x: ArrayLike) -> Vector:
        """Return the flank's centres of curvature in the sprocket's frame.

        Equation physics.md (S5).

        Parameters
        ----------
        x : array_like
            Distance of the roller centre before the line of the pitch point at contact [mm].

        Returns
        -------
        numpy.ndarray
            Coordinates [mm], shape (n, 2): on the common normal between roller
            centre and pitch point, at the distance l / (1 + l^2 / (R h)) from the pitch point.
        """
        x = np.asarray(x, dtype=float)
        distance = self.pitch_point_distance(x)
        part = (self.flank_radius(x) - self.roller_radius) / distance
        return self._rotated(-x + part * x, self.height + part * self.offset, x)

    def _rotated(self, x_fixed: Vector, y_fixed: Vector, x: Vector) -> Vector:
        cosine, sine = np.cos(x / self.centrode_radius), np.sin(x / self.centrode_radius)
        return np.column_stack([x_fixed * cosine + y_fixed * sine, -x_fixed * sine + y_fixed * cosine])

    def _direction_rate(self, x: Vector) -> Vector:
        """d(alpha - psi)/dx: how fast the normal turns in the sprocket's frame [rad/mm]."""
        return -(self.offset / self.pitch_point_distance(x) ** 2 + 1.0 / self.centrode_radius)


@dataclass(frozen=True)
class EvoluteFlank:
    """An evolute flank with, at every node, the roller position that touches it."""

    strand: Strand  # sprocket and line of roller centres
    contact_distance: Vector  # distance x of the roller centre [mm], root to tip
    profile: Profile  # the flank in the sprocket's frame


def evolute_flank(strand: Strand, contact_end: float, contact_start: float, nodes: int) -> EvoluteFlank:
    """Integrate the flank's intrinsic equation d(theta)/ds = 1/rho_t from root to tip.

    Nodes lie at equal steps of the roller's way x. On every step the direction
    theta = alpha - psi of the normal and the point follow from ds = rho_t |d(theta)/dx| dx
    by Gauss quadrature of order 12; the closed form gives only the first point and
    direction, and is the check of the rest.

    Equations physics.md (S7), with (S3) and (S4).

    Parameters
    ----------
    strand : Strand
        Sprocket and line of roller centres.
    contact_end, contact_start : float
        x_min and x_max [mm], 0 < x_min < x_max: the roller leaves the flank at its root
        end x_min and enters at its tip x_max.
    nodes : int
        Number of points, at least three.

    Returns
    -------
    EvoluteFlank
        Points within 1e-9 mm of the closed form, from eleven nodes on.

    Raises
    ------
    GeometryError
        The range of contact is empty or reaches the line of the pitch point.
    """
    if not 0.0 < contact_end < contact_start:
        raise GeometryError(
            f"evolute flank: 0 < contact_end < contact_start must hold, got {contact_end:g} and "
            f"{contact_start:g} mm: the flank ends before the line of the pitch point"
        )
    x = np.linspace(contact_end, contact_start, nodes)
    half = 0.5 * np.diff(x)[:, None]
    at = x[:-1, None] + half * (1.0 + _GAUSS_POINTS)
    inner_half = 0.5 * (at - x[:-1, None])[..., None]
    inner_at = x[:-1, None, None] + inner_half * (1.0 + _GAUSS_POINTS)
    turn = half[:, 0] * (strand._direction_rate(at) @ _GAUSS_WEIGHTS)
    first = float(strand.pressure_angle(contact_end)) - contact_end / strand.centrode_radius
    theta_node = first + np.concatenate([[0.0], np.cumsum(turn)])[:-1]
    theta = theta_node[:, None] + inner_half[..., 0] * (strand._direction_rate(inner_at) @ _GAUSS_WEIGHTS)
    arc_rate = -strand.flank_radius(at) * strand._direction_rate(at)
    step_x = half[:, 0] * ((-np.sin(theta) * arc_rate) @ _GAUSS_WEIGHTS)
    step_y = half[:, 0] * ((np.cos(theta) * arc_rate) @ _GAUSS_WEIGHTS)
    start = strand.conjugate_points([contact_end])[0]
    profile = Profile(
        start[0] + np.concatenate([[0.0], np.cumsum(step_x)]),
        start[1] + np.concatenate([[0.0], np.cumsum(step_y)]),
    )
    return EvoluteFlank(strand, x, profile)


def contact_ratio(contact_end: float, contact_start: float, pitch: float) -> float:
    """Return the contact ratio (x_max - x_min) / p of an unworn evolute flank."""
    return (contact_start - contact_end) / pitch
