"""Eight formulas for the diameter of the flexspline of a wave drive.

V.N. Tkachenko, "Comparative analysis of methods of dimensioning the flexspline of a wave gear"
(2010; source document 004) sets formulas of six textbooks, [1] to [6] there, beside each other.
They are kept as printed where that reproduces the diameters printed with them; where it does
not, the corrected form stands here and the printed one can be chosen.
"""

import math
from collections.abc import Mapping

from wearsim.errors import GeometryError

Values = Mapping[str, float]
"""Numbers of drive and method by their input keys."""

_BENDING_SPEED = 2.3e-10
"""Of the method with the speed of the generator, printed without a unit [1/(rpm^2 mm)]."""


def pressure_diameter(v: Values) -> float:
    """Diameter by the pressure between the teeth, method of [1].

    d = (4 T K_n / (K_z psi [p]))^(1/3) with T in N mm.

    Equation wave-drive.md (1).

    Parameters
    ----------
    v : mapping
        ``output_torque_N_m``, ``load_nonuniformity``, ``engaged_share``, ``tooth_length_ratio``,
        ``allowable_pressure_MPa``.

    Returns
    -------
    float
        d [mm].

    Examples
    --------
    >>> v = dict(output_torque_N_m=800, load_nonuniformity=1.5, engaged_share=0.25,
    ...          tooth_length_ratio=0.2, allowable_pressure_MPa=65)
    >>> round(pressure_diameter(v), 6)
    113.881355
    """
    torque = 4e3 * v["output_torque_N_m"] * v["load_nonuniformity"]
    return math.cbrt(torque / (v["engaged_share"] * v["tooth_length_ratio"] * v["allowable_pressure_MPa"]))


def crushing_diameter(v: Values) -> float:
    """Diameter by crushing of the flanks, method of [2].

    d = (10 T / (psi [sigma]))^(1/3) with T in N mm.

    Equation wave-drive.md (2).

    Parameters
    ----------
    v : mapping
        ``output_torque_N_m``, ``tooth_length_ratio``, ``allowable_crushing_MPa``.

    Returns
    -------
    float
        d [mm].
    """
    return math.cbrt(1e4 * v["output_torque_N_m"] / (v["tooth_length_ratio"] * v["allowable_crushing_MPa"]))


def torsion_diameter(v: Values) -> float:
    """Diameter by torsion of the rim, method of [3].

    d = C (T psi_h / [tau])^(1/3) with T in N m. Printed with a square root (``root`` 2), which
    gives 373 to 511 mm where 142 mm is printed.

    Equation wave-drive.md (3).

    Parameters
    ----------
    v : mapping
        ``output_torque_N_m``, ``diameter_to_thickness``, ``allowable_shear_MPa``, ``root`` (3, or
        2 as printed), and ``torsion_coefficient`` or the ``gear_ratio`` that it follows from.

    Returns
    -------
    float
        d [mm].
    """
    inside = v["output_torque_N_m"] * v["diameter_to_thickness"] / v["allowable_shear_MPa"]
    coefficient = v.get("torsion_coefficient", torsion_coefficient(v["gear_ratio"]))
    return coefficient * math.pow(inside, 1.0 / v["root"])


def torsion_coefficient(gear_ratio: float) -> float:
    """Coefficient of the method of [3] by the gear ratio.

    14 at a ratio of 100 and 12 at 400 are printed; the line between them is reconstruction. It
    goes on below 100; above 400 the coefficient stays at 12.

    Parameters
    ----------
    gear_ratio : float
        Speed of the generator over that of the output.

    Returns
    -------
    float
        C.

    Examples
    --------
    >>> torsion_coefficient(100.0), torsion_coefficient(400.0)
    (14.0, 12.0)
    """
    return max(14.0 - (gear_ratio - 100.0) / 150.0, 12.0)


def tooth_wear_diameter(v: Values) -> float:
    """Diameter by wear of the teeth under shocks, method of [3].

    d = (1e4 T K / (psi [sigma]))^(1/3) with T in N m.

    Equation wave-drive.md (4).

    Parameters
    ----------
    v : mapping
        ``output_torque_N_m``, ``dynamic_factor``, ``tooth_length_ratio``, ``allowable_crushing_MPa``.

    Returns
    -------
    float
        d [mm].
    """
    return math.cbrt(v["dynamic_factor"]) * crushing_diameter(v)


def flank_pressure_diameter(v: Values) -> float:
    """Diameter by the pressure on the flanks against wear, method of [4].

    d = 28.4 (T / (psi [p]))^(1/3) with T in N m.

    Equation wave-drive.md (5).

    Parameters
    ----------
    v : mapping
        ``output_torque_N_m``, ``tooth_length_ratio``, ``allowable_pressure_MPa``.

    Returns
    -------
    float
        d [mm].
    """
    return 28.4 * math.cbrt(v["output_torque_N_m"] / (v["tooth_length_ratio"] * v["allowable_pressure_MPa"]))


def rim_bending_diameter(v: Values) -> float:
    """Diameter by endurance of the rim, method of [5].

    d = 10 (0.456 T / (X psi psi_s))^(1/3), T in N m, with what the bending of the rim by the
    generator leaves for the torque, X = sigma_-1/(K_s n_s) - 3 E Y_z psi_s / u. Printed with
    28.4, the factor of [4], in place of 10 (``prefix``); the diameter printed with it then takes an
    endurance limit near 1000 MPa.

    Equation wave-drive.md (6).

    Parameters
    ----------
    v : mapping
        ``output_torque_N_m``, ``tooth_length_ratio``, ``gear_ratio``, ``endurance_limit_MPa``,
        ``stress_concentration``, ``safety_factor``, ``youngs_modulus_MPa``, ``tooth_form_factor``,
        ``thickness_ratio``, ``prefix``.

    Returns
    -------
    float
        d [mm].

    Raises
    ------
    GeometryError
        X is not above 0.
    """
    endured = v["endurance_limit_MPa"] / (v["stress_concentration"] * v["safety_factor"])
    thickness = v["thickness_ratio"]
    bent = 3.0 * v["youngs_modulus_MPa"] * v["tooth_form_factor"] * thickness / v["gear_ratio"]
    if not endured > bent:
        raise GeometryError(
            f"rim_bending: the endurance of the rim, {endured:.4g} MPa with its safety, must exceed its "
            f"bending by the generator, {bent:.4g} MPa: lower thickness_ratio or raise "
            "endurance_limit_MPa or gear_ratio"
        )
    torque = 0.456 * v["output_torque_N_m"]
    return v["prefix"] * math.cbrt(torque / ((endured - bent) * v["tooth_length_ratio"] * thickness))


def rim_endurance_diameter(v: Values) -> float:
    """Diameter by endurance of the rim with the speed of the generator, method of [6].

    d0 = 105 (T [s] K_s / (0.16 u^0.5 sigma_-1))^(1/3), T in N m, d = d0 / (1 - 2.3e-10 n_h^2 d0).

    Equation wave-drive.md (7).

    Parameters
    ----------
    v : mapping
        ``output_torque_N_m``, ``safety_factor``, ``gear_ratio``, ``endurance_limit_MPa``,
        ``generator_speed_rpm``, and ``stress_concentration`` unless it is 1.5 + 0.0015 u.

    Returns
    -------
    float
        d [mm].

    Raises
    ------
    GeometryError
        The generator is too fast: the denominator is not above 0.

    Examples
    --------
    >>> v = dict(output_torque_N_m=800, safety_factor=1.7, gear_ratio=100,
    ...          endurance_limit_MPa=280, generator_speed_rpm=1500)
    >>> round(rim_endurance_diameter(v), 6)
    198.068973
    """
    concentration = v.get("stress_concentration", 1.5 + 0.0015 * v["gear_ratio"])
    torque = v["output_torque_N_m"] * v["safety_factor"] * concentration
    static = 105.0 * math.cbrt(torque / (0.16 * math.sqrt(v["gear_ratio"]) * v["endurance_limit_MPa"]))
    rest = 1.0 - _BENDING_SPEED * v["generator_speed_rpm"] ** 2 * static
    if not rest > 0.0:
        fastest = 1.0 / math.sqrt(_BENDING_SPEED * static)
        raise GeometryError(
            f"rim_endurance: generator_speed_rpm must be below {fastest:.4g} for a rim of {static:.4g} "
            f"mm, but is {v['generator_speed_rpm']:g}: lower it or raise endurance_limit_MPa"
        )
    return static / rest


def generator_bearing_diameter(v: Values) -> float:
    """Diameter by the load rating of the generator's bearing, method of [6].

    d0 = (T G (L_h n_h)^(1/3))^0.357 with G = B K_T / (A K_L), T in N m; the tables of A and B
    are not in the source.

    Equation wave-drive.md (8).

    Parameters
    ----------
    v : mapping
        ``output_torque_N_m``, ``bearing_constant``, ``life_hours``, ``generator_speed_rpm``.

    Returns
    -------
    float
        d [mm].
    """
    turns = math.cbrt(v["life_hours"] * v["generator_speed_rpm"])
    return math.pow(v["output_torque_N_m"] * v["bearing_constant"] * turns, 0.357)
