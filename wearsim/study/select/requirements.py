"""What a drive is to do, and which chains, teeth and places may be used for it."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

from wearsim.catalogue.catalogues import MOST_STRANDS, USUAL_CONDITION, WearCondition, wear_conditions
from wearsim.errors import CaseError, Fault, Range, quoted

SERIES = {"A": "ISO606-A/ANSI B29.1", "B": "ISO606-B", "H": "ISO606-H", "GOST": "GOST13568"}
"""Series of the catalogue by the word that one chooses it with."""

MOST_TEETH = 120
"""Teeth of the larger sprocket up to which handbooks go.

A chain rides higher on more teeth: by 200/z % of elongation it is worn out, 1.67 % at 120.
"""

_LENGTH = Range(above=0.0, most=1e6, optional=True)
_TEETH = Range(least=9, most=MOST_TEETH, whole=True)
_STRANDS = Range(least=1, most=MOST_STRANDS, whole=True)

_RANGES: dict[str, tuple[Range, str]] = {
    "power": (Range(above=0.0, most=1e5), "give the power in kW, or with its unit"),
    "speed": (Range(least=1e-3, most=1e5), "give the speed of the driver in rpm"),
    "ratio": (Range(above=0.0, most=20.0), "give the speed ratio, driver over driven"),
    "hours": (Range(above=0.0, most=1e7), "give the running hours that the chain must last"),
    "service_factor": (Range(least=1.0, most=10.0), "give f1 of ISO 10823"),
    "joint_application_factor": (Range(least=0.5, most=10.0), "give K_e of GOST practice"),
    "centre": (_LENGTH, "give the centre distance in mm"),
    "centre_min": (_LENGTH, "give the smallest centre distance in mm"),
    "centre_max": (_LENGTH, "give the largest centre distance in mm"),
    "max_diameter": (_LENGTH, "give the largest tip diameter in mm"),
    "ratio_tolerance": (Range(least=0.0, most=0.2), "give the allowed deviation, such as 3 %"),
    "teeth_min": (_TEETH, "17 are usual, fewer run roughly"),
    "teeth_max": (_TEETH, "25 are usual"),
    "strands_min": (_STRANDS, "the catalogue has A chains to six strands, others to three"),
    "strands_max": (_STRANDS, "the catalogue has A chains to six strands, others to three"),
}
"""What a number may be, and what to do where it is not."""

_OPTIONAL = ("centre", "centre_min", "centre_max", "max_diameter")

_NOTHING_LOST = 1e-9
"""Part of a tooth by which rounding may move a bound."""


@dataclass(frozen=True)
class DriveRequirements:
    """What a drive is to do, and what may be used for it.

    Raises
    ------
    CaseError
        Numbers outside their range or at odds with each other; all of them at once.

    Examples
    --------
    >>> need = DriveRequirements(power=3.0, speed=120.0, ratio=2.7, hours=15_000.0)
    >>> need.allows(17, 46), need.allows(17, 49)  # 2.706 and 2.882
    (True, False)
    """

    power: float  # transmitted [kW]
    speed: float  # of the driver [rpm]
    ratio: float  # speed of the driver over that of the driven shaft, below 1 to drive faster
    hours: float  # that the chain must live [h]
    service_factor: float = 1.0  # f1 on the power
    joint_application_factor: float = 1.0  # K_e on the joint pressure
    # how pin and bush wear
    joints: WearCondition = field(default_factory=lambda: wear_conditions()[USUAL_CONDITION])
    lubrication: str = ""  # row of the table of lubricants; empty: as recommended
    environment: str = "clean"  # row of the table of environments
    tooth_hardness: str = "hardened"  # in words: for the case of a drive, its chain does not depend on it
    centre: float | None = None  # distance of the shafts [mm]
    centre_min: float | None = None  # bounds of it where it may be chosen [mm]
    centre_max: float | None = None
    max_diameter: float | None = None  # largest tip circle that there is room for [mm]
    ratio_tolerance: float = 0.03  # part by which the ratio may be off
    teeth_min: int = 17  # of the smaller sprocket
    teeth_max: int = 25
    strands_min: int = 1  # chains side by side
    strands_max: int = 3
    series: tuple[str, ...] = tuple(SERIES)  # words of `SERIES` that may be used

    def __post_init__(self) -> None:
        faults = requirement_faults(vars(self))
        if faults:
            raise CaseError(faults)

    @cached_property
    def oiled(self) -> "DriveRequirements":
        """The same with clean joints, oiled as recommended, to which published factors refer."""
        oiled = wear_conditions()[USUAL_CONDITION]
        return replace(self, joints=oiled, lubrication="", environment="clean")

    def allows(self, small: int, large: int) -> bool:
        """Return whether two numbers of teeth give the ratio within its tolerance."""
        wanted = max(self.ratio, 1.0 / self.ratio)
        return abs(large / small - wanted) <= self.ratio_tolerance * wanted + _NOTHING_LOST

    def tooth_pairs(self) -> Iterator[tuple[int, int]]:
        """Give all teeth of the smaller and the larger sprocket that make the ratio."""
        wanted = max(self.ratio, 1.0 / self.ratio)
        for small in range(self.teeth_min, self.teeth_max + 1):
            nearest = round(wanted * small)
            reach = math.ceil(self.ratio_tolerance * wanted * small) + 1
            for large in range(max(small, nearest - reach), min(MOST_TEETH, nearest + reach) + 1):
                if self.allows(small, large):
                    yield small, large


def requirement_faults(given: Mapping[str, Any]) -> list[Fault]:
    """Return what is wrong with numbers by the names of their fields; those not given are not judged.

    Examples
    --------
    >>> [str(fault) for fault in requirement_faults({"power": -3.0, "teeth_min": 21, "teeth_max": 19})]
    ['power: must be above 0 and at most 100000 (got -3): give the power in kW, or with its unit',
     'teeth_max: must be at least teeth_min (got 19 and 21): exchange them']
    """
    faults, sound = [], {}
    for name, (allowed, cure) in _RANGES.items():
        value = given.get(name)
        if name not in given or (value is None and name in _OPTIONAL):
            continue
        must = allowed.must(value)
        if must:
            faults.append(Fault(f"must be {must} (got {_shown(value)}): {cure}", name))
        else:
            sound[name] = value
    faults += _in_order(sound)
    for word in given.get("series", ()):
        if word not in SERIES:
            faults.append(
                Fault(f"must be of {', '.join(SERIES)} (got {quoted(word)}): choose among them", "series")
            )
    if sound.get("centre") is not None:
        faults += [
            Fault("must be left out where the centre distance is given: remove one of the two", name)
            for name in ("centre_min", "centre_max")
            if sound.get(name) is not None
        ]
    return faults or _without_pairs(sound)


def _shown(value: Any) -> str:
    return f"{value:g}" if isinstance(value, int | float) else repr(value)


def _in_order(sound: Mapping[str, Any]) -> list[Fault]:
    """Return the pairs of bounds of which the lower one lies above the upper one."""
    pairs = (("centre_min", "centre_max"), ("teeth_min", "teeth_max"), ("strands_min", "strands_max"))
    return [
        Fault(f"must be at least {low} (got {sound[high]:g} and {sound[low]:g}): exchange them", high)
        for low, high in pairs
        if sound.get(low) is not None and sound.get(high) is not None and sound[low] > sound[high]
    ]


def _without_pairs(sound: Mapping[str, Any]) -> list[Fault]:
    """Return a fault where no teeth give the ratio."""
    names = ("ratio", "ratio_tolerance", "teeth_min", "teeth_max")
    if not all(name in sound for name in names):
        return []
    wanted, tolerance, least, most = (sound[name] for name in names)
    wanted = max(wanted, 1.0 / wanted)
    for small in range(least, most + 1):
        large = min(MOST_TEETH, max(small, round(wanted * small)))
        if abs(large / small - wanted) <= tolerance * wanted + _NOTHING_LOST:
            return []
    message = (
        f"must be that of {least} to {most} teeth and of at most {MOST_TEETH} within "
        f"{100 * tolerance:g} % (got {sound['ratio']:g}): allow more tolerance or other teeth, "
        "or use two stages"
    )
    return [Fault(message, "ratio")]
