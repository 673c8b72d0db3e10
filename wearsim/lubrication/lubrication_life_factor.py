"""What a lubrication other than the recommended one does to the life of a chain.

The factors stand in lubrication_life_factors.csv of the catalogue.
"""

from dataclasses import dataclass

from wearsim.catalogue.catalogues import catalogue_rows
from wearsim.lubrication.recommended import TYPES

_SCANT = ("manual", "greased")
"""Lubrications below the poorest type: by brush or can now and then, or with grease."""


@dataclass(frozen=True)
class LubricationFactor:
    """What a lubrication does to a life, over that with the recommended one."""

    state: str  # row of the table of factors
    factor: float  # on the life
    low: float
    high: float
    source: str  # where the numbers come from


def lubrication_state(supplied: str, recommended: str, environment: str = "clean") -> str:
    """Return the row of the table of factors for a lubrication beside the recommended one.

    Parameters
    ----------
    supplied : str
        ``drip``, ``oil bath``, ``forced``, ``manual``, ``greased`` or ``dry``.
    recommended : str
        Of `recommended_lubrication`.
    environment : str
        ``clean``, ``dust``, ``wet``, ``mud`` or ``soil``; the last three are dirt.

    Examples
    --------
    >>> lubrication_state("drip", "oil bath"), lubrication_state("manual", "oil bath")
    ('one type below', 'insufficient')
    """
    if supplied == "dry":
        return "dry, clean" if environment == "clean" else "dry, dirty"
    below = TYPES.index(recommended) - (-1 if supplied in _SCANT else TYPES.index(supplied))
    if environment in ("wet", "mud", "soil"):
        return "insufficient, dirty"
    if environment == "dust":
        # As one type less; the best of them is no better than what is recommended without dust.
        below = max(below + 1, 0)
    if below > 1:
        return "insufficient"
    if below == 1:
        return "now and then" if supplied in _SCANT else "one type below"
    return "as recommended" if below == 0 else "better than recommended"


def lubrication_life_factor(supplied: str, recommended: str, environment: str = "clean") -> LubricationFactor:
    """Return what a lubrication does to the life of a chain.

    Weighed from the steps of Vorobyev's K_sp, GOST practice's K_e and the cube of f6 of DIN 8195,
    which differ by up to 4 times: the band is theirs, the factor a middle of it. No measurement.

    Parameters
    ----------
    supplied, recommended, environment : str
        As `lubrication_state` takes them.

    Returns
    -------
    LubricationFactor
        Factor on the life with its band.

    Examples
    --------
    >>> found = lubrication_life_factor("drip", "oil bath")
    >>> found.factor, found.low, found.high
    (0.4, 0.25, 0.65)
    """
    state = lubrication_state(supplied, recommended, environment)
    row = next(row for row in catalogue_rows("lubrication_life_factors") if row["state"] == state)
    return LubricationFactor(
        state, float(row["factor"]), float(row["low"]), float(row["high"]), row["source"]
    )
