"""A pair of spur gears whose flanks wear each other."""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from wearsim.contact.engagement import ContactKind, FlankContact
from wearsim.contact.hertz import half_width
from wearsim.geometry.gear.mesh import Mesh, ToothPair
from wearsim.geometry.profile_points import Profile, Vector
from wearsim.kernels.gear_pair import COLUMNS, gear_pair_contact

_LEAST_CURVATURE = 0.04
"""Of the least relative curvature of the new flanks: where a worn step leaves a hollow of less, the
mate bridges it, with a contact at most five times as wide as on new flanks."""

_ELSEWHERE = 0.7
"""Points of a grid whose places are others, over those of the flank."""


@dataclass(frozen=True, eq=False)
class GearPairMechanism:
    """Both flanks of a gear pair, in the cycles of the pinion.

    One depth stands for both: flanks that meet at the same place share load, pressure and
    sliding speed, so the wheel's depth is at any time

        h2/h1 = (k2/k1) (v_t1/v_t2) z1/z2

    of the pinion's: the wheel meets u times less often. Every tooth meets the average of its
    mates, as with hunting teeth or teeth all alike.

    Equation gears.md (4).
    """

    pair: ToothPair  # the new gears
    torque: float  # of the pinion over the face width [N]
    angular_speed: float  # of the pinion [rad/s]
    modulus: float  # contact modulus E* [MPa]
    mate_coefficient: float  # k2/k1, wear coefficient of the wheel over that of the pinion
    # of one pair of teeth per face width [N/mm2]; 0 for rigid teeth that share the load half and half
    stiffness: float
    points: int  # of the flank, at least 5

    @cached_property
    def mesh(self) -> Mesh:
        """The way of the new teeth through contact."""
        return self.pair.mesh(self.points)

    @property
    def place(self) -> Vector:
        """Places of the points, growing evenly with the turn [mm]."""
        return self.mesh.place

    @property
    def mate_depth(self) -> Vector:
        """Depth of the wheel over that of the pinion at every point.

        Equation gears.md (4).
        """
        own, other = self.mesh.rolling
        return np.asarray(self.mate_coefficient * own / (other * self.pair.circles.gear_ratio))

    @property
    def slip_ratio(self) -> Vector:
        """|v_s|/v_t1 of the pinion, |1 - v_t2/v_t1|.

        Equation gears.md (2).
        """
        own, other = self.mesh.rolling
        return np.asarray(np.abs(1.0 - other / own))

    @property
    def sliding_speed(self) -> Vector:
        """|v_s| [mm/s]."""
        relative = self.angular_speed * (1.0 + 1.0 / self.pair.circles.gear_ratio)
        return np.abs(self.mesh.pitch_point_distance) * relative

    @property
    def curvature(self) -> Vector:
        """Relative curvature of the new flanks [1/mm]."""
        return self.mesh.relative_curvature

    @property
    def share(self) -> Vector:
        """Share of the load that rigid teeth carry: 1, one half where two pairs touch.

        At the ends of single contact it passes from one to the other over the width of the
        contact, in which a point of the flank sees both.
        """
        mesh = self.mesh
        first, last = mesh.place[-1] - mesh.pitch, mesh.place[0] + mesh.pitch
        load = self.torque / mesh.lever
        rolled = mesh.pitch / (math.tau / self.pair.teeth[0]) / mesh.lever
        width = 2.0 * float((half_width(load, self.curvature, self.modulus) * rolled).max())
        inside = np.minimum(mesh.place - first, last - mesh.place) / max(width, 1e-9) + 0.5
        share: Vector = 0.5 + 0.5 * np.clip(inside, 0.0, 1.0)
        return share

    @cached_property
    def contact(self) -> FlankContact:
        """The pinion's flank and its contact."""
        mesh, profile = self.mesh, self.mesh.flank
        least = _LEAST_CURVATURE * float(self.curvature.min())
        columns = np.empty((COLUMNS, mesh.place.size))
        columns[:] = (
            mesh.arc[0],
            mesh.arc[1],
            self.curvature,
            self.slip_ratio,
            self.sliding_speed,
            profile.normal_x,
            profile.normal_y,
            self.mate_depth,
            self.share,
            mesh.place,
            *mesh.gaps,
            mesh.lever,
            *mesh.levers,
        )
        at_pitch_point = int(np.argmin(np.abs(mesh.pitch_point_distance)))
        return FlankContact(
            kind=ContactKind.TRAVELLING,
            kernel=gear_pair_contact,
            constants=np.array([self.torque, self.stiffness, mesh.pitch, least]),
            columns=columns,
            profile=profile,
            arc_length=columns[0],
            mate_radius=1.0 / abs(float(mesh.curvature[1, at_pitch_point])),
            mate="mating flank",
            modulus=self.modulus,
            slip_curvature_exponent=0.0,
            offset_form=False,
            least_curvature=least,
        )

    @property
    def flank(self) -> Profile:
        """The pinion's flank from the place where contact starts to its tip."""
        return self.mesh.flank

    def other_grids(self) -> tuple[FlankContact, ...]:
        """Return the flank on every second point, on every fourth, and on points elsewhere.

        A kink beside a point stays there when every second one is left out.
        """
        half = self.contact.coarsened()
        elsewhere = replace(self, points=round(_ELSEWHERE * self.points))
        return half, half.coarsened(), elsewhere.contact

    def refined(self, level: int) -> "GearPairMechanism | None":
        """Return the pair on twice as many points."""
        return replace(self, points=2 * self.points - 1) if level == 1 else None

    def mate_columns(self, depth: Vector) -> dict[str, Vector]:
        """Return the wheel's flank as it wears, at the points that meet those of the pinion."""
        new, worn = self.mesh.mate, self.mate_depth * depth
        return {
            "path_mm": np.tile(self.mesh.pitch_point_distance, depth.shape[0]),
            "wheel_x_mm": (new.x[::-1] - worn * new.normal_x[::-1]).ravel(),
            "wheel_y_mm": (new.y[::-1] - worn * new.normal_y[::-1]).ravel(),
            "wheel_depth_mm": worn.ravel(),
        }

    def worn_contact_ratio(self, x: Vector, y: Vector) -> float:
        """Return the contact ratio of the new pair: flanks keep to their path."""
        return self.mesh.contact_ratio

    def assumptions(self) -> list[str]:
        """Return what this picture takes for granted."""
        sharing = (
            f"pairs of teeth share the load as springs of {self.stiffness / 1000.0:g} N/(mm um), with gaps "
            "by wear and with contact of the tip corners before and after the path of contact"
            if self.stiffness
            else "teeth are rigid; two pairs in contact share the load equally, also when worn"
        )
        common = math.gcd(*self.pair.teeth)
        meeting = (
            "every tooth meets every tooth of its mate (hunting)"
            if common == 1
            else f"each tooth meets only one in {common} teeth of its mate; all are alike when new and stay "
            "so"
        )
        return [
            "worn flanks meet where they did when new, on the line of action, with the same sliding",
            sharing,
            meeting,
            "the mate bridges hollows that a step of the load leaves: the relative curvature is not taken "
            f"below {_LEAST_CURVATURE:g} of that of the new flanks; pressures there are not known, but wear "
            "with pressure exponent 1 does not depend on them",
            "dynamic loads, misalignment and wear by tip corners outside the path of contact are neglected",
        ]
