"""Synthesis of paths of contact with a prescribed reduced radius."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp

from wearsim.errors import GeometryError
from wearsim.geometry.gear.path_of_contact import PathOfContact
from wearsim.geometry.gear.plane_gearing import Contacts, Family, PitchCircles
from wearsim.geometry.profile_points import Vector

Law = Callable[[float, float], float]
"""Reduced radius rho [mm] from the distance l [mm] from the pitch point and the pressure angle [rad]."""

_STEEPEST = math.radians(89.0)
"""Pressure angle up to which lines are followed; they get stiff beyond it."""

_NEAREST = 1e-6
"""Distance from the pitch point at which a line through it is begun, over the reduced radius there."""


@dataclass(frozen=True)
class PitchPointCrossing:
    """How a path of contact of the family 1 goes through the pitch point."""

    pressure_angle: float  # alpha at the pitch point [rad], below 90 deg
    # turn_before, turn_after: d(alpha)/d(phi1) on either side of it; they differ where the law has a corner
    # there
    turn_before: float
    turn_after: float


@dataclass(frozen=True)
class PathSynthesis:
    """The paths of contact of one family under a law for the reduced radius."""

    circles: PitchCircles  # the pair
    radius_rule: Law  # reduced radius rho(l, alpha) [mm], above 0
    family: Family  # which of the two pairs of profiles

    def through_pitch_point(
        self, crossing: PitchPointCrossing, pitch_point_distance: ArrayLike
    ) -> PathOfContact:
        """Return the path of contact through the pitch point, integrated outward from it.

        Where alpha is below 45 deg, what is wrong near the pitch point fades on the way outward (as
        l^(-1/2) under a constant normal load); inward it would grow. Only the family 1 gets
        there.
        """
        l = np.asarray(pitch_point_distance, dtype=float)
        near = _NEAREST * float(self.circles.pitch_point_radius(crossing.pressure_angle))
        advance = self.circles.pinion_radius * math.cos(crossing.pressure_angle)
        turn = np.where(l < 0.0, crossing.turn_before, crossing.turn_after)
        roll = l / advance
        angle = crossing.pressure_angle + turn * roll
        for side, rate in ((-1, crossing.turn_before), (1, crossing.turn_after)):
            at = np.flatnonzero(side * l > near)[::side]
            if at.size:
                first = side * near / advance
                start = (side * near, crossing.pressure_angle + rate * first, first)
                angle[at], roll[at] = self._march(start, l[at])
                turn[at] = self._turn(l[at], angle[at])
        return PathOfContact(Contacts(self.circles, l, angle, turn), roll)

    def from_point(self, start: tuple[float, float], pitch_point_distance: ArrayLike) -> PathOfContact:
        """Return the path of contact from a point on."""
        l = np.asarray(pitch_point_distance, dtype=float)
        angle, roll = self._march((*start, 0.0), l)
        return PathOfContact(Contacts(self.circles, l, angle, self._turn(l, angle)), roll)

    def end(self, start: tuple[float, float], last: float) -> tuple[float, float]:
        """Return where the path of contact from a point ends.

        It ends where its pressure angle comes to 90 deg, or to 0, where the contact would run
        back on one of the profiles.
        """
        with np.errstate(invalid="ignore"):
            found = solve_ivp(
                partial(self._rate, start[0]),
                (0.0, math.log(last / start[0])),
                (start[1], 0.0),
                "Radau",
                rtol=1e-9,
                atol=1e-12,
                events=_level,
            )
        return start[0] * math.exp(found.t[-1]), float(found.y[0, -1])

    def _turn(self, pitch_point_distance: Vector, angle: Vector) -> Vector:
        radius = [self.radius_rule(l, a) for l, a in zip(pitch_point_distance, angle, strict=True)]
        return self.circles.turn(pitch_point_distance, angle, radius, self.family)

    def _march(self, start: tuple[float, float, float], at: Vector) -> tuple[Vector, Vector]:
        """Return alpha and phi1 at some distances from the pitch point, or raise where the line ends."""
        way = np.log(at / start[0])
        with np.errstate(invalid="ignore"):
            found = solve_ivp(
                partial(self._rate, start[0]),
                (0.0, way[-1]),
                start[1:],
                "DOP853",
                way,
                rtol=1e-13,
                atol=1e-14,
                events=(_level, _steep),
            )
        if len(found.t) < at.size:
            l, last = self.end(start[:2], at[-1])
            first, degrees = round(start[0], 3) + 0.0, abs(round(math.degrees(last), 1))
            raise GeometryError(
                f"line of action: the family {self.family:+d} from l = {first:.6g} mm must end before "
                f"l = {l:.6g} mm, where its pressure angle comes to {degrees:g} deg, but "
                f"is to reach {at[-1]:.6g}: end it earlier or start it elsewhere"
            )
        return found.y[0], found.y[1]

    def _rate(self, first: float, x: float, y: Vector) -> tuple[float, float]:
        """Return d(alpha)/dx = l d(alpha)/dl and d(phi1)/dx = l/(r1 cos(alpha)), x = ln(l/first).

        In x the way out from the pitch point has no singular point.
        """
        l, angle = first * math.exp(x), float(y[0])
        advance = l / (self.circles.pinion_radius * math.cos(angle))
        turn = self.circles.turn(l, angle, self.radius_rule(l, angle), self.family)
        return advance * float(turn), advance


def _level(x: float, y: Vector) -> float:
    """Cross 0 where the pressure angle does, and stop there."""
    return float(y[0])


def _steep(x: float, y: Vector) -> float:
    """Cross 0 where lines are followed no further, and stop there."""
    return float(y[0]) - _STEEPEST


for _event in (_level, _steep):
    _event.terminal = True  # type: ignore[attr-defined]
