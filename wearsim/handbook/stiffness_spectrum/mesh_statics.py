"""Deflection and stiffness of a mesh under load, from the number of contacts that share it.

Golubkov et al. (2016; source document 003), equations 1 and 2: every contact has the energy
B delta^p / p and all have the same deflection.
"""

import math
from dataclasses import dataclass

import numpy as np

from wearsim.errors import GeometryError
from wearsim.handbook.stiffness_spectrum.contact_number import Floats, StepFunction


@dataclass(frozen=True, eq=False)
class MeshStatics:
    """Deflection and stiffness under load."""

    force: float  # F, normal force in the mesh [N]
    constant: float  # B of the law force = B deflection^(p - 1) of one contact [N/mm^(p-1)]
    exponent: float  # p of the energy
    # contacts, deflections, stiffnesses: N, and for it delta [mm] and C [N/mm]
    contacts: Floats
    deflections: Floats
    stiffnesses: Floats
    stiffness: StepFunction  # C over the common period [N/mm]


def hertz_constant(radius: float, mate_radius: float, youngs_modulus: float, poissons_ratio: float) -> float:
    """B of two crowned bodies of one material, force = B deflection^(3/2) (Hertz point contact).

    B = 2 E / (3 (1 - nu^2)) sqrt(R1 R2 / (R1 + R2)); the source gives no exponent with it.

    Equation stiffness-spectrum.md (6).

    Parameters
    ----------
    radius, mate_radius : float
        R1 and R2 [mm].
    youngs_modulus : float
        E [MPa].
    poissons_ratio : float
        nu.

    Returns
    -------
    float
        B [N/mm^1.5].

    Examples
    --------
    >>> round(hertz_constant(10.0, 10.0, 2.1e5, 0.3), 3)
    344010.458
    """
    together = math.sqrt(radius * mate_radius / (radius + mate_radius))
    return 2.0 * youngs_modulus / (3.0 * (1.0 - poissons_ratio**2)) * together


def deflection(contacts: Floats, force: float, constant: float, exponent: float) -> Floats:
    """Deflection when all contacts share the load alike, equation 2 of the source solved.

    delta = (F / (B N))^(1/(p - 1)).

    Equation stiffness-spectrum.md (6).

    Parameters
    ----------
    contacts : ndarray
        N, above 0.
    force : float
        F [N].
    constant : float
        B [N/mm^(p-1)].
    exponent : float
        p.

    Returns
    -------
    ndarray
        delta [mm].
    """
    return np.asarray((force / (constant * contacts)) ** (1.0 / (exponent - 1.0)))


def mesh_stiffness(contacts: Floats, force: float, constant: float, exponent: float) -> Floats:
    """Stiffness about the static deflection, with delta^(p-2) (the source's equation 1 prints p - 1).

    C = (p - 1) N B delta^(p-2).

    Equation stiffness-spectrum.md (6).

    Parameters
    ----------
    contacts : ndarray
        N, above 0.
    force : float
        F [N].
    constant : float
        B [N/mm^(p-1)].
    exponent : float
        p.

    Returns
    -------
    ndarray
        C [N/mm].
    """
    delta = deflection(contacts, force, constant, exponent)
    return np.asarray((exponent - 1.0) * contacts * constant * delta ** (exponent - 2.0))


@dataclass(frozen=True)
class LoadedTeeth:
    """Load and bodies for the deflection of a pair; give one of force and torque."""

    pinion_curvature_radius: float  #: of the flanks where they touch [mm]
    wheel_curvature_radius: float
    force: float | None = None  #: along the common normal [N]
    pinion_torque: float | None = None  #: [N mm]
    youngs_modulus: float = 2.1e5  #: [MPa]
    poissons_ratio: float = 0.3
    energy_exponent: float = 2.5
    formula: str | None = None  #: `printed`: the force along the pitch circle is taken for the normal one


def mesh_statics(
    given: LoadedTeeth, contacts: StepFunction, pitch_radius: float, pressure_angle: float
) -> MeshStatics:
    """Return deflection and stiffness over the number of contacts."""
    free = float(contacts.widths[contacts.values == 0.0].sum()) / math.tau
    if free > 0.0:
        raise GeometryError(
            f"statics: some teeth must touch at every moment to carry the load, but none do for "
            f"{100.0 * free:.3g} % of the time: lower pitch_error_mm or remove [statics]"
        )
    constant = hertz_constant(
        given.pinion_curvature_radius,
        given.wheel_curvature_radius,
        given.youngs_modulus,
        given.poissons_ratio,
    )
    law = (normal_force(given, pitch_radius, pressure_angle), constant, given.energy_exponent)
    numbers = np.union1d(contacts.values, (1.0, 2.0, 4.0))
    stiffness = StepFunction(contacts.edges, mesh_stiffness(contacts.values, *law))
    return MeshStatics(*law, numbers, deflection(numbers, *law), mesh_stiffness(numbers, *law), stiffness)


def normal_force(given: LoadedTeeth, pitch_radius: float, pressure_angle: float) -> float:
    """Force along the common normal of the teeth [N].

    F = M / (r1 cos a) of a torque M; the source prints M / r1, the force along the pitch circle.
    """
    if given.pinion_torque is None:
        return float(given.force or 0.0)
    arm = pitch_radius if given.formula == "printed" else pitch_radius * math.cos(pressure_angle)
    return given.pinion_torque / arm
