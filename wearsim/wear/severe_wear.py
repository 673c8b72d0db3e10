"""Wear that becomes severe where pressure and sliding are high: by p v, or by T-gamma."""

import math
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from wearsim.geometry.profile_points import Vector
from wearsim.kernels import severity as kernel

_Energy = TypeVar("_Energy", float, Vector)

_DENSITY = 7.85e6
"""Density of steel, 7850 kg/m3, in ug/mm3, times 1000 mm/m."""


@dataclass(frozen=True)
class Severity:
    """What multiplies the depth of a cycle, point by point, by the pressure and the sliding there.

    Equations physics.md (L6) to (L8).
    """

    kind: float = kernel.NONE
    limit: float = math.inf  # of peak pressure times sliding speed [MPa mm/s]
    factor: float = 1.0  # on the coefficient beyond it; the coefficient of friction by T-gamma

    @property
    def numbers(self) -> tuple[float, float, float]:
        """What the kernel takes."""
        return self.kind, self.limit, self.factor

    @property
    def steepness(self) -> float:
        """Bound of d(ln depth)/d(ln pressure) that it adds.

        By p v 1.5 (1 + w)/w ln(factor), w the width of the transition; by T-gamma that where the last branch
        begins.
        """
        if self.kind == kernel.BY_PRESSURE_SPEED:
            return 1.5 * (1.0 + kernel.TRANSITION) / kernel.TRANSITION * math.log(self.factor)
        return kernel.STEEP * kernel.SECOND / kernel.LEVEL - 1.0 if self.kind == kernel.BY_T_GAMMA else 0.0


NO_SEVERITY = Severity()
"""None: the coefficient does not depend on pressure and sliding."""


def severe_multiple(pressure: float, speed: float, pv_limit: float, severe_factor: float) -> float:
    """Return the multiple of the coefficient at a pressure and a sliding speed.

    Equation physics.md (L7).

    Parameters
    ----------
    pressure : float
        Peak pressure [MPa].
    speed : float
        Sliding speed [mm/s].
    pv_limit : float
        Limit of their product [MPa mm/s].
    severe_factor : float
        What the coefficient is multiplied by beyond it.

    Returns
    -------
    float
        1 up to the limit, ``severe_factor`` from 1.1 times the limit on.

    Examples
    --------
    In the middle of the transition it is the root of the factor:

    >>> round(severe_multiple(1050.0, 1.0, 1000.0, 9.0), 12)
    3.0
    """
    return float(kernel.severe_multiple(pressure * speed / pv_limit, severe_factor))


def t_gamma_energy(mean_pressure: _Energy, slip_ratio: _Energy, friction: float) -> _Energy:
    """Return T-gamma over the contact area, x = mu p_mean s.

    Equation physics.md (L8).

    Parameters
    ----------
    mean_pressure : float or numpy.ndarray
        Mean pressure of the contact [MPa], pi/4 of the peak in a line contact.
    slip_ratio : float or numpy.ndarray
        Sliding over rolling.
    friction : float
        Coefficient of friction.

    Returns
    -------
    float or numpy.ndarray
        X [N/mm2].

    Examples
    --------
    >>> t_gamma_energy(1000.0, 0.02, 0.5)
    10.0
    """
    return friction * mean_pressure * slip_ratio


def t_gamma_coefficient(friction: float) -> float:
    """Return the specific wear rate of the mild branch [mm2/N], which is Archard's law.

    Equation physics.md (L8).

    Parameters
    ----------
    friction : float
        Coefficient of friction.

    Returns
    -------
    float
        5.3 mu/rho [mm2/N].

    Examples
    --------
    >>> round(t_gamma_coefficient(0.5) / (5.3 * 0.5 / 7.85e6), 12)
    1.0
    """
    return kernel.MILD * friction / _DENSITY


def on_level_branch(energy: Vector) -> bool:
    """Whether a point lies where the rate does not rise with the pressure."""
    return bool(np.any((energy >= kernel.FIRST) & (energy <= kernel.SECOND)))
