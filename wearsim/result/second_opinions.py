"""What the published rules say of a chain beside its computed life."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from wearsim.chain.power_rating import NO_MORE_HOURS
from wearsim.quantities import grouped
from wearsim.result.ends import LifeBand
from wearsim.result.lives import Life

if TYPE_CHECKING:
    from wearsim.chain.practice_drive import PracticeDrive


@dataclass(frozen=True)
class RuleLife:
    """Hours of a published rule."""

    rule: str
    hours: float | None  # None outside the range of the rule
    trust: str
    source: str
    note: str  # why there are no hours, or what limits their worth


@dataclass(frozen=True)
class SecondOpinions:
    """What practice says of a chain; practice, not measurement.

    Examples
    --------
    >>> from wearsim.chain.practice_drive import PracticeDrive
    >>> from wearsim.result import LowerBound
    >>> drive = PracticeDrive(19.05, 21, 57 / 21, 120.0, 124, 3750.0, 89.3, 5.72)
    >>> found = second_opinions(drive)
    >>> found.within((Life(1e6, 3200.0), Life(8e6, 25_000.0))), found.within((Life(1e6, 9e3), Life(2e6, 2e4)))
    (True, False)
    >>> found.within((LowerBound(1e5, 330.0), LowerBound(1e6, 3000.0)))
    True
    """

    rules: tuple[RuleLife, ...]
    mean_hours: float | None  # geometric mean of the schools
    outside: str  # why no rule has been in use here; empty where rules are
    lubrication: str  # what is said of the lubrication; empty where it is as recommended or not known
    lubrication_factor: float  # of lubrication and surroundings, on the hours
    shock_factor: float  # on the pull of the rules
    pressure_velocity: float  # joint pressure times chain speed [MPa m/s]

    @property
    def span(self) -> tuple[float, float] | None:
        """Shortest and longest hours of all rules; None where none has any."""
        hours = [rule.hours for rule in self.rules if rule.hours is not None]
        return (min(hours), max(hours)) if hours else None

    @property
    def warnings(self) -> tuple[str, ...]:
        """What practice warns of: a poorer lubrication first, and a joint pressure outside of it."""
        outside = f"outside any published practice: {self.outside}" if self.outside else ""
        poorer = self.lubrication if self.lubrication_factor < 1.0 else ""
        return tuple(filter(None, (poorer, outside)))

    def within(self, band: LifeBand) -> bool:
        """Return whether the mean of the rules lies in the band of a life, as far as that is known.

        Hours above 100 000 are all alike.
        """
        if self.mean_hours is None:
            return True
        low, high = band
        most = high.hours if isinstance(high, Life) else math.inf
        return min(low.hours_run, NO_MORE_HOURS) <= min(self.mean_hours, NO_MORE_HOURS) <= most


def second_opinions(*duty: "PracticeDrive") -> SecondOpinions:
    """Return what the published rules say of a drive, given once for each block of its duty."""
    # Read by a chain's life only: a strand starts without the tables of the rules.
    from wearsim.chain.practice_rules import (
        fastest,
        geometric_mean,
        opinions,
        outside_practice,
        pressure_velocity,
    )

    found, judged = opinions(*duty), fastest(duty)
    return SecondOpinions(
        tuple(RuleLife(one.rule.name, one.hours, one.rule.trust, one.rule.source, one.note) for one in found),
        geometric_mean(found),
        outside_practice(*duty),
        _lubrication(judged),
        judged.lubrication_factor.factor,
        judged.shock_factor,
        pressure_velocity(*duty),
    )


def _lubrication(drive: "PracticeDrive") -> str:
    """Say what is recommended where another lubrication is known, and what that does to the life."""
    found = drive.lubrication_factor
    if not drive.lubrication or found.factor == 1.0:
        return ""
    there = "" if drive.environment == "clean" else f" in {drive.environment}"
    return (
        f"lubrication {drive.lubrication!r}{there}, where {drive.recommended!r} is recommended at "
        f"{drive.chain_speed:.3g} m/s and {drive.pitch:g} mm pitch: published rules give {found.factor:g} "
        f"times the life ({found.low:g} to {found.high:g})"
    )


def practice_text(found: SecondOpinions) -> str:
    """Return the second opinions in one line.

    Examples
    --------
    >>> from wearsim.chain.practice_drive import PracticeDrive
    >>> practice_text(second_opinions(PracticeDrive(19.05, 21, 57 / 21, 120.0, 124, 3750.0, 89.3, 5.72)))
    '4 100 to 16 100 h by 7 published rules, mean of the schools 7 017 h (practice, no measurement)'
    """
    if found.outside:
        return f"outside any published practice: {found.outside}"
    if found.span is None or found.mean_hours is None:
        return "no published rule gives hours here"
    count = sum(rule.hours is not None for rule in found.rules)
    mean = rule_hours(found.mean_hours, 4)
    if found.mean_hours > NO_MORE_HOURS:
        mean += ": wear does not end the life of this chain"
    return (
        f"{span_text(found.span)} by {count} published rules{counted_text(found)}, mean of the schools "
        f"{mean} (practice, no measurement)"
    )


def rule_hours(hours: float, digits: int = 3) -> str:
    """Return hours of a rule, no number where it is not wear that ends a chain by then.

    Examples
    --------
    >>> rule_hours(69_812.0), rule_hours(6.19e6)
    ('69 800 h', '> 100 000 h')
    """
    return f"> {grouped(NO_MORE_HOURS)} h" if hours > NO_MORE_HOURS else f"{grouped(hours, digits)} h"


def span_text(span: tuple[float, float]) -> str:
    """Return the shortest and the longest hours of the rules, one of both where they read alike.

    Examples
    --------
    >>> [span_text(span) for span in ((4100.0, 16_100.0), (69_812.0, 6.19e6), (3e5, 6e6))]
    ['4 100 to 16 100 h', '69 800 to > 100 000 h', '> 100 000 h']
    """
    low, high = map(rule_hours, span)
    return high if low == high else f"{low.removesuffix(' h')} to {high}"


def counted_text(found: SecondOpinions) -> str:
    """Return in words what the rules count beside the pull: shocks, another lubrication than recommended."""
    counted = []
    if found.shock_factor != 1.0:
        counted.append(f"with shocks f1 = {found.shock_factor:g}, which the computed life does not include")
    if found.lubrication_factor != 1.0:
        counted.append(f"times {found.lubrication_factor:g} for lubrication and surroundings")
    return "".join(f", {one}" for one in counted)


RULE_HEAD = ("published rule", "hours", "trust", "note")
"""Heads of `rule_rows`."""


def rule_rows(found: SecondOpinions) -> list[tuple[str, str, str, str]]:
    """Return every rule with its hours, its trust, and why it has none or what limits their worth.

    The last row is the limit of pressure times speed, which has no hours.
    """
    from wearsim.chain.practice_rules import PRESSURE_VELOCITY

    least, most = PRESSURE_VELOCITY
    side = "within" if found.pressure_velocity <= least else "BEYOND"
    return [
        *(
            (
                rule.rule,
                rule_hours(rule.hours) if rule.hours is not None else "-",
                rule.trust,
                rule.note or "-",
            )
            for rule in found.rules
        ),
        (
            "pressure times chain speed",
            "-",
            "constants unverified",
            f"{grouped(found.pressure_velocity, 3)} MPa m/s, {side} the {least:g} to {most:g} at which "
            "p_v of DIN 8195 ends; ANSI ratings reach about 165 with a stream of oil",
        ),
    ]


def opinions_json(found: SecondOpinions) -> dict[str, Any]:
    """Return the second opinions as JSON."""
    return {
        "rules": [asdict(rule) for rule in found.rules],
        "mean_hours": found.mean_hours,
        "outside": found.outside,
        "lubrication": found.lubrication,
        "lubrication_factor": found.lubrication_factor,
        "shock_factor": found.shock_factor,
        "pressure_velocity_MPa_m_per_s": found.pressure_velocity,
    }


def read_opinions(stored: Mapping[str, Any]) -> SecondOpinions:
    """Return the second opinions that were stored."""
    rules: Sequence[Mapping[str, Any]] = stored["rules"]
    return SecondOpinions(
        tuple(RuleLife(**rule) for rule in rules),
        stored["mean_hours"],
        stored["outside"],
        stored["lubrication"],
        stored["lubrication_factor"],
        stored["shock_factor"],
        stored["pressure_velocity_MPa_m_per_s"],
    )
