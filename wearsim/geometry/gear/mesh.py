"""The way of a pair of teeth through contact, whatever its path of contact looks like."""

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from wearsim.errors import GeometryError
from wearsim.geometry.gear.path_of_contact import PathOfContact
from wearsim.geometry.gear.plane_gearing import PitchCircles
from wearsim.geometry.profile_points import Profile, Vector

_INTERFERES = 1e-5
"""Angle [rad] by which the corner of a tip may seem to cut into a flank between two of its points."""

_NOT_ROLLING = "is not above 0 everywhere on the line of action, the contact runs back there"


@dataclass(frozen=True, eq=False)
class Mesh:
    """A pair of teeth from the start of contact to its end, with those before and after it."""

    place: Vector  # coordinate of the points that grows evenly with the turn [mm]
    pitch: float  # from one pair of teeth to the next, in that coordinate [mm]
    # signed distance l of the contact from the pitch point [mm], negative before it
    pitch_point_distance: Vector
    lever: Vector  # arm of the common normal about the pinion's axis [mm]
    # way of the contact along the flanks of pinion and wheel per turn of the pinion [mm/rad], shape (2,
    # points)
    rolling: Vector
    curvature: Vector  # of both flanks, convex positive [1/mm], shape (2, points)
    arc: Vector  # way along both flanks from the first point [mm], shape (2, points)
    # flank, mate: pinion's flank, and the wheel's in reverse order: both from root to tip
    flank: Profile
    mate: Profile
    # gaps, levers: gap along its normal [mm] and lever [mm] of the pairs one pitch ahead and behind, shape
    # (2, points); beyond the ends of the path that of a tip's corner, infinite where that meets no flank
    gaps: Vector
    levers: Vector

    @property
    def relative_curvature(self) -> Vector:
        """Sum of the curvatures of both flanks [1/mm]."""
        return np.asarray(self.curvature.sum(axis=0))

    @property
    def contact_ratio(self) -> float:
        """Length of the path over the pitch."""
        return float(self.place[-1] - self.place[0]) / self.pitch


class ToothPair(Protocol):
    """A pair of gears with its path of contact."""

    @property
    def teeth(self) -> tuple[int, int]:
        """Numbers of teeth z1 and z2."""

    @property
    def circles(self) -> PitchCircles:
        """The pitch circles."""

    @property
    def pitch_point_angle(self) -> float:
        """Pressure angle at the pitch point [rad]."""

    def mesh(self, points: int) -> Mesh:
        """Return the way through contact at so many points, both ends included."""


def mesh_on(line: PathOfContact, teeth: tuple[int, int]) -> Mesh:
    """Return the way of a pair of teeth along a path of contact.

    The places are lengths that the pitch circles roll on each other, from the pitch point.
    """
    contacts = line.contacts
    circles = contacts.circles
    rolling = np.array([contacts.pinion_rolling, contacts.wheel_rolling])
    for name, way in zip(("pinion", "wheel"), rolling, strict=True):
        if not (way > 0.0).all():
            raise GeometryError(f"line of action: the rolling on the {name} {_NOT_ROLLING}: shorten it")
    if not (contacts.relative_curvature > 0.0).all():
        raise GeometryError(
            "line of action: the sum of the curvatures of both flanks must be above 0 everywhere, but "
            f"falls to {contacts.relative_curvature.min():.3g} 1/mm: the flanks interfere, shorten it"
        )
    _check_tips(line, teeth)
    flank, mate = Profile(*line.pinion_profile.T), Profile(*line.wheel_profile[::-1].T)
    place = circles.pinion_radius * line.roll_angle
    pitch = math.tau * circles.pinion_radius / teeth[0]
    lever = circles.pinion_radius * np.cos(contacts.pressure_angle)
    others = place + pitch * np.array([[1.0], [-1.0]])
    gaps = np.array([_separation(line, circles, other) for other in others])
    return Mesh(
        place=place,
        pitch=pitch,
        pitch_point_distance=contacts.pitch_point_distance,
        lever=lever,
        rolling=rolling,
        curvature=np.array([contacts.pinion_curvature, contacts.wheel_curvature]),
        arc=np.array([flank.arc_length, mate.arc_length[-1] - mate.arc_length[::-1]]),
        flank=flank,
        mate=mate,
        gaps=gaps,
        levers=np.interp(others, place, lever),
    )


def _check_tips(line: PathOfContact, teeth: tuple[int, int]) -> None:
    """Raise where both flanks of a tooth, half a pitch apart on the pitch circle, cross below its tip."""
    corners = line.pinion_profile[-1] * (-1.0, 1.0), line.wheel_profile[0] * (1.0, -1.0)
    for name, (x, y), count in zip(("pinion", "wheel"), corners, teeth, strict=True):
        half = 0.5 * math.pi / count - math.atan2(x, y)
        check_tip(name, 2.0 * half * math.hypot(x, y))


def check_tip(name: str, width: float) -> None:
    """Raise where a tooth is pointed."""
    if not width > 0.0:
        raise GeometryError(
            f"gear pair: the width of the tip of the {name} must be above 0 mm, but is {width:.3g} mm: "
            "end contact earlier (lower the tip), or take less shift or fewer teeth"
        )


def check_contact_ratio(ratio: float) -> None:
    """Raise where more than two pairs of teeth, or none, would touch."""
    if not 1.0 <= ratio < 2.0:
        raise GeometryError(
            f"gear pair: the contact ratio must be at least 1 and below 2, but is {ratio:.4g}: change "
            "the ends of contact (tips) or numbers of teeth"
        )


def _separation(line: PathOfContact, circles: PitchCircles, place: Vector) -> Vector:
    """Gap along its normal of a pair of teeth at a place, 0 on the path.

    Before the path the corner of the wheel's tip is next to the pinion's flank, after it that
    of the pinion's to the wheel's; the gap is what the pinion has to turn on until they touch,
    times the lever at that end.
    """
    turn = place / circles.pinion_radius
    lever = circles.pinion_radius * np.cos(line.contacts.pressure_angle[[0, -1]])
    before, after = turn < line.roll_angle[0], turn > line.roll_angle[-1]
    gap = np.zeros(place.size)
    gap[before] = lever[0] * _corner(
        line.wheel_profile[0],
        turn[before] / circles.gear_ratio,
        -turn[before],
        circles.centre_distance,
        line.pinion_profile,
    )
    gap[after] = (
        circles.gear_ratio
        * lever[1]
        * _corner(
            line.pinion_profile[-1],
            -turn[after],
            turn[after] / circles.gear_ratio,
            -circles.centre_distance,
            line.wheel_profile,
        )
    )
    return gap


def _corner(corner: Vector, turn: Vector, mate_turn: Vector, axis: float, mate: Vector) -> Vector:
    """Angle [rad] between a flank and a corner of the other gear; infinite where it is off the flank.

    ``turn`` and ``mate_turn``: of the corner's gear and of the other, counterclockwise. ``axis``:
    place of the axis of the corner's gear above that of the other.
    """
    from scipy.interpolate import PchipInterpolator  # takes 0.1 s, and most cases are not of gears

    at = complex(*corner) * np.exp(1j * turn) + 1j * axis
    own = at * np.exp(-1j * mate_turn)
    flank = mate[:, 0] + 1j * mate[:, 1]
    radius, middle = np.abs(flank), flank[flank.size // 2]
    order = np.argsort(radius)
    if not (np.diff(radius[order]) > 0.0).all():
        raise GeometryError(
            "gear pair: a flank must come nearer to or farther from its axis from point to point, but "
            "two points are equally far: ask a lower stress, or take fewer nodes"
        )
    angle = PchipInterpolator(radius[order], np.angle(flank / middle)[order], extrapolate=False)
    gap = angle(np.abs(own)) - np.angle(own / middle)
    if (gap < -_INTERFERES).any():
        raise GeometryError(
            "gear pair: the corner of a tip must pass the flank of its mate beyond the ends of contact, "
            f"but cuts {-np.nanmin(gap):.3g} rad into it: lower the tips"
        )
    return np.asarray(np.where(gap >= 0.0, gap, np.where(np.isnan(gap), math.inf, 0.0)))
