"""Whether hard particles scratch a surface: the ratio of their hardness to that of the surface."""

HARDNESS_RATIO = 1.2
"""Hardness of an abrasive over that of a surface below which it does not scratch (Hutchings)."""


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
