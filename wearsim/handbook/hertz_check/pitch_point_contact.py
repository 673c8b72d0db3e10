"""Contact stress of a gear pair at the pitch point, by a printed formula and exactly.

A. Yu. Vasiliev, A. V. Grabovskii, A. V. Martynenko, D. S. Mukhin, A. V. Ustinenko, "Comparison of
contact stress calculations in gearing by Hertz' formula and by finite elements" (2012; source
document 000, second paper), equations 1 to 6.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import product

from scipy.optimize import brentq

from wearsim.contact.hertz import contact_modulus, half_width, peak_pressure

PRINTED_COEFFICIENT = 0.418
"""Of equation 1 of the source: the exact one for a Poisson's ratio of 0.3 in three digits."""

PRINTED_SURFACE, PRINTED_DEPTH = 0.4, 0.56
"""Shares of von Mises' stress in the contact stress, equations 5 and 6 of the source."""


@dataclass(frozen=True)
class PitchPointContact:
    """Two straight involute teeth that touch at the pitch point: cylinders with their radii there.

    Examples
    --------
    >>> pair = PitchPointContact(240e3, 1.5, 76.0, 108.0, math.radians(20.0))
    >>> round(pair.printed_stress, 6), round(pair.peak_pressure, 6)
    (453.938082, 454.160863)
    """

    torque: float  #: t1 of the pinion [N mm]
    gear_ratio: float  #: u
    face_width: float  #: b [mm]
    pitch_diameter: float  #: d_w1, of the pinion's working pitch circle [mm]
    pressure_angle: float  #: alpha_w, working [rad]
    load_factor: float = 1.0  #: load over the nominal one
    youngs_modulus: tuple[float, float] = (2.1e5, 2.1e5)  #: of pinion and wheel [MPa]
    poissons_ratio: float = 0.3  #: of both

    @property
    def normal_force(self) -> float:
        """Return F_n = 2 K T1/(d_w1 cos(alpha_w)) [N].

        Equation hertz-check.md (1).
        """
        tangential = 2.0 * self.load_factor * self.torque / self.pitch_diameter
        return tangential / math.cos(self.pressure_angle)

    @property
    def load_per_width(self) -> float:
        """Return q = F_n/b, equation 4 of the source [N/mm].

        Equation hertz-check.md (1).
        """
        return self.normal_force / self.face_width

    @property
    def flank_radii(self) -> tuple[float, float]:
        """Return the radii of curvature at the pitch point, d_w sin(alpha_w)/2 of pinion and wheel [mm]."""
        radius = 0.5 * self.pitch_diameter * math.sin(self.pressure_angle)
        return radius, self.gear_ratio * radius

    @property
    def reduced_radius(self) -> float:
        """Return rho with 1/rho = 2 (u + 1)/(u d_w1 sin(alpha_w)), equation 3 of the source [mm].

        Equation hertz-check.md (1).
        """
        return 1.0 / sum(1.0 / radius for radius in self.flank_radii)

    @property
    def reduced_modulus(self) -> float:
        """Return E = 2 E1 E2/(E1 + E2), equation 2 of the source [MPa].

        Equation hertz-check.md (1).
        """
        first, second = self.youngs_modulus
        return 2.0 * first * second / (first + second)

    @property
    def printed_stress(self) -> float:
        """Return 0.418 sqrt(q E/rho), equation 1 of the source [MPa].

        Equation hertz-check.md (1).
        """
        return PRINTED_COEFFICIENT * math.sqrt(
            self.load_per_width * self.reduced_modulus / self.reduced_radius
        )

    @property
    def exact_coefficient(self) -> float:
        """Return what belongs in the place of 0.418, 1/sqrt(2 pi (1 - nu^2))."""
        return 1.0 / math.sqrt(2.0 * math.pi * (1.0 - self.poissons_ratio**2))

    @property
    def contact_modulus(self) -> float:
        """Return E* with 1/E* = (1 - nu^2)(1/E1 + 1/E2) [MPa].

        Equation hertz-check.md (2).
        """
        return contact_modulus(self.youngs_modulus, (self.poissons_ratio, self.poissons_ratio))

    @property
    def peak_pressure(self) -> float:
        """Return Hertz' pressure in the middle of the contact [MPa].

        Equation hertz-check.md (2).
        """
        return float(peak_pressure(self.load_per_width, 1.0 / self.reduced_radius, self.contact_modulus))

    @property
    def half_width(self) -> float:
        """Return half the width of the contact, a [mm].

        Equation hertz-check.md (2).
        """
        return float(half_width(self.load_per_width, 1.0 / self.reduced_radius, self.contact_modulus))


def combinations(
    contact: PitchPointContact, torques: Sequence[float], widths: Sequence[float], ratios: Sequence[float]
) -> list[PitchPointContact]:
    """Return a contact with every torque, face width and gear ratio."""
    return [
        replace(contact, torque=torque, face_width=width, gear_ratio=ratio)
        for torque, width, ratio in product(
            torques or [contact.torque], widths or [contact.face_width], ratios or [contact.gear_ratio]
        )
    ]


@dataclass(frozen=True)
class InputChange:
    """What one key alone must be for a contact stress."""

    key: str  # of the input's table `contact`
    # present, needed: its value in the input, and that which gives the stress, in the unit of the key; nan
    # where none does
    present: float
    needed: float
    ends: tuple[float, float]  # what gives the ends of the stress's rounding, in the order of the ends


_Scale = Callable[[PitchPointContact, float], PitchPointContact]

_KEYS: dict[str, tuple[Callable[[PitchPointContact], float], _Scale]] = {
    "load_factor": (lambda c: c.load_factor, lambda c, f: replace(c, load_factor=c.load_factor * f)),
    "torque_N_m": (lambda c: 1e-3 * c.torque, lambda c, f: replace(c, torque=c.torque * f)),
    "face_width_mm": (lambda c: c.face_width, lambda c, f: replace(c, face_width=c.face_width * f)),
    "gear_ratio": (lambda c: c.gear_ratio, lambda c, f: replace(c, gear_ratio=c.gear_ratio * f)),
    "pinion_pitch_diameter_mm": (
        lambda c: c.pitch_diameter,
        lambda c, f: replace(c, pitch_diameter=c.pitch_diameter * f),
    ),
    "working_pressure_angle_deg": (
        lambda c: math.degrees(c.pressure_angle),
        lambda c, f: replace(c, pressure_angle=c.pressure_angle * f),
    ),
    "youngs_modulus_MPa": (
        lambda c: c.youngs_modulus[0],
        lambda c, f: replace(c, youngs_modulus=(c.youngs_modulus[0] * f, c.youngs_modulus[1] * f)),
    ),
}
"""For each key its value, and the contact with a multiple of it; both moduli go together."""

_SPAN = 100.0
"""A key is looked for within this factor."""


def single_changes(contact: PitchPointContact, target: float, rounding: float) -> list[InputChange]:
    """Return what each key alone must be for the printed formula to give a contact stress.

    Examples
    --------
    >>> pair = PitchPointContact(240e3, 1.5, 76.0, 108.0, math.radians(20.0))
    >>> found = {change.key: change for change in single_changes(pair, 464.0, 0.5)}
    >>> round(found["load_factor"].needed, 5), round(found["torque_N_m"].needed, 3)
    (1.04482, 250.758)
    """
    return [
        InputChange(
            key,
            value(contact),
            value(contact) * _factor(contact, key, target),
            (
                value(contact) * _factor(contact, key, target - rounding),
                value(contact) * _factor(contact, key, target + rounding),
            ),
        )
        for key, (value, _) in _KEYS.items()
    ]


def _factor(contact: PitchPointContact, key: str, target: float) -> float:
    """Return the multiple of a key that gives a contact stress; nan where none does."""
    scaled = _KEYS[key][1]
    greatest = _SPAN
    if key == "working_pressure_angle_deg":
        greatest = 0.25 * math.pi / contact.pressure_angle

    def miss(factor: float) -> float:
        return scaled(contact, factor).printed_stress - target

    if miss(1.0 / _SPAN) * miss(greatest) > 0.0:
        return math.nan
    return float(brentq(miss, 1.0 / _SPAN, greatest, xtol=1e-14))


def share_for(contact: PitchPointContact, target: float) -> float:
    """Return the share of the load with which the printed formula gives a contact stress."""
    return (target / contact.printed_stress) ** 2
