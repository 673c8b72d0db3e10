"""Contact fatigue of a gear pair whose flanks wear: hours until pitting is to be expected."""

import math

from wearsim.case.model import Case, GearDrive, GearSide
from wearsim.contact.hertz import peak_pressure
from wearsim.sizing.heat_treatment import in_brinell, treatments
from wearsim.sizing.strength import (
    CONTACT_EXPONENT,
    Endurance,
    EnduredHours,
    FatigueCurve,
    contact_base_cycles,
    cycles_per_hour,
)


def pole_stress(case: Case, drive: GearDrive) -> float:
    """Return the contact stress at the pole, where one pair of teeth carries the whole load.

    Parameters
    ----------
    case : Case
        A case of gears.
    drive : GearDrive
        Its gears.

    Returns
    -------
    float
        sigma_H of the new flanks with the load factor [MPa], source document 001.
    """
    curvature = 1.0 / float(drive.pair.circles.pole_radius(drive.pair.pole_angle))
    return float(peak_pressure(drive.load_factor * drive.pole_load, curvature, case.modulus))


def fatigue_lives(case: Case) -> dict[str, EnduredHours]:
    """Return the hours for which the contact stress at the pole is allowed.

    Parameters
    ----------
    case : Case
        A complete case.

    Returns
    -------
    dict of str to EnduredHours
        ``pinion`` and ``wheel``, by formulas (21) to (26) of source document 001 under the constant
        load; empty where the case is not of gears or tells no materials.
    """
    drive = case.drive
    if not isinstance(drive, GearDrive) or drive.materials is None:
        return {}
    stress = pole_stress(case, drive)
    speeds = case.speed_rpm, case.speed_rpm / drive.pair.circles.gear_ratio
    return {
        name: _endurance(side, cycles_per_hour(speed), case.run.horizon_hours).life(stress)
        for name, side, speed in zip(("pinion", "wheel"), drive.materials, speeds, strict=True)
    }


def _endurance(side: GearSide, per_hour: float, hours: float) -> Endurance:
    treatment = treatments()[side.treatment]
    brinell = in_brinell(side.hardness, side.scale)
    limit = side.contact_limit or treatment.contact_limit(treatment.own_hardness(brinell))
    curve = FatigueCurve(
        limit=limit / (side.contact_safety or treatment.contact_safety),
        base_cycles=contact_base_cycles(brinell),
        exponent=CONTACT_EXPONENT,
        greatest_factor=treatment.contact_factor,
    )
    return Endurance(limit, curve, 1.0, per_hour, hours, math.nan)
