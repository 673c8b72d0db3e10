"""What the published rules say of a chain beside its computed life."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from wearsim.quantities import grouped
from wearsim.result.ends import Lives
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

    @property
    def span(self) -> tuple[float, float] | None:
        """Shortest and longest hours of all rules; None where none has any."""
        hours = [rule.hours for rule in self.rules if rule.hours is not None]
        return (min(hours), max(hours)) if hours else None

    def within(self, band: Lives) -> bool:
        """Return whether the mean of the rules lies in the band of a life, as far as that is known."""
        low, high = band
        most = high.hours if isinstance(high, Life) else math.inf
        return self.mean_hours is None or low.hours_run <= self.mean_hours <= most


def second_opinions(drive: "PracticeDrive") -> SecondOpinions:
    """Return what the published rules say of a drive."""
    # Read by a chain's life only: a strand starts without the tables of the rules.
    from wearsim.chain.practice import geometric_mean, opinions, outside_practice

    found = opinions(drive)
    return SecondOpinions(
        tuple(RuleLife(one.rule.name, one.hours, one.rule.trust, one.rule.source, one.note) for one in found),
        geometric_mean(found),
        outside_practice(drive),
        _lubrication(drive),
    )


def _lubrication(drive: "PracticeDrive") -> str:
    """Say what is recommended where a poorer lubrication is known, and what that does to the life."""
    found = drive.lubrication_factor
    if not drive.lubrication or found.factor >= 1.0:
        return ""
    return (
        f"lubrication {drive.lubrication!r}, where {drive.recommended!r} is recommended at "
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
        return "no published rule has hours here"
    low, high = (grouped(end, 3) for end in found.span)
    count = sum(rule.hours is not None for rule in found.rules)
    return (
        f"{low} to {high} h by {count} published rules, mean of the schools {grouped(found.mean_hours)} h "
        "(practice, no measurement)"
    )


RULE_HEAD = ("published rule", "hours", "trust", "note")
"""Heads of `rule_rows`."""


def rule_rows(found: SecondOpinions) -> list[tuple[str, str, str, str]]:
    """Return every rule with its hours, its trust, and why it has none or what limits their worth."""
    return [
        (
            rule.rule,
            f"{grouped(rule.hours, 3)} h" if rule.hours is not None else "-",
            rule.trust,
            rule.note or "-",
        )
        for rule in found.rules
    ]


def opinions_json(found: SecondOpinions) -> dict[str, Any]:
    """Return the second opinions as JSON."""
    return {
        "rules": [asdict(rule) for rule in found.rules],
        "mean_hours": found.mean_hours,
        "outside": found.outside,
        "lubrication": found.lubrication,
    }


def read_opinions(stored: Mapping[str, Any]) -> SecondOpinions:
    """Return the second opinions that were stored."""
    rules: Sequence[Mapping[str, Any]] = stored["rules"]
    return SecondOpinions(
        tuple(RuleLife(**rule) for rule in rules),
        stored["mean_hours"],
        stored["outside"],
        stored["lubrication"],
    )
