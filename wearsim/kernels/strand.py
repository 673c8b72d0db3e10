"""Contact of a worn flank with the rollers of a straight strand (a pin rack)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import CONTACT

if TYPE_CHECKING:
    from wearsim.jit.signatures import Vector

HEIGHT, RADIUS, PULL, LOAD_END, LOAD_START, PER_OVERLAP, SLIP_FRACTION, ANGULAR_SPEED = range(8)
"""Places of the constants: height of the strand's line, radius of the roller, pull per face width, end and
start of the load along the strand, 1/overlap, slip fraction, angular speed."""


@kernel(CONTACT)
def strand_contact(
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
    """Write load per width, slip ratio, sliding speed and relative curvature at every point.

    The roller centre is one roller radius off the point along the normal and must lie
    on the strand's line; its distance before the line of the pitch point, the pressure angle and the
    slip ratio follow without an angle being formed (the distance stands in ``speed`` and
    the cosine in ``relative`` until both are replaced at the end). A point that the line does not
    reach, or outside the stretch that carries load, has load zero.

    Equations physics.md (S8) to (S11).
    """
    height, radius, pull = constants[HEIGHT], constants[RADIUS], constants[PULL]
    x_min, x_max = constants[LOAD_END], constants[LOAD_START]
    per_overlap, fraction, omega = constants[PER_OVERLAP], constants[SLIP_FRACTION], constants[ANGULAR_SPEED]
    n = x.size
    for j in range(n):
        cx, cy = x[j] + radius * normal_x[j], y[j] + radius * normal_y[j]
        inside = cx * cx + cy * cy - height * height
        speed[j] = math.sqrt(inside) if inside > 0.0 else 0.0
    for j in range(n):
        cx, cy = x[j] + radius * normal_x[j], y[j] + radius * normal_y[j]
        across = normal_x[j] * cy - normal_y[j] * cx
        along = normal_x[j] * cx + normal_y[j] * cy
        relative[j] = (across * height - along * speed[j]) / (cx * cx + cy * cy)
    for j in range(n):
        share = min(1.0, min(x_max - speed[j], speed[j] - x_min) * per_overlap)
        load[j] = pull * share / relative[j] if share > 0.0 else 0.0
        slip[j] = (
            fraction * (1.0 + radius * relative[j] / speed[j]) * (1.0 + radius * curvature[j])
            if load[j] > 0.0
            else 0.0
        )
    for j in range(n):
        speed[j] = fraction * omega * (speed[j] / relative[j] + radius) if load[j] > 0.0 else 0.0
        relative[j] = 1.0 / radius + curvature[j]
