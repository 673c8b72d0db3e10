"""Lubrication that a chain asks for at its speed, and what a poorer one does to its life.

The tables are empirical and written in the handbooks' units: chain speed in m/s.
"""

import math
from dataclasses import dataclass
from itertools import pairwise

from wearsim.catalogue.catalogues import catalogue_rows

TYPES = ("drip", "oil-bath", "forced")
"""Types A (manual or drip), B (bath or disc) and C (stream) of ANSI B29.1, the poorest first."""

_SCANT = ("periodic", "grease")
"""Lubrications below the poorest type: by brush or can now and then, or with grease."""

_BELOW_DRIP, _BELOW_STREAM = 0.56, 0.5
"""Powers of the pitch by which the limits fall, for chains smaller or larger than the table's."""


@dataclass(frozen=True)
class LubricationFactor:
    """What a lubrication does to a life, over that with the recommended one."""

    state: str  # row of the table of factors
    factor: float  # on the life
    low: float
    high: float
    source: str  # where the numbers come from


def lubrication_speed_limits(pitch: float) -> tuple[float, float]:
    """Return the chain speeds up to which drip and up to which a bath is recommended.

    Between two pitches of the table the limits follow a power of the pitch; beyond its ends
    p^-0.56 for drip and p^-0.5 for a bath, as the limits of ISO 10823 about do.

    Parameters
    ----------
    pitch : float
        Chain pitch [mm], above 0.

    Returns
    -------
    tuple of float
        Greatest speed for drip and for a bath [m/s].

    Examples
    --------
    >>> lubrication_speed_limits(25.4)
    (0.86, 7.6)
    >>> drip, bath = lubrication_speed_limits(101.6)  # twice 50.8 mm: 5.1/sqrt(2)
    >>> round(bath, 3)
    3.606
    """
    rows = [
        (float(row["pitch_mm"]), float(row["drip_m_per_s"]), float(row["oil_bath_m_per_s"]))
        for row in catalogue_rows("recommended_lubrication")
    ]
    end = rows[0] if pitch <= rows[0][0] else rows[-1]
    if not rows[0][0] < pitch < rows[-1][0]:
        return end[1] * (end[0] / pitch) ** _BELOW_DRIP, end[2] * (end[0] / pitch) ** _BELOW_STREAM
    smaller, larger = next((a, b) for a, b in pairwise(rows) if pitch <= b[0])
    part = math.log(pitch / smaller[0]) / math.log(larger[0] / smaller[0])
    drip, bath = (smaller[i] ** (1.0 - part) * larger[i] ** part if part < 1.0 else larger[i] for i in (1, 2))
    return drip, bath


def recommended_lubrication(pitch: float, chain_speed: float) -> str:
    """Return the poorest lubrication that is recommended for a chain at its speed.

    Types A, B and C of ANSI B29.1, each up to a chain speed that falls with the pitch.

    Parameters
    ----------
    pitch : float
        Chain pitch [mm], above 0.
    chain_speed : float
        v [m/s].

    Returns
    -------
    str
        ``drip``, ``oil-bath`` or ``forced``.

    Examples
    --------
    No. 60 drips to 1.12 m/s, and lies in a bath to 9.1 m/s:

    >>> [recommended_lubrication(19.05, speed) for speed in (0.8, 1.2, 9.2)]
    ['drip', 'oil-bath', 'forced']
    """
    return TYPES[sum(chain_speed > limit for limit in lubrication_speed_limits(pitch))]


def lubrication_state(supplied: str, recommended: str, environment: str = "clean") -> str:
    """Return the row of the table of factors for a lubrication beside the recommended one.

    Parameters
    ----------
    supplied : str
        ``drip``, ``oil-bath``, ``forced``, ``periodic``, ``grease`` or ``dry``.
    recommended : str
        Of `recommended_lubrication`.
    environment : str
        ``clean``, ``dust``, ``wet`` or ``mud``; the last two are dirt.

    Examples
    --------
    >>> lubrication_state("drip", "oil-bath"), lubrication_state("periodic", "oil-bath")
    ('one type below', 'insufficient')
    """
    if supplied == "dry":
        return "dry, clean" if environment == "clean" else "dry, dirty"
    below = TYPES.index(recommended) - (-1 if supplied in _SCANT else TYPES.index(supplied))
    if environment in ("wet", "mud"):
        return "insufficient, dirty"
    dusty = environment == "dust"
    if below > 1 or (dusty and below == 1):
        return "insufficient"
    if below == 1 or dusty:
        return "periodic" if supplied in _SCANT else "one type below"
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
    >>> found = lubrication_life_factor("drip", "oil-bath")
    >>> found.factor, found.low, found.high
    (0.4, 0.25, 0.65)
    """
    state = lubrication_state(supplied, recommended, environment)
    row = next(row for row in catalogue_rows("lubrication_life_factors") if row["state"] == state)
    return LubricationFactor(
        state, float(row["factor"]), float(row["low"]), float(row["high"]), row["source"]
    )
