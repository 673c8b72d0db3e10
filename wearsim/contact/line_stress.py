"""Stresses below the middle of a Hertz line contact, in shares of the peak pressure.

Depths are in half-widths of the contact. Stresses are those of K. L. Johnson, Contact Mechanics,
section 4.2, equations 4.46, in plane strain.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

_SEARCH = np.linspace(0.0, 2.0, 401)
"""Depths among which a maximum is looked for; it lies above 0.79 for every Poisson's ratio."""


@dataclass(frozen=True)
class GreatestStress:
    """The greatest of a stress on the axis of a contact."""

    depth: float  # z/a; 0 where it is on the surface
    stress: float  # over the peak pressure


def axis_stresses(depth: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the stresses along the surface and across it, on the axis of the contact.

    With s = sqrt(1 + z^2): sigma_x/p0 = -((1 + 2 z^2)/s - 2 z), sigma_z/p0 = -1/s.

    Equation hertz-check.md (3).

    Parameters
    ----------
    depth : array_like
        z/a, at least 0.

    Returns
    -------
    tuple of numpy.ndarray
        sigma_x/p0 and sigma_z/p0, principal stresses; pressure is negative.

    Examples
    --------
    >>> along, across = axis_stresses([0.0, 0.75])
    >>> along.round(6).tolist(), across.round(6).tolist()
    ([-1.0, -0.2], [-1.0, -0.8])
    """
    z = np.asarray(depth, dtype=float)
    s = np.sqrt(1.0 + z * z)
    return -((1.0 + 2.0 * z * z) / s - 2.0 * z), -1.0 / s


def axis_shear(depth: ArrayLike) -> NDArray[np.float64]:
    """Return the greatest shear stress in the plane, on the axis of the contact."""
    along, across = axis_stresses(depth)
    return 0.5 * (along - across)


def axis_von_mises(depth: ArrayLike, poissons_ratio: float) -> NDArray[np.float64]:
    """Return von Mises' stress in plane strain, on the axis of the contact.

    The third stress is nu (sigma_x + sigma_z), so that
    sigma_v^2 = (1 - nu + nu^2)(sigma_x^2 + sigma_z^2) - (1 + 2 nu - 2 nu^2) sigma_x sigma_z.

    Equation hertz-check.md (4).

    Parameters
    ----------
    depth : array_like
        z/a, at least 0.
    poissons_ratio : float
        Of the body, 0 to below 0.5.

    Returns
    -------
    numpy.ndarray
        sigma_v/p0, on the surface 1 - 2 nu.

    Examples
    --------
    >>> round(float(axis_von_mises(0.0, 0.3)), 12)
    0.4
    """
    along, across = axis_stresses(depth)
    squares, product = _weights(poissons_ratio)
    return np.sqrt(squares * (along**2 + across**2) - product * along * across)


def greatest_von_mises(poissons_ratio: float) -> GreatestStress:
    """Return the greatest von Mises stress on the axis of the contact.

    Parameters
    ----------
    poissons_ratio : float
        Of the body, 0 to below 0.5.

    Returns
    -------
    Greatest
        On the surface for a Poisson's ratio below about 0.19.

    Examples
    --------
    >>> found = greatest_von_mises(0.3)
    >>> round(found.stress, 10), round(found.depth, 8)
    (0.5575162166, 0.70429168)
    """
    top = int(axis_von_mises(_SEARCH, poissons_ratio).argmax())
    if top == 0:
        return GreatestStress(0.0, 1.0 - 2.0 * poissons_ratio)
    depth = float(brentq(_slope, _SEARCH[top - 1], _SEARCH[top + 1], args=(poissons_ratio,), xtol=1e-15))
    return GreatestStress(depth, float(axis_von_mises(depth, poissons_ratio)))


def greatest_shear() -> GreatestStress:
    """Return the greatest shear stress on the axis of the contact.

    tau/p0 = z - z^2/s; its derivative vanishes where z^4 + z^2 = 1.

    Returns
    -------
    Greatest
        At z/a = sqrt((sqrt(5) - 1)/2).

    Examples
    --------
    >>> found = greatest_shear()
    >>> round(found.stress, 10), round(found.depth, 8)
    (0.300283106, 0.78615138)
    """
    depth = math.sqrt(0.5 * (math.sqrt(5.0) - 1.0))
    return GreatestStress(depth, float(axis_shear(depth)))


def _weights(poissons_ratio: float) -> tuple[float, float]:
    """Return what the squares and the product of the stresses weigh in von Mises' square."""
    nu = poissons_ratio
    return 1.0 - nu + nu * nu, 1.0 + 2.0 * nu - 2.0 * nu * nu


def _slope(depth: float, poissons_ratio: float) -> float:
    """Return half the derivative of von Mises' square by the depth."""
    along, across = axis_stresses(depth)
    s = math.sqrt(1.0 + depth * depth)
    along_slope = 2.0 - (3.0 * depth + 2.0 * depth**3) / s**3
    across_slope = depth / s**3
    squares, product = _weights(poissons_ratio)
    return float(
        squares * (along * along_slope + across * across_slope)
        - 0.5 * product * (along_slope * across + along * across_slope)
    )
