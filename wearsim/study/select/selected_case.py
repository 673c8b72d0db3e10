"""A drive that was chosen, as a case of its own."""

import math
from typing import Any

from wearsim.chain.elongation_limit import elongation_limit
from wearsim.chain.standard_teeth import standard_form
from wearsim.study.select.model import SAG, CandidateDrive
from wearsim.study.select.requirements import DriveRequirements


def case_tables(drive: CandidateDrive, need: DriveRequirements, hours_per_day: float) -> dict[str, Any]:
    """Return the tables of a case with both sprockets of a drive.

    Parameters
    ----------
    drive : CandidateDrive
        Chain, teeth, links.
    need : DriveRequirements
        Load, factors and lubrication.
    hours_per_day : float
        Running hours of a day.
    """
    chain, layout = drive.chain, drive.layout
    profile = standard_form(chain)
    limit = 100.0 * elongation_limit(max(layout.teeth_1, layout.teeth_2))
    return {
        "format_version": 1,
        "title": f"{chain.designation}, {layout.teeth_1} to {layout.teeth_2} teeth",
        "chain": {"designation": chain.designation},
        "sprocket": [
            {"role": "driver", "teeth": layout.teeth_1, "profile": profile},
            {"role": "driven", "teeth": layout.teeth_2, "profile": profile},
        ],
        "drive": {
            "links": layout.links,
            "sag_percent": 100.0 * SAG,
            "service_factor": _digits(need.service_factor),
            "joint_application_factor": _digits(need.joint_application_factor),
        },
        "load": {"power_kW": need.power, "speed_rpm": need.speed},
        **_lubricated(need),
        # Rounded down, so that it stays within the rule.
        "stop": {"elongation_percent": math.floor(1e4 * limit + 1e-6) / 1e4},
        "service": {"hours_per_day": hours_per_day},
    }


def _lubricated(need: DriveRequirements) -> dict[str, Any]:
    """Return the tables of a case that say how its contacts are lubricated."""
    if not need.lubrication:
        return {"wear": {"condition": need.joints.condition}}
    return {
        "wear": {"tooth_hardness": need.tooth_hardness},
        "lubrication": {"lubricant": need.lubrication, "environment": need.environment},
    }


def case_text(tables: dict[str, Any], command: str) -> str:
    """Return tables as the text of an input file, with the command that chose them."""
    import tomlkit

    text = tomlkit.dumps(tables)
    return f"# Chosen by {command}\n# Its assumptions: wearsim check --explain, with this file.\n{text}"


def _digits(value: float) -> float:
    return float(f"{value:.12g}")
