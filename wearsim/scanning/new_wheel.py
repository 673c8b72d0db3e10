"""The form that a wheel had when it was new, as stations along its gaps."""

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from wearsim.catalogue.catalogues import Chain, chains
from wearsim.catalogue.chain_names import known_chain_name
from wearsim.errors import CaseError, Fault, GeometryError
from wearsim.geometry.forms import TOOTH_FORMS
from wearsim.geometry.outline import along_ways, rotated
from wearsim.geometry.profile_points import Vector

if TYPE_CHECKING:
    from wearsim.case.model import Case

_FINE = 1e-4
"""Distance of chords from their arcs [mm]."""

STANDARDS = tuple(name for name, form in TOOTH_FORMS.items() if form.standard_gap)
"""Tooth forms that follow from a chain and a number of teeth."""


@dataclass(frozen=True, eq=False)
class NewWheel:
    """A wheel whose gaps are all alike."""

    teeth: int
    pitch: float  # of the chain [mm]
    gap: Vector  # points of a gap about +y, from its right tip to its left one [mm], shape (n, 2)
    words: str  # which form it is
    thickness: float  # of the teeth [mm]
    roller_diameter: float | None = None  # of the chain [mm]; None where no chain is known
    per_case: bool = False  # whether the number of teeth was said, not counted

    @property
    def tip_radius(self) -> float:
        """Radius of the tip circle [mm]."""
        return float(np.hypot(*self.gap[0]))

    @property
    def root_radius(self) -> float:
        """Least distance of a gap from the axis [mm]."""
        return float(np.hypot(*self.gap.T).min())

    @property
    def symmetric(self) -> bool:
        """Whether both sides of a gap are mirror images."""
        mirrored = self.gap[::-1] * [-1.0, 1.0]
        return len(mirrored) == len(self.gap) and bool(np.abs(mirrored - self.gap).max() < 1e-3 * self.pitch)

    @property
    def mirrored(self) -> "NewWheel":
        """The same wheel seen from its other side."""
        return replace(self, gap=self.gap[::-1] * [-1.0, 1.0])

    @property
    def area(self) -> float:
        """Area of the wheel without holes [mm2]."""
        x, y = np.concatenate([self.gap, rotated(self.gap[:1], math.tau / self.teeth)]).T
        return 0.5 * self.teeth * float(np.dot(x[:-1], y[1:]) - np.dot(x[1:], y[:-1]))

    def stations(self, count: int) -> "Stations":
        """Return places at equal steps along a gap."""
        way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(self.gap, axis=0).T))])
        at = np.linspace(0.0, way[-1], count + 2)[1:-1]
        step = 0.5 * (at[1] - at[0])
        points, before, after = (
            np.column_stack([np.interp(there, way, axis) for axis in self.gap.T])
            for there in (at, at - step, at + step)
        )
        along = after - before
        along /= np.hypot(*along.T)[:, None]
        # From the right tip through the bottom to the left one the steel is on the left hand.
        return Stations(points, np.column_stack([along[:, 1], -along[:, 0]]), at, way[-1])


@dataclass(frozen=True, eq=False)
class Stations:
    """Places along a gap, from its right tip to its left one."""

    points: Vector  # [mm], shape (n, 2)
    normals: Vector  # out of the steel, shape (n, 2)
    way: Vector  # from the right tip [mm], shape (n,)
    length: float  # of the gap [mm]

    @property
    def curvature(self) -> Vector:
        """Curvature of the gap, above 0 where the steel is hollow [1/mm]."""
        turn = np.unwrap(np.arctan2(self.normals[:, 1], self.normals[:, 0]))
        return np.asarray(-np.gradient(turn, self.way))

    @property
    def from_middle(self) -> Vector:
        """Way from the middle over half the length, positive on the left: from -1 to 1 [1]."""
        return np.asarray(2.0 * self.way / self.length - 1.0)


def wheel_of_case(case: "Case") -> NewWheel:
    """Return the new sprocket of a case."""
    shapes = case.drive.wheels(case.engaged_every)
    if len(shapes) != 1 or not shapes[0].new[0].rooted:
        text = "the case must have a sprocket whose whole gap is known, but has none: give its drive"
        raise CaseError([Fault(text, "mechanism.kind", case.name)])
    (shape,) = shapes
    space = shape.new[0]
    parts = []
    for stretch in (*space.right, *space.left):
        points, _ = along_ways(stretch.vertices[:-1], stretch.vertices[1:], stretch.bulges, _FINE)
        parts += [points, stretch.vertices[-1:]]
    points = np.concatenate(parts)
    apart = np.concatenate([[True], np.hypot(*np.diff(points, axis=0).T) > 1e-9])
    pitch = 2.0 * shape.pitch_radius * math.sin(math.pi / len(shape.new))
    words, chain = f"the sprocket of {case.title}", chain_of_case(case)
    roller = None if chain is None else float(chain.roller_diameter)
    return NewWheel(len(shape.new), pitch, points[apart], words, shape.width, roller, per_case=True)


def chain_of_case(case: "Case") -> Chain | None:
    """Return the chain of a case, None where it has none."""
    found: Chain | None = getattr(case.drive, "chain", None)
    return found


def chain_named(designation: str) -> Chain:
    """Return a chain of the catalogue."""
    try:
        return chains()[known_chain_name(designation)]
    except ValueError as error:
        raise CaseError([Fault(str(error), "", f"--chain {designation}")]) from None


def wheel_of_chain(designation: str, teeth: int, profile: str | None) -> NewWheel:
    """Return the sprocket of a standard form for a chain; by default the usual form of its series."""
    chain = chain_named(designation)
    form = profile or next(
        (name for name in STANDARDS if chain.series in TOOTH_FORMS[name].usual_for), STANDARDS[0]
    )
    try:
        outline = TOOTH_FORMS[form].gap(chain.pitch, chain.roller_diameter, teeth).outline(2001)
    except GeometryError as error:
        raise CaseError([Fault(str(error), "", f"--profile {form}")]) from None
    gap = np.column_stack([outline.x, outline.y])
    words = f"{form} for {chain.designation}, {teeth} teeth"
    thickness = (chain.strands - 1) * chain.transverse_pitch + chain.face_width / chain.strands
    return NewWheel(teeth, chain.pitch, gap, words, thickness, chain.roller_diameter)


def around(points: Vector, teeth: int) -> Vector:
    """Return rows of a gap's points in all gaps, counterclockwise, shape (teeth, n, 2)."""
    return np.stack([rotated(points, math.tau * number / teeth) for number in range(teeth)])
