"""Contact fatigue of a gear pair whose flanks wear: hours until pitting is to be expected."""

from wearsim.case.flank_endurance import FatigueInput
from wearsim.case.model import Case, GearDrive
from wearsim.contact.hertz import peak_pressure
from wearsim.fatigue.contact_fatigue import fatigue_life
from wearsim.fatigue.endurance import EnduredHours, cycles_per_hour


def pole_stress(drive: GearDrive, load_factor: float, modulus: float) -> float:
    """Return the contact stress at the pole, where one pair of teeth carries the whole load.

    Equation gears.md (7).

    Parameters
    ----------
    drive : GearDrive
        The gears.
    load_factor : float
        K_H on the load.
    modulus : float
        Contact modulus E* [MPa].

    Returns
    -------
    float
        sigma_H of the new flanks with the load factor [MPa], source document 001.
    """
    curvature = 1.0 / float(drive.pair.circles.pole_radius(drive.pair.pole_angle))
    return float(peak_pressure(load_factor * drive.pole_load, curvature, modulus))


def gear_fatigue_lives(
    case: Case, drive: GearDrive, fatigue: FatigueInput, peak_pressure: float
) -> dict[str, EnduredHours]:
    """Return the hours for which the contact stress of the new flanks is allowed.

    It is that at the pole of source document 001, or the highest on the path of contact if
    that is more.

    Parameters
    ----------
    case : Case
        A complete case.
    drive : GearDrive
        Its gears.
    fatigue : FatigueInput
        Their materials.
    peak_pressure : float
        Highest on the new flanks as they share the load, with the load factor [MPa].

    Returns
    -------
    dict of str to EnduredHours
        ``pinion`` and ``wheel``, by strength.md (21) to (26) under the constant
        load.
    """
    stress = max(pole_stress(drive, fatigue.load_factor, case.modulus), peak_pressure)
    speeds = {"pinion": case.speed_rpm, "wheel": case.speed_rpm / drive.pair.circles.gear_ratio}
    return {
        name: fatigue_life(
            fatigue.materials[name], [(stress, 1.0)], cycles_per_hour(speed), case.run.horizon_hours
        )
        for name, speed in speeds.items()
    }
