"""Lives by the rules that the trade publishes: formulas here, their words in practice_rules.csv.

That table stands in the catalogue. Handbooks and standards of four schools, each with hours of its
own for a drive: practice, not measurement. They are second opinions beside a computed life: single
rules scatter by a factor of 1.8 about their mean, and for most of them the constants were not
checked against the printed page. Written in the handbooks' units: m/s, rpm, kW.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from wearsim.catalogue.catalogues import catalogue_rows
from wearsim.chain.chain_length import belt_centre
from wearsim.chain.joint_pressure import allowable_joint_pressure
from wearsim.chain.power_rating import (
    NO_MORE_HOURS,
    RATED_HOURS,
    hours_over_duty,
    power_rating,
    strand_factor,
)
from wearsim.chain.practice_drive import RATED_ELONGATION, PracticeDrive
from wearsim.chain.rating_findings import LARGEST_PITCH, rating_note
from wearsim.errors import GeometryError
from wearsim.quantities import grouped

GOST_HOURS = 10_000.0
"""Hours to 3 % assumed behind the [p] of GOST practice; handbooks have 3000 to 10 000."""

GREATEST_PRESSURE = 45.0
"""Joint pressure above which no rule has been in use [MPa]; neither above twice [p]."""

PRESSURE_VELOCITY = 110.0, 130.0
"""Joint pressure times chain speed at which the tables p_v of DIN 8195 end [MPa m/s]."""

_NO_WEAR = 0.01
"""Part of the pull times way of a duty that may fall to blocks in which a rule has no hours."""

_RATED_LINKS, _RATED_RATIO = 120.0, 3.0
_MOST_STRANDS_GOST = 3
_SLOWEST, _FASTEST = 0.1, 10.0
_HANDBOOK_CHARTS = 0.9
"""c1 c3 of the cube law, for its charts: with it no. 40 lasts 15 000 h at its rating."""


@dataclass(frozen=True)
class PracticeRule:
    """A published rule of wear life."""

    name: str
    school: str  # rules of one school differ in one constant
    formula: str  # in plain text: T in h, p in MPa, v in m/s, powers in kW, lengths in mm
    valid: str  # range in which it is used
    source: str  # where it comes from
    trust: str  # how well its constants are known
    # hours to 3 % with the recommended lubrication, of the drive and its joint pressure with
    # shocks [MPa]; or why there are none
    hours: Callable[[PracticeDrive, float], float | str]


@dataclass(frozen=True)
class Opinion:
    """Hours of a rule for a drive."""

    rule: PracticeRule
    hours: float | None  # to the elongation of the drive [h]; None outside the range of the rule
    note: str = ""  # why there are no hours, or what limits their worth


def _kinematics(drive: PracticeDrive) -> float:
    """Life over that of 120 links and a ratio of 3: links by their number, joints by their angles."""
    bends = (drive.ratio / (drive.ratio + 1.0)) / (_RATED_RATIO / (_RATED_RATIO + 1.0))
    return drive.links / _RATED_LINKS * bends


def _by_rating(drive: PracticeDrive, pressure: float) -> float | str:
    if drive.pitch > LARGEST_PITCH:
        return f"no rating above a pitch of {LARGEST_PITCH:g} mm"
    rating = power_rating(drive.pitch, drive.teeth, drive.speed, drive.light)
    carried = rating * strand_factor(drive.strands) / (drive.shock_factor * drive.power)
    return RATED_HOURS * carried**3 * _kinematics(drive)


def _by_din(drive: PracticeDrive, pressure: float) -> float | str:
    if not _SLOWEST <= drive.chain_speed <= _FASTEST:
        return f"p_v is tabulated from {_SLOWEST:g} to {_FASTEST:g} m/s"
    rows = catalogue_rows("din_joint_pressure")
    speeds = [float(row["speed_m_per_s"]) for row in rows]
    allowed = np.interp(drive.chain_speed, speeds, [float(row["pressure_MPa"]) for row in rows])
    return RATED_HOURS * float(allowed / pressure) ** 3 * _kinematics(drive)


def _by_gost(exponent: float) -> Callable[[PracticeDrive, float], float | str]:
    def hours(drive: PracticeDrive, pressure: float) -> float | str:
        if drive.strands > _MOST_STRANDS_GOST:
            return f"m_p is tabulated for up to {_MOST_STRANDS_GOST} strands"
        allowed = allowable_joint_pressure(drive.pitch, drive.speed)
        if allowed is None:
            return f"[p] is not tabulated for {drive.pitch:g} mm at {drive.speed:g} rpm"
        return float(GOST_HOURS * (allowed / pressure) ** exponent)

    return hours


def _by_vorobyev(constant: float) -> Callable[[PracticeDrive, float], float | str]:
    def hours(drive: PracticeDrive, pressure: float) -> float | str:
        speed = drive.chain_speed
        if not _SLOWEST <= speed <= _FASTEST:
            return f"in use from about {_SLOWEST:g} to {_FASTEST:g} m/s"
        try:
            centre = belt_centre(round(drive.teeth), round(drive.teeth * drive.ratio), drive.links)
        except GeometryError:
            return "two sprockets of this ratio need more links, so there is no centre distance"
        supply = 1.2 if speed <= 1.5 else 1.5 if speed <= 3.0 else 2.5
        lubrication = supply / math.sqrt(speed)
        drives = math.sqrt(drive.teeth) * math.cbrt(centre * drive.ratio / speed)
        return constant * 100.0 * RATED_ELONGATION * lubrication * drives / pressure

    return hours


def _by_handbook(drive: PracticeDrive, pressure: float) -> float | str:
    rows = catalogue_rows("wear_pitch_factors")
    pitches = [float(row["pitch_mm"]) for row in rows]
    if not pitches[0] <= drive.pitch <= pitches[-1]:
        return f"c2 is tabulated for pitches from {pitches[0]:g} to {pitches[-1]:g} mm"
    factor = np.interp(drive.pitch, pitches, [float(row["factor"]) for row in rows])
    load = float(_HANDBOOK_CHARTS * factor / pressure) ** 3
    bends = drive.teeth * drive.ratio / (drive.ratio + 1.0)
    path = drive.links / drive.chain_speed * bends * drive.pitch / (3.2 * drive.pin_diameter)
    return 91_500.0 * load * path * 100.0 * RATED_ELONGATION


_HOURS: dict[str, Callable[[PracticeDrive, float], float | str]] = {
    "rating rule": _by_rating,
    "Vorobyev 4350": _by_vorobyev(4350.0),
    "Vorobyev 5200": _by_vorobyev(5200.0),
    "handbook cube law": _by_handbook,
    "DIN 8195 pressure": _by_din,
    "GOST pressure, m = 3": _by_gost(3.0),
    "GOST pressure, m = 1.5": _by_gost(1.5),
}

RULES: tuple[PracticeRule, ...] = tuple(
    PracticeRule(
        row["rule"],
        row["school"],
        row["formula"],
        row["range"],
        row["source"],
        row["trust"],
        _HOURS[row["rule"]],
    )
    for row in catalogue_rows("practice_rules")
)
"""The rules in the order of `opinions`."""


def outside_practice(*duty: PracticeDrive) -> str:
    """Return why no rule has been in use at the joint pressure of a drive; empty where rules are.

    Of a duty of several blocks by the block of the highest pressure that is outside. The pressure is
    that of the pull alone, without shocks and without K_e.

    Examples
    --------
    >>> outside_practice(PracticeDrive(19.05, 21, 3.0, 120.0, 124, 5000.0, 100.0, 5.72))
    'joint pressure 50 MPa, in practice at most 45 MPa'
    """
    outside = [drive for drive in duty if drive.pressure > _greatest_pressure(drive)]
    if not outside:
        return ""
    worst = max(outside, key=lambda drive: drive.pressure)
    limit = _greatest_pressure(worst)
    twice = "" if limit == GREATEST_PRESSURE else ", twice [p]"
    found = f"joint pressure {worst.pressure:.3g} MPa{_under(worst, duty)}"
    return f"{found}, in practice at most {limit:.3g} MPa{twice}"


def _greatest_pressure(drive: PracticeDrive) -> float:
    allowed = allowable_joint_pressure(drive.pitch, drive.speed)
    return min(GREATEST_PRESSURE, math.inf if allowed is None else 2.0 * allowed)


def _under(block: PracticeDrive, duty: Sequence[PracticeDrive]) -> str:
    """Say which block of several."""
    return f" under {grouped(block.pull)} N at {block.speed:.4g} rpm" if len(duty) > 1 else ""


def pressure_velocity(*duty: PracticeDrive) -> float:
    """Return the greatest joint pressure times chain speed of a drive [MPa m/s].

    Examples
    --------
    40 MPa at 0.8 m/s:

    >>> round(pressure_velocity(PracticeDrive(19.05, 21, 3.0, 120.0, 124, 4000.0, 100.0, 5.72)), 2)
    32.0
    """
    return max(drive.pressure * drive.chain_speed for drive in duty)


def opinions(*duty: PracticeDrive) -> tuple[Opinion, ...]:
    """Return the hours of every published rule for a drive, in the order of `RULES`.

    To the elongation of the drive, all rules being linear in it, and with the lubrication that it
    has: hours with the recommended one times `PracticeDrive.lubrication_factor`. The pull of the
    rules is that of the drive times its shock factor. Of a chain of several strands the rules of
    pressure take the strand that carries most, F_t/m_p, the rating rule its strand factor.

    Of a duty T = 1/sum(share_i/T_i), the lubrication being judged by the fastest block. A rule has
    no hours where more than 1 % of pull times way falls to blocks outside its range.

    Parameters
    ----------
    *duty : PracticeDrive
        The drive, once for each block that pulls.

    Returns
    -------
    tuple of Opinion
        One for each rule. None has hours where `outside_practice` says why.

    Examples
    --------
    No. 60 with 21 teeth is rated at 2.546 kW at 120 rpm, and carries 3 kW for 15 000 (2.546/3)^3 1.007 h:

    >>> conveyor = PracticeDrive(19.05, 21, 57 / 21, 120.0, 124, 3750.0, 89.3, 5.72)
    >>> first = opinions(conveyor)[0]
    >>> first.rule.name, round(first.hours, -2)
    ('rating rule', 9200.0)
    """
    return tuple(_opinion(rule, duty) for rule in RULES)


def fastest(duty: Sequence[PracticeDrive]) -> PracticeDrive:
    """Return the block of the highest chain speed, by which lubrication is recommended."""
    return max(duty, key=lambda drive: drive.chain_speed)


def _pull_times_way(block: PracticeDrive) -> float:
    return block.time_share * block.pull * block.speed


def _opinion(rule: PracticeRule, duty: Sequence[PracticeDrive]) -> Opinion:
    if outside := outside_practice(*duty):
        return Opinion(rule, None, f"outside any published practice: {outside}")
    blocks: list[tuple[float, float]] = []
    silent: list[tuple[float, str]] = []
    for drive in duty:
        found = rule.hours(drive, drive.pressure * drive.shock_factor)
        if isinstance(found, str):
            silent.append((_pull_times_way(drive), f"{found}{_under(drive, duty)}"))
        else:
            blocks.append((drive.time_share, found))
    if math.fsum(way for way, _ in silent) > _NO_WEAR * math.fsum(map(_pull_times_way, duty)):
        return Opinion(rule, None, max(silent)[1])
    judged = fastest(duty)
    hours = hours_over_duty(blocks) * judged.elongation / RATED_ELONGATION * judged.lubrication_factor.factor
    notes = [rating_note(judged.series)] if rule.school == "rating" else []
    if hours > NO_MORE_HOURS:
        notes.append("above 100 000 h wear does not end the life of a chain")
    return Opinion(rule, hours, "; ".join(filter(None, notes)))


def geometric_mean(found: Iterable[Opinion]) -> float | None:
    """Return the mean of the schools: Vorobyev 5200, rating with DIN, and GOST with m = 3.

    (T_V sqrt(T_r T_D) T_G)^(1/3), rating and DIN counting as one as they share exponent and
    hours. The handbook's cube law is left out, whose charts are not at hand. A rule without hours
    is left out as well.

    Parameters
    ----------
    found : iterable of Opinion
        Of `opinions`.

    Returns
    -------
    float or None
        Hours [h]; None where none of these rules has any.

    Examples
    --------
    (11.9 sqrt(9.2 * 4.1) 4.7)^(1/3) in thousands for the drive of `PracticeDrive`:

    >>> conveyor = PracticeDrive(19.05, 21, 57 / 21, 120.0, 124, 3750.0, 89.3, 5.72)
    >>> round(geometric_mean(opinions(conveyor)), -2)
    7000.0
    """
    hours = {one.rule.name: one.hours for one in found if one.hours is not None}
    groups = [
        [math.log(hours[name]) for name in names if name in hours]
        for names in (("Vorobyev 5200",), ("rating rule", "DIN 8195 pressure"), ("GOST pressure, m = 3",))
    ]
    means = [sum(logs) / len(logs) for logs in groups if logs]
    return math.exp(sum(means) / len(means)) if means else None
