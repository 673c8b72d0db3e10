"""Measured points of a profile laid on its nominal form by least squares."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
import shapely

from wearsim.errors import GeometryError
from wearsim.geometry.profile_points import Profile, Vector, chord_lengths

Freedom = Literal["none", "turn", "free"]
"""How points may be moved: not at all, turned about the axis, turned and shifted."""

_MAX_STEPS = 50
_SETTLED = 1e-8
"""Largest movement of the last step [mm]."""

UNSEEN = 1e-3
"""Ways to move whose change of the recess, over that of the one that changes most, is smaller are
not gone: that along an arc by its own radius is one."""


@dataclass(frozen=True, eq=False)
class RegisteredProfile:
    """Points on a nominal profile."""

    arc_length: Vector  # where their feet lie along the nominal profile [mm], shape (n,)
    recess: Vector  # distance from the nominal profile into the material [mm], shape (n,)
    # what a further movement changes of the recess over what is expected, a column for each way to move,
    # shape (n, 0, 1 or 3): turn, by the way of the outermost point, then shifts along x and y
    moves: Vector
    # turn, shift_x, shift_y: the movement that was found: about the axis [rad], then along x and y [mm]
    turn: float
    shift_x: float
    shift_y: float
    left_out: int  # points beyond the ends of the nominal profile


def feet(nominal: Profile, x: Vector, y: Vector) -> tuple[Vector, Vector]:
    """Return the feet of points on a profile.

    Examples
    --------
    A flank along +y with the gap on its right:

    >>> flank = Profile([0.0, 0.0, 0.0], [0.0, 1.0, 2.0])
    >>> arc, recess = feet(flank, np.array([-0.1]), np.array([0.5]))
    >>> float(arc[0]), float(recess[0])
    (0.5, 0.1)
    """
    places, recess, _, _ = _feet(nominal, x, y)
    return places, recess


def register(
    nominal: Profile, x: Vector, y: Vector, freedom: Freedom, expected: Vector | None = None
) -> RegisteredProfile:
    """Lay measured points on a nominal profile, or on one that has worn as is expected.

    The movement of least squared distances, by Gauss-Newton steps on the distances to the
    tangents (point to plane). Without what is expected a worn profile is moved too far by
    that: whoever compares the recess with a model must let the model move by `moves`, and
    register again with what it says.
    """
    turn, shift = 0.0, np.zeros(2)
    chords = chord_lengths(nominal.x, nominal.y)
    recessed = np.zeros(chords.size) if expected is None else expected
    slopes = np.gradient(recessed, chords)
    for _ in range(_MAX_STEPS):
        cos, sin = np.cos(turn), np.sin(turn)
        at_x, at_y = cos * x - sin * y + shift[0], sin * x + cos * y + shift[1]
        places, recess, normal_x, normal_y = _feet(nominal, at_x, at_y)
        on = (places > 0.0) & (places < chords[-1])
        if on.sum() < 11:
            raise GeometryError(
                f"registration: at least 11 points must lie on the profile of the case, {on.sum()} do: "
                "give them as `wearsim profile` does, in mm, axis at 0, gap on +y, mirrored if the other "
                "flank was measured"
            )
        slope = np.interp(places, chords, slopes)
        worn_x, worn_y = normal_x - slope * normal_y, normal_y + slope * normal_x
        moves = _moves(at_x, at_y, worn_x, worn_y)[:, : _WAYS[freedom]]
        over = recess - np.interp(places, chords, recessed)
        step = np.zeros(3)
        step[: _WAYS[freedom]] = -np.linalg.lstsq(moves[on], over[on], rcond=UNSEEN)[0]
        if np.abs(step).sum() < _SETTLED:
            left_out = int((~on).sum())
            shift_x, shift_y = shift.tolist()
            return RegisteredProfile(places[on], recess[on], moves[on], turn, shift_x, shift_y, left_out)
        angle = step[0] / float(np.hypot(at_x, at_y).max())
        c, s = np.cos(angle), np.sin(angle)
        turn, shift = turn + angle, np.array([[c, -s], [s, c]]) @ shift + step[1:]
    raise GeometryError(
        "registration: the points must settle on the profile of the case, but do not: check that they "
        "are those of its flank, in mm, or fix them by a datum (turn, none)"
    )


_WAYS = {"none": 0, "turn": 1, "free": 3}


def _feet(nominal: Profile, x: Vector, y: Vector) -> tuple[Vector, Vector, Vector, Vector]:
    """Arc lengths of the feet, distances into the material, and normals into the gap there."""
    line = shapely.LineString(np.column_stack([nominal.x, nominal.y]))
    places = shapely.line_locate_point(line, shapely.points(x, y))
    foot = shapely.line_interpolate_point(line, places)
    chords = chord_lengths(nominal.x, nominal.y)
    normal_x = np.interp(places, chords, nominal.normal_x)
    normal_y = np.interp(places, chords, nominal.normal_y)
    size = np.hypot(normal_x, normal_y)
    normal_x, normal_y = normal_x / size, normal_y / size
    away_x, away_y = x - shapely.get_x(foot), y - shapely.get_y(foot)
    return places, -(away_x * normal_x + away_y * normal_y), normal_x, normal_y


def _moves(x: Vector, y: Vector, normal_x: Vector, normal_y: Vector) -> Vector:
    """Change of the recess over what is expected by a turn about the axis and by shifts, shape (n, 3).

    The normals are those of what is expected, so that a movement along it matters as far as it
    has a slope.
    """
    size = float(np.hypot(x, y).max())
    return np.column_stack([(y * normal_x - x * normal_y) / size, -normal_x, -normal_y])
