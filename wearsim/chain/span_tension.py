"""Tensions of the spans of a chain: pull, own weight and centrifugal force."""

import math

from wearsim.errors import GeometryError

STANDARD_GRAVITY = 9806.65
"""g [mm/s2]."""


def centrifugal_tension(mass_per_length: float, chain_speed: float) -> float:
    """Return the tension that bends the moving chain around the sprockets, q v^2.

    It loads the links everywhere and the teeth nowhere.

    Equation physics.md (W4).

    Parameters
    ----------
    mass_per_length : float
        q [t/mm], 1e-6 of the value in kg/m.
    chain_speed : float
        v [mm/s].

    Returns
    -------
    float
        Tension [N].

    Examples
    --------
    >>> round(centrifugal_tension(2.6e-6, 10_000.0), 9)  # 2.6 kg/m at 10 m/s
    260.0
    """
    return mass_per_length * chain_speed**2


def catenary_tension(mass_per_length: float, span: float, sag: float = 0.02, slope: float = 0.0) -> float:
    """Return the tension of the slack span under its own weight, q g a cos(psi)/(8 f/a).

    The parabola in place of the catenary: below the tension at the ends of a level span by
    0.1, 0.4 and 0.8 % at a sag of 0.01, 0.02 and 0.03.

    Equation physics.md (W5).

    Parameters
    ----------
    mass_per_length : float
        q [t/mm], 1e-6 of the value in kg/m.
    span : float
        Length of the span a [mm]; handbooks put the centre distance.
    sag : float
        Sag over span f/a, above 0; 0.01 to 0.03 in practice, at 0.02 the tension is 6.25 q g a.
    slope : float
        Angle psi of the span to the horizontal [rad].

    Returns
    -------
    float
        Tension [N].

    Raises
    ------
    GeometryError
        The sag is not above 0.

    Examples
    --------
    >>> round(catenary_tension(1e-6, 1000.0), 4)  # 6.25 * 1 kg/m * 9.80665 m/s2 * 1 m
    61.2916
    """
    if not sag > 0.0:
        raise GeometryError(
            f"slack span: the sag must be above 0, is {sag:g}: about 0.02 of the span is usual"
        )
    return mass_per_length * STANDARD_GRAVITY * span * math.cos(slope) / (8.0 * sag)


def fitted_tension(
    mass_per_length: float, span: float, excess: float, yielding: float, slope: float = 0.0
) -> float:
    """Return the tension at rest of a chain fitted on fixed centres, of its one span that hangs.

    What a chain has too much of, and what it stretches by, hangs as a parabola:
    (q g cos(psi))^2 a^3/(24 T^2) = e + c T. Without stretch that is the catenary of the excess e; a chain
    that is too short by -e has the tension that stretches it.

    Equation physics.md (D10).

    Parameters
    ----------
    mass_per_length : float
        q [t/mm], above 0.
    span : float
        Length of the span a [mm].
    excess : float
        e, length of the chain less that of the taut one [mm]; below 0 for a chain that is too short.
    yielding : float
        c, by which the whole chain stretches [mm/N], links over the stiffness of one, above 0.
    slope : float
        Angle psi of the span to the horizontal [rad].

    Returns
    -------
    float
        Tension [N].

    Examples
    --------
    A chain too short by 0.1 mm, of 100 links of 50 000 N/mm, next to weightless: 0.1 * 50 000/100 N.

    >>> round(fitted_tension(1e-15, 500.0, -0.1, 100 / 5e4), 9)
    50.0
    """
    from scipy.optimize import brentq

    weight = mass_per_length * STANDARD_GRAVITY * math.cos(slope)
    hanging = weight**2 * span**3 / 24.0
    least = max(-excess, 0.0) / yielding
    most = least + (hanging / yielding) ** (1.0 / 3.0)
    if not most > least:
        return least
    return float(
        brentq(
            lambda pull: pull**2 * (excess + yielding * pull) - hanging, least, most, xtol=1e-12, rtol=1e-14
        )
    )


def shaft_load(tight: float, slack: float, inclination: float) -> float:
    """Return the force of both spans of a chain on either shaft.

    F = sqrt(((T_t + T_s) cos b)^2 + ((T_t - T_s) sin b)^2): the tight span lies at the angle b to
    the line of centres and the slack one at -b, so that their parts along the line add up and those
    across it subtract. The centrifugal tension bends the chain and loads no shaft. The weight of the
    sprockets is left out. Of two shafts the forces are equal and opposite.

    Parameters
    ----------
    tight, slack : float
        Tensions of both spans without the centrifugal part [N].
    inclination : float
        Angle b of a span to the line of centres [rad], `DriveLayout.inclination`.

    Returns
    -------
    float
        Force [N].

    Examples
    --------
    >>> shaft_load(1000.0, 20.0, 0.0)
    1020.0
    >>> round(shaft_load(1000.0, 0.0, 0.3), 9)  # one span alone pulls in its own direction
    1000.0
    """
    along = (tight + slack) * math.cos(inclination)
    return math.hypot(along, (tight - slack) * math.sin(inclination))
