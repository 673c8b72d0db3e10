"""Wear that becomes severe: what multiplies the depth of a cycle where pressure and sliding are high."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import VECTOR, float64, void

if TYPE_CHECKING:
    from wearsim.jit.signatures import Vector

NONE, BY_PRESSURE_SPEED, BY_T_GAMMA = 0.0, 1.0, 2.0
"""Kinds of severity."""

COEFFICIENT, PRESSURE_EXPONENT, LOAD_EXPONENT, SPEED_EXPONENT, CASE_DEPTH, CORE_FACTOR = range(6)
KIND, LIMIT, FACTOR = range(6, 9)
"""Places of the numbers of a law, as ``WearLaw.numbers`` gives them; the last three are its severity."""

TRANSITION = 0.1
"""Width of the transition as a part of the limit."""

MILD, LEVEL, STEEP = 5.3, 55.0, 61.9
"""Slope, level and slope of the rate by T-gamma [ug/(m mm2) per N/mm2, ug/(m mm2)]."""

FIRST, SECOND = 10.4, 77.2
"""T-gamma per area at which the branches meet [N/mm2]."""


@kernel(float64(float64, float64), quick=True)
def severe_multiple(ratio: float, factor: float) -> float:
    """Return the multiple of the coefficient at a part of the limit of p v.

    It is 1 up to the limit and ``factor`` from 1.1 times it on; its logarithm rises smoothly in between.

    Equation physics.md (L7).
    """
    if not ratio > 1.0:
        return 1.0
    part = min(1.0, (ratio - 1.0) / TRANSITION)
    return float(factor ** (part * part * (3.0 - 2.0 * part)))


@kernel(float64(float64), quick=True)
def t_gamma_rate(energy: float) -> float:
    """Return the rate by T-gamma over the contact area [ug/(m mm2)], of energy in N/mm2.

    Equation physics.md (L8).
    """
    if energy < FIRST:
        return MILD * energy
    return LEVEL + STEEP * max(0.0, energy - SECOND)


@kernel(void(VECTOR, VECTOR, VECTOR, VECTOR, float64, VECTOR, VECTOR))
def make_severe(
    load: Vector, slip: Vector, speed: Vector, relative: Vector, modulus: float, law: Vector, depth: Vector
) -> None:
    """Multiply the depth of a cycle by the severity of every loaded point.

    Equations physics.md (L6) and (L8).
    """
    for j in range(depth.size):
        if depth[j] > 0.0:
            pressure = math.sqrt(load[j] * relative[j] * (modulus / math.pi))
            if law[KIND] == BY_PRESSURE_SPEED:
                depth[j] *= severe_multiple(pressure * speed[j] / law[LIMIT], law[FACTOR])
            else:
                energy = law[FACTOR] * 0.25 * math.pi * pressure * slip[j]
                depth[j] *= t_gamma_rate(energy) / (MILD * energy)
