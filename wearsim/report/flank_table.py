"""The working flank of a case as a table."""

import numpy as np
import pandas as pd

from wearsim.case.model import Case, StrandDrive, WrapDrive
from wearsim.errors import CaseError, Fault
from wearsim.geometry.profile import Profile, Vector


def profile_table(case: Case) -> pd.DataFrame:
    """Return the points of a flank with what follows from them."""
    if isinstance(case.drive, WrapDrive):
        return _gap_table(case.drive)
    if not isinstance(case.drive, StrandDrive):
        message = "the case must have a sprocket, a table of loads or gears have none: nothing to write"
        raise CaseError([Fault(message, "mechanism.kind", case.name)])
    flank, strand = case.drive.profile, case.drive.tooth.strand
    if case.inputs["sprocket"]["profile"] == "evolute":
        x = np.linspace(case.drive.contact_end, case.drive.contact_start, flank.x.size)
        curvature = -1.0 / strand.flank_radius(x)
        angle = strand.pressure_angle(x)
        evolute = strand.evolute_points(x)
    else:
        curvature = flank.curvature
        angle = _pressure_angle(flank, strand.height, strand.roller_radius)
        evolute = np.column_stack(
            [flank.x - flank.normal_x / curvature, flank.y - flank.normal_y / curvature]
        )
    return pd.DataFrame(
        {
            "node": np.arange(1, flank.x.size + 1),
            "x_mm": flank.x,
            "y_mm": flank.y,
            "arc_length_mm": flank.arc_length,
            "curvature_per_mm": curvature,
            "flank_radius_mm": 1.0 / np.abs(curvature),
            "pressure_angle_deg": np.degrees(angle),
            "evolute_x_mm": evolute[:, 0],
            "evolute_y_mm": evolute[:, 1],
        }
    )


def _gap_table(drive: WrapDrive) -> pd.DataFrame:
    """Points of a whole gap from its right tip to its left one; no radius where it is straight."""
    outline = drive.outline
    theta = np.arctan2(np.abs(outline.normal_x), outline.normal_y)
    bent = np.abs(outline.curvature) > 1e-9
    curvature = np.where(bent, outline.curvature, np.nan)
    return pd.DataFrame(
        {
            "node": np.arange(1, outline.x.size + 1),
            "x_mm": outline.x,
            "y_mm": outline.y,
            "arc_length_mm": outline.arc_length,
            "curvature_per_mm": np.where(bent, curvature, 0.0),
            "flank_radius_mm": 1.0 / np.abs(curvature),
            "pressure_angle_deg": 90.0 - np.degrees(theta + 0.5 * drive.pitch_angle),
            "evolute_x_mm": outline.x - outline.normal_x / curvature,
            "evolute_y_mm": outline.y - outline.normal_y / curvature,
        }
    )


def _pressure_angle(flank: Profile, height: float, radius: float) -> Vector:
    """Angle of the normal when the roller on the strand touches; nan where it does not reach."""
    centre_x, centre_y = flank.x + radius * flank.normal_x, flank.y + radius * flank.normal_y
    with np.errstate(invalid="ignore"):
        distance = np.sqrt(centre_x**2 + centre_y**2 - height**2)
    turn = np.arctan2(height, -distance) - np.arctan2(centre_y, centre_x)
    return np.asarray(np.arctan2(flank.normal_y, flank.normal_x) + turn)
