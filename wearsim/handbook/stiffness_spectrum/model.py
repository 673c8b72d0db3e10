"""Lines of the mesh stiffness of a gear pair whose wheels have pitch errors.

Golubkov et al. (2016; source document 003): the stiffness follows the number of contacts, whose
spectrum has, beside the tooth frequency fz and its multiples, combination lines l fz + a f1 +
b f2 of the turns f1 of the pinion and f2 of the wheel.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from typing import Literal, get_args

import numpy as np

from wearsim.errors import ABOVE_0, AT_LEAST_0, Allowed, GeometryError, Range, check_ranges
from wearsim.handbook.stiffness_spectrum.contact_number import (
    Floats,
    GearPair,
    StepFunction,
    Wheel,
    check_order,
    contact_number,
    contact_ratio,
)
from wearsim.handbook.stiffness_spectrum.contact_number_series import Formula, one_sided, series_coefficients
from wearsim.handbook.stiffness_spectrum.mesh_statics import LoadedTeeth, MeshStatics, mesh_statics

_SERIES_HARMONICS = 6000

Combination = tuple[int, int, int]
"""l, a and b of the frequency l fz + a f1 + b f2."""


@dataclass(frozen=True)
class SpectrumLine:
    """A line of the spectrum."""

    harmonic: int  # h, in common periods of the pair
    combinations: tuple[Combination, ...]  # ways to it of the lowest order, at least one
    two_sided: float  # |S_h|, the magnitude of the complex coefficient
    series: float  # one-sided amplitude by the closed form; nan where there is none
    stiffness: float  # one-sided amplitude of the stiffness [N/mm]; nan without statics

    @property
    def one_sided(self) -> float:
        """2 |S_h|, the amplitude of the cosine."""
        return 2.0 * self.two_sided

    @property
    def name(self) -> str:
        """Such as ``fz - f1``; equal ways are joined by an equals sign."""
        return " = ".join(_name(combination) for combination in self.combinations)

    @property
    def short_name(self) -> str:
        """The first of the ways, with dots for others that are too long for a table."""
        first = _name(self.combinations[0])
        return first if self.name == first else f"{first} = ..." if len(self.name) > 20 else self.name

    @property
    def family(self) -> str:
        """Whose line it is: ``mesh``, ``pinion``, ``wheel``, or ``both``."""
        kinds = {(a != 0, b != 0) for _, a, b in self.combinations}
        names = {(False, False): "mesh", (True, False): "pinion", (False, True): "wheel"}
        return names.get(kinds.pop(), "both") if len(kinds) == 1 else "both"


@dataclass(frozen=True, eq=False)
class StiffnessSpectrum:
    """The whole answer."""

    pair: GearPair  #: the wheels
    #: contacts, ideal: number of contacts over the common period, with the pitch errors and without
    contacts: StepFunction
    ideal: StepFunction
    lines: tuple[SpectrumLine, ...]  #: by frequency, the mean apart
    series_mean: float  #: mean number of contacts by the closed form; nan where there is none
    mesh_frequency: float  #: fz [Hz]; nan without a speed
    statics: MeshStatics | None  #: where a load is given
    #: wheel whose tips reach beyond the tangent point of the other, empty where none does
    beyond_involute: str

    @property
    def variance_share(self) -> float:
        """Part of the variance of the number of contacts that the lines hold (Parseval)."""
        return 2.0 * sum(line.two_sided**2 for line in self.lines) / self.contacts.variance


@dataclass(frozen=True)
class ToothErrors:
    """Teeth of a wheel and its pitch error, a sine over the tooth number."""

    teeth: int
    pitch_error: float  #: amplitude along the pitch circle [mm]
    error_order: int = 1  #: waves in a turn
    error_phase: float = 0.0  #: [rad]


@dataclass(frozen=True)
class SpectrumChoice:
    """What is counted as contact, and which lines are wanted."""

    model: Literal["pairs", "double_sum"] = "pairs"
    tooth_harmonics: int = 3
    sideband_order: int = 2
    formula: Formula | None = None  #: of the closed form of `double_sum`
    series_harmonics: int | None = None


_PAIR: Mapping[str, Allowed] = {
    "module": ABOVE_0,
    "pressure_angle": Range(math.radians(10.0), math.radians(35.0)),
    "pinion_speed": Range(above=0.0, optional=True),
}
_TEETH: Mapping[str, Allowed] = {
    "teeth": Range(5, 300, whole=True),
    "pitch_error": AT_LEAST_0,
    "error_order": Range(1, 150, whole=True),
    "error_phase": Range(),
}
_CHOICE: Mapping[str, Allowed] = {
    "model": ("pairs", "double_sum"),
    "tooth_harmonics": Range(1, 20, whole=True),
    "sideband_order": Range(0, 5, whole=True),
    "formula": (*get_args(Formula), None),
    "series_harmonics": Range(10, 100_000, whole=True, optional=True),
}
_LOADED: Mapping[str, Allowed] = {
    **dict.fromkeys(("pinion_curvature_radius", "wheel_curvature_radius", "youngs_modulus"), ABOVE_0),
    **dict.fromkeys(("force", "pinion_torque"), Range(above=0.0, optional=True)),
    "poissons_ratio": Range(least=0.0, below=0.5),
    "energy_exponent": Range(1.5, 4.0),
    "formula": ("corrected", "printed", None),
}


def mesh_spectrum(
    pinion: ToothErrors,
    wheel: ToothErrors,
    *,
    module: float,
    pressure_angle: float = math.radians(20.0),
    pinion_speed: float | None = None,
    choice: SpectrumChoice = SpectrumChoice(),
    load: LoadedTeeth | None = None,
) -> StiffnessSpectrum:
    """Return the spectrum of the contacts of a pair with pitch errors and, with a load, of its stiffness.

    The number of contacts by stiffness-spectrum.md (1) to (3), its lines by (4) to (8) and the stiffness by
    (9) to (11); Golubkov et al. (2016), source document 003. Standard spur teeth without profile shift.

    Parameters
    ----------
    pinion, wheel : ToothErrors
        Teeth and errors.
    module : float
        m [mm], above 0.
    pressure_angle : float, optional
        [rad], 20 degrees if left out.
    pinion_speed : float, optional
        [rpm], for frequencies in Hz.
    choice : SpectrumChoice, optional
        What is counted, and which lines are wanted.
    load : LoadedTeeth, optional
        For deflection and stiffness.

    Returns
    -------
    StiffnessSpectrum
        Lines by frequency.

    Raises
    ------
    GeometryError
        The teeth cannot run so, or with a load, no tooth carries it at some moment.

    Examples
    --------
    The lines of 20 teeth with an error and 30 without, in turns of the common period of 60 meshes: one turn
    of the pinion is 3 of them.

    >>> found = mesh_spectrum(
    ...     ToothErrors(20, 0.01), ToothErrors(30, 0.0), module=5.0, choice=SpectrumChoice(tooth_harmonics=1)
    ... )
    >>> [line.harmonic for line in found.lines]
    [3, 6, 54, 57, 60, 63, 66]
    """
    pair_numbers = {"module": module, "pressure_angle": pressure_angle, "pinion_speed": pinion_speed}
    check_ranges("stiffness spectrum", pair_numbers, _PAIR)
    for name, errors in (("pinion", pinion), ("wheel", wheel)):
        check_ranges(f"stiffness spectrum: {name}", vars(errors), _TEETH)
        most = Range(most=errors.teeth // 2)
        check_ranges(f"stiffness spectrum: {name}", vars(errors), {"error_order": most})
    check_ranges("stiffness spectrum: choice", vars(choice), _CHOICE)
    if choice.model != "double_sum" and (choice.formula or choice.series_harmonics):
        raise GeometryError(
            "stiffness spectrum: formula and series_harmonics belong to the closed form of "
            'model="double_sum": leave them out or set that model'
        )
    if load is not None:
        _check_load(load)
    pair = gear_pair(pinion, wheel, module, pressure_angle)
    contacts = contact_number(pair, choice.model)
    statics = None
    if load is not None:
        statics = mesh_statics(load, contacts, 0.5 * module * pinion.teeth, pressure_angle)
    lattice = combinations(pair, choice.tooth_harmonics, choice.sideband_order)
    exact = np.abs(contacts.coefficients(list(lattice)))
    series = _series(pair, choice, [0, *lattice])
    stiffness = np.full(len(lattice), math.nan)
    if statics is not None:
        stiffness = one_sided(statics.stiffness.coefficients(list(lattice)))
    lines = tuple(
        SpectrumLine(h, ways, *map(float, values))
        for (h, ways), *values in zip(lattice.items(), exact, series[1:], stiffness, strict=True)
    )
    frequency = math.nan if pinion_speed is None else pinion_speed / 60.0 * pinion.teeth
    return StiffnessSpectrum(
        pair,
        contacts,
        contact_number(pair.without_error, choice.model),
        lines,
        float(series[0]),
        frequency,
        statics,
        _beyond_involute({"pinion": pinion.teeth, "wheel": wheel.teeth}, pressure_angle),
    )


def _check_load(load: LoadedTeeth) -> None:
    check_ranges("stiffness spectrum: load", vars(load), _LOADED)
    if (load.force is None) == (load.pinion_torque is None):
        raise GeometryError("stiffness spectrum: load must have one of force and pinion_torque: give one")
    if load.formula is not None and load.pinion_torque is None:
        raise GeometryError("stiffness spectrum: formula belongs to pinion_torque: leave it out")


def _series(pair: GearPair, choice: SpectrumChoice, harmonics: list[int]) -> Floats:
    """Return the mean and the one-sided amplitudes by the closed form; nan where there is none."""
    if choice.model != "double_sum":
        return np.full(len(harmonics), math.nan)
    formula: Formula = choice.formula or "corrected"
    limit = choice.series_harmonics or _SERIES_HARMONICS
    found = series_coefficients(pair, harmonics, limit, formula)
    return np.append(found[0].real, one_sided(found[1:], formula))


def gear_pair(pinion: ToothErrors, wheel: ToothErrors, module: float, pressure_angle: float) -> GearPair:
    """Return the wheels of a pair with their contact ratio."""
    ratio = contact_ratio(pinion.teeth, wheel.teeth, pressure_angle)
    wheels = [
        _wheel(one, place, 0.5 * module * one.teeth) for one, place in ((pinion, "pinion"), (wheel, "wheel"))
    ]
    return GearPair(wheels[0], wheels[1], ratio)


def _wheel(errors: ToothErrors, place: str, pitch_radius: float) -> Wheel:
    wheel = Wheel(errors.teeth, errors.pitch_error / pitch_radius, errors.error_order, errors.error_phase)
    check_order(wheel, place, pitch_radius)
    return wheel


def _beyond_involute(teeth: Mapping[str, int], pressure_angle: float) -> str:
    """Return whose tips reach past the tangent of the other's base circle, where no involute is."""
    sine = math.sin(pressure_angle)
    line = sum(teeth.values()) / 2.0 * sine
    beyond = [name for name, z in teeth.items() if math.sqrt((z * sine / 2.0) ** 2 + z + 1.0) > line]
    return " and ".join(beyond)


def combinations(
    pair: GearPair, tooth_harmonics: int, sideband_order: int
) -> dict[int, tuple[Combination, ...]]:
    """Return the lines that pitch errors can give, with what they are combined of.

    A wheel whose error has kappa waves in a turn gives sidebands at multiples of kappa turns; a
    wheel without error gives none. Ways to one frequency by more sidebands than needed are left
    out, such as 3 f2 = 2 f1 of 20 and 30 teeth for 2 f1.

    Equation stiffness-spectrum.md (4).

    Parameters
    ----------
    pair : GearPair
        The wheels.
    tooth_harmonics : int
        Greatest l.
    sideband_order : int
        Greatest number of sidebands, those of both wheels together.

    Returns
    -------
    dict
        Combinations by harmonic of the common period, ascending; without h = 0.

    Examples
    --------
    >>> pair = GearPair(Wheel(20, 0.01), Wheel(30, 0.0), 1.6)
    >>> combinations(pair, 1, 1)
    {3: ((0, 1, 0),), 57: ((1, -1, 0),), 60: ((1, 0, 0),), 63: ((1, 1, 0),)}
    """
    sides = [
        range(-sideband_order, sideband_order + 1) if wheel.error_angle > 0.0 else range(1)
        for wheel in (pair.pinion, pair.wheel)
    ]
    ways: dict[int, list[tuple[int, Combination]]] = {}
    for l, a, b in product(range(tooth_harmonics + 1), *sides):
        order = abs(a) + abs(b)
        turns = (a * pair.pinion.error_order, b * pair.wheel.error_order)
        h = l * pair.meshes + turns[0] * pair.pinion_turns + turns[1] * pair.wheel_turns
        if h > 0 and order <= sideband_order:
            ways.setdefault(h, []).append((order, (l, *turns)))
    return {
        h: tuple(
            sorted(
                (way for order, way in ways[h] if order == min(ways[h])[0]),
                key=lambda way: (way[0], abs(way[2])),
            )
        )
        for h in sorted(ways)
    }


def _name(combination: Combination) -> str:
    terms = zip(combination, ("fz", "f1", "f2"), strict=True)
    shown = sorted(((count, name) for count, name in terms if count), key=lambda term: term[0] < 0)
    text = " ".join(
        f"{'+' if count > 0 else '-'} {'' if abs(count) == 1 else abs(count)}{name}" for count, name in shown
    )
    return text.removeprefix("+ ")
