"""Wear of pin and bush: how fast a chain grows, by pressure, turning speed and pitch, and how surely."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from wearsim.catalogue.catalogues import WearCondition

LEAST_PRESSURE = 15.0
"""Joint pressure below which a rate is held [MPa]: no published route was read below it."""

TURNING = (30.0, 1000.0)
"""Speeds of the small sprocket between which a rate changes [rpm]; it is held outside."""

PITCHES = (12.7, 50.8)
"""Pitches between which a rate changes [mm]; it is held outside."""


class JointState(NamedTuple):
    """Where joints run: what a law of their wear depends on."""

    pressure: float  # between pin and bush in the tight span [MPa]
    speed: float  # of the small sprocket [rpm]
    pitch: float  # of the chain [mm]

    @property
    def held(self) -> "JointState":
        """Where a law takes them to run: at the ends of its ranges where they run beyond."""
        return JointState(
            max(self.pressure, LEAST_PRESSURE), _held(self.speed, TURNING), _held(self.pitch, PITCHES)
        )


@dataclass(frozen=True)
class JointLaw:
    """Specific wear rate of pin and bush by pressure, turning speed and pitch.

    k = k0 (p/p0)^(m-1) (n0/n)^q (P/P0)^r, p and p0 held to at least `LEAST_PRESSURE`, n and n0 to
    `TURNING`, P and P0 to `PITCHES`. With m = 1 and q = r = 0 it is Archard's constant rate.

    Equation physics.md (E2).

    Examples
    --------
    At twice the reference pressure and a quarter of the reference speed, m = 2 and q = 0.5 give four times
    the rate:

    >>> law = JointLaw(1e-10, 2.0, 0.5, 0.0, 20.0, 800.0, 12.7)
    >>> law.rate(40.0, 200.0, 12.7)
    4e-10
    """

    coefficient: float  # k0 of pin and bush together [mm2/N]
    pressure_exponent: float = 1.0  # m
    speed_exponent: float = 0.0  # q
    pitch_exponent: float = 0.0  # r
    # where k0 holds: pressure in the joint [MPa], speed of the small sprocket [rpm], pitch [mm]
    reference_pressure: float = 25.7
    reference_speed: float = 1000.0
    reference_pitch: float = 12.7

    @property
    def reference(self) -> JointState:
        """Where the coefficient holds."""
        return JointState(self.reference_pressure, self.reference_speed, self.reference_pitch)

    def at(self, state: JointState) -> "JointLaw":
        """Return the same rates, told by that where some joints run.

        Examples
        --------
        >>> law = JointLaw(1e-10, 2.0, 0.5, 0.0, 20.0, 800.0, 12.7)
        >>> law.at(JointState(40.0, 200.0, 12.7))  # doctest: +ELLIPSIS
        JointLaw(coefficient=4e-10, ... reference_pressure=40.0, reference_speed=200.0, reference_pitch=12.7)
        """
        return replace(self.referred_to(state.held), coefficient=self.rate(*state))

    def referred_to(self, state: JointState) -> "JointLaw":
        """Return a law of the same exponents whose coefficient holds elsewhere."""
        pressure, speed, pitch = state
        return replace(self, reference_pressure=pressure, reference_speed=speed, reference_pitch=pitch)

    def pressure_factor(self, pressure: float) -> float:
        """Return the rate at a pressure in the joint [MPa] over that at the reference pressure."""
        held = max(pressure, LEAST_PRESSURE) / max(self.reference_pressure, LEAST_PRESSURE)
        return float(held ** (self.pressure_exponent - 1.0))

    def wearing_pressure(self, pressure: float) -> float:
        """Return a pressure in the joint times the rate there over that at the reference pressure [MPa]."""
        return pressure * self.pressure_factor(pressure)

    def turning_factor(self, speed: float, pitch: float) -> float:
        """Return the rate at a speed of the small sprocket [rpm] and a pitch [mm] over the reference."""
        turning = _held(self.reference_speed, TURNING) / _held(speed, TURNING)
        size = _held(pitch, PITCHES) / _held(self.reference_pitch, PITCHES)
        return float(turning**self.speed_exponent * size**self.pitch_exponent)

    def rate(self, pressure: float, speed: float, pitch: float) -> float:
        """Return the specific wear rate k [mm2/N] at a pressure [MPa], a speed [rpm] and a pitch [mm]."""
        return self.coefficient * self.pressure_factor(pressure) * self.turning_factor(speed, pitch)

    @property
    def is_constant(self) -> bool:
        """Whether the rate is the same everywhere."""
        return (self.pressure_exponent, self.speed_exponent, self.pitch_exponent) == (1.0, 0.0, 0.0)


def _held(value: float, ends: tuple[float, float]) -> float:
    return min(max(value, ends[0]), ends[1])


def joint_law(state: WearCondition) -> JointLaw:
    """Return the law of the joints in a wear condition.

    Examples
    --------
    >>> from wearsim.catalogue.catalogues import wear_conditions
    >>> law = joint_law(wear_conditions()["hardened, oiled"])
    >>> law.coefficient, law.pressure_exponent, law.speed_exponent
    (1.2e-10, 2.0, 0.7)
    """
    return JointLaw(
        state.joint_typical,
        state.joint_pressure_exponent,
        state.joint_speed_exponent,
        state.joint_pitch_exponent,
        state.joint_reference_pressure,
        state.joint_reference_speed,
        state.joint_reference_pitch,
    )


class JointBand(NamedTuple):
    """Ends of the band of a rate over the rate, which holds 9 of 10 drives, and where it comes from."""

    low: float
    high: float
    source: str


class _Spread(NamedTuple):
    """One cause for a rate to be another one: ends over the rate, each as likely as the other."""

    low: float
    high: float
    why: str


_ROUTES = _Spread(0.5, 2.5, "spread of the published rules of chain life")
_EXTRAPOLATED = _Spread(1.0 / 1.8, 1.8, "")
_UNKNOWN_OIL = _Spread(0.2, 5.0, "lubrication not given")
_OPEN_TO_DIRT = _Spread(0.1, 10.0, "dirt, load and care in the field not given")

_WINDOW = ((0.58, 1.09), (0.5, 1.5), (0.5, 2.0))
"""Pressure, speed and pitch over those of the reference within which a rate is not extrapolated.

For oiled industrial chains 15 to 28 MPa, 500 to 1500 rpm and pitches to 25.4 mm.
"""

_QUANTITIES = (("joint pressure", "MPa"), ("small sprocket", "rpm"), ("pitch", "mm"))


def extrapolation(law: JointLaw, state: JointState) -> str:
    """Return in words where a drive lies outside of what a rate was found for; empty where it does not.

    Examples
    --------
    >>> law = JointLaw(1e-10, 2.0, 0.7, 0.0, 20.0, 800.0, 12.7)
    >>> extrapolation(law, JointState(40.0, 600.0, 12.7))
    'rate extrapolated from its sources: joint pressure 40 MPa (11.6 to 21.8 MPa)'
    """
    found = [
        f"{name} {value:.4g} {unit} ({low * at:.3g} to {high * at:.4g} {unit})"
        for (name, unit), value, at, (low, high) in zip(
            _QUANTITIES, state, law.reference, _WINDOW, strict=True
        )
        if not low * at * (1.0 - 1e-9) <= value <= high * at * (1.0 + 1e-9)
    ]
    return f"rate extrapolated from its sources: {', '.join(found)}" if found else ""


def joint_band(
    law: JointLaw,
    condition: WearCondition,
    state: JointState,
    known: bool = True,
    surroundings_known: bool = False,
) -> JointBand:
    """Return the band of a wear rate of joints that comes from a wear condition.

    Causes are independent, so their logarithms add as squares: the spread of the published rules of chain
    life, that of the condition's own rate, extrapolation beyond the window in which the rate was found,
    lubrication that nobody named, and surroundings that nobody named. What dirt does where it is named is
    not of the rate: that is the lubricant's. A constant rate is off by what the condition's law says as well.

    Parameters
    ----------
    law : JointLaw
        The law that is used.
    condition : WearCondition
        Where its rate comes from.
    state : JointState
        Where the joints run.
    known : bool
        Whether the condition was named, not only assumed.
    surroundings_known : bool
        Whether the surroundings were named.

    Returns
    -------
    JointBand
        Its ends hold 93 % of the published rules on 27 drives (docs/practice.md) and six of six owners.

    Examples
    --------
    Inside the window with a condition that has no spread of its own, that of the rules:

    >>> from dataclasses import replace
    >>> from wearsim.catalogue.catalogues import wear_conditions
    >>> oiled = wear_conditions()["hardened, oiled"]
    >>> sure = replace(oiled, joint_low=1.2e-10, joint_high=1.2e-10)
    >>> band = joint_band(joint_law(oiled), sure, JointState(25.0, 1000.0, 12.7))
    >>> round(band.low, 12), round(band.high, 12)
    (0.5, 2.5)
    """
    of_condition = joint_law(condition)
    low, high = (end / condition.joint_typical for end in (condition.joint_low, condition.joint_high))
    spreads = [_ROUTES, _Spread(low, high, f"rates of condition {condition.condition!r}")]
    outside = "" if of_condition.is_constant else extrapolation(of_condition, state)
    if outside:
        spreads.append(_EXTRAPOLATED._replace(why=outside))
    if not known:
        spreads.append(_UNKNOWN_OIL)
    if condition.machine != "any" and not surroundings_known:
        spreads.append(_OPEN_TO_DIRT)
    band = _together(spreads)
    if law.is_constant and not of_condition.is_constant:
        off = of_condition.rate(*state) / condition.joint_typical
        why = f"a constant rate, while law = 'pressure_speed' gives {off:.3g} times as much"
        return JointBand(band.low * min(off, 1.0), band.high * max(off, 1.0), f"{band.source}; {why}")
    return band


def extrapolated(band: JointBand, law: JointLaw, state: JointState) -> JointBand:
    """Return a band of a rate that goes by a law, wider where that is used beyond what it was found for."""
    outside = extrapolation(law, state)
    if not outside:
        return band
    return _together([_Spread(band.low, band.high, band.source), _EXTRAPOLATED._replace(why=outside)])


def _together(spreads: Iterable[_Spread]) -> JointBand:
    """Return the band of independent causes."""
    known = [spread for spread in spreads if (spread.low, spread.high) != (1.0, 1.0)]
    low, high = (
        math.exp(math.sqrt(math.fsum(math.log(end) ** 2 for end in ends)))
        for ends in zip(*((spread.low, spread.high) for spread in known), strict=True)
    )
    return JointBand(1.0 / low, high, "; ".join(spread.why for spread in known))


def elongation_per_loop(
    specific_wear_rate: float,
    pressures: Sequence[tuple[float, float]],
    pin_diameter: float,
    pitch: float,
    teeth: Sequence[float],
) -> float:
    """Return how much a chain grows in one loop around its sprockets.

    A joint turns by 2 pi/z where it comes onto a sprocket and where it leaves it, each time under the
    tension of that span. Its pin slides pi d2/z each time, so Archard's law gives
    d(eps)/d(loop) = k pi d2/p sum over sprockets of (p_in + p_out)/z. For two sprockets that is equation
    (4.1) of the reference with its slack part.

    Equation physics.md (E1).

    Parameters
    ----------
    specific_wear_rate : float
        k of pin and bush together [mm2/N].
    pressures : sequence of tuple of float
        At each sprocket, tension of the spans on both sides over the bearing area, times what a `JointLaw`
        says of the rate there [MPa].
    pin_diameter : float
        d2 [mm].
    pitch : float
        p [mm].
    teeth : sequence of float
        z of each, rollers per turn.

    Returns
    -------
    float
        Relative elongation per loop.

    Examples
    --------
    1e-9 mm2/N at 20 MPa over pi 5 (1/20 + 1/20) mm on a pitch of 10 mm:

    >>> spans = [(20.0, 0.0), (0.0, 20.0)]
    >>> round(elongation_per_loop(1e-9, spans, 5.0, 10.0, (20, 20)) / (1e-9 * math.pi), 12)
    1.0
    """
    first = sum(pressures[0])
    turned = sum(sum(pair) / first / z for pair, z in zip(pressures, teeth, strict=True))
    return specific_wear_rate * first * (math.pi * pin_diameter * turned) / pitch
