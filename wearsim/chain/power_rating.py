"""Power that a roller chain carries for 15 000 hours: ANSI rating, ISO 10823 correction.

The formulas are empirical and written in the handbooks' units: power in kW, speed in rpm.
"""

import math
from collections.abc import Sequence

from wearsim.catalogue.catalogues import catalogue_rows, table_factor

HORSEPOWER = 0.745699872
"""1 hp = 550 ft lbf/s [kW]."""

REFERENCE_TEETH = 19
"""Teeth of the small sprocket of the reference drive of ISO 10823."""

RATED_HOURS = 15_000.0
"""Hours that the ratings of ANSI B29.1 and ISO 10823 are for [h]."""

NO_MORE_HOURS = 1e5
"""Hours above which a mode is not what ends a chain, and no number is told [h]."""

IMPACT_BAND = 2.0
"""Factor by which the hours until rollers fail may be shorter or longer: assumed, no scatter is published."""

_INCH, _POUND = 25.4, 4.4482216

_IMPACT_SLOPE, _IMPACT_LINKS = 2.5, 100.0


def application_factor(driver: str, driven: str) -> float:
    """Return f1 of ISO 10823, the factor on the power for shocks.

    Parameters
    ----------
    driver : str
        ``smooth`` (electric motor, turbine), ``slight shocks`` (engine of six or more cylinders)
        or ``moderate shocks`` (fewer cylinders).
    driven : str
        ``smooth``, ``moderate shocks`` or ``heavy shocks``.

    Returns
    -------
    float
        Factor, 1.0 to 2.1.

    Raises
    ------
    CaseError
        A word is none of these.

    Examples
    --------
    >>> application_factor("slight shocks", "moderate shocks")
    1.5
    """
    return table_factor("application_factors", driver=driver, driven=driven)


def shock_class(factor: float) -> tuple[str, str] | None:
    """Return the kinds of driver and driven machine that f1 of ISO 10823 stands for; None of another factor.

    All nine factors of the table differ.

    Examples
    --------
    >>> shock_class(1.4), shock_class(1.25)
    (('smooth', 'moderate shocks'), None)
    """
    for row in catalogue_rows("application_factors"):
        if math.isclose(float(row["factor"]), factor, rel_tol=1e-9):
            return row["driver"], row["driven"]
    return None


def tooth_factor(teeth: float) -> float:
    """Return f2 of ISO 10823, the factor on the power for the small sprocket, (19/z1)^1.08.

    Parameters
    ----------
    teeth : float
        Gaps of the smaller sprocket.

    Returns
    -------
    float
        Factor.

    Examples
    --------
    >>> tooth_factor(19)
    1.0
    """
    return float((REFERENCE_TEETH / teeth) ** 1.08)


def corrected_power(power: float, service_factor: float, teeth: float) -> float:
    """Return the power that the reference drive would have to carry, Pc = P f1 f2.

    The reference drive of ISO 10823 has 19 teeth, 120 links, a ratio of 1:3 to 3:1, a uniform
    load, clean surroundings, full lubrication and 15 000 hours to 3 % elongation.

    Parameters
    ----------
    power : float
        Transmitted power P [kW].
    service_factor : float
        f1, `application_factor` times whatever reserve is wanted.
    teeth : float
        Gaps of the smaller sprocket.

    Returns
    -------
    float
        Corrected power [kW].

    Examples
    --------
    >>> corrected_power(10.0, 1.4, 19)
    14.0
    """
    return power * service_factor * tooth_factor(teeth)


def strand_factor(strands: int, method: str = "ANSI") -> float:
    """Return how many times the load of one strand several strands carry.

    Parameters
    ----------
    strands : int
        1 to 6; 1 to 3 for GOST.
    method : str
        ``ANSI`` (B29.1: 1, 1.7, 2.5, 3.3, 3.9, 4.6) or ``GOST`` (m_p: 1, 1.7, 2.5).

    Returns
    -------
    float
        Factor.

    Raises
    ------
    CaseError
        The table has no such number of strands.

    Examples
    --------
    >>> strand_factor(3)
    2.5
    """
    return table_factor("strand_factors", method=method, strands=str(strands))


def plate_fatigue_rating(pitch: float, teeth: float, speed: float, light: bool = False) -> float:
    """Return the power of one strand at the fatigue limit of the link plates.

    H1 = 0.004 N^1.08 n^0.9 P^(3 - 0.07 P) [hp], P in inches (ANSI B29.1; Shigley eq. 17-32),
    0.0022 in place of 0.004 for no. 41. For the A series, 15 000 h; it governs at low speed.

    Parameters
    ----------
    pitch : float
        Chain pitch [mm].
    teeth : float
        Gaps of the smaller sprocket.
    speed : float
        Speed of the smaller sprocket [rpm].
    light : bool
        Whether the chain is no. 41 (085-1).

    Returns
    -------
    float
        Rating H1 [kW].

    Examples
    --------
    >>> round(plate_fatigue_rating(44.45, 17, 300) / HORSEPOWER, 2)  # no. 140, Shigley: 72.4 hp
    72.39
    """
    inches = pitch / _INCH
    constant = 0.0022 if light else 0.004
    power = constant * teeth**1.08 * speed**0.9 * inches ** (3.0 - 0.07 * inches)
    return float(HORSEPOWER * power)


def roller_impact_rating(pitch: float, teeth: float, speed: float, light: bool = False) -> float:
    """Return the power of one strand at the fatigue limit of rollers and bushes under impact.

    H2 = 1000 Kr N^1.5 P^0.8/n^1.5 [hp], P in inches (ANSI B29.1; Shigley eq. 17-33), Kr = 29 for
    no. 25 and 35, 3.4 for no. 41, 17 for no. 40 to 240. It governs at high speed.

    Parameters
    ----------
    pitch : float
        Chain pitch [mm].
    teeth : float
        Gaps of the smaller sprocket.
    speed : float
        Speed of the smaller sprocket [rpm].
    light : bool
        Whether the chain is no. 41 (085-1).

    Returns
    -------
    float
        Rating H2 [kW].

    Examples
    --------
    >>> round(roller_impact_rating(25.4, 25, 1000) / HORSEPOWER, 2)  # 17e6 / 10**4.5 * 125e-3
    67.2
    """
    inches = pitch / _INCH
    small = pitch < 12.0
    constant = 3.4 if light else 29.0 if small else 17.0
    power = 1000.0 * constant * teeth**1.5 * inches**0.8 / speed**1.5
    return float(HORSEPOWER * power)


def power_rating(pitch: float, teeth: float, speed: float, light: bool = False) -> float:
    """Return the power of one strand, the smaller of both fatigue ratings."""
    return min(
        plate_fatigue_rating(pitch, teeth, speed, light), roller_impact_rating(pitch, teeth, speed, light)
    )


def roller_impact_hours(used: float, links: float) -> float:
    """Return the hours until rollers and bushes fail by impact, from how far their rating is used.

    h = 15000 (H2/H)^2.5 X/100: impact on rollers and bushes follows H^2.5 h/X = constant (Shigley's
    Mechanical Engineering Design, eq. 17-39 and 17-40; the exponent is the Diamond Chain Company's). The
    rating H2 is that of 100 pitches for 15 000 h. No slope is published for the fatigue of link plates.

    Parameters
    ----------
    used : float
        Power with its service factor over the rating H2, above 0.
    links : float
        X, length of the chain in pitches.

    Returns
    -------
    float
        Hours [h].

    Examples
    --------
    A quarter of the rating, 32 times the hours; twice the links, twice the hours:

    >>> roller_impact_hours(0.25, 100), roller_impact_hours(1.0, 200)
    (480000.0, 30000.0)
    """
    return float(RATED_HOURS * used**-_IMPACT_SLOPE * links / _IMPACT_LINKS)


def hours_over_duty(blocks: Sequence[tuple[float, float]]) -> float:
    """Return the hours of a duty of which every block wears its share: 1/sum(share_i/h_i).

    Parameters
    ----------
    blocks : sequence of tuple
        Share of the time, and the hours if the block lasted all the time [h], above 0; one block or more.

    Examples
    --------
    >>> hours_over_duty([(0.1, 2000.0)]), hours_over_duty([(0.5, 1000.0), (0.5, 3000.0)])
    (20000.0, 1500.0)
    """
    # Relative to the first block: hours of a constant load come out to the last digit.
    first = blocks[0][1]
    return first / math.fsum(share * (first / hours) for share, hours in blocks)


def galling_speed(pitch: float, teeth: float, tension: float) -> float:
    """Return the speed of the small sprocket above which pin and bush may gall.

    (n/1000)^(1.59 lg P + 1.873) = 82.5/(7.95^P 1.0278^z 1.323^(F/1000)), P in inches, F in lbf
    (American Chain Association; Shigley's Mechanical Engineering Design, chapter 17). From tests,
    without hours.

    Parameters
    ----------
    pitch : float
        Chain pitch [mm].
    teeth : float
        Gaps of the smaller sprocket.
    tension : float
        F of the tight span of one strand [N].

    Returns
    -------
    float
        Speed [rpm].

    Examples
    --------
    One inch, no load: 82.5/(7.95 1.0278^20) = 5.997, and 5.997^(1/1.873) = 2.602

    >>> round(galling_speed(25.4, 20, 0.0))
    2602
    """
    inches, pounds = pitch / _INCH, tension / _POUND
    # Beyond two million pounds the speed is 0 to any digit.
    right = 82.5 / (7.95**inches * 1.0278**teeth * 1.323 ** min(pounds / 1000.0, 2000.0))
    return float(1000.0 * right ** (1.0 / (1.59 * math.log10(inches) + 1.873)))
