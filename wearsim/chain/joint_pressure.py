"""Pressure between pin and bush against what GOST practice allows, its speed limits and its safety.

The tables are empirical and written in the handbooks' units: speed in rpm.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from wearsim.catalogue.catalogues import catalogue_rows, table_factor
from wearsim.chain.power_rating import strand_factor
from wearsim.errors import CaseError, Fault

_SAME = 1e-3
"""Difference within which two pitches are the same [mm]."""


@dataclass(frozen=True)
class JointApplication:
    """Factors of GOST practice for how a drive is used, whose product is K_e.

    Two kinds of factor stand in K_e. Those of the load press the joint harder. Those of lubrication
    and shifts leave the pressure as it is: they stand for the hours that the allowable pressure is
    meant for, which wear faster or come sooner. A life that goes with the pressure takes `pressure`
    alone, or it counts lubrication and shifts twice.

    Examples
    --------
    Shifts are hours by the cube law, life ~ p^-3: 1.25 and 1.45 are the cube roots of 2 and 3.

    >>> used = JointApplication(load=1.5, lubrication=1.5, shifts=1.25)
    >>> used.pressure, used.hours, used.factor
    (1.5, 1.875, 2.8125)
    >>> [round(shifts ** (1 / 3), 2) for shifts in (2, 3)]
    [1.26, 1.44]
    """

    load: float = 1.0
    lubrication: float = 1.0
    shifts: float = 1.0
    adjustment: float = 1.0  # of the tension
    slope: float = 1.0  # of the line of centres

    @property
    def pressure(self) -> float:
        """Part of K_e that presses the joint harder: load, adjustment, slope."""
        return self.load * self.adjustment * self.slope

    @property
    def hours(self) -> float:
        """Part of K_e that stands for hours: lubrication, shifts."""
        return self.lubrication * self.shifts

    @property
    def factor(self) -> float:
        """K_e, the product of all."""
        return self.load * self.lubrication * self.shifts * self.adjustment * self.slope


def joint_application(
    load: str = "steady",
    lubrication: str = "drip",
    shifts: str = "one",
    adjustment: str = "movable axis",
    slope: float = 0.0,
) -> JointApplication:
    """Return the GOST factors for how the drive is used.

    Parameters
    ----------
    load : str
        ``steady`` 1, ``moderate shocks`` 1.35 (of 1.2 to 1.5) or ``heavy shocks`` 1.8.
    lubrication : str
        ``continuous`` 0.8, ``drip`` 1 or ``periodic`` 1.5.
    shifts : str
        Shifts a day: ``one`` 1, ``two`` 1.25 or ``three`` 1.45. Chernavsky rounds the last to 1.5.
    adjustment : str
        Of the tension: ``movable axis`` 1, ``tensioner`` 1.1 or ``none`` 1.25.
    slope : float
        Angle psi of the line of centres to the horizontal [rad]: 1 up to 60 degrees,
        0.15 sqrt(psi in degrees) above.

    Returns
    -------
    JointApplication
        Factors; handbooks ask for another drive where their product K_e exceeds 3.

    Raises
    ------
    CaseError
        A word is none of these.

    Examples
    --------
    >>> joint_application(shifts="two", adjustment="none").factor  # 1.25 * 1.25
    1.5625
    """
    causes = {"load": load, "lubrication": lubrication, "shifts": shifts, "adjustment": adjustment}
    factors = {
        cause: table_factor("exploitation_factors", cause=cause, state=state)
        for cause, state in causes.items()
    }
    degrees = abs(math.degrees(slope))
    return JointApplication(**factors, slope=0.15 * math.sqrt(degrees) if degrees > 60.0 else 1.0)


def joint_application_factor(
    load: str = "steady",
    lubrication: str = "drip",
    shifts: str = "one",
    adjustment: str = "movable axis",
    slope: float = 0.0,
) -> float:
    """Return K_e, the product of the factors of `joint_application`, for the same words.

    Examples
    --------
    >>> joint_application_factor(shifts="two", adjustment="none")  # 1.25 * 1.25
    1.5625
    """
    return joint_application(load, lubrication, shifts, adjustment, slope).factor


def joint_pressure(pull: float, bearing_area: float, strands: int = 1, application: float = 1.0) -> float:
    """Return the pressure in the joint by GOST practice, p = F_t K_e/(A m_p).

    Parameters
    ----------
    pull : float
        F_t [N].
    bearing_area : float
        Projected area of pin in bush of all strands together, as in the catalogue [mm2]; A is
        that of one strand.
    strands : int
        1 to 3.
    application : float
        K_e of `joint_application_factor`.

    Returns
    -------
    float
        Pressure [MPa].

    Raises
    ------
    CaseError
        The area is not above 0, or the table has no factor m_p for so many strands.

    Examples
    --------
    >>> joint_pressure(2000.0, 100.0, application=1.5)
    30.0
    """
    if not bearing_area > 0.0:
        message = (
            f"joint pressure: the bearing area must be above 0, is {bearing_area:g} mm2: use the value of "
            "the chain maker's catalogue"
        )
        raise CaseError([Fault(message)])
    return pull * application * strands / (bearing_area * strand_factor(strands, "GOST"))


def allowable_joint_pressure(pitch: float, speed: float) -> float | None:
    """Return the allowable pressure [p] of the GOST practice, interpolated in the speed.

    Parameters
    ----------
    pitch : float
        Chain pitch [mm].
    speed : float
        Speed of the smaller sprocket [rpm]; below the 50 of the table its value at 50 holds.

    Returns
    -------
    float or None
        Pressure [MPa]; None where the table knows neither the pitch (12.7 to 15.9, 19.05 to
        25.4, 31.75 to 38.1, 44.45 to 50.8 mm) nor, above its last column, the speed.

    Examples
    --------
    >>> allowable_joint_pressure(25.4, 300)  # halfway between 30 and 26
    28.0
    """
    column = [
        (float(row["speed_rpm"]), float(row["pressure_MPa"]))
        for row in catalogue_rows("joint_pressure")
        if float(row["smallest_pitch_mm"]) - _SAME <= pitch <= float(row["largest_pitch_mm"]) + _SAME
    ]
    return _interpolated(column, speed)


def _interpolated(column: Sequence[tuple[float, float]], speed: float) -> float | None:
    """Return the value at a speed, the first one below the column; None above it, and of an empty one."""
    if not column or speed > column[-1][0]:
        return None
    if speed <= column[0][0]:
        return column[0][1]
    for (slower, before), (faster, after) in pairwise(column):
        if speed <= faster:
            return before + (after - before) * (speed - slower) / (faster - slower)
    return None


def speed_limits(pitch: float) -> tuple[float, float] | None:
    """Return the recommended and the greatest speed of the smaller sprocket for a pitch.

    Parameters
    ----------
    pitch : float
        Chain pitch [mm].

    Returns
    -------
    tuple of float or None
        Recommended and greatest speed [rpm]; None for a pitch that the table does not hold.

    Examples
    --------
    >>> speed_limits(25.4)
    (800.0, 1200.0)
    """
    for row in catalogue_rows("speed_limits"):
        if abs(float(row["pitch_mm"]) - pitch) <= _SAME:
            return float(row["recommended_rpm"]), float(row["greatest_rpm"])
    return None


def least_safety(pitch: float, speed: float) -> float | None:
    """Return the least safety against breaking [s] of the GOST practice, interpolated in the speed.

    Tensile strength over k_d F_t + F_v + F_f: pull times the factor of shocks, centrifugal tension,
    tension of the sag. For chains ПР and 2ПР.

    Parameters
    ----------
    pitch : float
        Chain pitch [mm].
    speed : float
        Speed of the smaller sprocket [rpm]; below the 50 of the table its value at 50 holds.

    Returns
    -------
    float or None
        Safety, 7.1 to 15; None for a pitch that the table does not hold, and above its last speed.

    Examples
    --------
    >>> least_safety(25.4, 400)  # halfway between 8.9 and 10.2
    9.55
    >>> least_safety(50.8, 500)  # the table ends at 300
    """
    column = [
        (float(row["speed_rpm"]), float(row["safety"]))
        for row in catalogue_rows("least_safety")
        if abs(float(row["pitch_mm"]) - pitch) <= _SAME
    ]
    return _interpolated(column, speed)
