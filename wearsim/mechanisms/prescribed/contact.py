"""Load and sliding along a flank as the user gives them, from his own run or measurement."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from wearsim.contact.engagement import ContactKind, FlankContact
from wearsim.geometry.profile_points import Profile, Vector
from wearsim.kernels.prescribed import prescribed_contact


def flank_from_curvature(arc_length: Vector, curvature: Vector) -> Profile:
    """Return the flank whose signed curvature is given along its arc, starting at (0, 0).

    The direction is integrated by the trapezoidal rule and the points by the chord of
    each arc; the flank starts along -x, so that its normal points to +y at the start.
    """
    step = np.diff(arc_length)
    turn = 0.5 * (curvature[1:] + curvature[:-1]) * step
    direction = np.pi + np.concatenate([[0.0], np.cumsum(turn)])
    middle = 0.5 * (direction[1:] + direction[:-1])
    chord = step * np.sinc(turn / (2.0 * np.pi))
    x = np.concatenate([[0.0], np.cumsum(chord * np.cos(middle))])
    y = np.concatenate([[0.0], np.cumsum(chord * np.sin(middle))])
    return Profile(x, y)


@dataclass(frozen=True, eq=False)
class PrescribedMechanism:
    """A contact whose load, sliding and initial curvature are given per point."""

    kind: ContactKind  # TRAVELLING where slip is the ratio |v_s|/v_t, LOCAL where it is a path [mm]
    arc_length: Vector  # increasing [mm]
    load_per_width: Vector  # normal load [N/mm]
    slip: Vector  # slip ratio or path [mm]
    sliding_speed: Vector  # sliding speed [mm/s], nan where it is not given
    flank_curvature: Vector  # of the unworn flank, convex positive [1/mm]; the end rows keep it as they wear
    mate_radius: float  # radius of the mate [mm]
    modulus: float  # contact modulus E* [MPa]

    @cached_property
    def contact(self) -> FlankContact:
        """The flank and its contact."""
        profile = flank_from_curvature(self.arc_length, self.flank_curvature)
        rows = [
            self.arc_length,
            self.load_per_width,
            self.slip,
            self.sliding_speed,
            self.flank_curvature,
            profile.normal_x,
            profile.normal_y,
        ]
        return FlankContact(
            kind=self.kind,
            kernel=prescribed_contact,
            constants=np.array([1.0 / self.mate_radius]),
            columns=np.array(rows),
            profile=profile,
            arc_length=self.arc_length,
            mate_radius=self.mate_radius,
            mate="roller",
            modulus=self.modulus,
            slip_curvature_exponent=0.0,
            offset_form=True,
        )

    def other_grids(self) -> tuple[FlankContact, ...]:
        """Return the flank on every second row and on every fourth."""
        half = self.contact.coarsened()
        return half, half.coarsened()

    def refined(self, level: int) -> None:
        """Return nothing: between the rows of a table nothing is known."""

    def mate_columns(self, depth: Vector) -> dict[str, Vector]:
        """Return nothing: rollers do not wear."""
        return {}

    def worn_contact_ratio(self, x: Vector, y: Vector) -> float:
        """Return nan: a table of loads says nothing of the rollers before and after."""
        return float("nan")

    def assumptions(self) -> list[str]:
        """Return what this picture takes for granted."""
        return [
            "load and sliding along the flank are those of the table and do not change with wear",
            "the curvature of the first and the last row does not change",
        ]
