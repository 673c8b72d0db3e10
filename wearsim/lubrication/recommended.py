"""Lubrication that a chain needs at its speed, and the oil for it.

The tables are empirical and written in the handbooks' units: chain speed in m/s, degrees C.
"""

import math
from dataclasses import dataclass
from itertools import pairwise

from wearsim.catalogue.catalogues import catalogue_rows

TYPES = ("drip", "oil bath", "forced")
"""Types A (manual or drip), B (bath or disc) and C (stream) of ANSI B29.1, the poorest first."""

_BELOW_DRIP, _BELOW_STREAM = 0.56, 0.5
"""Powers of the pitch by which the limits fall, for chains smaller or larger than the table's."""


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
        ``drip``, ``oil bath`` or ``forced``.

    Examples
    --------
    No. 60 drips to 1.12 m/s, and lies in a bath to 9.1 m/s:

    >>> [recommended_lubrication(19.05, speed) for speed in (0.8, 1.2, 9.2)]
    ['drip', 'oil bath', 'forced']
    """
    return TYPES[sum(chain_speed > limit for limit in lubrication_speed_limits(pitch))]


@dataclass(frozen=True)
class Oil:
    """An oil for a range of ambient temperature."""

    coldest: float  # [degrees C]
    warmest: float  # [degrees C]
    sae: str  # grade of SAE J300
    iso_vg: str  # viscosity grade of ISO 3448, one or a range [mm2/s at 40 degrees C]


def recommended_oils() -> tuple[Oil, ...]:
    """Return the oils that are recommended for roller chains, the coldest range first.

    The oil must be thin enough to enter the joints: a mineral oil without detergents.

    Examples
    --------
    >>> [oil.sae for oil in recommended_oils() if oil.coldest <= 20.0 <= oil.warmest]
    ['SAE 30']
    """
    return tuple(
        Oil(float(row["coldest_C"]), float(row["warmest_C"]), row["sae"], row["iso_vg"])
        for row in catalogue_rows("oil_viscosity")
    )
