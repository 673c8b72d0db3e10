"""Wear laws: depth removed in one cycle from pressure, slip and sliding speed.

All are one expression, depth = K sigma^m v^n times the path a point slides: the swept
width c_m 2a times the slip ratio in a travelling contact, the given path in a local one.

The kernels that raise to the pressure exponent m: `hertz_wear.py` and `offset.py`; on a wrap `wrap_stage.py`,
and event by event `half_space.py` and `wrap_wear.py`.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np

from wearsim.contact.engagement import ContactKind
from wearsim.geometry.profile_points import Vector
from wearsim.kernels.severity import BY_PRESSURE_SPEED, BY_T_GAMMA
from wearsim.wear.mate_clock import STEADY, MateClock
from wearsim.wear.running_in import NO_RUNNING_IN, WearClock
from wearsim.wear.severe_wear import NO_SEVERITY, Severity, t_gamma_coefficient


def mean_pressure_factor(exponent: float) -> float:
    """Return c_m, the mean of (sigma/sigma_H)^m over the width of a Hertz line contact.

    Equation physics.md (L2).

    Parameters
    ----------
    exponent : float
        m, above -2.

    Returns
    -------
    float
        (sqrt(pi)/2) Gamma(1 + m/2) / Gamma(3/2 + m/2).

    Examples
    --------
    The integral of 1 - u^2 over 0..1 is 2/3:

    >>> round(mean_pressure_factor(2.0), 12)
    0.666666666667
    """
    return 0.5 * math.sqrt(math.pi) * math.gamma(1.0 + exponent / 2) / math.gamma(1.5 + exponent / 2)


@dataclass(frozen=True)
class WearLaw:
    """Depth per unit of sliding = coefficient * sigma_H^m * v_s^n, with sigma in MPa, v in mm/s.

    Equations physics.md (L1) and (L3).
    """

    coefficient: float  # K [1/MPa^m (s/mm)^n], above 0
    pressure_exponent: float  # m, above 0
    speed_exponent: float  # n
    case_depth: float = math.inf  # depth of the hardened layer [mm], infinite where there is none
    core_factor: float = 1.0  # what the coefficient is multiplied by below it
    # how the coefficient changes with the cycles, of which the engines count those of constant coefficient,
    # and how that of a mate does which is renewed meanwhile
    running_in: WearClock = NO_RUNNING_IN
    mates: MateClock = STEADY
    severity: Severity = NO_SEVERITY

    def numbers(self, kind: ContactKind) -> Vector:
        """Return the law as the kernel takes it.

        Equations physics.md (L1), for m = 1 (L5), and (L3).

        Parameters
        ----------
        kind : ContactKind
            How the contact meets the points.

        Returns
        -------
        numpy.ndarray
            Factor, exponent of the pressure, of the load and of the speed, depth of the
            hardened layer and the factor below it, kind, limit and factor of the severity. In a
            travelling contact c_m 2a = c_m 4 q/(pi sigma_H) turns one power of sigma_H into the load.
        """
        return self._numbers(kind, self.coefficient)

    def unit_numbers(self, kind: ContactKind) -> Vector:
        """Return the law as the kernel takes it, with the coefficient 1."""
        return self._numbers(kind, 1.0)

    def _numbers(self, kind: ContactKind, coefficient: float) -> Vector:
        m, n = self.pressure_exponent, self.speed_exponent
        changes = self.case_depth, self.core_factor, *self.severity.numbers
        if kind is ContactKind.LOCAL:
            return np.array([coefficient, m, 0.0, n, *changes])
        factor = coefficient * mean_pressure_factor(m) * 4.0 / math.pi
        return np.array([factor, m - 1.0, 1.0, n, *changes])

    def diffusion(self, kind: ContactKind, slip_curvature_exponent: float) -> float:
        """Return e = d(ln depth)/d(ln relative curvature), which decides stability.

        Equation physics.md (A2).

        Parameters
        ----------
        kind : ContactKind
            How the contact meets the points.
        slip_curvature_exponent : float
            d(ln slip)/d(ln relative curvature) of the mechanism.

        Returns
        -------
        float
            (m+1)/2 on a strand, m/2 with a given path, (m-1)/2 with a given slip ratio; with a severity the
            most that it comes to.
        """
        swept = self.pressure_exponent if kind is ContactKind.LOCAL else self.pressure_exponent - 1.0
        return 0.5 * (swept + self.severity.steepness) + slip_curvature_exponent


def archard(specific_wear_rate: float) -> WearLaw:
    """Return Archard's linear law.

    Equation physics.md (L4).

    Parameters
    ----------
    specific_wear_rate : float
        k [mm2/N]: volume per load and sliding distance, 1e-3 times the value in
        mm3/(N m). The dimensionless coefficient of Archard is k times the hardness.

    Returns
    -------
    Law
        With m = 1, n = 0.
    """
    return WearLaw(specific_wear_rate, 1.0, 0.0)


def power(coefficient: float, pressure_exponent: float) -> WearLaw:
    """Return the power law I = K sigma^m.

    Equation physics.md (L4).

    Parameters
    ----------
    coefficient : float
        K [1/MPa^m].
    pressure_exponent : float
        m, above 0.

    Returns
    -------
    Law
        With n = 0.
    """
    return WearLaw(coefficient, pressure_exponent, 0.0)


def drozdov(
    coefficient: float,
    pressure_exponent: float,
    hardness: float,
    reference_speed: float,
    speed_exponent: float,
) -> WearLaw:
    """Return the Kragelsky/Drozdov form I = K (sigma_H/H)^m (v/v0)^n.

    Equation physics.md (L4).

    Parameters
    ----------
    coefficient : float
        Dimensionless intensity K.
    pressure_exponent : float
        m, above 0.
    hardness : float
        H [MPa].
    reference_speed : float
        v0 [mm/s].
    speed_exponent : float
        n.

    Returns
    -------
    Law
        With the hardness and the speed taken into the coefficient.
    """
    scale = hardness**pressure_exponent * reference_speed**speed_exponent
    return WearLaw(coefficient / scale, pressure_exponent, speed_exponent)


def t_gamma(coefficient: float, friction: float) -> WearLaw:
    """Return the law by T-gamma, mild to catastrophic, for contacts that travel with a slip ratio.

    Equation physics.md (L8).

    Parameters
    ----------
    coefficient : float
        C on the published rate; 1 for the pair R8T on UIC60 900A.
    friction : float
        Coefficient of friction.

    Returns
    -------
    Law
        Archard's, with the coefficient of the mild branch and a severity.
    """
    mild = archard(coefficient * t_gamma_coefficient(friction))
    return replace(mild, severity=Severity(BY_T_GAMMA, math.inf, friction))


LAWS: dict[str, Callable[..., WearLaw]] = {law.__name__: law for law in (archard, power, drozdov, t_gamma)}
"""Constructors of the laws of `wear_laws.csv`; their arguments are the keys of that row, in its order."""


def with_pressure_speed_limit(law: WearLaw, pv_limit: float, severe_factor: float) -> WearLaw:
    """Return a law whose coefficient is higher beyond a limit of peak pressure times sliding speed.

    Equation physics.md (L6).

    Parameters
    ----------
    law : Law
        That below the limit.
    pv_limit : float
        Limit [MPa mm/s].
    severe_factor : float
        What the coefficient is multiplied by beyond it, at least 1.

    Returns
    -------
    Law
        The same law with a severity.
    """
    if severe_factor == 1.0:
        return law
    return replace(law, severity=Severity(BY_PRESSURE_SPEED, pv_limit, severe_factor))


@dataclass(frozen=True)
class RelativeLoad:
    """A part of a duty, relative to the load and speed that a contact is made for."""

    share: float  # of the cycles
    # load, speed: over those of the contact
    load: float
    speed: float
    wear_factor: float  # on the wear coefficient


def equivalent_factor(law: WearLaw, kind: ContactKind, parts: Iterable[RelativeLoad]) -> float:
    """Return the factor on the coefficient that puts one constant load in the place of a duty.

    Where load and sliding speed at every point are proportional to those of the drive and the
    slip does not depend on them, the depth of a cycle is proportional to
    load^((m+1)/2) speed^n in a travelling contact and to load^(m/2) speed^n in a local one
    (sigma ~ sqrt(load), swept width ~ sqrt(load)), whatever the worn shape. The mean
    over the cycles is then exact.

    Equation physics.md (R4).

    Parameters
    ----------
    law : WearLaw
        The wear law.
    kind : ContactKind
        How the contact meets the points; not one that rests.
    parts : iterable of RelativeLoad
        The duty, shares summing to 1.

    Returns
    -------
    float
        Sum of share * wear_factor * load^p * speed^n.

    Examples
    --------
    Half of the cycles at a quarter of the load, m = 2: (1 + 0.25^1.5)/2

    >>> parts = [RelativeLoad(0.5, 1.0, 1.0, 1.0), RelativeLoad(0.5, 0.25, 1.0, 1.0)]
    >>> equivalent_factor(WearLaw(1e-12, 2.0, 0.0), ContactKind.TRAVELLING, parts)
    0.5625
    """
    pressure, load, speed = (float(number) for number in law.numbers(kind)[1:4])
    exponent = 0.5 * pressure + load
    return math.fsum(
        part.share * part.wear_factor * part.load**exponent * part.speed**speed for part in parts
    )
