"""Diameter of the flexspline of a wave drive by eight methods side by side."""

import math
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from scipy.optimize import brentq

from wearsim.errors import ABOVE_0, GeometryError, Range, check_ranges
from wearsim.handbook.wave_drive.formulas import (
    Values,
    crushing_diameter,
    flank_pressure_diameter,
    generator_bearing_diameter,
    pressure_diameter,
    rim_bending_diameter,
    rim_endurance_diameter,
    tooth_wear_diameter,
    torsion_diameter,
)

Ranges = Mapping[str, tuple[float, float]]


@dataclass(frozen=True)
class DiameterMethod:
    """A way to the diameter."""

    name: str  # table of the input that holds what it allows
    source: str  # number of the textbook in the source's list
    criterion: str  # what it limits
    # from the numbers of the drive and of the method to the diameter [mm]
    diameter: Callable[[Values], float]
    # least and greatest value that the source recommends, for each key of the method that it gives one for
    ranges: Ranges
    numbers: Mapping[str, Range]  # what it takes; the first is what the diameter is usually set by
    drive_ranges: Ranges = field(default_factory=dict)  # as `ranges` for keys of the drive

    @property
    def allowable(self) -> str:
        """The key that the diameter is usually set by."""
        return next(iter(self.numbers))


_TOOTH_LENGTH: Ranges = {"tooth_length_ratio": (0.15, 0.25)}

_SHARE = Range(above=0.0, most=1.0)
_FACTOR = Range(least=1.0)

METHODS = (
    DiameterMethod(
        "pressure",
        "[1]",
        "pressure between the teeth",
        pressure_diameter,
        {"allowable_pressure_MPa": (60.0, 65.0), "engaged_share": (0.22, 0.25)},
        {"allowable_pressure_MPa": ABOVE_0, "load_nonuniformity": ABOVE_0, "engaged_share": _SHARE},
        _TOOTH_LENGTH,
    ),
    DiameterMethod(
        "crushing",
        "[2]",
        "crushing of the flanks",
        crushing_diameter,
        {"allowable_crushing_MPa": (10.0, 30.0)},
        {"allowable_crushing_MPa": ABOVE_0},
        _TOOTH_LENGTH,
    ),
    DiameterMethod(
        "torsion",
        "[3]",
        "torsion of the rim",
        torsion_diameter,
        {"allowable_shear_MPa": (60.0, 90.0), "diameter_to_thickness": (80.0, 100.0)},
        {
            "allowable_shear_MPa": ABOVE_0,
            "diameter_to_thickness": ABOVE_0,
            "torsion_coefficient": Range(above=0.0, optional=True),
        },
        {"gear_ratio": (100.0, 400.0)},
    ),
    DiameterMethod(
        "tooth_wear",
        "[3]",
        "wear of the teeth",
        tooth_wear_diameter,
        {"allowable_crushing_MPa": (10.0, 20.0), "dynamic_factor": (1.0, 1.75)},
        {"allowable_crushing_MPa": ABOVE_0, "dynamic_factor": _FACTOR},
    ),
    DiameterMethod(
        "flank_pressure",
        "[4]",
        "wear of the teeth",
        flank_pressure_diameter,
        {"allowable_pressure_MPa": (20.0, 25.0)},
        {"allowable_pressure_MPa": ABOVE_0},
    ),
    DiameterMethod(
        "rim_bending",
        "[5]",
        "fatigue of the rim",
        rim_bending_diameter,
        {},
        {
            "endurance_limit_MPa": ABOVE_0,
            **dict.fromkeys(("safety_factor", "stress_concentration"), _FACTOR),
            **dict.fromkeys(("tooth_form_factor", "youngs_modulus_MPa"), ABOVE_0),
            "thickness_ratio": Range(above=0.0, below=1.0),
        },
    ),
    DiameterMethod(
        "rim_endurance",
        "[6]",
        "fatigue of the rim",
        rim_endurance_diameter,
        {"safety_factor": (1.6, 1.7)},
        {
            "endurance_limit_MPa": ABOVE_0,
            "safety_factor": _FACTOR,
            "stress_concentration": Range(least=1.0, optional=True),
        },
    ),
    DiameterMethod(
        "generator_bearing",
        "[6]",
        "bearing of the generator",
        generator_bearing_diameter,
        {},
        {"bearing_constant": ABOVE_0},
    ),
)
"""In the order of the source."""


@dataclass(frozen=True)
class MethodDiameter:
    """What a method comes to."""

    method: DiameterMethod  # the method
    as_printed: bool  # whether a formula that is wrong as printed was asked for all the same
    diameter: float  # with the values given [mm]
    # least, greatest: over the ranges that the source recommends for the method's own keys, the others as
    # given [mm]
    least: float
    greatest: float
    # relative change of the diameter over that of each number of drive and method, where it is not 0
    elasticity: Mapping[str, float]
    outside: Mapping[str, float]  # the numbers that are outside of what the source recommends
    published: float  # diameter to hold it against [mm]; nan where none was given
    needed: float  # value of the allowable that would give that; nan where none does
    # rank, least_rank, greatest_rank: from 1 for the largest diameter: with the values given, and where each
    # method may take any diameter of its range
    rank: int
    least_rank: int
    greatest_rank: int

    @property
    def reproduces(self) -> bool:
        """Whether the diameter is the published one to half a millimetre."""
        return abs(self.diameter - self.published) <= 0.5


@dataclass(frozen=True)
class MethodComparison:
    """The methods side by side."""

    diameters: tuple[MethodDiameter, ...]  #: in the order of the source
    #: why a method that the file says nothing about has no diameter with its defaults
    left_out: Mapping[str, str]


_DRIVE: Mapping[str, Range] = {
    **dict.fromkeys(("gear_ratio", "output_torque_N_m", "life_hours", "generator_speed_rpm"), ABOVE_0),
    "tooth_length_ratio": _SHARE,
}


def flexspline_diameters(
    drive: Values,
    methods: Mapping[str, Values],
    *,
    printed: Collection[str] = (),
    published: Mapping[str, float] = MappingProxyType({}),
    required: Collection[str] | None = None,
) -> MethodComparison:
    """Return the diameter of a flexspline by several methods, with what each rests on.

    Formulas of six textbooks as collected by Tkachenko (2010), wave-drive.md (1) to (8).

    Parameters
    ----------
    drive : mapping of str to float
        ``gear_ratio``, ``output_torque_N_m``, ``life_hours``, ``generator_speed_rpm`` and
        ``tooth_length_ratio``: all above 0.
    methods : mapping of str to mapping
        For each of the `METHODS` wanted, by its name, the numbers that it takes, such as
        ``allowable_pressure_MPa``.
    printed : collection of str, optional
        Methods whose formula is to be taken as printed, ``torsion`` and ``rim_bending`` only.
    published : mapping of str to float, optional
        Diameters to hold the results against [mm], above 0.
    required : collection of str, optional
        Methods without which there is no answer; all that are wanted if left out.

    Returns
    -------
    MethodComparison
        Methods, with reasons for those left out.

    Raises
    ------
    GeometryError
        A number cannot be or is missing, a name is not known, or a method that is required has no diameter.

    Examples
    --------
    Twice the torque asks for 2^(1/3) of the diameter where the pressure between the teeth limits it:

    >>> def size(torque):
    ...     drive = {
    ...         "gear_ratio": 100.0,
    ...         "output_torque_N_m": torque,
    ...         "life_hours": 1e4,
    ...         "generator_speed_rpm": 1500.0,
    ...         "tooth_length_ratio": 0.2,
    ...     }
    ...     pressure = {"allowable_pressure_MPa": 60.0, "load_nonuniformity": 1.5, "engaged_share": 0.25}
    ...     return flexspline_diameters(drive, {"pressure": pressure}).diameters[0].diameter
    >>> round((size(400.0) / size(200.0)) ** 3, 9)
    2.0
    """
    known = {method.name: method for method in METHODS}
    wanted = methods if required is None else required
    for name, given, names in (
        ("methods", methods, known),
        ("printed", printed, _PRINTED),
        ("published", published, known),
        ("required", wanted, methods),
    ):
        _check_names(name, given, names)
    check_ranges("wave drive: published", published, dict.fromkeys(published, ABOVE_0))
    numbers = {"drive": (drive, _DRIVE)} | {name: (methods[name], known[name].numbers) for name in methods}
    for name, (values, allowed) in numbers.items():
        _check_names(name, values, allowed)
        check_ranges(f"wave drive: {name}", values, allowed)
    used, left_out = _feasible(drive, methods, printed, wanted)
    sizes = [method.diameter(v) for method, v in used]
    ranges = [_range(method, v) for method, v in used]
    results = []
    for i, ((method, v), size) in enumerate(zip(used, sizes, strict=True)):
        least, greatest = ranges[i]
        others = ranges[:i] + ranges[i + 1 :]
        target = published.get(method.name, math.nan)
        results.append(
            MethodDiameter(
                method,
                method.name in printed,
                size,
                least,
                greatest,
                _elasticity(method, v),
                _outside(method, v),
                target,
                _needed(method, v, target),
                rank=1 + sum(other > size for other in sizes),
                least_rank=1 + sum(low > greatest for low, _ in others),
                greatest_rank=1 + sum(high > least for _, high in others),
            )
        )
    return MethodComparison(tuple(results), left_out)


def _check_names(what: str, given: Collection[str], known: Collection[str]) -> None:
    unknown = [name for name in given if name not in known]
    if unknown:
        raise GeometryError(
            f"wave drive: {what} must be among {', '.join(known)}, but holds {unknown[0]}: correct it"
        )


def _feasible(
    drive: Values, methods: Mapping[str, Values], printed: Collection[str], required: Collection[str]
) -> tuple[list[tuple[DiameterMethod, Values]], dict[str, str]]:
    """Return the methods that have a diameter, with their numbers, and why others have none."""
    used: list[tuple[DiameterMethod, Values]] = []
    left_out = {}
    for method in METHODS:
        if method.name not in methods:
            continue
        own = {key: value for key, value in methods[method.name].items() if value is not None}
        v = {**drive, **own}
        if method.name in _PRINTED:
            name, corrected, as_printed = _PRINTED[method.name]
            v[name] = as_printed if method.name in printed else corrected
        try:
            method.diameter(v)
        except GeometryError as error:
            if method.name in required:
                raise
            left_out[method.name] = str(error)
        else:
            used.append((method, v))
    return used, left_out


_PRINTED = {"torsion": ("root", 3.0, 2.0), "rim_bending": ("prefix", 10.0, 28.4)}
"""What differs in a formula as it is printed: the name of it, corrected, printed."""


def _range(method: DiameterMethod, v: Values) -> tuple[float, float]:
    """Return the least and the greatest diameter over the corners of the recommended ranges."""
    corners: list[Values] = [v]
    for key, ends in method.ranges.items():
        corners = [{**corner, key: end} for corner in corners for end in ends]
    sizes = [method.diameter(corner) for corner in corners]
    return min(sizes), max(sizes)


def _outside(method: DiameterMethod, v: Values) -> dict[str, float]:
    """Return the numbers outside of what is recommended; a coefficient that is given needs none."""
    ranges = {**method.ranges, **method.drive_ranges}
    if "torsion_coefficient" in v:
        ranges.pop("gear_ratio", None)
    return {key: v[key] for key, (low, high) in ranges.items() if not low <= v[key] <= high}


_STEP = 1e-5


def _elasticity(method: DiameterMethod, v: Values) -> dict[str, float]:
    """Return d(ln d)/d(ln value) of all numbers by central differences."""
    slopes = {}
    for key, value in v.items():
        if key in ("root", "prefix"):
            continue
        up, down = (method.diameter({**v, key: value * (1.0 + s)}) for s in (_STEP, -_STEP))
        slope = math.log(up / down) / math.log((1.0 + _STEP) / (1.0 - _STEP))
        if abs(slope) > 1e-6:
            slopes[key] = slope
    return slopes


def _needed(method: DiameterMethod, v: Values, target: float) -> float:
    """Return the allowable that gives a diameter, within a factor of 100; nan where none does."""

    def missing(factor: float) -> float:
        """Of 1/d, which goes to 0 where the method has no diameter any more."""
        try:
            size = method.diameter({**v, method.allowable: v[method.allowable] * factor})
        except GeometryError:
            return -1.0 / target
        return 1.0 / size - 1.0 / target

    low, high = 0.01, 100.0
    if not missing(low) * missing(high) <= 0.0:
        return math.nan
    return v[method.allowable] * float(brentq(missing, low, high, xtol=1e-13))
