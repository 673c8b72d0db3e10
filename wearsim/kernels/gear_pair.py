"""Contact of the worn flanks of a gear pair that meet along a fixed path."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.kernels.compiled import kernel
from wearsim.kernels.gear_rows import (
    ARC,
    BASE_PITCH,
    CURVATURE,
    LAST_GAP,
    LEAST_CURVATURE,
    LINE_LOAD,
    MATE_ARC,
    MATE_DEPTH,
    NEXT_GAP,
    NORMAL_X,
    NORMAL_Y,
    PLACE,
    SHARE,
    SLIP,
    SPEED,
    STIFFNESS,
)
from wearsim.kernels.second_difference import add_second_difference
from wearsim.kernels.signatures import CONTACT, TABLE, VECTOR, float64, int64

if TYPE_CHECKING:
    from wearsim.kernels.signatures import Vector


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


@kernel(float64(float64, float64, float64, float64))
def shared(load: float, own: float, next_gap: float, last_gap: float) -> float:
    """Return what one of three springs of stiffness 1 takes of a load that closes their gaps.

    ``load`` is over the stiffness; gaps are those before any load, infinite where there is no
    spring. Springs close in the order of their gaps.
    """
    low = min(own, min(next_gap, last_gap))
    high = max(own, max(next_gap, last_gap))
    if high < math.inf:
        middle = own + next_gap + last_gap - low - high
    elif own < math.inf and next_gap < math.inf:
        middle = max(own, next_gap)
    elif own < math.inf and last_gap < math.inf:
        middle = max(own, last_gap)
    else:
        middle = math.inf
    closing = load + low
    if closing > middle:
        closing = 0.5 * (load + low + middle)
        if closing > high:
            closing = (load + low + middle + high) / 3.0
    return max(0.0, closing - own)


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
    the load is the given share of the line load. With one, the pairs of teeth in contact
    are equal springs in parallel, each closing its worn gap first, and beyond the ends of
    the path that of the tip's corner (``NEXT_GAP`` and ``LAST_GAP``, of the pairs one base pitch
    ahead and behind; infinite where there is none).
    """
    n = depth.size
    line_load, stiffness, pitch = constants[LINE_LOAD], constants[STIFFNESS], constants[BASE_PITCH]
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
            load[j] = line_load * columns[SHARE, j]
        return
    ahead, behind = 0, 0
    for j in range(n):
        place = columns[PLACE, j]
        while ahead < n - 2 and columns[PLACE, ahead + 1] < place + pitch:
            ahead += 1
        while behind < n - 2 and columns[PLACE, behind + 1] < place - pitch:
            behind += 1
        own = depth[j] * (1.0 + columns[MATE_DEPTH, j])
        next_gap, last_gap = columns[NEXT_GAP, j], columns[LAST_GAP, j]
        if next_gap < math.inf:
            next_gap += worn_gap(depth, columns, place + pitch, ahead)
        if last_gap < math.inf:
            last_gap += worn_gap(depth, columns, place - pitch, behind)
        load[j] = stiffness * shared(line_load / stiffness, own, next_gap, last_gap)
