"""Rollers of a straight strand on any flank: the source's picture, a pin rack."""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from wearsim.contact.engagement import ContactKind, FlankContact
from wearsim.geometry.forms.evolute import Strand
from wearsim.geometry.profile_points import Profile, Vector
from wearsim.kernels.flank_geometry import flank_frame
from wearsim.kernels.strand import strand_contact


def load_share(x: Vector, contact_end: float, contact_start: float, pitch: float) -> Vector:
    """Return the share of the pull that a roller carries: 1, with a linear ramp at each end.

    The ramps are as long as the overlap x_max - x_min - p, so that the shares of
    successive rollers sum to 1. It is a convention, kept as the flank wears.

    Equation physics.md (S11).

    Parameters
    ----------
    x : numpy.ndarray
        Distance of the roller centre before the line of the pitch point [mm].
    contact_end, contact_start : float
        x_min and x_max [mm].
    pitch : float
        Chain pitch [mm], less than x_max - x_min.

    Returns
    -------
    numpy.ndarray
        Share from 0 to 1.
    """
    overlap = contact_start - contact_end - pitch
    return np.clip(np.minimum(contact_start - x, x - contact_end) / overlap, 0.0, 1.0)


@dataclass(frozen=True, eq=False)
class StrandMechanism:
    """A flank driven past, or driving, the rollers of a straight strand."""

    strand: Strand  # sprocket and line of roller centres
    profile: Profile  # the flank, root to tip
    # contact_end, contact_start: range of x that carries load [mm]
    contact_end: float
    contact_start: float
    pitch: float  # chain pitch [mm]
    pull_per_width: float  # F_t / b [N/mm]
    angular_speed: float  # of the sprocket [rad/s]
    slip_fraction: float  # scales the sliding: 1 for a roller that does not turn
    modulus: float  # contact modulus E* [MPa]

    @cached_property
    def contact(self) -> FlankContact:
        """The flank and its contact."""
        overlap = self.contact_start - self.contact_end - self.pitch
        constants = [
            self.strand.height,
            self.strand.roller_radius,
            self.pull_per_width,
            self.contact_end,
            self.contact_start,
            1.0 / overlap,
            self.slip_fraction,
            self.angular_speed,
        ]
        return FlankContact(
            kind=ContactKind.TRAVELLING,
            kernel=strand_contact,
            constants=np.array(constants),
            columns=np.zeros((1, 1)),
            profile=self.profile,
            arc_length=self.profile.arc_length,
            mate_radius=self.strand.roller_radius,
            mate="roller",
            modulus=self.modulus,
            slip_curvature_exponent=1.0,
            offset_form=False,
        )

    def other_grids(self) -> tuple[FlankContact, ...]:
        """Return the flank on every second point, on every fourth, and on every second with fine ends.

        Where the load sets in and ends, lives converge with the first power of the spacing; in
        between with the second.
        """
        half = self.contact.coarsened()
        return half, half.coarsened(), self._with_fine_ends(0.5).contact

    def refined(self, level: int) -> "StrandMechanism":
        """Return the flank with fine ends, on its own points, on twice as many, and so on."""
        return self._with_fine_ends(2.0 ** (level - 1))

    def _with_fine_ends(self, fineness: float) -> "StrandMechanism":
        intervals = max(2, round(fineness * (self.profile.x.size - 1)))
        return replace(self, profile=self.profile.with_fine_ends(intervals))

    def mate_columns(self, depth: Vector) -> dict[str, Vector]:
        """Return nothing: rollers do not wear."""
        return {}

    def worn_contact_ratio(self, x: Vector, y: Vector) -> float:
        """Return the range of sprocket turn over which the flank can touch, in pitches.

        Equation physics.md (S8), for where the roller is.

        Parameters
        ----------
        x, y : numpy.ndarray
            Points of the worn flank [mm].

        Returns
        -------
        float
            (psi_max - psi_min) R / p; below 1 the next roller comes before this one
            has left only on the edge of the tip, which is not modelled.
        """
        frame, radius = np.empty((4, x.size)), self.strand.roller_radius
        flank_frame(x, y, *frame)
        centre_x, centre_y = x + radius * frame[0], y + radius * frame[1]
        inside = centre_x**2 + centre_y**2 - self.strand.height**2
        touching = inside > 0.0
        distance = -np.sqrt(inside[touching])
        turn = np.arctan2(self.strand.height, distance) - np.arctan2(centre_y[touching], centre_x[touching])
        engaged = float(turn.max() - turn.min()) % (2.0 * math.pi)
        return engaged * self.strand.centrode_radius / self.pitch

    def assumptions(self) -> list[str]:
        """Return what this picture takes for granted."""
        sliding = (
            "the roller does not turn (roller_slip_fraction 1)"
            if self.slip_fraction == 1.0
            else f"the roller turns and slides over {self.slip_fraction:g} of the full distance"
        )
        return [
            sliding,
            "the chain is a guided straight strand at the evolute offset "
            f"{self.strand.offset:.4g} mm (crawler, conveyor, rack drive); a chain that wraps lies "
            "about 0.52 p/z inside the centrode and cannot reach contact ratio 1 there",
            "the kinematics, and the synthesis of an evolute flank, are a reconstruction from "
            "Euler-Savary/Bobillier: the source's equations (1) to (9) are lost",
            "successive rollers share the pull by linear ramps over the overlap, also on the worn "
            "flank; the slack strand carries nothing",
        ]
