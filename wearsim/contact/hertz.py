"""Hertz line contact of two elastic cylinders.

The kernels `hertz_wear.py`, `severity.py` and `offset.py` repeat the pressure; on a wrap `springs` of
`wrap_stage.py` yield it.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray


def contact_modulus(youngs_modulus: tuple[float, float], poissons_ratio: tuple[float, float]) -> float:
    """Return E* with 1/E* = sum((1 - nu^2)/E) over both bodies.

    Some packages call twice this value the effective modulus; wearsim has no second definition.

    Equation physics.md (C1).

    Parameters
    ----------
    youngs_modulus : tuple of float
        Of both bodies [MPa], above 0.
    poissons_ratio : tuple of float
        Of both bodies, -1 < nu < 0.5.

    Returns
    -------
    float
        Contact modulus [MPa].

    Examples
    --------
    Steel on steel, 2.1e5 / (2 * 0.91):

    >>> round(contact_modulus((2.1e5, 2.1e5), (0.3, 0.3)), 3)
    115384.615
    """
    return 1.0 / sum(
        (1.0 - nu**2) / modulus for modulus, nu in zip(youngs_modulus, poissons_ratio, strict=True)
    )


def peak_pressure(
    load_per_width: ArrayLike, relative_curvature: ArrayLike, modulus: float
) -> NDArray[np.float64]:
    """Return the Hertz pressure in the middle of a line contact, sqrt(q E*/(pi rho)).

    Equation physics.md (C2).

    Parameters
    ----------
    load_per_width : array_like
        q [N/mm].
    relative_curvature : array_like
        1/rho, sum of both signed curvatures [1/mm], above 0.
    modulus : float
        Contact modulus E* [MPa].

    Returns
    -------
    numpy.ndarray
        Pressure [MPa] (K. L. Johnson, Contact Mechanics, section 4.2).

    Examples
    --------
    >>> float(peak_pressure(100.0, 1.0 / 6.035, 2.1e5 / 1.82).round(4))
    780.1181
    """
    return np.sqrt(np.asarray(load_per_width) * relative_curvature * modulus / math.pi)


def half_width(
    load_per_width: ArrayLike, relative_curvature: ArrayLike, modulus: float
) -> NDArray[np.float64]:
    """Return half the width of a line contact, a = sqrt(4 q rho/(pi E*)).

    Equation physics.md (C3).

    Parameters
    ----------
    load_per_width : array_like
        q [N/mm].
    relative_curvature : array_like
        1/rho, sum of both signed curvatures [1/mm], above 0.
    modulus : float
        Contact modulus E* [MPa].

    Returns
    -------
    numpy.ndarray
        Half-width [mm].

    Examples
    --------
    >>> float(half_width(100.0, 1.0 / 6.035, 2.1e5 / 1.82).round(6))
    0.081606
    """
    return np.sqrt(4.0 * np.asarray(load_per_width) / (math.pi * modulus * np.asarray(relative_curvature)))
