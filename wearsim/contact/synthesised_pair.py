"""Gears synthesised for a contact stress, as a pair of teeth that meshes."""

from dataclasses import dataclass

import numpy as np

from wearsim.contact.prescribed_stress import LoadedPair
from wearsim.geometry.gear.mesh import Mesh, mesh_on
from wearsim.geometry.gear.path_of_contact import PathOfContact
from wearsim.geometry.gear.path_synthesis import PathSynthesis
from wearsim.geometry.gear.plane_gearing import PitchCircles


@dataclass(frozen=True, eq=False)
class SynthesisedPair:
    """Gears whose path of contact through the pitch point has a prescribed contact stress."""

    loaded: LoadedPair  # the pair with its stress
    teeth: tuple[int, int]  # z1 and z2
    # distances from the pitch point of the first and the last contact [mm], below and above 0: those of the
    # tips of wheel and pinion
    reach: tuple[float, float]

    @property
    def circles(self) -> PitchCircles:
        """The pitch circles."""
        return self.loaded.circles

    @property
    def pitch_point_angle(self) -> float:
        """Pressure angle at the pitch point [rad]."""
        return self.loaded.pitch_point_crossing().pressure_angle

    def line(self, points: int) -> PathOfContact:
        """Return the path of contact at points that are nearly evenly turned."""
        crossing, synthesis = (
            self.loaded.pitch_point_crossing(),
            PathSynthesis(self.circles, self.loaded.radius_rule, 1),
        )
        tried = np.linspace(*self.reach, points)
        roll = synthesis.through_pitch_point(crossing, tried).roll_angle
        even = np.interp(np.linspace(roll[0], roll[-1], points), roll, tried)
        even[[0, -1]] = self.reach
        return synthesis.through_pitch_point(crossing, even)

    def mesh(self, points: int) -> Mesh:
        """Return the way of a pair of teeth through contact."""
        return mesh_on(self.line(points), self.teeth)
