"""Contact of the worn flanks of a gear pair that meet along a fixed path."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import CONTACT, TABLE, VECTOR, float64, int64
from wearsim.kernels.flank_geometry import add_second_difference

if TYPE_CHECKING:
    from wearsim.jit.signatures import Vector


@kernel(float64(VECTOR, TABLE, float64, int64))
def worn_gap(depth: Vector, columns: Vector, place: float, near: int) -> float:
    """Return what both flanks have lost together at a place of the path, past its ends as there.

    ``near``: a node to search from, upwards.
    """
    j, last = near, depth.size - 1
    while j < last - 1 and columns[PLACE, j + 1] < place:
        j += 1
    step = columns[PLACE, j + 1] - columns[PLACE, j]
    part = min(max((place - columns[PLACE, j]) / step, 0.0), 1.0)
    here = depth[j] * (1.0 + columns[MATE_DEPTH, j])
    there = depth[j + 1] * (1.0 + columns[MATE_DEPTH, j + 1])
    gap: float = here + part * (there - here)
    return gap


@kernel(float64(*(float64,) * 7))
def turned_by_depth(
    torque: float,
    gap: float,
    lever: float,
    next_gap: float,
    next_lever: float,
    last_gap: float,
    last_lever: float,
) -> float:
    """Return the turn at which springs of stiffness 1 in contact carry a torque together.

    Spring i closes its gap g_i by the turn times its lever w_i and then presses. Where a set S of
    springs presses, the turn is (torque + sum w g) / sum w^2; of all sets the right one gives the
    least, as every other leaves out a spring that presses or takes one to pull. A gap is infinite
    where there is no spring.

    Equation gears.md (6).
    """
    a, b, c = lever * gap, next_lever * next_gap, last_lever * last_gap
    p, q, r = lever * lever, next_lever * next_lever, last_lever * last_lever
    one = min((torque + a) / p, min((torque + b) / q, (torque + c) / r))
    two = min((torque + a + b) / (p + q), (torque + a + c) / (p + r))
    two = min(two, (torque + b + c) / (q + r))
    return min(one, min(two, (torque + a + b + c) / (p + q + r)))


@kernel(CONTACT)
def gear_pair_contact(
    x: Vector,
    y: Vector,
    normal_x: Vector,
    normal_y: Vector,
    curvature: Vector,
    depth: Vector,
    constants: Vector,
    columns: Vector,
    load: Vector,
    slip: Vector,
    speed: Vector,
    relative: Vector,
) -> None:
    """Write load, slip, speed and relative curvature of flanks that meet where they did when new.

    The depth is that of the pinion; the wheel's is ``MATE_DEPTH`` times it at the point that it
    meets. The relative curvature is that of the new flanks plus the second differences of
    both depths, each over its own arc, but no less than ``LEAST_CURVATURE``; the end points keep
    theirs (the wheel's depth stands in ``load`` until that is written). Without a stiffness
    the load is the given share of the torque over the lever of the normal. With one, the pairs
    of teeth in contact are equal springs turned by one torque, each closing its worn gap first,
    and beyond the ends of the path that of the tip's corner (``NEXT_GAP`` and ``LAST_GAP``, of the
    pairs one pitch ahead and behind; infinite where there is none).

    Equations gears.md (3), (5) and (6).
    """
    n = depth.size
    torque, stiffness, pitch = constants[TORQUE], constants[STIFFNESS], constants[PITCH]
    for j in range(n):
        slip[j], speed[j], relative[j] = columns[SLIP, j], columns[SPEED, j], columns[CURVATURE, j]
    for j in range(n):
        normal_x[j], normal_y[j] = columns[NORMAL_X, j], columns[NORMAL_Y, j]
    add_second_difference(columns[ARC], depth, relative)
    for j in range(n):
        load[j] = columns[MATE_DEPTH, j] * depth[j]
    add_second_difference(columns[MATE_ARC], load, relative)
    for j in range(n):
        relative[j] = max(relative[j], constants[LEAST_CURVATURE])
    if stiffness == 0.0:
        for j in range(n):
            load[j] = torque * columns[SHARE, j] / columns[LEVER, j]
        return
    ahead, behind = 0, 0
    for j in range(n):
        place = columns[PLACE, j]
        while ahead < n - 2 and columns[PLACE, ahead + 1] < place + pitch:
            ahead += 1
        while behind < n - 2 and columns[PLACE, behind + 1] < place - pitch:
            behind += 1
        own, lever = depth[j] * (1.0 + columns[MATE_DEPTH, j]), columns[LEVER, j]
        next_gap, last_gap = columns[NEXT_GAP, j], columns[LAST_GAP, j]
        if next_gap < math.inf:
            next_gap += worn_gap(depth, columns, place + pitch, ahead)
        if last_gap < math.inf:
            last_gap += worn_gap(depth, columns, place - pitch, behind)
        turn = turned_by_depth(
            torque / stiffness, own, lever, next_gap, columns[NEXT_LEVER, j], last_gap, columns[LAST_LEVER, j]
        )
        load[j] = stiffness * max(0.0, turn * lever - own)


(
    ARC,
    MATE_ARC,
    CURVATURE,
    SLIP,
    SPEED,
    NORMAL_X,
    NORMAL_Y,
    MATE_DEPTH,
    SHARE,
    PLACE,
    NEXT_GAP,
    LAST_GAP,
    LEVER,
    NEXT_LEVER,
    LAST_LEVER,
) = range(15)
COLUMNS = 15

TORQUE, STIFFNESS, PITCH, LEAST_CURVATURE = range(4)
"""The torque and the stiffness of a pair of teeth are those per face width."""
