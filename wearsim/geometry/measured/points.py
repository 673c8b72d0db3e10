"""A flank from measured or drawn points, through a smoothing spline."""

import math
import warnings
from typing import TYPE_CHECKING

import numpy as np

from wearsim.errors import GeometryError
from wearsim.geometry.forms.evolute import Strand
from wearsim.geometry.profile_points import Profile, Vector, chord_lengths

if TYPE_CHECKING:
    from scipy.interpolate import BSpline


def flank_from_points(x: Vector, y: Vector, noise: float, nodes: int) -> Profile:
    """Return a smooth flank through points that are known only within a noise.

    Curvature is a second difference: 0.1 um of noise on 200 points makes it meaningless
    (its error is sqrt(6) noise / spacing^2). A quintic spline over the chord length
    with as few knots as leave residuals of the noise's size replaces the points.

    Equation physics.md (F1).

    Parameters
    ----------
    x, y : numpy.ndarray
        Points from root to tip [mm], at least 11.
    noise : float
        Standard deviation of each coordinate [mm]; 0 interpolates.
    nodes : int
        Points of the result, at equal steps of arc length.

    Returns
    -------
    Profile
        The smooth flank.

    Raises
    ------
    GeometryError
        The flank crosses itself.
    """
    chord = chord_lengths(x, y)
    spline = _smoothing_spline(x, y, chord, noise)
    fine = np.linspace(0.0, chord[-1], 20 * nodes + 1)
    speed = np.hypot(*spline.derivative()(fine))
    arc = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(fine))])
    at = np.interp(np.linspace(0.0, arc[-1], nodes), arc, fine)
    profile = Profile(*spline(at))
    if not profile.is_simple:
        raise GeometryError(
            "points: the flank must not cross itself, but does: check the order of the points"
        )
    return profile


def _smoothing_spline(x: Vector, y: Vector, chord: Vector, noise: float) -> "BSpline":
    """Fit both coordinates over the chord length with squared residuals of n noise^2 in all.

    That is the noise across the flank; along it the chord length takes the noise up. The
    fit is loosened step by step where it does not converge.
    """
    from scipy.interpolate import make_splprep

    for loosened in (1.0, 1.5, 2.0):
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("error", RuntimeWarning)
                spline, _ = make_splprep([x, y], u=chord, k=5, s=loosened * x.size * noise**2)
        except (RuntimeWarning, ValueError, RuntimeError):
            # FITPACK gives up in all of these ways.
            continue
        return spline
    raise GeometryError(
        f"points: a smooth curve must pass within {noise:g} mm of the points, but none was found: give "
        "a larger points_noise_mm"
    )


def working_side(profile: Profile) -> Profile:
    """Return a flank on the left of the gap, as the mechanisms expect it."""
    if float(profile.x.mean()) <= 0.0:
        return profile
    return Profile(-profile.x, profile.y)


def gap_rotation(profile: Profile, strand: Strand) -> float:
    """Return by how much a flank is turned against the gap's centre line on +y.

    The sprocket turns by psi = x/R while the roller comes in, so the turn at which a point
    touches tells where the centre line of its gap is.
    """
    centre_x = profile.x + strand.roller_radius * profile.normal_x
    centre_y = profile.y + strand.roller_radius * profile.normal_y
    inside = np.maximum(centre_x**2 + centre_y**2 - strand.height**2, 0.0)
    distance = np.sqrt(inside)
    turn = np.arctan2(strand.height, -distance) - np.arctan2(centre_y, centre_x)
    error = distance / strand.centrode_radius - turn
    return float(np.median(np.angle(np.exp(1j * error))))


def contact_range(profile: Profile, height: float, roller_radius: float) -> tuple[float, float]:
    """Return where along the strand the roller touches the two ends of a flank."""
    distances = []
    for end, name in ((0, "root"), (-1, "tip")):
        centre_x = profile.x[end] + roller_radius * profile.normal_x[end]
        centre_y = profile.y[end] + roller_radius * profile.normal_y[end]
        inside = centre_x**2 + centre_y**2 - height**2
        if not inside > 0.0:
            raise GeometryError(
                f"points: a roller on the strand must reach the {name} end of the flank, but passes "
                f"{math.sqrt(height**2 - inside) - height:.3g} mm outside its centre: check "
                "evolute_offset_mm, or cut the flank there"
            )
        distances.append(math.sqrt(inside))
    return distances[0], distances[1]
