"""Contact fatigue of flanks under the loads of a duty: hours until pitting is to be expected.

Source 001, formulas (21) to (26), which are those of gears; on a sprocket's tooth they are this
project's reconstruction.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from wearsim.fatigue.endurance import (
    CONTACT_EXPONENT,
    Endurance,
    EnduredHours,
    FatigueCurve,
    contact_base_cycles,
)
from wearsim.fatigue.heat_treatment import in_brinell, treatments


@dataclass(frozen=True)
class FlankMaterial:
    """Material of the flanks of a sprocket, pinion or wheel against contact fatigue."""

    treatment: str  # heat treatment
    hardness: float  # of the flank
    scale: str  # `HB` or `HRC`
    contact_limit: float | None  # sigma_Hlim [MPa]; None for that of the treatment
    contact_safety: float | None  # S_H; None for that of the treatment


def stress_equivalence(stresses: Sequence[tuple[float, float]]) -> float:
    """Return the cycles of the highest stress that fatigue as much, over all cycles.

    mu_H = sum (sigma_i/sigma)^6 N_i/N, strength.md (22) in the place of torques, with whose root the
    stress of a Hertz contact goes. Stresses below the endurance limit count as well.

    Parameters
    ----------
    stresses : sequence of tuple of float
        Pairs of a contact stress [MPa] and its share of all cycles.

    Returns
    -------
    float
        mu_H, up to 1.

    Examples
    --------
    Half the load, 0.5^3, for half of the cycles:

    >>> round(stress_equivalence([(1000.0, 0.5), (1000.0 * 0.5**0.5, 0.5)]), 9)
    0.5625
    """
    highest = max(stress for stress, _ in stresses)
    return math.fsum(share * (stress / highest) ** CONTACT_EXPONENT for stress, share in stresses)


def fatigue_life(
    material: FlankMaterial, stresses: Sequence[tuple[float, float]], cycles_per_hour: float, hours: float
) -> EnduredHours:
    """Return the hours for which the contact stresses of a flank are allowed.

    Examples
    --------
    23 HRC / 1.2 of carburised teeth, N_HG = 1.2e8, K = 1.4 and so 1.2e8 K^-6 cycles:

    >>> steel = FlankMaterial("carburised", 60.0, "HRC", None, None)
    >>> life = fatigue_life(steel, [(1.4 * 1150.0, 1.0)], 6000.0, 1e4)
    >>> life.hours == 1.2e8 * 1.4**-6 / 6000.0, round(life.hours, 1)
    (True, 2656.2)
    """
    treatment = treatments()[material.treatment]
    brinell = in_brinell(material.hardness, material.scale)
    limit = material.contact_limit or treatment.contact_limit(treatment.own_hardness(brinell))
    curve = FatigueCurve(
        limit=limit / (material.contact_safety or treatment.contact_safety),
        base_cycles=contact_base_cycles(brinell),
        exponent=CONTACT_EXPONENT,
        greatest_factor=treatment.contact_factor,
    )
    mu = stress_equivalence(stresses)
    highest = max(stress for stress, _ in stresses)
    return Endurance(limit, curve, mu, cycles_per_hour, hours, math.nan).life(highest)


def hardness_warnings(materials: Mapping[str, FlankMaterial]) -> list[str]:
    """Return warnings of endurance limits by a formula outside the range it is given for."""
    found = []
    for name, material in materials.items():
        treatment = treatments()[material.treatment]
        hardness = treatment.own_hardness(in_brinell(material.hardness, material.scale))
        text = treatment.outside(hardness)
        if text and material.contact_limit is None:
            found.append(f"fatigue.{name}: {text}")
    return found
