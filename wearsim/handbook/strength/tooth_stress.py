"""Load factors and stresses of the teeth of a spur gear pair.

Source 001, second half ("Basis of the strength of gears"). All its formulas but that of Hertz are
lost pictures; those of the load factors are textbook forms of the same names.
"""

import math
from dataclasses import dataclass

from wearsim.contact.hertz import peak_pressure


@dataclass(frozen=True)
class LoadFactor:
    """By what the load of a tooth exceeds its nominal one."""

    application: float  # K_A, of the machine around the gears
    face: float  # K_Hb or K_Fb, of the load along the face
    transverse: float  # K_Ha or K_Fa, of the load between the pairs of teeth
    dynamic: float  # K_Hv or K_Fv, of the mesh

    @property
    def total(self) -> float:
        """K_H = K_A K_Hb K_Ha K_Hv, or K_F.

        Equations strength.md (103) or (104).
        """
        return self.application * self.face * self.transverse * self.dynamic


def run_in(initial: float, share: float) -> float:
    """Return a factor of uneven load after running-in, 1 + (K0 - 1) K_w.

    Equation strength.md (103).

    Parameters
    ----------
    initial : float
        K0, of new teeth.
    share : float
        K_w, the part of the unevenness that running-in leaves.

    Returns
    -------
    float
        Factor (textbook).

    Examples
    --------
    >>> round(run_in(1.2, 0.26), 12)
    1.052
    """
    return 1.0 + (initial - 1.0) * share


def initial_transverse_factor(grade: int) -> float:
    """Return the unevenness between pairs of new spur teeth, K0_Ha = 1 + 0.06 (n_st - 5).

    Equation strength.md (103).

    Parameters
    ----------
    grade : int
        Grade of accuracy n_st, 5 to 9.

    Returns
    -------
    float
        Factor (textbook).
    """
    return 1.0 + 0.06 * (grade - 5)


def bending_face_factor(initial: float) -> float:
    """Return the unevenness along the face in bending, K_Fb = 0.18 + 0.82 K0_Hb.

    Equation strength.md (104).

    Parameters
    ----------
    initial : float
        K0_Hb of new teeth in contact.

    Returns
    -------
    float
        Factor (textbook).

    Examples
    --------
    >>> round(bending_face_factor(1.2), 12)
    1.164
    """
    return 0.18 + 0.82 * initial


def form_factor(teeth: float) -> float:
    """Return Y_FS of teeth without profile shift, 3.47 + 13.2/z.

    Equation strength.md (102).

    Parameters
    ----------
    teeth : float
        Number of teeth z.

    Returns
    -------
    float
        Factor (textbook, GOST 21354; not in the source).
    """
    return 3.47 + 13.2 / teeth


@dataclass(frozen=True)
class SpurMesh:
    """A pair of spur gears without profile shift."""

    torque: float  # of the pinion [N mm]
    module: float  # of the teeth [mm]
    teeth: int  # of the pinion
    ratio: float  # u = z2/z1
    face_width: float  # b [mm]
    pressure_angle: float  # alpha [rad]
    contact_modulus: float  # E* of both materials [MPa]

    @property
    def pinion_diameter(self) -> float:
        """Pitch diameter of the pinion [mm]."""
        return self.module * self.teeth

    @property
    def tangential_force(self) -> float:
        """F_t = 2 T/d1 [N]."""
        return 2.0 * self.torque / self.pinion_diameter

    @property
    def relative_curvature(self) -> float:
        """1/R1 + 1/R2 of the flanks at the pitch point, R = (d/2) sin alpha [1/mm]."""
        first = 0.5 * self.pinion_diameter * math.sin(self.pressure_angle)
        return (1.0 + 1.0 / self.ratio) / first

    def contact_stress(self, factor: float, normal: bool = True) -> float:
        """Return the contact stress at the pitch point, sigma_H = sqrt(q E*/(pi rho)).

        With one Poisson's ratio E* is E_pr/(2 (1 - nu^2)) of the source. It prints
        q = F_t K_H/b, the tangential force; teeth press with the normal one, F_t/cos alpha, which
        also is what the factors Z_E Z_H sqrt(F_t K_H (u + 1)/(b d1 u)) of the standards hold.

        Equation strength.md (101).

        Parameters
        ----------
        factor : float
            K_H.
        normal : bool
            With the normal force; with the tangential one, as printed, where False.

        Returns
        -------
        float
            Stress [MPa].

        Examples
        --------
        >>> mesh = SpurMesh(240e3, 3.0, 36, 1.5, 76.0, math.radians(20.0), 2.1e5 / 1.82)
        >>> round(mesh.contact_stress(1.167307616), 6)
        490.68453
        """
        force = self.tangential_force / (math.cos(self.pressure_angle) if normal else 1.0)
        load = force * factor / self.face_width
        return float(peak_pressure(load, self.relative_curvature, self.contact_modulus))

    def bending_stress(self, factor: float, form: float) -> float:
        """Return the bending stress in the root, sigma_F = F_t K_F Y_FS/(b m).

        Equation strength.md (102).

        Parameters
        ----------
        factor : float
            K_F.
        form : float
            Y_FS of the gear's teeth.

        Returns
        -------
        float
            Stress [MPa] (textbook; the source's formula is lost but for its arm and section).
        """
        return self.tangential_force * factor * form / (self.face_width * self.module)
