"""The whole tooth around a working flank, and the room the roller needs."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely

from wearsim.errors import GeometryError
from wearsim.geometry.forms.evolute import Strand
from wearsim.geometry.outline import rotated
from wearsim.geometry.profile_points import Profile, Vector

CUT_TOLERANCE = 1e-3
"""Depth [mm] by which a roller may enter the outline before the flank counts as cut."""

RELIEF_PER_PITCH = 0.01
"""Recess of a relieved back flank behind the mirror image, as a fraction of the pitch."""

_SEAT_CLEARANCES = (0.005, 0.01, 0.02, 0.04)
"""Depths of the seat below the roller tried in turn, as a fraction of the roller diameter."""


def sweep_path(strand: Strand, tip_radius: float, side: float) -> shapely.LineString:
    """Return the way of a roller centre in the sprocket's frame, from the line of the pitch point out."""
    reach = tip_radius + strand.roller_radius
    far = math.sqrt(max(reach**2 - strand.height**2, strand.roller_radius**2))
    return shapely.LineString(strand.roller_path(side * np.linspace(0.0, far, 1000)))


def cut_depth(points: Vector, path: shapely.Geometry, roller_radius: float) -> float:
    """Return how deep a roller that follows a path enters behind the given points."""
    shapely.prepare(path)
    return roller_radius - float(shapely.distance(shapely.multipoints(points), path))


@dataclass(frozen=True)
class Tooth:
    """A tooth between two gaps of a wheel, built around its working flank.

    The gap's centre line is +y, the working flank bounds it on the left. The seat is an
    arc through both flanks' root points that passes below the roller; the back flank is
    the mirror image of the working flank, recessed by the relief; the tip is a circle
    through the end of the working flank.

    Raises
    ------
    GeometryError
        No seat clears the roller.
    """

    strand: Strand  # sprocket and line of roller centres
    flank: Profile  # working flank, root to tip
    teeth: int  # number of gaps of the wheel
    relief: float  # recess of the back flank along its normal [mm]; 0 makes it the mirror image

    @property
    def tip_radius(self) -> float:
        """Radius of the tip circle [mm]."""
        return math.hypot(self.flank.x[-1], self.flank.y[-1])

    @cached_property
    def back_flank(self) -> Profile:
        """Right side of the gap, run from tip to root."""
        return self.flank.mirrored().recede(self.relief)

    @cached_property
    def seat(self) -> Vector:
        """Points of the seat arc from the working flank's root to the back flank's [mm]."""
        bottom = self.strand.height - self.strand.roller_radius
        path = shapely.union(
            sweep_path(self.strand, self.tip_radius, 1.0), sweep_path(self.strand, self.tip_radius, -1.0)
        )
        for clearance in _SEAT_CLEARANCES:
            depth = clearance * 2.0 * self.strand.roller_radius
            points = _arc_through(
                (self.flank.x[0], self.flank.y[0]),
                (0.0, bottom - depth),
                (self.back_flank.x[-1], self.back_flank.y[-1]),
            )
            if cut_depth(points, path, self.strand.roller_radius) <= CUT_TOLERANCE:
                return points
        raise GeometryError(
            "seat: an arc through both root points must clear the roller, but none does: move the "
            "root end of the flank (contact_end_mm) nearer to the line of the pitch point"
        )

    @property
    def gap(self) -> Vector:
        """Outline of one gap from the working flank's tip to the back flank's tip [mm]."""
        working = np.column_stack([self.flank.x, self.flank.y])[::-1]
        back = np.column_stack([self.back_flank.x, self.back_flank.y])[::-1]
        return np.concatenate([working, self.seat[1:-1], back])

    def cut_depth(self) -> float:
        """Return how deep the roller cuts the outline on its way in and out."""
        path = shapely.union(
            sweep_path(self.strand, self.tip_radius, 1.0), sweep_path(self.strand, self.tip_radius, -1.0)
        )
        pitch_angle = 2.0 * math.pi / self.teeth
        outline = np.concatenate([rotated(self.gap, i * pitch_angle) for i in (1, 0, -1)])
        return cut_depth(outline, path, self.strand.roller_radius)

    def thickness(self, radius: "float | Vector") -> Vector:
        """Return the chordal thickness of the tooth on a circle around the axis."""
        radius = np.clip(radius, *_radii(self.flank)[[0, -1]])
        return 2.0 * radius * np.sin(0.5 * self._angle(radius))

    @cached_property
    def tip_land(self) -> float:
        """Length of the tip between the two flanks along the tip circle [mm]."""
        return float(self.tip_radius * self._angle(self.tip_radius))

    @cached_property
    def neck(self) -> float:
        """Smallest chordal thickness along the working flank [mm]."""
        return float(self.thickness(_radii(self.flank)).min())

    @cached_property
    def pitch_line_thickness(self) -> float:
        """Chordal thickness where the centrode meets the tooth [mm]."""
        return float(self.thickness(self.strand.centrode_radius))

    def worn_tip_land(self, x: Vector, y: Vector) -> float:
        """Return the tip land that a worn working flank leaves."""
        radius, angle = np.hypot(x, y), np.arctan2(-x, y)
        last = angle[-1] + (self.tip_radius - radius[-1]) * (angle[-1] - angle[-2]) / (
            radius[-1] - radius[-2]
        )
        unworn = math.atan2(-self.flank.x[-1], self.flank.y[-1])
        return float(self.tip_land - self.tip_radius * (last - unworn))

    def worn_thickness(self, x: Vector, y: Vector) -> float:
        """Return the thickness on the centrode that a worn working flank leaves."""
        radius = float(np.clip(self.strand.centrode_radius, *_radii(self.flank)[[0, -1]]))
        worn = np.interp(radius, np.hypot(x, y), np.arctan2(-x, y))
        new = np.interp(radius, _radii(self.flank), np.arctan2(-self.flank.x, self.flank.y))
        angle = float(self._angle(radius)) - float(worn - new)
        return 2.0 * radius * math.sin(0.5 * angle)

    def _angle(self, radius: "float | Vector") -> Vector:
        """Angle that the tooth takes up on a circle [rad]."""
        working = np.interp(radius, _radii(self.flank), np.arctan2(-self.flank.x, self.flank.y))
        back = self.back_flank.mirrored()
        behind = np.interp(radius, _radii(back), np.arctan2(-back.x, back.y))
        return np.asarray(2.0 * math.pi / self.teeth - working - behind)


def _radii(flank: Profile) -> Vector:
    return np.hypot(flank.x, flank.y)


def _arc_through(start: tuple[float, float], middle: tuple[float, float], end: tuple[float, float]) -> Vector:
    """Points on the arc through three points, 61 of them, from the first to the last."""
    (x1, y1), (x2, y2), (x3, y3) = start, middle, end
    matrix = np.array([[x2 - x1, y2 - y1], [x3 - x1, y3 - y1]])
    right = 0.5 * np.array([x2**2 - x1**2 + y2**2 - y1**2, x3**2 - x1**2 + y3**2 - y1**2])
    centre = np.linalg.solve(matrix, right)
    first, last = (math.atan2(y - centre[1], x - centre[0]) for x, y in (start, end))
    left_turn = (x2 - x1) * (y3 - y2) > (y2 - y1) * (x3 - x2)
    if left_turn and first > last:
        first -= 2.0 * math.pi
    elif not left_turn and first < last:
        first += 2.0 * math.pi
    angles = np.linspace(first, last, 61)
    radius = math.hypot(x1 - centre[0], y1 - centre[1])
    return centre + radius * np.column_stack([np.cos(angles), np.sin(angles)])
