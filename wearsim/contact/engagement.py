"""The seam between mechanisms and the wear engine: a contact, and one passage through it."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum
from typing import Protocol

import numpy as np

from wearsim.geometry.profile_points import Profile, Vector
from wearsim.kernels.flank_geometry import flank_frame


class ContactKind(Enum):
    """How a contact meets the points of a worn flank."""

    TRAVELLING = "travelling"
    """The whole contact ellipse sweeps every point; slip is the ratio |v_s|/v_t."""

    LOCAL = "local"
    """Slip is the path [mm] a point slides under the local peak pressure."""

    RESTING = "resting"
    """A mate rests in the outline and slides a path [mm]; its pressure follows from the gap."""


@dataclass(frozen=True)
class Engagement:
    """One passage of a flank through contact, as arrays over its phases (points of the flank)."""

    kind: ContactKind  # what `slip` means
    arc_length: Vector  # where on the flank [mm]
    load_per_width: Vector  # normal load [N/mm]; zero where there is no contact
    per_cycle: Vector  # how often in one cycle
    slip: Vector  # slip ratio, or path [mm] for a local contact
    sliding_speed: Vector  # sliding speed [mm/s], nan where it is not known
    relative_curvature: Vector  # sum of the signed curvatures of flank and roller [1/mm]


@dataclass(frozen=True, eq=False)
class FlankContact:
    """A flank and the compiled function that says how it is touched as it wears."""

    kind: ContactKind  # how the contact meets the points
    kernel: Callable[..., None]  # compiled function of the signature `kernels.signatures.CONTACT`
    constants: Vector  # numbers handed to it
    columns: Vector  # rows of values per point handed to it, shape (rows, points)
    profile: Profile  # the unworn flank
    arc_length: Vector  # arc length of the unworn points [mm]
    mate_radius: float  # radius of the mate [mm]
    modulus: float  # contact modulus E* [MPa]
    # d(ln slip)/d(ln relative curvature): 1 where slip follows from the worn geometry, else 0
    slip_curvature_exponent: float
    # whether load and sliding are those of the columns (rows as in `kernels.offset`) and the curvature
    # follows from the depth over their arc length, at the ends not at all; of the worn points otherwise
    offset_form: bool
    # relative curvature [1/mm] that the kernel takes where that of the worn flank is less: a mate that
    # bridges a hollow; 0 where it takes that of the flank everywhere
    least_curvature: float = 0.0
    mate: str = "mate"  # what touches the flank, in words

    @property
    def end_spacing(self) -> float:
        """Mean distance of the two first and of the two last points [mm]."""
        steps = np.diff(self.arc_length)
        return 0.5 * float(steps[0] + steps[-1])

    def coarsened(self) -> "FlankContact":
        """Return the same contact on about every second point."""
        profile, keep = self.profile.thinned()
        columns = self.columns
        if columns.shape[1] == self.profile.x.size:
            columns = np.ascontiguousarray(columns[:, keep])
        return replace(self, profile=profile, arc_length=self.arc_length[keep], columns=columns)

    def engage(self, x: Vector, y: Vector, depth: Vector) -> Engagement:
        """Return the engagement of a worn flank."""
        frame, touch = np.empty((4, x.size)), np.empty((4, x.size))
        flank_frame(x, y, *frame)
        self.kernel(x, y, *frame[:3], depth, self.constants, self.columns, *touch)
        load, slip, speed, relative = touch
        return Engagement(self.kind, self.arc_length, load, np.ones(x.size), slip, speed, relative)

    def new_engagement(self) -> Engagement:
        """Return the engagement of the unworn flank."""
        profile = self.profile
        return self.engage(profile.x.copy(), profile.y.copy(), np.zeros(profile.x.size))


class Mechanism(Protocol):
    """What touches a flank, where, how hard and with how much slip."""

    @property
    def contact(self) -> FlankContact:
        """The flank and its contact."""

    def other_grids(self) -> tuple[FlankContact, ...]:
        """Return the new flank on other points, whose lives tell how wrong that on its own is."""

    def refined(self, level: int) -> "Mechanism | None":
        """Return the same mechanism on a flank that tells its life better."""

    def mate_columns(self, depth: Vector) -> "dict[str, Vector]":
        """Return columns of a mate that wears with the flank."""

    def worn_contact_ratio(self, x: Vector, y: Vector) -> float:
        """Return the contact ratio of a worn flank."""

    def assumptions(self) -> "list[str]":
        """Return what this picture takes for granted, one sentence each."""
