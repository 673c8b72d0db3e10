"""Lines of action and the profiles that they make."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from wearsim.geometry.gear.plane_gearing import Contacts, PitchCircles
from wearsim.geometry.profile_points import Vector


@dataclass(frozen=True, eq=False)
class PathOfContact:
    """A path of contact with the roll angle at each of its points."""

    contacts: Contacts  # its points, one row
    roll_angle: Vector  # angle phi1 by which the pinion has turned [rad]; the wheel has turned by phi1/u

    @property
    def pinion_profile(self) -> Vector:
        """Points of the pinion's profile about its axis, as it stands at phi1 = 0 [mm].

        Equation synthesise.md (11).
        """
        axis = [0.0, -self.contacts.circles.pinion_radius]
        return _rotated(self.contacts.points - axis, self.roll_angle)

    @property
    def wheel_profile(self) -> Vector:
        """Points of the wheel's profile about its axis, as it stands at phi1 = 0 [mm].

        Equation synthesise.md (11).
        """
        axis = [0.0, self.contacts.circles.wheel_radius]
        angle = -self.roll_angle / self.contacts.circles.gear_ratio
        return _rotated(self.contacts.points - axis, angle)


def _rotated(points: Vector, angle: Vector) -> Vector:
    """Turn each point about the origin by its own angle, counterclockwise."""
    (x, y), cosine, sine = points.T, np.cos(angle), np.sin(angle)
    return np.column_stack([cosine * x - sine * y, sine * x + cosine * y])


def involute(circles: PitchCircles, pressure_angle: float, pitch_point_distance: ArrayLike) -> PathOfContact:
    """Return the straight path of contact, whose profiles are involutes."""
    l = np.asarray(pitch_point_distance, dtype=float)
    contacts = Contacts(circles, l, np.full_like(l, pressure_angle), np.zeros_like(l))
    return PathOfContact(contacts, l / (circles.pinion_radius * math.cos(pressure_angle)))
