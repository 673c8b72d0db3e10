"""Strength of a gear pair: from the tables of its case to stresses, margins and lives."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from wearsim.contact.hertz import contact_modulus
from wearsim.errors import ABOVE_0, POISSONS_RATIO, Allowed, GeometryError, Range, check_ranges
from wearsim.fatigue.endurance import (
    CONTACT_EXPONENT,
    Endurance,
    EnduredHours,
    FatigueCurve,
    contact_base_cycles,
    cycles_per_hour,
)
from wearsim.fatigue.heat_treatment import Treatment, in_brinell, treatments
from wearsim.handbook.strength.spectrum import OVERLOAD_CYCLES, LoadSpectrum, load_spectrum, regime_spectrum
from wearsim.handbook.strength.tooth_stress import (
    LoadFactor,
    SpurMesh,
    bending_face_factor,
    form_factor,
    initial_transverse_factor,
    run_in,
)

_LEAST_TEETH = 2.0
"""Over sin^2 of the pressure angle: teeth below which a gear without shift is undercut."""

_UNIFORM = 1.25
"""K_A of an even motor and a machine that is nearly so, under a constant load."""

_GOST_TAIL = (20.0, 0.75)
"""Exponent and least life factor beyond the base number of cycles by GOST 21354."""


@dataclass(frozen=True)
class GearMaterial:
    """What pinion or wheel is made of; what is left out follows from the heat treatment.

    Stresses and moduli in MPa.
    """

    treatment: str  #: of `wearsim.fatigue.heat_treatment.treatments`
    hardness_HB: float | None = None  #: of the flanks: give one of both
    hardness_HRC: float | None = None
    core_hardness_HRC: float | None = None  #: of nitrided teeth
    yield_strength: float | None = None
    youngs_modulus: float = 2.1e5
    poissons_ratio: float = 0.3
    meshings_per_revolution: int = 1
    contact_limit: float | None = None  #: sigma_Hlim; of nitrided teeth it must be given
    contact_base_cycles: float | None = None
    contact_safety: float | None = None
    greatest_contact_life_factor: float | None = None
    greatest_contact: float | None = None  #: allowed in an overload
    roughness_factor: float = 1.0
    speed_factor: float = 1.0
    bending_limit: float | None = None
    bending_base_cycles: float = 4e6
    bending_exponent: float | None = None
    bending_safety: float = 1.7
    greatest_bending_life_factor: float | None = None
    greatest_bending: float | None = None
    fillet_factor: float = 1.0
    reversal_factor: float = 1.0
    form_factor: float | None = None


@dataclass(frozen=True)
class SpectrumStep:
    """A torque of a load spectrum; give one of share and cycles."""

    relative_torque: float
    share_of_time: float | None = None
    overload_cycles: float | None = None


@dataclass(frozen=True)
class StrengthRules:
    """How the curves of fatigue are read, and the safety in an overload."""

    base_cycles: Literal["gost", "source"] = "gost"
    long_life: Literal["constant", "gost"] = "constant"  #: by GOST the curve goes on falling
    overload_ratio: float | None = None  #: greatest torque over the largest long-acting one
    overload_frequency_factor: float = 1.0
    static_safety: float = 1.75


@dataclass(frozen=True)
class PairLoad:
    """What a pair carries, and the factors on it."""

    pinion_torque: float  #: largest long-acting one [N mm]
    module: float  #: [mm]
    pinion_teeth: int
    face_width: float  #: [mm]
    initial_face_load_factor: float
    running_in_share: float
    contact_dynamic_factor: float
    bending_dynamic_factor: float
    pressure_angle: float = math.radians(20.0)  #: [rad]
    application_factor: float | None = None  #: K_A
    accuracy_grade: int | None = None  #: give it or the next
    initial_transverse_load_factor: float | None = None
    formula: Literal["corrected", "printed"] = "corrected"

    @property
    def undercut_below(self) -> int:
        """Least number of pinion teeth without undercut and without profile shift, 2/sin^2(alpha)."""
        return math.floor(_LEAST_TEETH / math.sin(self.pressure_angle) ** 2)


@dataclass(frozen=True)
class GearEndurance:
    """Pinion or wheel with what its teeth endure."""

    name: str  # `pinion` or `wheel`
    treatment: Treatment  # heat treatment
    hardness: float  # of the flank, in the treatment's scale
    brinell: float  # the same in HB, 10 to 1 HRC
    cycles: float  # load cycles of a tooth over the life, N
    # contact, bending: against pitting and against breakage
    contact: Endurance
    bending: Endurance


@dataclass(frozen=True)
class ToothLoad:
    """What the teeth carry under the largest long-acting torque."""

    mesh: SpurMesh  # the pair
    # contact_factor, bending_factor: K_H and K_F
    contact_factor: LoadFactor
    bending_factor: LoadFactor
    contact_stress: float  # that counts [MPa]
    # printed_contact_stress, corrected_contact_stress: with the tangential and with the normal force [MPa]
    printed_contact_stress: float
    corrected_contact_stress: float
    bending_stresses: tuple[float, float]  # of pinion and wheel [MPa]


@dataclass(frozen=True)
class StressCheck:
    """A stress held against what is endured."""

    # lasting, peak: under the largest long-acting torque and in an overload [MPa]
    lasting: float
    peak: float
    endurance: Endurance  # what is endured

    @property
    def margin(self) -> float:
        """Allowable stress over the lasting one."""
        return self.endurance.allowable / self.lasting

    @property
    def peak_margin(self) -> float:
        """Stress allowed in an overload over that in one; nan where the former is not known."""
        return self.endurance.greatest / self.peak

    @property
    def life(self) -> EnduredHours:
        """Hours for which the lasting stress is allowed."""
        return self.endurance.life(self.lasting)


@dataclass(frozen=True)
class PairStrength:
    """Strength of a gear pair."""

    hours: float  #: running time asked for [h]
    spectrum: LoadSpectrum  #: the loads
    peak: float  #: largest torque over the largest long-acting one
    gears: tuple[GearEndurance, GearEndurance]  #: pinion and wheel
    load: ToothLoad | None  #: none where the case gives no load

    @property
    def contact_governs(self) -> GearEndurance:
        """The gear with the smaller allowable contact stress, which is the pair's."""
        return min(self.gears, key=lambda gear: gear.contact.allowable)

    @property
    def stresses(self) -> tuple[tuple[StressCheck, StressCheck], ...]:
        """In contact and in bending, of pinion and wheel; empty where the case gives no load.

        In an overload the contact stress goes with the root of the torque, the bending stress
        with the torque.
        """
        if self.load is None:
            return ()
        contact = self.load.contact_stress
        return tuple(
            (
                StressCheck(contact, contact * math.sqrt(self.peak), gear.contact),
                StressCheck(bending, bending * self.peak, gear.bending),
            )
            for gear, bending in zip(self.gears, self.load.bending_stresses, strict=True)
        )


def first_life(lives: Sequence[EnduredHours]) -> tuple[int, EnduredHours]:
    """Return the life that ends first: a life that ends at all before one that is only bounded.

    Examples
    --------
    >>> first_life([EnduredHours(5000.0, bound=True), EnduredHours(8000.0, bound=False)])
    (1, EnduredHours(hours=8000.0, bound=False))
    """
    place = min(range(len(lives)), key=lambda i: (lives[i].bound, lives[i].hours))
    return place, lives[place]


_FACTOR = Range(least=1.0)
_OWN_FACTOR, _OWN = replace(_FACTOR, optional=True), replace(ABOVE_0, optional=True)
_DRIVE: Mapping[str, Allowed] = {
    "pinion_speed": ABOVE_0,
    "gear_ratio": _FACTOR,
    "hours": ABOVE_0,
    "regime": ("0", "I", "II", "III", "IV", "V"),
}
_STEP: Mapping[str, Allowed] = {
    "relative_torque": Range(0.0, 1000.0),
    "share_of_time": Range(above=0.0, most=1.0, optional=True),
    "overload_cycles": Range(above=0.0, below=OVERLOAD_CYCLES, optional=True),
}
_MATERIAL: Mapping[str, Allowed] = {
    "poissons_ratio": POISSONS_RATIO,
    "meshings_per_revolution": Range(1, 100, whole=True),
    "bending_safety": _FACTOR,
    **dict.fromkeys(("contact_safety", "bending_exponent"), _OWN_FACTOR),
    **dict.fromkeys(("greatest_contact_life_factor", "greatest_bending_life_factor"), _OWN_FACTOR),
    **dict.fromkeys(("hardness_HB", "hardness_HRC", "core_hardness_HRC", "yield_strength"), _OWN),
    **dict.fromkeys(("contact_limit", "bending_limit", "contact_base_cycles", "form_factor"), _OWN),
    **dict.fromkeys(("greatest_contact", "greatest_bending"), _OWN),
    **dict.fromkeys(("youngs_modulus", "bending_base_cycles", "roughness_factor"), ABOVE_0),
    **dict.fromkeys(("speed_factor", "fillet_factor", "reversal_factor"), ABOVE_0),
}
_RULES: Mapping[str, Allowed] = {
    "base_cycles": ("gost", "source"),
    "long_life": ("constant", "gost"),
    "overload_ratio": _OWN_FACTOR,
    **dict.fromkeys(("overload_frequency_factor", "static_safety"), _FACTOR),
}
_LOAD: Mapping[str, Allowed] = {
    "pinion_teeth": Range(5, 1000, whole=True),
    "pressure_angle": Range(math.radians(10.0), math.radians(35.0)),
    "accuracy_grade": Range(5, 9, whole=True, optional=True),
    "running_in_share": Range(above=0.0, most=1.0),
    "formula": ("corrected", "printed"),
    "application_factor": _OWN,
    "initial_transverse_load_factor": _OWN_FACTOR,
    **dict.fromkeys(("pinion_torque", "module", "face_width"), ABOVE_0),
    "initial_face_load_factor": _FACTOR,
    **dict.fromkeys(("contact_dynamic_factor", "bending_dynamic_factor"), _FACTOR),
}


def pair_strength(
    pinion: GearMaterial,
    wheel: GearMaterial,
    *,
    pinion_speed: float,
    gear_ratio: float,
    hours: float,
    regime: str = "0",
    load_spectrum: Sequence[SpectrumStep] = (),
    rules: StrengthRules = StrengthRules(),
    load: PairLoad | None = None,
) -> PairStrength:
    """Return what the teeth of a gear pair endure and, where a load is given, what it comes to.

    Allowable stresses follow from hardness, life and load spectrum by strength.md (21) to (26), source
    document 001, with the numbers of GOST 21354 where the source leaves them out. Spur gears of steel.

    Parameters
    ----------
    pinion, wheel : GearMaterial
        What they are made of.
    pinion_speed : float
        Speed of the pinion [rpm], above 0.
    gear_ratio : float
        Teeth of the wheel over those of the pinion, at least 1.
    hours : float
        Running time over the life [h], above 0.
    regime : str, optional
        Typical regime of load: ``0`` (constant) or ``I`` to ``V``.
    load_spectrum : sequence of SpectrumStep, optional
        Torques with the time they act, in place of a regime.
    rules : StrengthRules, optional
        How the curves of fatigue are read.
    load : PairLoad, optional
        What the pair carries.

    Returns
    -------
    PairStrength
        Allowable stresses, and margins and lives with a load.

    Raises
    ------
    GeometryError
        A number cannot be, or everything in the load spectrum is an overload.

    Examples
    --------
    Normalised steel of 200 HB, a limit of 2*200 + 70 = 470 MPa, a safety of 1.1, and more cycles than the
    base number of 30*200^2.4 = 1e7:

    >>> steel = GearMaterial("normalised", hardness_HB=200.0)
    >>> found = pair_strength(steel, steel, pinion_speed=1000.0, gear_ratio=2.0, hours=10_000.0)
    >>> found.gears[0].cycles, round(found.contact_governs.contact.allowable, 2)
    (600000000.0, 427.27)
    """
    given_numbers = {"pinion_speed": pinion_speed, "gear_ratio": gear_ratio, "hours": hours, "regime": regime}
    check_ranges("strength", given_numbers, _DRIVE)
    check_ranges("strength", vars(rules), _RULES)
    if load is not None:
        check_ranges("strength", vars(load), _LOAD)
    given = (("pinion", pinion, 1.0), ("wheel", wheel, gear_ratio))
    for name, gear, _ in given:
        check_ranges(f"strength: {name}", vars(gear), {"treatment": tuple(treatments()), **_MATERIAL})
    rates = [cycles_per_hour(pinion_speed / ratio, gear.meshings_per_revolution) for _, gear, ratio in given]
    spectrum = _spectrum(load_spectrum, regime, hours * max(rates))
    gears = [
        _gear(name, gear, rules, spectrum, rate, hours)
        for (name, gear, _), rate in zip(given, rates, strict=True)
    ]
    carried = None if load is None else _tooth_load(load, (pinion, wheel), gear_ratio, spectrum)
    peak = max(spectrum.peak, rules.overload_ratio or 1.0)
    return PairStrength(hours, spectrum, peak, (gears[0], gears[1]), carried)


def _spectrum(steps: Sequence[SpectrumStep], regime: str, cycles: float) -> LoadSpectrum:
    """Return the loads; a torque is no overload once the gear with more cycles has enough."""
    if not steps:
        return regime_spectrum(regime)
    if regime != "0":
        raise GeometryError("strength: load_spectrum gives the loads already: leave out it or regime")
    for number, step in enumerate(steps, start=1):
        place = f"strength: step {number} of load_spectrum"
        check_ranges(place, vars(step), _STEP)
        if (step.share_of_time is None) == (step.overload_cycles is None):
            raise GeometryError(f"{place} must have one of share_of_time and overload_cycles: give one")
    shares = math.fsum(step.share_of_time or 0.0 for step in steps)
    if abs(shares - 1.0) > 1e-6:
        raise GeometryError(
            f"strength: the shares of time of load_spectrum must come to 1, come to {shares:g}"
        )
    acting = [
        (step.relative_torque, step.overload_cycles or (step.share_of_time or 0.0) * cycles) for step in steps
    ]
    return load_spectrum(acting, cycles)


def _gear(
    name: str, gear: GearMaterial, rules: StrengthRules, spectrum: LoadSpectrum, rate: float, hours: float
) -> GearEndurance:
    if (gear.hardness_HB is None) == (gear.hardness_HRC is None):
        raise GeometryError(f"strength: {name} must have one of hardness_HB and hardness_HRC: give one")
    if gear.treatment == "nitrided" and (
        gear.contact_limit is None or (gear.bending_limit is None) == (gear.core_hardness_HRC is None)
    ):
        raise GeometryError(
            f"strength: {name} is nitrided and must have contact_limit, and one of bending_limit and "
            "core_hardness_HRC: give them"
        )
    treatment = treatments()[gear.treatment]
    brinell = gear.hardness_HB or in_brinell(gear.hardness_HRC or 0.0, "HRC")
    hardness = treatment.own_hardness(brinell)
    found = []
    for limit, curve, greatest, exponent in (
        _contact(gear, treatment, hardness, brinell, rules),
        _bending(gear, treatment, hardness, rules),
    ):
        mu = spectrum.equivalence(exponent)
        found.append(Endurance(limit, curve, mu, rate, hours, greatest))
    return GearEndurance(name, treatment, hardness, brinell, rate * hours, *found)


Fatigue = tuple[float, FatigueCurve, float, float]
"""Endurance limit, its curve, the greatest stress of an overload, the exponent of the torque."""


def _contact(
    table: GearMaterial, treatment: Treatment, hardness: float, brinell: float, reading: StrengthRules
) -> Fatigue:
    limit = table.contact_limit or treatment.contact_limit(hardness)
    surface = table.roughness_factor * table.speed_factor
    tail, least = _GOST_TAIL if reading.long_life == "gost" else (math.inf, 1.0)
    curve = FatigueCurve(
        limit=limit * surface / (table.contact_safety or treatment.contact_safety),
        base_cycles=table.contact_base_cycles or contact_base_cycles(brinell, reading.base_cycles),
        exponent=CONTACT_EXPONENT,
        greatest_factor=table.greatest_contact_life_factor or treatment.contact_factor,
        tail_exponent=tail,
        least_factor=least,
    )
    strength = table.yield_strength or math.nan
    greatest = table.greatest_contact or treatment.greatest_contact(hardness, strength)
    return limit, curve, greatest, 0.5 * CONTACT_EXPONENT


def _bending(table: GearMaterial, treatment: Treatment, hardness: float, overload: StrengthRules) -> Fatigue:
    of = table.core_hardness_HRC or hardness
    limit = table.bending_limit or treatment.bending_limit(of)
    exponent = table.bending_exponent or treatment.bending_exponent
    curve = FatigueCurve(
        limit=limit * table.fillet_factor * table.reversal_factor / table.bending_safety,
        base_cycles=table.bending_base_cycles,
        exponent=exponent,
        greatest_factor=table.greatest_bending_life_factor or treatment.bending_factor,
    )
    frequency = overload.overload_frequency_factor / overload.static_safety
    greatest = table.greatest_bending or limit * curve.greatest_factor * frequency
    return limit, curve, greatest, exponent


def _tooth_load(
    load: PairLoad, gears: tuple[GearMaterial, GearMaterial], ratio: float, spectrum: LoadSpectrum
) -> ToothLoad:
    elastic = [(gear.youngs_modulus, gear.poissons_ratio) for gear in gears]
    mesh = SpurMesh(
        torque=load.pinion_torque * spectrum.torque,
        module=load.module,
        teeth=load.pinion_teeth,
        ratio=ratio,
        face_width=load.face_width,
        pressure_angle=load.pressure_angle,
        contact_modulus=contact_modulus(*zip(*elastic, strict=True)),
    )
    contact, bending = _load_factors(load, constant=spectrum.name == "constant")
    stresses = {
        formula: mesh.contact_stress(contact.total, normal=formula == "corrected")
        for formula in ("printed", "corrected")
    }
    pinion, wheel = (
        mesh.bending_stress(bending.total, table.form_factor or form_factor(teeth))
        for table, teeth in zip(gears, (load.pinion_teeth, load.pinion_teeth * ratio), strict=True)
    )
    return ToothLoad(
        mesh,
        contact,
        bending,
        stresses[load.formula],
        stresses["printed"],
        stresses["corrected"],
        (pinion, wheel),
    )


def _load_factors(load: PairLoad, constant: bool) -> tuple[LoadFactor, LoadFactor]:
    """Return K_H and K_F; a spectrum holds the shocks of the machine already, then K_A is 1."""
    application = load.application_factor or (_UNIFORM if constant else 1.0)
    initial = load.initial_transverse_load_factor
    if (initial is None) == (load.accuracy_grade is None):
        raise GeometryError(
            "strength: the load must have one of accuracy_grade and initial_transverse_load_factor: give one"
        )
    if initial is None:
        assert load.accuracy_grade is not None
        initial = initial_transverse_factor(load.accuracy_grade)
    face = load.initial_face_load_factor
    share = load.running_in_share
    contact = LoadFactor(
        application, run_in(face, share), run_in(initial, share), load.contact_dynamic_factor
    )
    bending = LoadFactor(application, bending_face_factor(face), initial, load.bending_dynamic_factor)
    return contact, bending


def shown_hours(pair: PairStrength) -> tuple[float, float]:
    """Return the hours over which allowable stresses are shown."""
    marks = [pair.hours]
    for gear in pair.gears:
        marks += [one.curve.flat_from / one.equivalent_cycles_at(1.0) for one in (gear.contact, gear.bending)]
    return 0.05 * min(marks), 4.0 * max(marks)
