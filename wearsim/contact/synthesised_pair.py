"""Gears synthesised for a contact stress, as a pair of teeth that meshes."""

from dataclasses import dataclass

import numpy as np

from wearsim.contact.prescribed_stress import LoadedPair
from wearsim.geometry.gear.line_of_action import LineOfAction
from wearsim.geometry.gear.line_synthesis import Synthesis
from wearsim.geometry.gear.mesh import Mesh, mesh_on
from wearsim.geometry.gear.plane_gearing import PitchCircles


@dataclass(frozen=True, eq=False)
class SynthesisedPair:
    """Gears whose line of action through the pole has a prescribed contact stress.

    Attributes
    ----------
    loaded : LoadedPair
        The pair with its stress.
    teeth : tuple of int
        z1 and z2.
    reach : tuple of float
        Distances from the pole of the first and the last contact [mm], below and above 0: those
        of the tips of wheel and pinion.
    """

    loaded: LoadedPair
    teeth: tuple[int, int]
    reach: tuple[float, float]

    @property
    def circles(self) -> PitchCircles:
        """The pitch circles."""
        return self.loaded.circles

    @property
    def pole_angle(self) -> float:
        """Pressure angle in the pole [rad]."""
        return self.loaded.pole_crossing().pressure_angle

    def line(self, points: int) -> LineOfAction:
        """Return the line of action at points that are nearly evenly turned."""
        crossing, synthesis = (self.loaded.pole_crossing(), Synthesis(self.circles, self.loaded.law, 1))
        tried = np.linspace(*self.reach, points)
        roll = synthesis.through_pole(crossing, tried).roll_angle
        even = np.interp(np.linspace(roll[0], roll[-1], points), roll, tried)
        even[[0, -1]] = self.reach
        return synthesis.through_pole(crossing, even)

    def mesh(self, points: int) -> Mesh:
        """Return the way of a pair of teeth through contact."""
        return mesh_on(self.line(points), self.teeth)
