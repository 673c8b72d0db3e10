"""What every drive answers for itself, and the blocks of constant load that it runs under."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from wearsim.chain.selection import Finding
from wearsim.contact.criteria import Criterion, depth_criterion, falling, rising, tip_land_criterion
from wearsim.contact.engagement import Contact, Mechanism
from wearsim.fatigue.contact_fatigue import fatigue_life
from wearsim.fatigue.endurance import EnduredHours
from wearsim.geometry.profile import Vector

if TYPE_CHECKING:
    from wearsim.case.model import Case, FatigueInput


@dataclass(frozen=True)
class Block:
    """A part of the duty in which load and speed are constant; a constant drive is one block."""

    share: float  # of the cycles; those of all blocks sum to 1
    speed_rpm: float  # of the sprocket
    tension: float  # of the tight strand without the centrifugal part, on a straight strand the pull [N]
    centrifugal: float  # tension that the chain's own speed adds [N], 0 on a straight strand
    wear_factor: float  # on the wear coefficient of the tooth
    joint_factor: float  # on that of the chain's joints, which a straight strand does not have


def heaviest(blocks: tuple[Block, ...]) -> Block:
    """Return the block of the largest tension, the first of them where several are alike."""
    return max(blocks, key=lambda block: block.tension)


class Drive:
    """What wears in a case: the answers of a bare flank, of which a mechanism changes what differs."""

    rests: ClassVar[bool] = False
    """Whether mates rest in the outline instead of passing every point of a flank once a cycle."""

    has_tooth: ClassVar[bool] = False
    """Whether the tooth around the flank is known."""

    from_root: ClassVar[bool] = True
    """Whether arc lengths count from the root of the flank."""

    @property
    def duty(self) -> tuple[Block, ...]:
        """Blocks of load; none where the load is one and the same."""
        return ()

    @property
    def wear_coefficients(self) -> Mapping[str, float]:
        """Wear coefficients of other parts than the flank by their keys."""
        return {}

    @property
    def pitch_line_thickness(self) -> float:
        """Chordal thickness of the new tooth on the pitch line [mm]; nan without a tooth."""
        return float("nan")

    @property
    def thinnest(self) -> float:
        """Smallest thickness of the new tooth [mm]; nan without a tooth."""
        return float("nan")

    @property
    def tip_land(self) -> float:
        """Length of the new tip [mm]; nan without a tooth."""
        return float("nan")

    def worn_thickness(self, x: Vector, y: Vector) -> float:
        """Return the thickness on the pitch line that a worn flank leaves [mm]."""
        return float("nan")

    def worn_tip_land(self, x: Vector, y: Vector) -> float:
        """Return the tip land that a worn flank leaves [mm]."""
        return float("nan")

    def teeth_in_words(self, case: "Case") -> str:
        """Return the number of teeth and, if there is one, the chain."""
        given = case.inputs["chain"]
        chain = given.get("designation") or f"of {given['pitch_mm']:g} mm pitch"
        return f"{case.inputs['sprocket']['teeth']} teeth, chain {chain}"

    def blank_area(self) -> float | None:
        """Return the area of the whole wheel [mm2]; None where its outline is not known."""
        return None

    def profile_columns(self) -> dict[str, Vector]:
        """Return the flank as the columns of a table; empty where there is none."""
        return {}

    def mechanism(self, case: "Case") -> Mechanism:
        """Return what loads every point of the flank once a cycle."""
        raise NotImplementedError(f"{type(self).__name__}: mates rest in the outline")

    def stop_limits(self, case: "Case", contact: Contact) -> tuple[Criterion, ...]:
        """Return what ends the life of a flank with this contact, the critical depth first."""
        return self.tooth_limits(case)

    def tooth_limits(self, case: "Case") -> tuple[Criterion, ...]:
        """Return the limits of a worn flank or outline on its own, the critical depth first."""
        more = case.more_limits
        found = [depth_criterion(case.critical_depth)]
        if "case_depth_mm" in more:
            found.append(
                rising("case_depth_mm", more["case_depth_mm"], lambda x, y, depth: float(depth.max()))
            )
        if self.has_tooth and case.min_tip_land:
            found.append(tip_land_criterion(case.min_tip_land, self.worn_tip_land))
        if self.has_tooth and "min_tooth_thickness_mm" in more:
            thickness = more["min_tooth_thickness_mm"]
            found.append(
                falling("min_tooth_thickness_mm", thickness, lambda x, y, depth: self.worn_thickness(x, y))
            )
        return tuple(found)

    def fatigue_lives(
        self, case: "Case", fatigue: "FatigueInput", stresses: Sequence[tuple[float, float]]
    ) -> dict[str, EnduredHours]:
        """Return the hours until pitting of each part, from the pressures of a duty and their shares."""
        material = fatigue.materials["sprocket"]
        hours = fatigue_life(material, stresses, case.cycles_per_hour, case.run.horizon_hours)
        return {"sprocket": hours}

    def check(self, case: "Case") -> None:
        """Raise where the new drive does not work at all, which takes no run to find."""

    def ratings(self, case: "Case") -> tuple[Finding, ...]:
        """Return what the handbooks say about the drive."""
        return ()

    def notes(self, case: "Case") -> list[str]:
        """Return what a designer asks of a drive that no rule limits."""
        return []
