"""Why wheels and chain make no loop that can run, with the names of the parts and their figures."""

import math
from collections.abc import Iterator
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from wearsim.chain.loop_path import FULL_TURN, Floats, span_tangents, wrap_angles

if TYPE_CHECKING:
    from wearsim.chain.chain_loop import ChainLoop

_NO_WRAP = 1e-9
"""Wrap angle below which a chain does not touch a wheel [rad]."""


def number_faults(loop: "ChainLoop") -> Iterator[str]:
    """Yield what is wrong with single numbers and names."""
    if not 0.0 < loop.pitch < math.inf:
        yield f"the pitch must be above 0, is {loop.pitch:g} mm: give the chain's"
    if not 0.0 <= loop.plate_height < math.inf:
        yield f"the plate height must be at least 0, is {loop.plate_height:g} mm: give the chain's, or 0"
    if not 0.0 <= loop.elongation < 1.0:
        yield f"the elongation must be at least 0 and below 1, is {loop.elongation:g}: 0.03 is 3 %"
    if (inside := sum(not wheel.outside for wheel in loop.wheels)) < 2:
        yield f"two wheels or more must lie inside of the loop, {inside} do: add one"
    names = [wheel.name for wheel in loop.wheels]
    for name in sorted({name for name in names if names.count(name) > 1}):
        yield f"wheels must have names of their own, {names.count(name)} are called {name!r}: rename them"
    for wheel in loop.wheels:
        if wheel.teeth < 5:
            yield f"wheel {wheel.name!r} needs at least 5 teeth, has {wheel.teeth}: use more"
        if len(wheel.centre) != 2 or not np.all(np.isfinite(wheel.centre)):
            yield f"wheel {wheel.name!r} needs a centre of two finite numbers, has {wheel.centre}: correct it"


def overlap_faults(loop: "ChainLoop") -> Iterator[str]:
    """Yield the pairs of wheels whose tips overlap; all others have tangents."""
    tips = loop.tip_radii
    for i, j in combinations(range(len(loop.wheels)), 2):
        distance, least = math.dist(loop.centres[i], loop.centres[j]), tips[i] + tips[j]
        if not distance >= least:
            yield (
                f"wheels {loop.wheels[i].name!r} and {loop.wheels[j].name!r} must not overlap, are "
                f"{distance:.6g} mm apart: use at least {math.ceil(1e3 * least) / 1e3:.10g} mm"
            )


def turning_faults(loop: "ChainLoop") -> Iterator[str]:
    """Yield the wheels that the chain passes by, or a path that is not one turn.

    Equation physics.md (D4).

    Parameters
    ----------
    loop : ChainLoop
        Wheels that do not overlap.

    Yields
    ------
    str
        What must hold, what it is, and what to do.
    """
    missed, turning = _passed_by(loop.span_angles, loop.span_lengths, loop.senses, loop.pitch_radii)
    once = abs(turning - loop.turn * FULL_TURN) < 1e-6
    if once and not missed.size:
        return
    signed = (loop.senses * loop.pitch_radii)[::-1]
    backwards = span_tangents(loop.centres[::-1], signed)
    other_way = _passed_by(*backwards, loop.senses[::-1], loop.pitch_radii[::-1])
    if not other_way[0].size and abs(other_way[1] - loop.turn * FULL_TURN) < 1e-6:
        order = ", ".join(wheel.name for wheel in reversed(loop.wheels))
        must, does = ("clockwise", "counter-clockwise")[:: int(-loop.turn)]
        yield f"the chain must run {must}, runs {does}: give the wheels in the order {order}"
        return
    for i in missed:
        wrap = math.degrees((loop.wrap_angles[i] + math.pi) % FULL_TURN - math.pi)
        before, after = loop.wheels[i - 1].name, loop.wheels[(i + 1) % len(loop.wheels)].name
        yield (
            f"the chain does not touch wheel {loop.wheels[i].name!r} between {before!r} and {after!r}: its "
            f"wrap angle must be above 0, would be {wrap:.4g} deg: move it, put it on the other side, "
            "leave it out, or correct the order of the wheels"
        )
    if not missed.size:
        yield (
            f"the chain must turn by 360 deg in all, turns by {math.degrees(turning):.6g} deg: correct the "
            "order of the wheels, or which of them lie outside"
        )


def _passed_by(
    angles: Floats, lengths: Floats, senses: Floats, radii: Floats
) -> tuple[NDArray[np.intp], float]:
    """Wheels whose own two spans cross, or that have no wrap, and the turn of the whole path [rad]."""
    wraps = wrap_angles(angles, senses)
    crossing = radii * np.abs(np.tan(0.5 * wraps))
    shorter = np.minimum(lengths, np.roll(lengths, 1))
    none = np.minimum(wraps, FULL_TURN - wraps) < _NO_WRAP
    missed = none | ((wraps > math.pi) & (crossing < shorter) & (len(wraps) > 2))
    return np.flatnonzero(missed), float(np.sum(senses * wraps))


def path_faults(loop: "ChainLoop") -> Iterator[str]:
    """Yield spans that cross each other or run through a wheel."""
    count = len(loop.wheels)
    for i, j in combinations(range(count), 2):
        if (j - i) % count in (1, count - 1):
            continue
        if _cross(loop.starts[i], loop.ends[i], loop.starts[j], loop.ends[j]):
            yield (
                f"spans must not cross, {loop.span_name(i)} crosses {loop.span_name(j)}: correct the order "
                "of the wheels, or which of them lie outside"
            )
    for i in range(count):
        for k in set(range(count)) - {i, (i + 1) % count}:
            along = np.dot(loop.centres[k] - loop.starts[i], loop.directions[i])
            nearest = loop.starts[i] + np.clip(along, 0.0, loop.span_lengths[i]) * loop.directions[i]
            distance = math.dist(nearest, loop.centres[k])
            least = loop.tip_radii[k] + 0.5 * loop.plate_height
            if not distance >= least:
                yield (
                    f"the span {loop.span_name(i)} must clear wheel {loop.wheels[k].name!r}, runs "
                    f"{distance:.6g} mm from its centre and needs {least:.6g} mm: move it, or lead the "
                    "chain round the wheel"
                )


def _cross(a: Floats, b: Floats, c: Floats, d: Floats) -> bool:
    """Whether the straight lines from a to b and from c to d cross."""

    def side(p: Floats, q: Floats, r: Floats) -> float:
        return float((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))

    return side(a, b, c) * side(a, b, d) < 0.0 and side(c, d, a) * side(c, d, b) < 0.0
