"""Dirt in the contacts: what it adds to their wear, by its surroundings and by its hardness."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from wearsim.catalogue.catalogues import environments

if TYPE_CHECKING:
    from wearsim.input.faults import CaseRecord
    from wearsim.lubrication.keys import LubricationPhase, LubricationTable

HARDNESS_RATIO = 1.2
"""Hardness of an abrasive over that of a surface below which it does not scratch (Hutchings)."""


@dataclass(frozen=True)
class Dirt:
    """What the surroundings do to the contacts."""

    excess: float = 0.0  # what it adds to the factor 1 on the wear
    ageing: float = 1.0  # how many times as fast a lubricant ages
    ends: tuple[float, float] | None = None  # of what is known of the excess; None where it is sure

    def at_end(self, end: int) -> "Dirt":
        """Return the same at the low end, 0, or the high end, 1, of what is known of it."""
        return self if self.ends is None else replace(self, excess=self.ends[end], ends=None)


CLEAN = Dirt()
"""Surroundings that do nothing."""

_USUAL_BAND = 2.0
"""Factor to either side of what a user says that dirt does: about that of the environments of the table."""


def read_dirt(
    case: "CaseRecord", whole: "LubricationTable", table: "LubricationTable | LubricationPhase", place: str
) -> Dirt:
    """Return what dirt does by a whole table or a phase of it: given, or as in the environment, and said."""
    row = environments()[table.environment or "clean"]
    given = {"contamination_factor": table.contamination_factor, "ageing_factor": table.ageing_factor}
    taken = {"contamination_factor": row.factor, "ageing_factor": row.ageing}
    for key, value in taken.items():
        if given[key] is None and value != 1.0:
            span = f": {row.low:g} to {row.high:g}" if key == "contamination_factor" else ""
            why = f"environment {row.environment!r}{span}; {row.source}"
            if table is whole:
                case.take(f"{place}.{key}", value, why)
            else:
                case.assumptions.append(f"{place}.{key} = {value:g} ({why})")
    factor, ageing = given["contamination_factor"] or row.factor, given["ageing_factor"] or row.ageing
    share = _abrasion(case, whole, table, place)
    if factor == 1.0 or share == 0.0:
        return Dirt(0.0, ageing)
    low, high = row.low, row.high
    band = whole.contamination_band_factor
    if band is None and factor != row.factor:
        band = _USUAL_BAND
        text = (
            f"{place}.contamination_factor is given by the user, assumed as known to a factor of {band:g} "
            "either way"
        )
        case.assumptions.append(text)
    if band is not None:
        low, high = max(factor / band, 1.0), factor * band
    return Dirt(factor - 1.0, ageing, (low - 1.0, high - 1.0))


def _abrasion(
    case: "CaseRecord", whole: "LubricationTable", table: "LubricationTable | LubricationPhase", place: str
) -> float:
    """Return which part of what dirt adds its hardness leaves: all or none."""
    hardness, surface = table.abrasive_hardness_HV, whole.surface_hardness_HV
    if hardness is None or surface is None:
        return 1.0
    share = abrasion_share(hardness, surface)
    scratches = "scratches" if share else "does not scratch"
    case.assumptions.append(
        f"{place}: dirt of {hardness:g} HV {scratches} surfaces of {surface:g} HV (it must be 1.2 times as "
        "hard, Hutchings); teeth, pins and bushes are assumed equally hard"
    )
    return share


def abrasion_share(abrasive_hardness: float, surface_hardness: float) -> float:
    """Return which part of the abrasion by contaminants a surface suffers: all or none.

    Abrasion needs particles at least 1.2 times as hard as the surface: below that they yield before the
    surface does (I. M. Hutchings, Tribology, 1992; Proc. IMechE J 216 (2002) 55; reviewed by Pintaude,
    J. Tribol. 132 (2010) 034502). Measured wear falls over some width about that ratio, which is not told
    here.

    Equation physics.md (L9).

    Parameters
    ----------
    abrasive_hardness : float
        Of the particles [HV], above 0.
    surface_hardness : float
        Of the surface, on the same scale [HV], above 0.

    Returns
    -------
    float
        1 from the ratio 1.2 on, 0 below it.

    Raises
    ------
    ValueError
        A hardness is not above 0.

    Examples
    --------
    Quartz of 1100 HV scratches a hardened tooth of 700 HV, chalk of 140 HV does not:

    >>> abrasion_share(1100.0, 700.0), abrasion_share(140.0, 700.0)
    (1.0, 0.0)
    """
    if not min(abrasive_hardness, surface_hardness) > 0.0:
        raise ValueError(f"both must be above 0 (got {abrasive_hardness:g} and {surface_hardness:g} HV)")
    return 1.0 if abrasive_hardness >= HARDNESS_RATIO * surface_hardness else 0.0
