"""A closed chain round two or more sprockets: tangents, wrap angles, teeth in mesh, links.

Wheels stand in the order in which the chain reaches them, and span i leads from wheel i to the next
one. The chain turns counter-clockwise round wheels inside of the loop and clockwise round those
outside, where its joints bend the other way; the reverse where the whole loop runs clockwise.

Spans are tangents of the pitch circles. On a wheel the chain counts z pitches a turn, as in
`belt_links`: its links are chords of the pitch circle, which along the arc would be longer by the factor
(pi/z)/sin(pi/z). How the length changes while a tooth passes, since links are a polygon, is left out.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from wearsim.chain.chain_length import even_links
from wearsim.chain.loop_faults import number_faults, overlap_faults, path_faults, turning_faults
from wearsim.chain.loop_path import FULL_TURN, Floats, links_round, span_tangents, wrap_angles
from wearsim.errors import CaseError, Fault
from wearsim.geometry.gap import pitch_diameter


@dataclass(frozen=True)
class Wheel:
    """A sprocket of a loop.

    Examples
    --------
    >>> Wheel("idler", (120.0, 40.0), teeth=13, outside=True).name
    'idler'
    """

    name: str  # unlike that of any other wheel of the loop
    centre: tuple[float, float]  # x, y [mm]; y points upwards
    teeth: int  # gaps, at least 5
    outside: bool = False  # whether the chain runs round it with its back


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

    def __post_init__(self) -> None:
        object.__setattr__(self, "wheels", tuple(self.wheels))
        for faults in (number_faults, overlap_faults, turning_faults, path_faults):
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
        """Teeth of the wheels, shape (n,)."""
        return np.array([wheel.teeth for wheel in self.wheels], float)

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
        return np.array([0.5 * pitch_diameter(self.chain_pitch, wheel.teeth) for wheel in self.wheels])

    @property
    def tip_radii(self) -> Floats:
        """Radii of the tips [mm], shape (n,), with the diameters p (0.6 + cot(pi/z)) of ANSI B29.1."""
        return 0.5 * self.pitch * (0.6 + 1.0 / np.tan(math.pi / self.teeth))

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
