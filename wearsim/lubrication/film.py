"""Film of oil in a line contact that rolls and slides, and its ratio to the roughness."""

from dataclasses import dataclass

from wearsim.geometry.profile_points import Vector


@dataclass(frozen=True)
class Lubricant:
    """An oil at the temperature of the contact's inlet."""

    viscosity: float  # dynamic [MPa s], 1e-9 times the value in mPa s
    pressure_viscosity: float  # alpha of Barus [1/MPa]


def minimum_film(
    lubricant: Lubricant, entrainment: Vector, load: Vector, relative_curvature: Vector, modulus: float
) -> Vector:
    """Return the least thickness of the film in line contacts whose inlet is flooded.

    Dowson and Higginson's formula (D. Dowson, Proc. IMechE 182 (1968) 151): elastic bodies, an oil that
    stiffens with the pressure, of one temperature, smooth surfaces.

    Equation physics.md (L10).

    Parameters
    ----------
    lubricant : Lubricant
        The oil.
    entrainment : numpy.ndarray
        Mean of the speeds of both surfaces towards the contact [mm/s].
    load : numpy.ndarray
        Normal load over width [N/mm].
    relative_curvature : numpy.ndarray
        Sum of the signed curvatures [1/mm].
    modulus : float
        Contact modulus E* [MPa], half of the E' of the formula.

    Returns
    -------
    numpy.ndarray
        H_min [mm].

    Examples
    --------
    Discs of 20 mm, 0.1 Pa s, 20/GPa, 1 m/s, 100 N/mm: U = 2.167e-11, G = 4615, W = 2.167e-5, and
    2.65 G^0.54 U^0.7 W^-0.13 is 2.65 95.1 3.42e-8 4.04 = 3.48e-5, or 0.70 um.

    >>> import numpy as np
    >>> oil = Lubricant(1e-7, 0.02)
    >>> one = np.ones(1)
    >>> film = minimum_film(oil, 1000.0 * one, 100.0 * one, 0.05 * one, 115384.6)
    >>> round(1000.0 * float(film[0]), 2)
    0.7
    """
    full = 2.0 * modulus
    speed = lubricant.viscosity * entrainment * relative_curvature / full
    material = lubricant.pressure_viscosity * full
    weight = load * relative_curvature / full
    thickness: Vector = 2.65 * material**0.54 * speed**0.7 * weight**-0.13 / relative_curvature
    return thickness
