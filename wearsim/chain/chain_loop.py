"""A closed chain round two or more sprockets: tangents, wrap angles, teeth in mesh, links.

Wheels stand in the order in which the chain reaches them, and span i leads from wheel i to the next
one. The chain turns counter-clockwise round wheels inside of the loop and clockwise round those
outside, where its joints bend the other way; the reverse where the whole loop runs clockwise.

Spans are tangents of the pitch circles. On a wheel the chain counts z pitches a turn, as in
`belt_links`: its links are chords of the pitch circle, which along the arc would be longer by the factor
(pi/z)/sin(pi/z). How the length changes while a tooth passes, since links are a polygon, is left out.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from wearsim.chain.chain_length import even_links
from wearsim.chain.loop_path import FULL_TURN, Floats, links_round, span_tangents, wrap_angles
from wearsim.errors import CaseError, Fault
from wearsim.geometry.gap import pitch_diameter

_NO_WRAP = 1e-9
"""Wrap angle below which a chain does not touch a wheel [rad]."""


@dataclass(frozen=True)
class Wheel:
    """A sprocket of a loop, or a smooth wheel that the rollers of the chain run on.

    Examples
    --------
    >>> Wheel("idler", (120.0, 40.0), teeth=13, outside=True).name
    'idler'
    """

    name: str  # unlike that of any other wheel of the loop
    centre: tuple[float, float]  # x, y [mm]; y points upwards
    teeth: int  # gaps, at least 5; 0 of a smooth wheel
    outside: bool = False  # whether the chain runs round it with its back
    radius: float = 0.0  # of a smooth wheel [mm]; 0 of a sprocket


@dataclass(frozen=True)
class ChainLoop:
    """A closed chain round wheels, in the order in which it reaches them.

    Raises
    ------
    CaseError
        A number is out of its range, two wheels overlap with their tip circles, taken with the diameters
        p (0.6 + cot(pi/z)) of ANSI B29.1, the chain does not touch a wheel, does not turn once in all,
        crosses itself, or runs through a wheel.

    Examples
    --------
    >>> loop = ChainLoop(10.0, (Wheel("driver", (0.0, 0.0), 20), Wheel("driven", (300.0, 0.0), 20)))
    >>> loop.links, loop.teeth_in_mesh.tolist(), loop.span_lengths.tolist()
    (80.0, [10.0, 10.0], [300.0, 300.0])
    """

    pitch: float  # of the new chain [mm], above 0
    wheels: tuple[Wheel, ...]  # two or more, two of them inside
    plate_height: float = 0.0  # of the links [mm]; half of it stands out on both sides of a span
    # by how much the pitch of the chain has grown; its rollers ride as much higher on the wheels
    elongation: float = 0.0
    clockwise: bool = False  # whether the chain runs round the whole loop clockwise
    roller_radius: float = 0.0  # by which joints lie further out than a smooth wheel [mm]

    def __post_init__(self) -> None:
        object.__setattr__(self, "wheels", tuple(self.wheels))
        for faults in (_number_faults, _overlap_faults, _turning_faults, _path_faults):
            if found := [Fault(f"chain loop: {text}") for text in faults(self)]:
                raise CaseError(found)

    def index(self, name: str) -> int:
        """Return the place of the wheel of a name."""
        names = [wheel.name for wheel in self.wheels]
        if name not in names:
            raise CaseError(
                [Fault(f"chain loop: no wheel is called {name!r}: use one of {', '.join(names)}")]
            )
        return names.index(name)

    @property
    def chain_pitch(self) -> float:
        """Pitch of the chain with its elongation [mm]."""
        return self.pitch * (1.0 + self.elongation)

    @cached_property
    def teeth(self) -> Floats:
        """Teeth of the wheels, shape (n,); of a smooth one the links that lie round all of it."""
        return np.array([wheel.teeth or self._links_round(wheel) for wheel in self.wheels], float)

    def _links_round(self, wheel: Wheel) -> float:
        """Chords of the pitch on the circle through the joints on a smooth wheel."""
        return math.pi / math.asin(0.5 * self.chain_pitch / (wheel.radius + self.roller_radius))

    @cached_property
    def senses(self) -> Floats:
        """1 where the chain turns counter-clockwise, -1 where clockwise, shape (n,)."""
        return self.turn * np.array([-1.0 if wheel.outside else 1.0 for wheel in self.wheels])

    @property
    def turn(self) -> float:
        """1 where the loop as a whole turns counter-clockwise, -1 where clockwise."""
        return -1.0 if self.clockwise else 1.0

    @cached_property
    def centres(self) -> Floats:
        """Centres of the wheels [mm], shape (n, 2)."""
        return np.array([wheel.centre for wheel in self.wheels], float)

    @cached_property
    def pitch_radii(self) -> Floats:
        """Radii of the circles through the joints [mm], shape (n,)."""
        return np.array(
            [
                0.5 * pitch_diameter(self.chain_pitch, wheel.teeth)
                if wheel.teeth
                else wheel.radius + self.roller_radius
                for wheel in self.wheels
            ]
        )

    @property
    def tip_radii(self) -> Floats:
        """Radii of the tips [mm], shape (n,), with the diameters p (0.6 + cot(pi/z)) of ANSI B29.1.

        Of a smooth wheel its own.
        """
        tips = 0.5 * self.pitch * (0.6 + 1.0 / np.tan(math.pi / self.teeth))
        return np.array([wheel.radius or tip for wheel, tip in zip(self.wheels, tips, strict=True)])

    @property
    def mean_radii(self) -> Floats:
        """Chain speed over angular speed, z p/(2 pi) [mm], shape (n,): in the mean a pull has this lever."""
        return self.teeth * self.chain_pitch / FULL_TURN

    @cached_property
    def _tangents(self) -> tuple[Floats, Floats]:
        return span_tangents(self.centres, self.senses * self.pitch_radii)

    @property
    def span_angles(self) -> Floats:
        """Direction in which the chain runs along each span [rad], shape (n,)."""
        return self._tangents[0]

    @property
    def span_lengths(self) -> Floats:
        """Lengths of the spans [mm], shape (n,)."""
        return self._tangents[1]

    @cached_property
    def directions(self) -> Floats:
        """Unit vectors in which the chain runs along each span, shape (n, 2)."""
        return np.column_stack((np.cos(self.span_angles), np.sin(self.span_angles)))

    @cached_property
    def starts(self) -> Floats:
        """Where each span leaves its wheel [mm], shape (n, 2)."""
        return self.centres + self._outwards(self.directions)

    @cached_property
    def ends(self) -> Floats:
        """Where each span reaches the next wheel [mm], shape (n, 2)."""
        reached = self.centres + self._outwards(np.roll(self.directions, 1, axis=0))
        return np.roll(reached, -1, axis=0)

    def _outwards(self, directions: Floats) -> Floats:
        """Vectors from the centres to where a chain of these directions touches."""
        right = np.column_stack((directions[:, 1], -directions[:, 0]))
        return (self.senses * self.pitch_radii)[:, None] * right

    @cached_property
    def wrap_angles(self) -> Floats:
        """Angle by which the chain turns on each wheel [rad], shape (n,)."""
        return wrap_angles(self.span_angles, self.senses)

    @property
    def teeth_in_mesh(self) -> Floats:
        """Wrap angle over pitch angle of each wheel, shape (n,)."""
        return self.wrap_angles * self.teeth / FULL_TURN

    @property
    def links(self) -> float:
        """Links that fit exactly, in general no whole number."""
        return links_round(self.chain_pitch, self.span_lengths, self.wrap_angles, self.teeth)

    @property
    def even_links(self) -> int:
        """Next even number of links, which needs no offset link."""
        return even_links(self.links)

    @property
    def length(self) -> float:
        """Length of the chain, links times pitch [mm]."""
        return self.links * self.chain_pitch

    @property
    def circle_length(self) -> float:
        """Length of the line along spans and pitch circles [mm]: a little more than the chain's."""
        return float(np.sum(self.span_lengths) + np.sum(self.pitch_radii * self.wrap_angles))

    def span_name(self, span: int) -> str:
        """Return the names of the wheels that a span joins."""
        after = self.wheels[(span + 1) % len(self.wheels)]
        return f"{self.wheels[span].name!r} to {after.name!r}"


def _number_faults(loop: ChainLoop) -> Iterator[str]:
    """Yield what is wrong with single numbers and names."""
    if not 0.0 < loop.pitch < math.inf:
        yield f"the pitch must be above 0, is {loop.pitch:g} mm: give the chain's"
    if not 0.0 <= loop.plate_height < math.inf:
        yield f"the plate height must be at least 0, is {loop.plate_height:g} mm: give the chain's, or 0"
    if not 0.0 <= loop.elongation < 1.0:
        yield f"the elongation must be at least 0 and below 1, is {loop.elongation:g}: 0.03 is 3 %"
    if (inside := sum(not wheel.outside for wheel in loop.wheels)) < 2:
        yield f"at least two wheels must lie inside the loop, {inside} do: add one"
    names = [wheel.name for wheel in loop.wheels]
    for name in sorted({name for name in names if names.count(name) > 1}):
        yield f"wheels must have different names, {names.count(name)} are called {name!r}: rename them"
    for wheel in loop.wheels:
        if not wheel.radius and wheel.teeth < 5:
            yield f"wheel {wheel.name!r} needs at least 5 teeth, has {wheel.teeth}: use more"
        if wheel.radius and not (width := 2.0 * wheel.radius) >= (least := _least_width(loop)):
            yield (
                f"the smooth wheel {wheel.name!r} must be at least {least:.4g} mm in diameter, for 5 links "
                f"round it, is {width:.4g} mm: use a larger one"
            )
        if len(wheel.centre) != 2 or not np.all(np.isfinite(wheel.centre)):
            yield f"wheel {wheel.name!r} needs a centre of two finite numbers, has {wheel.centre}: correct it"


def _least_width(loop: ChainLoop) -> float:
    """Return the diameter of a smooth wheel round which 5 links lie [mm]."""
    return pitch_diameter(loop.chain_pitch, 5) - 2.0 * loop.roller_radius


def _overlap_faults(loop: ChainLoop) -> Iterator[str]:
    """Yield the pairs of wheels whose tips overlap; all others have tangents."""
    tips = loop.tip_radii
    for i, j in combinations(range(len(loop.wheels)), 2):
        distance, least = math.dist(loop.centres[i], loop.centres[j]), tips[i] + tips[j]
        if not distance >= least:
            yield (
                f"wheels {loop.wheels[i].name!r} and {loop.wheels[j].name!r} must not overlap, are "
                f"{distance:.6g} mm apart: use at least {math.ceil(1e3 * least) / 1e3:.10g} mm"
            )


def _turning_faults(loop: ChainLoop) -> Iterator[str]:
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


def _path_faults(loop: ChainLoop) -> Iterator[str]:
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
                    f"{distance:.6g} mm from its centre and needs {least:.6g} mm: move it, or route the "
                    "chain round the wheel"
                )


def _cross(a: Floats, b: Floats, c: Floats, d: Floats) -> bool:
    """Whether the straight lines from a to b and from c to d cross."""

    def side(p: Floats, q: Floats, r: Floats) -> float:
        return float((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))

    return side(a, b, c) * side(a, b, d) < 0.0 and side(c, d, a) * side(c, d, b) < 0.0
