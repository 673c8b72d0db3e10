"""Diameter of the flexspline of a wave drive by eight methods side by side.

V.N. Tkachenko, "Comparative analysis of methods of dimensioning the flexspline of a wave gear"
(2010; source document 004) sets formulas of six textbooks, [1] to [6] there, beside each other.
They are kept as printed where that reproduces the diameters printed with them; where it does
not, the corrected form stands here and the printed one can be chosen.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from scipy.optimize import brentq

from wearsim.case.schema.wave_drive import WaveDriveTables
from wearsim.errors import GeometryError

Values = Mapping[str, float]

_BENDING_SPEED = 2.3e-10
"""Of the method with the speed of the generator, printed without a unit (rpm^-2 mm^-1)."""


@dataclass(frozen=True)
class Method:
    """A way to the diameter.

    Attributes
    ----------
    name : str
        Table of the input that holds what it allows.
    source : str
        Number of the textbook in the source's list.
    criterion : str
        What it limits.
    diameter : callable
        From the numbers of the drive and of the method to the diameter [mm].
    ranges : mapping
        Least and greatest value that the source recommends, for each key that it gives one for.
    allowable : str
        The key that the diameter is usually set by.
    """

    name: str
    source: str
    criterion: str
    diameter: Callable[[Values], float]
    ranges: Mapping[str, tuple[float, float]]
    allowable: str


def pressure_diameter(v: Values) -> float:
    """Diameter by the pressure between the teeth, method of [1].

    d = (4 T K_n / (K_z psi [p]))^(1/3) with T in N mm.

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
    return math.cbrt(
        torque / (v["engaged_share"] * v["tooth_length_ratio"] * v["allowable_pressure_MPa"])
    )


def crushing_diameter(v: Values) -> float:
    """Diameter by crushing of the flanks, method of [2].

    d = (10 T / (psi [sigma]))^(1/3) with T in N mm.

    Parameters
    ----------
    v : mapping
        ``output_torque_N_m``, ``tooth_length_ratio``, ``allowable_crushing_MPa``.

    Returns
    -------
    float
        d [mm].
    """
    return math.cbrt(
        1e4 * v["output_torque_N_m"] / (v["tooth_length_ratio"] * v["allowable_crushing_MPa"])
    )


def torsion_diameter(v: Values) -> float:
    """Diameter by torsion of the rim, method of [3].

    d = C (T psi_h / [tau])^(1/3) with T in N m; C falls from 14 at a ratio of 100 to 12 at
    400. Printed with a square root (``root`` 2), which gives 373 to 511 mm where 142 mm is printed.

    Parameters
    ----------
    v : mapping
        ``output_torque_N_m``, ``diameter_to_thickness``, ``allowable_shear_MPa``,
        ``torsion_coefficient``, ``root`` (3, or 2 as printed).

    Returns
    -------
    float
        d [mm].
    """
    inside = v["output_torque_N_m"] * v["diameter_to_thickness"] / v["allowable_shear_MPa"]
    return v["torsion_coefficient"] * math.pow(inside, 1.0 / v["root"])


def tooth_wear_diameter(v: Values) -> float:
    """Diameter by wear of the teeth under shocks, method of [3].

    d = (1e4 T K / (psi [sigma]))^(1/3) with T in N m.

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

    Parameters
    ----------
    v : mapping
        ``output_torque_N_m``, ``tooth_length_ratio``, ``allowable_pressure_MPa``.

    Returns
    -------
    float
        d [mm].
    """
    return 28.4 * math.cbrt(
        v["output_torque_N_m"] / (v["tooth_length_ratio"] * v["allowable_pressure_MPa"])
    )


def rim_bending_diameter(v: Values) -> float:
    """Diameter by endurance of the rim, method of [5].

    d = 10 (0.456 T / (X psi psi_s))^(1/3), T in N m, with what the bending of the rim by the
    generator leaves for the torque, X = sigma_-1/(K_s n_s) - 3 E Y_z psi_s / u. Printed with
    28.4 in place of 10 (``prefix``), which no admissible values bring to the printed diameter.

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
    return v["prefix"] * math.cbrt(
        torque / ((endured - bent) * v["tooth_length_ratio"] * thickness)
    )


def rim_endurance_diameter(v: Values) -> float:
    """Diameter by endurance of the rim with the speed of the generator, method of [6].

    d0 = 105 (T [s] K_s / (0.16 u^0.5 sigma_-1))^(1/3), T in N m, d = d0 / (1 - 2.3e-10 n_h^2 d0).

    Parameters
    ----------
    v : mapping
        ``output_torque_N_m``, ``safety_factor``, ``stress_concentration``, ``gear_ratio``,
        ``endurance_limit_MPa``, ``generator_speed_rpm``.

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
    >>> v = dict(output_torque_N_m=800, safety_factor=1.7, stress_concentration=1.65,
    ...          gear_ratio=100, endurance_limit_MPa=280, generator_speed_rpm=1500)
    >>> round(rim_endurance_diameter(v), 6)
    198.068973
    """
    torque = v["output_torque_N_m"] * v["safety_factor"] * v["stress_concentration"]
    static = 105.0 * math.cbrt(
        torque / (0.16 * math.sqrt(v["gear_ratio"]) * v["endurance_limit_MPa"])
    )
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


METHODS = (
    Method(
        "pressure", "[1]", "pressure between the teeth", pressure_diameter,
        {"allowable_pressure_MPa": (60.0, 65.0), "engaged_share": (0.22, 0.25)},
        "allowable_pressure_MPa",
    ),
    Method(
        "crushing", "[2]", "crushing of the flanks", crushing_diameter,
        {"allowable_crushing_MPa": (10.0, 30.0)}, "allowable_crushing_MPa",
    ),
    Method(
        "torsion", "[3]", "torsion of the rim", torsion_diameter,
        {"allowable_shear_MPa": (60.0, 90.0), "diameter_to_thickness": (80.0, 100.0)},
        "allowable_shear_MPa",
    ),
    Method(
        "tooth_wear", "[3]", "wear of the teeth", tooth_wear_diameter,
        {"allowable_crushing_MPa": (10.0, 20.0), "dynamic_factor": (1.0, 1.75)},
        "allowable_crushing_MPa",
    ),
    Method(
        "flank_pressure", "[4]", "wear of the teeth", flank_pressure_diameter,
        {"allowable_pressure_MPa": (20.0, 25.0)}, "allowable_pressure_MPa",
    ),
    Method(
        "rim_bending", "[5]", "endurance of the rim", rim_bending_diameter, {}, "endurance_limit_MPa"
    ),
    Method(
        "rim_endurance", "[6]", "endurance of the rim", rim_endurance_diameter,
        {"safety_factor": (1.6, 1.7)}, "endurance_limit_MPa",
    ),
    Method(
        "generator_bearing", "[6]", "bearing of the generator", generator_bearing_diameter, {},
        "bearing_constant",
    ),
)  # fmt: skip
"""In the order of the source."""


@dataclass(frozen=True)
class Found:
    """What a method comes to.

    Attributes
    ----------
    method : Method
        The method.
    diameter : float
        With the values given [mm].
    least, greatest : float
        Over the ranges that the source recommends for the method's own keys, the others as
        given [mm].
    elasticity : mapping
        Relative change of the diameter over that of each number of drive and method, where it
        is not 0.
    published : float
        Diameter to hold it against [mm]; nan where none was given.
    needed : float
        Value of the allowable that would give that; nan where none does.
    rank, best_rank, worst_rank : int
        From 1 for the largest diameter: with the values given, and where each method may take
        any diameter of its range.
    """

    method: Method
    diameter: float
    least: float
    greatest: float
    elasticity: Mapping[str, float]
    published: float
    needed: float
    rank: int
    best_rank: int
    worst_rank: int

    @property
    def reproduces(self) -> bool:
        """Whether the diameter is the published one to the millimetre."""
        return abs(self.diameter - self.published) <= 0.5


def wave_drive(tables: WaveDriveTables) -> tuple[Found, ...]:
    """Return the diameter of the flexspline by every method that has its numbers.

    Parameters
    ----------
    tables : WaveDriveTables
        Drive and methods.

    Returns
    -------
    tuple of Found
        In the order of the source.

    Raises
    ------
    GeometryError
        A method has no diameter.
    """
    used = [method for method in METHODS if getattr(tables, method.name) is not None]
    values = [_values(tables, method) for method in used]
    sizes = [method.diameter(v) for method, v in zip(used, values, strict=True)]
    ranges = [_range(method, v) for method, v in zip(used, values, strict=True)]
    found = []
    for i, (method, v, size) in enumerate(zip(used, values, sizes, strict=True)):
        least, greatest = ranges[i]
        others = ranges[:i] + ranges[i + 1 :]
        published = getattr(tables, method.name).published_diameter_mm
        target = math.nan if published is None else published
        found.append(
            Found(
                method, size, least, greatest, _elasticity(method, v), target,
                math.nan if published is None else _needed(method, v, published),
                rank=1 + sum(other > size for other in sizes),
                best_rank=1 + sum(low > greatest for low, _ in others),
                worst_rank=1 + sum(high > least for _, high in others),
            )
        )  # fmt: skip
    return tuple(found)


def _values(tables: WaveDriveTables, method: Method) -> dict[str, float]:
    """Return all numbers that a method may take, with what follows from the drive."""
    drive, own = tables.wave_drive, getattr(tables, method.name)
    v = {**drive.model_dump(), **own.model_dump(exclude={"published_diameter_mm"})}
    printed = v.pop("formula", "") == "printed"
    if method.name == "rim_bending":
        v["prefix"] = 28.4 if printed else 10.0
    if method.name == "torsion":
        v["root"] = 2.0 if printed else 3.0
        if v["torsion_coefficient"] is None:
            v["torsion_coefficient"] = _torsion_coefficient(v["gear_ratio"])
    if method.name == "rim_endurance" and v["stress_concentration"] is None:
        v["stress_concentration"] = 1.5 + 0.0015 * v["gear_ratio"]
    return v


def _torsion_coefficient(ratio: float) -> float:
    """C of [3]: 14 at a ratio of 100, 12 at 400, on the line between and as at the ends beyond."""
    return 14.0 - 2.0 * min(max((ratio - 100.0) / 300.0, 0.0), 1.0)


def _range(method: Method, v: Values) -> tuple[float, float]:
    """Return the least and the greatest diameter over the corners of the recommended ranges."""
    corners: list[Values] = [v]
    for key, ends in method.ranges.items():
        corners = [{**corner, key: end} for corner in corners for end in ends]
    sizes = [method.diameter(corner) for corner in corners]
    return min(*sizes, sizes[0]), max(*sizes, sizes[0])


_STEP = 1e-5


def _elasticity(method: Method, v: Values) -> dict[str, float]:
    """Return d(ln d)/d(ln value) of all numbers by central differences."""
    found = {}
    for key, value in v.items():
        if key in ("root", "prefix"):
            continue
        up, down = (method.diameter({**v, key: value * (1.0 + s)}) for s in (_STEP, -_STEP))
        slope = math.log(up / down) / math.log((1.0 + _STEP) / (1.0 - _STEP))
        if abs(slope) > 1e-6:
            found[key] = slope
    return found


def _needed(method: Method, v: Values, target: float) -> float:
    """Return the allowable that gives a diameter, within a factor of 100; nan where none does."""

    def miss(factor: float) -> float:
        try:
            return method.diameter({**v, method.allowable: v[method.allowable] * factor}) - target
        except GeometryError:
            return math.inf

    low, high = 0.01, 100.0
    while math.isinf(miss(low)) and low < 1.0:
        low = 1.0 - 0.99 * (1.0 - low)
    if not math.isfinite(miss(low)) or miss(low) * miss(high) > 0.0:
        return math.nan
    return v[method.allowable] * float(brentq(miss, low, high, xtol=1e-13))
