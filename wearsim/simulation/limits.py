"""The limits of a case as criteria of the wear engine."""

from typing import TYPE_CHECKING

from wearsim.case.model import Case, GearDrive, StrandDrive, WrapDrive
from wearsim.contact.engagement import Contact
from wearsim.geometry.measuring import measurement_over_pins
from wearsim.geometry.profile import Vector
from wearsim.kernels.gear_rows import MATE_DEPTH
from wearsim.result import LimitState
from wearsim.wear.criteria import Criterion, depth_criterion, falling, rising, tip_land_criterion

if TYPE_CHECKING:
    from wearsim.geometry.roller_path import RollerPath


def tooth_criteria(case: Case) -> tuple[Criterion, ...]:
    """Return the limits of a worn flank or outline, the critical depth first."""
    drive, more = case.drive, case.more_limits
    found = [depth_criterion(case.critical_depth)]
    if "case_depth_mm" in more:
        found.append(rising("case_depth_mm", more["case_depth_mm"], lambda x, y, depth: float(depth.max())))
    if isinstance(drive, StrandDrive | WrapDrive):
        if case.min_tip_land:
            found.append(tip_land_criterion(case.min_tip_land, drive.worn_tip_land))
        if "min_tooth_thickness_mm" in more:
            found.append(
                falling(
                    "min_tooth_thickness_mm",
                    more["min_tooth_thickness_mm"],
                    lambda x, y, depth: drive.worn_thickness(x, y),
                )
            )
    return tuple(found)


def mate_criteria(case: Case, contact: Contact) -> tuple[Criterion, ...]:
    """Return the limit of the wheel of a gear pair."""
    if not isinstance(case.drive, GearDrive):
        return ()
    ratio, key = contact.columns[MATE_DEPTH], "wheel_critical_depth_mm"
    return (rising(key, case.more_limits[key], lambda x, y, depth: float((ratio * depth).max())),)


def over_pins(path: "RollerPath", x: Vector, y: Vector, gaps: int) -> float:
    """Return the measurement over pins of the roller's diameter in two gaps worn alike."""
    centres = path.worn(x, y).locus
    lowest = float((centres[0] ** 2 + centres[1] ** 2).min()) ** 0.5
    return measurement_over_pins(lowest, 2.0 * path.roller_radius, gaps)


def pin_criteria(case: Case, path: "RollerPath") -> tuple[Criterion, ...]:
    """Return the limit on what a measurement over pins has changed by."""
    drive, limit = case.drive, case.more_limits.get("over_pins_change_mm")
    if limit is None or not isinstance(drive, WrapDrive):
        return ()
    new = over_pins(path, drive.outline.x.copy(), drive.outline.y.copy(), drive.gaps)
    return (
        rising("over_pins_change_mm", limit, lambda x, y, depth: new - over_pins(path, x, y, drive.gaps)),
    )


def limit_states(
    criteria: tuple[Criterion, ...], x: Vector, y: Vector, depth: Vector
) -> tuple[LimitState, ...]:
    """Return what the quantity of every limit has come to."""
    return tuple(
        LimitState(criterion.name, criterion.limit, criterion.value(x, y, depth)) for criterion in criteria
    )
