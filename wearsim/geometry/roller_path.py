"""The line on which the centre of a roller sits in a gap, and how it moves as the gap wears."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wearsim.errors import GeometryError
from wearsim.geometry.profile_points import Profile, Vector
from wearsim.kernels.roller_locus import roller_locus

Rows = NDArray[np.float64]

_CORNER = np.radians(3.0)
"""Turn of the direction between two nodes above which the line is taken to have a corner there."""

_INSIDE = 1e-5
"""Depth [roller radii] by which a roller may enter the outline before its place does not count."""

_FINEST_TURN = np.radians(2.0)
"""Turn of the line that counts as much as the mean distance of two nodes when they are spread."""


_FINEST_STEP = 2e-4
"""Distance of nodes [roller radii] below which the direction between them would be rounding's."""

_NODES_PER_NODE = 2.0
"""Nodes of a worn line for each of the unworn one."""


@dataclass(frozen=True, eq=False)
class WornPath:
    """Centres of a roller that touches a worn outline, right side to left side."""

    place: Vector  # where each node stands on the unworn line, counted in its nodes from 0
    locus: Rows  # rows x, y, normal x, normal y of the centres [mm], shape (4, nodes)
    touched: Vector  # place on the outline that each of them touches, counted in points from 0

    def node_place(self, node: Vector) -> Vector:
        """Return where places between nodes stand on the unworn line."""
        return np.interp(node, np.arange(self.place.size), self.place)

    def node_of(self, place: Vector) -> Vector:
        """Return the nodes at places of the unworn line, the inverse of ``node_place``."""
        return np.interp(place, self.place, np.arange(self.place.size))


@dataclass(frozen=True, eq=False)
class RollerPath:
    """Centres of a roller that touches a gap's outline, right side to left side."""

    # nodes on the unworn gap: rows x, y [mm] and the unit direction out of the material, shape (4, nodes)
    base: Rows
    roller_radius: float  # radius of the roller [mm]

    def worn(self, x: Vector, y: Vector) -> "WornPath":
        """Return the line on a worn outline.

        Where a worn pocket holds the roller the line turns on the spot: nodes are spread
        by length and by turn of a first line.
        """
        first = self._cast(x, y, np.arange(self.base.shape[1], dtype=float))
        chord = np.hypot(np.diff(first.locus[0]), np.diff(first.locus[1]))
        cosine = np.sum(first.locus[2:, 1:] * first.locus[2:, :-1], axis=0)
        turn = np.arccos(np.clip(cosine, -1.0, 1.0)) / _FINEST_TURN
        turn = np.minimum(turn, chord / (_FINEST_STEP * self.roller_radius))
        weight = np.concatenate([[0.0], np.cumsum(0.1 + chord / chord.mean() + turn)])
        nodes = int(_NODES_PER_NODE * weight.size)
        return self._cast(x, y, np.interp(np.linspace(0.0, weight[-1], nodes), weight, first.place))

    def _cast(self, x: Vector, y: Vector, place: Vector) -> "WornPath":
        before = np.minimum(place.astype(int), self.base.shape[1] - 2)
        base = self.base.take(before, axis=1)
        base += (place - before) * (self.base.take(before + 1, axis=1) - base)
        base[2:] /= np.hypot(base[2], base[3])
        locus, touched = np.empty_like(base), np.empty(place.size)
        roller_locus(x, y, base, self.roller_radius, np.empty(x.size + 4), locus, touched)
        return WornPath(place, locus, touched)


def roller_path(outline: Profile, roller_radius: float, nodes: int) -> RollerPath:
    """Return the line of roller centres on an unworn gap.

    Parallel curve of the outline at the distance of the roller's radius, without the
    parts where the roller would enter the outline elsewhere; at the corner that such a
    part leaves, nodes turn from one direction to the other.

    Examples
    --------
    A roller of 4 mm in a round seat of 5 mm around (0, 0) is centred within 1 mm of it:

    >>> import numpy as np
    >>> angle = np.linspace(0.0, -np.pi, 101)
    >>> seat = Profile(5.0 * np.cos(angle), 5.0 * np.sin(angle))
    >>> path = roller_path(seat, 4.0, 51)
    >>> float(np.hypot(path.base[0], path.base[1]).max().round(6))
    1.0
    """
    pick = np.unique(np.linspace(0, outline.x.size - 1, nodes).round().astype(int))
    nx, ny = outline.normal_x[pick], outline.normal_y[pick]
    base = np.array([outline.x[pick] + roller_radius * nx, outline.y[pick] + roller_radius * ny, nx, ny])
    path = RollerPath(base, roller_radius)
    unworn = path._cast(np.array(outline.x), np.array(outline.y), np.arange(pick.size, dtype=float))
    moved = (unworn.locus[0] - base[0]) * nx + (unworn.locus[1] - base[1]) * ny
    valid = (np.abs(moved) <= _INSIDE * roller_radius) & (unworn.touched >= 0.0)
    if valid.sum() < 3:
        raise GeometryError(
            f"gap: a roller of radius {roller_radius:g} mm must reach into it, but touches its outline "
            "nowhere without entering it elsewhere: check roller_diameter_mm against the outline"
        )
    return RollerPath(_with_corners(base[:, valid], roller_radius), roller_radius)


def _with_corners(base: Rows, radius: float) -> Rows:
    """Insert nodes that turn where two successive ones differ in direction by far more than elsewhere."""
    angle = np.unwrap(np.arctan2(base[3], base[2]))
    parts = []
    for k in range(base.shape[1] - 1):
        parts.append(base[:, k : k + 1])
        turn = angle[k + 1] - angle[k]
        way = np.hypot(*(base[:2, k + 1] - base[:2, k]))
        count = int(abs(turn) / _CORNER)
        if count == 0 or way > 0.1 * radius * abs(turn):
            continue
        part = np.arange(1, count + 1) / (count + 1)
        between = angle[k] + turn * part
        place = base[:2, k : k + 1] + (base[:2, k + 1] - base[:2, k])[:, None] * part
        parts.append(np.vstack([place, np.cos(between), np.sin(between)]))
    parts.append(base[:, -1:])
    return np.ascontiguousarray(np.hstack(parts))
