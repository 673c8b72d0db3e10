"""A published comparison of Hertz' formula with finite elements, completed and checked.

Table 3 of source document 000, second paper, has three columns, of which two cells are lost, and
does not say what its differences refer to.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from wearsim.errors import ABOVE_0, Allowed, GeometryError, Range, check_ranges, check_series
from wearsim.geometry.gear.involute import InvolutePair
from wearsim.handbook.hertz_check.pitch_point_contact import (
    PRINTED_DEPTH,
    PRINTED_SURFACE,
    InputChange,
    PitchPointContact,
    single_changes,
)

ROUNDING = 0.5
"""Of a published contact stress [MPa]."""

SHARES = {"contact": 1.0, "surface": PRINTED_SURFACE, "depth": PRINTED_DEPTH}
"""Columns of the comparison, and what Hertz' contact stress is multiplied by there."""

REFERENCES = ("larger", "hertz", "finite_elements")
"""What a difference may be relative to."""


def difference(hertz: float, finite_elements: float, reference: str) -> float:
    """Return the difference of two stresses in percent of one of them.

    Examples
    --------
    >>> round(difference(464.0, 418.0, "larger"), 4), round(difference(185.6, 216.0, "larger"), 4)
    (9.9138, 14.0741)
    >>> round(difference(464.0, 418.0, "finite_elements"), 4)
    11.0048
    """
    whole = {"larger": max(hertz, finite_elements), "hertz": hertz, "finite_elements": finite_elements}[
        reference
    ]
    return 100.0 * abs(hertz - finite_elements) / whole


def stresses_at(hertz: float, percent: float, reference: str) -> tuple[float, float]:
    """Return the stresses of finite elements that differ by a percentage from Hertz'.

    Examples
    --------
    >>> [round(stress, 3) for stress in stresses_at(259.84, 12.3, "larger")]
    [227.88, 296.283]
    """
    part = 0.01 * percent
    lower = hertz / (1.0 + part) if reference == "finite_elements" else hertz * (1.0 - part)
    higher = hertz * (1.0 + part) if reference == "hertz" else hertz / (1.0 - part)
    return lower, higher


def whole_stresses(hertz: float, percent: float, reference: str) -> list[int]:
    """Return the whole stresses whose difference from Hertz' rounds to a percentage.

    Examples
    --------
    >>> whole_stresses(259.84, 12.3, "larger")
    [228]
    """
    lowest, highest = stresses_at(hertz, min(percent + 0.1, 99.95), reference)
    return [
        stress
        for stress in range(max(1, math.floor(lowest)), math.ceil(highest) + 1)
        if _agrees(difference(hertz, stress, reference), percent)
    ]


def _agrees(found: float, printed: float) -> bool:
    """Say whether a percentage is the printed one to a tenth."""
    return abs(found - printed) < 0.05 + 1e-9


@dataclass(frozen=True)
class TeethOfPair:
    """Numbers of teeth and module of a pair."""

    pinion_teeth: int
    wheel_teeth: int
    module: float  #: [mm]


@dataclass(frozen=True)
class PublishedStresses:
    """A published comparison of Hertz' formula with finite elements; nan for what is lost.

    Each for `contact`, `surface` and `depth`: contact stress and von Mises' stresses [MPa], and differences
    in percent.
    """

    hertz: Mapping[str, float]
    finite_elements: Mapping[str, float]
    difference: Mapping[str, float]


@dataclass(frozen=True)
class ComparisonColumn:
    """A column of the comparison; nan for what is not known."""

    # hertz, finite_elements: as published, or completed: Hertz' by its formula, that of finite elements from
    # the difference where just one whole stress has it [MPa]
    hertz: float
    finite_elements: float
    printed_percent: float  # the difference as printed
    differences: Mapping[str, float]  # by what they are relative to [percent]
    # whole stresses of finite elements with the printed difference, where that stress is lost [MPa]
    candidates: tuple[int, ...]
    computed: float  # hertz' stress of the contact of the input by the same formula [MPa]
    computed_difference: float  # of that from the finite elements', relative to the larger one [percent]


@dataclass(frozen=True)
class Comparison:
    """The published comparison."""

    columns: Mapping[str, ComparisonColumn]  # `contact`, `surface` and `depth`
    references: tuple[str, ...]  # what all printed differences may be relative to


@dataclass(frozen=True)
class HertzCheck:
    """What there is to say about a contact at the pitch point."""

    contact: PitchPointContact  #: the contact
    literal: list[PitchPointContact]  #: the combinations of the input; empty where none are asked for
    teeth: TeethOfPair | None  #: as given
    contact_ratio: float  #: of the teeth without profile shift; nan where they are not given
    target: float  #: the published contact stress by Hertz [MPa]; nan where none is
    changes: list[InputChange]  #: what each key alone must be for it
    comparison: Comparison | None  #: the published comparison, where there is one


_CONTACT: Mapping[str, Allowed] = {
    **dict.fromkeys(("torque", "gear_ratio", "face_width", "pitch_diameter", "load_factor"), ABOVE_0),
    "pressure_angle": Range(math.radians(10.0), math.radians(45.0)),
    "poissons_ratio": Range(least=0.0, below=0.5),
}
_TEETH: Mapping[str, Allowed] = {
    **dict.fromkeys(("pinion_teeth", "wheel_teeth"), Range(5, 1000, whole=True)),
    "module": ABOVE_0,
}
_PUBLISHED: Mapping[str, Range] = {
    **dict.fromkeys(("hertz", "finite_elements"), ABOVE_0),
    "difference": Range(above=0.0, below=100.0),
}


def pitch_point_check(
    contact: PitchPointContact,
    *,
    teeth: TeethOfPair | None = None,
    literal: Sequence[PitchPointContact] = (),
    published: PublishedStresses | None = None,
) -> HertzCheck:
    """Return the stresses of a contact at the pitch point, with what a publication says of them.

    Contact stress by Hertz as source document 000 prints it, hertz-check.md (1), and exactly, (2).
    Parallel axes, straight teeth, one pair in contact.

    Parameters
    ----------
    contact : PitchPointContact
        Torque, ratio, sizes and moduli.
    teeth : TeethOfPair, optional
        For the contact ratio.
    literal : sequence of PitchPointContact, optional
        Other readings of the same input.
    published : PublishedStresses, optional
        To be completed and held against the contact.

    Returns
    -------
    HertzCheck
        What was found.

    Raises
    ------
    GeometryError
        A number cannot be, or there are no such teeth.

    Examples
    --------
    The stress grows with the root of the torque:

    >>> found = pitch_point_check(PitchPointContact(240e3, 1.5, 76.0, 108.0, math.radians(20.0)))
    >>> four = pitch_point_check(PitchPointContact(960e3, 1.5, 76.0, 108.0, math.radians(20.0)))
    >>> round(four.contact.peak_pressure / found.contact.peak_pressure, 9)
    2.0
    """
    _check_contact("hertz check", contact)
    for number, other in enumerate(literal, start=1):
        _check_contact(f"hertz check: literal {number}", other)
    if teeth is not None:
        check_ranges("hertz check", vars(teeth), _TEETH)
    if published is not None:
        _check_published(published)
    target = math.nan if published is None else published.hertz["contact"]
    return HertzCheck(
        contact=contact,
        literal=list(literal),
        teeth=teeth,
        contact_ratio=_contact_ratio(teeth, contact.pressure_angle),
        target=target,
        changes=[] if published is None else single_changes(contact, target, ROUNDING),
        comparison=None if published is None else completed(published, contact),
    )


def _check_contact(place: str, contact: PitchPointContact) -> None:
    check_ranges(place, vars(contact), _CONTACT)
    check_series(place, "youngs_modulus", contact.youngs_modulus, ABOVE_0, 2)


def _check_published(published: PublishedStresses) -> None:
    for row, allowed in _PUBLISHED.items():
        place, given = f"hertz check: published {row}", getattr(published, row)
        unknown = sorted(given.keys() - SHARES)
        if unknown:
            names = ", ".join(SHARES)
            raise GeometryError(f"{place} must be of {names}, but holds {unknown[0]!r}: correct it")
        legible = {name: value for name, value in given.items() if value == value}
        needed = {"contact"} if row == "hertz" else set()
        check_ranges(place, legible, dict.fromkeys(legible.keys() | needed, allowed))


def _contact_ratio(teeth: TeethOfPair | None, pressure_angle: float) -> float:
    if teeth is None:
        return math.nan
    z1, z2 = teeth.pinion_teeth, teeth.wheel_teeth
    tips = (0.5 * teeth.module * (z1 + 2), 0.5 * teeth.module * (z2 + 2))
    pair = InvolutePair((z1, z2), teeth.module, pressure_angle, (0.0, 0.0), tips)
    pair.check()
    return pair.contact_ratio


def completed(published: PublishedStresses, contact: PitchPointContact) -> Comparison:
    """Complete a published comparison and hold the contact's own stresses against it."""
    rows = {name: _legible(published, name) for name in SHARES}
    references = tuple(
        reference for reference in REFERENCES if all(_fits(*row, reference) for row in rows.values())
    )
    return Comparison(
        {
            name: _column(*rows[name], (references or REFERENCES)[0], share * contact.printed_stress)
            for name, share in SHARES.items()
        },
        references,
    )


def _legible(published: PublishedStresses, name: str) -> tuple[float, float, float]:
    """Return Hertz' stress, that of finite elements and their difference; nan for what is lost."""
    rows = (published.hertz, published.finite_elements, published.difference)
    hertz, elements, percent = (row.get(name, math.nan) for row in rows)
    if math.isnan(hertz):
        hertz = SHARES[name] * published.hertz["contact"]
    return hertz, elements, percent


def _fits(hertz: float, elements: float, percent: float, reference: str) -> bool:
    if math.isnan(percent):
        return True
    if math.isnan(elements):
        return bool(whole_stresses(hertz, percent, reference))
    return _agrees(difference(hertz, elements, reference), percent)


def _column(
    hertz: float, elements: float, percent: float, reference: str, computed: float
) -> ComparisonColumn:
    candidates: tuple[int, ...] = ()
    if math.isnan(elements) and not math.isnan(percent):
        candidates = tuple(whole_stresses(hertz, percent, reference))
        if len(candidates) == 1:
            elements = float(candidates[0])
    return ComparisonColumn(
        hertz,
        elements,
        percent,
        {name: difference(hertz, elements, name) for name in REFERENCES},
        candidates,
        computed,
        difference(computed, elements, "larger"),
    )
