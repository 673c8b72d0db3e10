"""Strength of a gear pair: from the tables of its case to stresses, margins and lives."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from wearsim.contact.hertz import contact_modulus
from wearsim.fatigue.endurance import (
    CONTACT_EXPONENT,
    Endurance,
    EnduredHours,
    FatigueCurve,
    contact_base_cycles,
    cycles_per_hour,
    service_hours,
)
from wearsim.fatigue.heat_treatment import Treatment, in_brinell, treatments
from wearsim.handbook.strength.keys import (
    OverloadTable,
    StrengthFatigueTable,
    StrengthGearTable,
    StrengthLoadTable,
    StrengthTables,
)
from wearsim.handbook.strength.spectrum import LoadSpectrum, load_spectrum, regime_spectrum
from wearsim.handbook.strength.tooth_stress import (
    LoadFactor,
    SpurMesh,
    bending_face_factor,
    form_factor,
    initial_transverse_factor,
    run_in,
)

_UNIFORM = 1.25
"""K_A of an even motor and a machine that is nearly so, under a constant load."""

_GOST_TAIL = (20.0, 0.75)
"""Exponent and least life factor beyond the base number of cycles by GOST 21354."""


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

    hours: float  # running time asked for [h]
    spectrum: LoadSpectrum  # the loads
    peak: float  # largest torque over the largest long-acting one
    gears: tuple[GearEndurance, GearEndurance]  # pinion and wheel
    load: ToothLoad | None  # none where the case gives no load

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

    Parameters
    ----------
    lives : sequence of EnduredHours
        Of the parts.

    Returns
    -------
    int
        Which one it is.
    EnduredHours
        It; the least bound where none ends.

    Examples
    --------
    >>> first_life([EnduredHours(5000.0, bound=True), EnduredHours(8000.0, bound=False)])
    (1, EnduredHours(hours=8000.0, bound=False))
    """
    place = min(range(len(lives)), key=lambda i: (lives[i].bound, lives[i].hours))
    return place, lives[place]


def pair_strength(tables: StrengthTables) -> PairStrength:
    """Return the strength of the gear pair of a case.

    Parameters
    ----------
    tables : StrengthTables
        The case.

    Returns
    -------
    PairStrength
        Allowable stresses and, where a load is given, what it comes to.

    Raises
    ------
    GeometryError
        Everything in the load spectrum is an overload.
    """
    drive = tables.drive
    hours = drive.life_hours
    if hours is None:
        assert drive.life_years is not None
        hours = service_hours(drive.life_years, drive.year_share, drive.day_share)
    given = (("pinion", tables.pinion, 1.0), ("wheel", tables.wheel, drive.gear_ratio))
    rates = [
        cycles_per_hour(drive.pinion_speed_rpm / ratio, table.meshings_per_revolution)
        for _, table, ratio in given
    ]
    spectrum = _spectrum(tables, hours * max(rates))
    pinion, wheel = (
        _gear(name, table, tables, spectrum, rate, hours)
        for (name, table, _), rate in zip(given, rates, strict=True)
    )
    load = None if tables.load is None else _load(tables, tables.load, spectrum)
    peak = max(spectrum.peak, tables.overload.overload_ratio or 1.0)
    return PairStrength(hours, spectrum, peak, (pinion, wheel), load)


def _spectrum(tables: StrengthTables, cycles: float) -> LoadSpectrum:
    """Return the loads; a torque is no overload once the gear with more cycles has enough."""
    if not tables.load_spectrum:
        return regime_spectrum(tables.drive.regime or "0")
    steps = [
        (step.relative_torque, step.overload_cycles or (step.share_of_time or 0.0) * cycles)
        for step in tables.load_spectrum
    ]
    return load_spectrum(steps, cycles)


def _gear(
    name: str,
    table: StrengthGearTable,
    tables: StrengthTables,
    spectrum: LoadSpectrum,
    rate: float,
    hours: float,
) -> GearEndurance:
    treatment = treatments()[table.treatment]
    brinell = table.hardness_HB or in_brinell(table.hardness_HRC or 0.0, "HRC")
    hardness = treatment.own_hardness(brinell)
    found = []
    for limit, curve, greatest, exponent in (
        _contact(table, treatment, hardness, brinell, tables.fatigue),
        _bending(table, treatment, hardness, tables.overload),
    ):
        mu = spectrum.equivalence(exponent)
        found.append(Endurance(limit, curve, mu, rate, hours, greatest))
    return GearEndurance(name, treatment, hardness, brinell, rate * hours, *found)


Fatigue = tuple[float, FatigueCurve, float, float]
"""Endurance limit, its curve, the greatest stress of an overload, the exponent of the torque."""


def _contact(
    table: StrengthGearTable,
    treatment: Treatment,
    hardness: float,
    brinell: float,
    reading: StrengthFatigueTable,
) -> Fatigue:
    limit = table.contact_limit_MPa or treatment.contact_limit(hardness)
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
    strength = table.yield_strength_MPa or math.nan
    greatest = table.greatest_contact_MPa or treatment.greatest_contact(hardness, strength)
    return limit, curve, greatest, 0.5 * CONTACT_EXPONENT


def _bending(
    table: StrengthGearTable, treatment: Treatment, hardness: float, overload: OverloadTable
) -> Fatigue:
    of = table.core_hardness_HRC or hardness
    limit = table.bending_limit_MPa or treatment.bending_limit(of)
    exponent = table.bending_exponent or treatment.bending_exponent
    curve = FatigueCurve(
        limit=limit * table.fillet_factor * table.reversal_factor / table.bending_safety,
        base_cycles=table.bending_base_cycles,
        exponent=exponent,
        greatest_factor=table.greatest_bending_life_factor or treatment.bending_factor,
    )
    frequency = overload.overload_frequency_factor / overload.static_safety
    greatest = table.greatest_bending_MPa or limit * curve.greatest_factor * frequency
    return limit, curve, greatest, exponent


def _load(tables: StrengthTables, load: StrengthLoadTable, spectrum: LoadSpectrum) -> ToothLoad:
    elastic = [(gear.youngs_modulus_MPa, gear.poissons_ratio) for gear in (tables.pinion, tables.wheel)]
    mesh = SpurMesh(
        torque=1e3 * load.pinion_torque_N_m * spectrum.torque,
        module=load.module_mm,
        teeth=load.pinion_teeth,
        ratio=tables.drive.gear_ratio,
        face_width=load.face_width_mm,
        pressure_angle=math.radians(load.pressure_angle_deg),
        contact_modulus=contact_modulus(*zip(*elastic, strict=True)),
    )
    contact, bending = _load_factors(load, constant=spectrum.name == "constant")
    stresses = {
        formula: mesh.contact_stress(contact.total, normal=formula == "corrected")
        for formula in ("printed", "corrected")
    }
    pinion, wheel = (
        mesh.bending_stress(bending.total, table.form_factor or form_factor(teeth))
        for table, teeth in (
            (tables.pinion, load.pinion_teeth),
            (tables.wheel, load.pinion_teeth * tables.drive.gear_ratio),
        )
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


def _load_factors(load: StrengthLoadTable, constant: bool) -> tuple[LoadFactor, LoadFactor]:
    """Return K_H and K_F; a spectrum holds the shocks of the machine already, then K_A is 1."""
    application = load.application_factor or (_UNIFORM if constant else 1.0)
    initial = load.initial_transverse_load_factor
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
    """Return the hours over which allowable stresses are shown.

    Parameters
    ----------
    pair : PairStrength
        The pair.

    Returns
    -------
    tuple of float
        First and last [h]: around the life asked for and the ends of all curves.
    """
    marks = [pair.hours]
    for gear in pair.gears:
        marks += [one.curve.flat_from / one.equivalent_cycles_at(1.0) for one in (gear.contact, gear.bending)]
    return 0.05 * min(marks), 4.0 * max(marks)
