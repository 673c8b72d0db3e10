"""Is a chain drive inside its rating: one finding for each rule of the handbooks."""

from collections.abc import Sequence
from dataclasses import dataclass

from wearsim.chain.joint_pressure import allowable_joint_pressure, joint_pressure, least_safety, speed_limits
from wearsim.chain.power_rating import (
    REFERENCE_TEETH,
    corrected_power,
    galling_speed,
    plate_fatigue_rating,
    power_rating,
    roller_impact_hours,
    roller_impact_rating,
    strand_factor,
)
from wearsim.errors import CaseError, Fault
from wearsim.quantities import grouped

LARGEST_PITCH = 76.2
"""Largest pitch that the ANSI rating covers, no. 240 [mm]."""


@dataclass(frozen=True)
class Rating:
    """A rule of the handbooks."""

    name: str  # of its findings: what is compared
    rated_hours: bool = False  # whether its limit is for 15 000 h
    of_load: bool = False  # whether it says how much load a chain carries
    advice: bool = False  # whether a drive may run outside of it
    end: str = ""  # how a chain ends by it; empty where that is not known


_PLATES = Rating("plate fatigue", rated_hours=True, of_load=True, end="link plate fatigue")
_IMPACT = Rating("roller impact", rated_hours=True, of_load=True, end="roller and bush impact")
_CORRECTED_POWER = Rating("corrected power", rated_hours=True, of_load=True)
_PRESSURE = Rating("joint pressure", of_load=True)
_SPEEDS = Rating("recommended speed", advice=True), Rating("greatest speed")
_SAFETY = Rating("safety against breaking")
_GALLING = Rating("galling speed", end="galling of pin and bush")

RATINGS = {
    one.name: one for one in (_PLATES, _IMPACT, _CORRECTED_POWER, _PRESSURE, *_SPEEDS, _SAFETY, _GALLING)
}
"""The one list of ratings by the names of their findings, in the order of `assess`."""

_LIMIT_OF_ITS_OWN = Rating("elongation at the end", advice=True)

LEAST_SAFETY = 7.0
"""Tensile strength over tension of the tight span, without shocks (iwis: 7; Renold: 8)."""

_GOST = "GOST13568"

_OTHER_CHAINS = "for information, the table is for GOST 13568 chains"
_MAYBE_OTHER_CHAINS = "indicative, the table is for GOST 13568 chains"
"""Notes of the tables of GOST practice on a chain of ISO 606, and on one whose series is not known."""


@dataclass(frozen=True)
class RatedDrive:
    """What the ratings need to know of a drive; 0 stands for not known.

    Raises
    ------
    CaseError
        Pitch, teeth, speed, power or strands are not above 0.

    Examples
    --------
    >>> drive = RatedDrive(pitch=25.4, teeth=20, speed=750.0, power=30.0)
    >>> round(drive.pull, 2)  # 30 kW at 6.35 m/s
    4724.41
    """

    pitch: float  # chain pitch [mm]
    teeth: float  # gaps of the smaller sprocket; no whole number where only some gaps carry a roller
    speed: float  # speed of the smaller sprocket [rpm]
    power: float  # transmitted power [kW]
    strands: int = 1  # chains side by side
    bearing_area: float = 0.0  # projected area of pin in bush, all strands together [mm2]
    tensile: float = 0.0  # minimum tensile strength, all strands together [N]
    own_tension: float = 0.0  # catenary and centrifugal tension of the tight span [N]
    series: str = ""  # as in the catalogue: `ISO606-A/ANSI B29.1`, `ISO606-B`, `ISO606-H`, `GOST13568`
    light: bool = False  # whether the chain is no. 41 (085-1).
    links: float = 0.0  # length of the chain in pitches

    def __post_init__(self) -> None:
        faults = [
            Fault(f"rating: {name} must be above 0, is {getattr(self, name):g}: give the drive's")
            for name in ("pitch", "teeth", "speed", "power", "strands")
            if not getattr(self, name) > 0.0
        ]
        if faults:
            raise CaseError(faults)

    @property
    def chain_speed(self) -> float:
        """Mean speed of the chain, v = z p n [m/s]."""
        return self.teeth * self.pitch * self.speed / 6e4

    @property
    def pull(self) -> float:
        """F_t = P/v with v = z p n [N]."""
        return 6.0e7 * self.power / (self.teeth * self.pitch * self.speed)


@dataclass(frozen=True)
class RatingFinding:
    """A number of the drive beside what a rule allows.

    Examples
    --------
    >>> RatingFinding("safety", 6.0, 7.0, "", "iwis", at_least=True).ok
    False
    """

    name: str  # what is compared
    # value, limit: of the drive, and by the rule, both in `unit`
    value: float
    limit: float
    unit: str  # unit of both, empty for a ratio
    source: str  # whose rule it is
    note: str = ""  # why the rule is only indicative here; empty where it applies as it stands
    at_least: bool = False  # whether the limit is a lower one
    load: str = ""  # which of several loads of the drive it is about; empty where there is one
    hours: float | None = None  # life by this rule [h]; None where it has no hours but those it is rated for

    @property
    def used(self) -> float:
        """Part of the limit that the value takes up, above 1 outside."""
        return self.limit / self.value if self.at_least else self.value / self.limit

    @property
    def margin(self) -> float:
        """What is left to the limit in `unit`, below 0 outside."""
        return self.value - self.limit if self.at_least else self.limit - self.value

    @property
    def ok(self) -> bool:
        """Whether the value keeps to the limit."""
        return self.value >= self.limit if self.at_least else self.value <= self.limit

    @property
    def informs(self) -> bool:
        """Whether the rule is for other chains, so that it informs and does not judge."""
        return self.note == _OTHER_CHAINS


def overloading(ratings: Sequence[RatingFinding]) -> tuple[RatingFinding, ...]:
    """Return the ratings that a drive is overloaded by.

    Those outside but for the recommended speed, above which a drive may run, the elongation,
    which is a limit of its own, and rules for other chains. Where a rating of the load applies as it
    stands, those that are only indicative overload no drive by themselves.

    Examples
    --------
    >>> plates = RatingFinding("plate fatigue", 4.6, 4.604, "kW", "ANSI B29.1, H1")
    >>> pressure = RatingFinding("joint pressure", 26.0, 22.5, "MPa", "GOST practice", "indicative")
    >>> overloading([plates, pressure])
    ()
    >>> [finding.name for finding in overloading([pressure])]
    ['joint pressure']
    """
    applying = tuple(one for one in ratings if not one.informs)
    outside = tuple(finding for finding in applying if not finding.ok and not _rating(finding).advice)
    judged = any(_rating(finding).of_load and not finding.note for finding in applying)
    return () if judged and all(finding.note for finding in outside) else outside


def deciding(ratings: Sequence[RatingFinding]) -> tuple[RatingFinding, ...]:
    """Return the ratings that decide by themselves whether a drive is overloaded.

    All but the recommended speed, the elongation and rules for other chains; where a rating of the
    load applies as it stands, only those that are not indicative. A drive that keeps to them is not
    `overloading`.

    Examples
    --------
    >>> plates = RatingFinding("plate fatigue", 4.6, 4.604, "kW", "ANSI B29.1, H1")
    >>> pressure = RatingFinding("joint pressure", 26.0, 22.5, "MPa", "GOST practice", "indicative")
    >>> [finding.name for finding in deciding([plates, pressure])]
    ['plate fatigue']
    """
    found = tuple(one for one in ratings if not one.informs and not _rating(one).advice)
    judged = any(_rating(one).of_load and not one.note for one in found)
    return tuple(one for one in found if not (judged and one.note))


def _rating(finding: RatingFinding) -> Rating:
    return RATINGS.get(finding.name, _LIMIT_OF_ITS_OWN)


def rated_for_hours(findings: Sequence[RatingFinding]) -> list[RatingFinding]:
    """Return the findings whose limit is for 15 000 h."""
    return [one for one in findings if _rating(one).rated_hours]


def rating_note(series: str) -> str:
    """Return what limits the use of the ANSI power ratings for a series of chains.

    Examples
    --------
    >>> rating_note("ISO606-A/ANSI B29.1")
    ''
    """
    if series.startswith("ISO606-A"):
        return ""
    kinds = {
        "ISO606-B": "B chains have other plates and rollers: see the maker's chart",
        "ISO606-H": "thicker plates carry more than the A chain of this pitch",
        "GOST13568": "GOST practice rates these chains by joint pressure",
    }
    return f"indicative, the formula is for the A series; {kinds.get(series, 'series not known')}"


def assess(
    drive: RatedDrive, service_factor: float = 1.0, application: float = 1.0
) -> tuple[RatingFinding, ...]:
    """Return what the handbooks say about a drive.

    Power against the ANSI ratings and, corrected by ISO 10823, against that of the reference
    drive; joint pressure and speed against the tables of GOST practice; tensile strength against
    the rule that belongs to the chain: GOST practice by pitch and speed for its chains of one and two
    strands, with the service factor on the pull, else iwis, without it.

    Examples
    --------
    No. 80, 20 teeth, 750 rpm carries 39.33 hp = 29.33 kW:

    >>> [finding.ok for finding in assess(RatedDrive(25.4, 20, 750.0, 29.3))][:3]
    [True, True, True]
    """
    return (
        *_power_findings(drive, service_factor),
        *_pressure_findings(drive, application),
        *_speed_findings(drive),
        *_tensile_findings(drive, service_factor),
        *_galling_findings(drive),
    )


def _power_findings(drive: RatedDrive, service_factor: float) -> list[RatingFinding]:
    if drive.pitch > LARGEST_PITCH:
        return []
    note = rating_note(drive.series)
    several = strand_factor(drive.strands)
    required = drive.power * service_factor
    here = (drive.pitch, drive.teeth, drive.speed, drive.light)
    reference = power_rating(drive.pitch, REFERENCE_TEETH, drive.speed, drive.light)
    plates = several * plate_fatigue_rating(*here)
    impact = several * roller_impact_rating(*here)
    hours = roller_impact_hours(required / impact, drive.links) if drive.links else None
    corrected = corrected_power(drive.power, service_factor, drive.teeth)
    iso = "ISO 10823, f1 f2; rating of 19 teeth by ANSI B29.1"
    return [
        RatingFinding(_PLATES.name, required, plates, "kW", "ANSI B29.1, H1", note),
        RatingFinding(_IMPACT.name, required, impact, "kW", "ANSI B29.1, H2", note, hours=hours),
        RatingFinding(_CORRECTED_POWER.name, corrected, several * reference, "kW", iso, note),
    ]


def _pressure_findings(drive: RatedDrive, application: float) -> list[RatingFinding]:
    allowed = allowable_joint_pressure(drive.pitch, drive.speed)
    if allowed is None or not drive.bearing_area or drive.strands > 3:
        return []
    found = joint_pressure(drive.pull, drive.bearing_area, drive.strands, application)
    note = _gost_note(drive.series)
    return [RatingFinding(_PRESSURE.name, found, allowed, "MPa", "GOST practice (Dunaev)", note)]


def _gost_note(series: str) -> str:
    """Return what limits the use of the tables of GOST practice for a series of chains."""
    if series == _GOST:
        return ""
    return _OTHER_CHAINS if series.startswith("ISO606") else _MAYBE_OTHER_CHAINS


def _speed_findings(drive: RatedDrive) -> list[RatingFinding]:
    limits = speed_limits(drive.pitch)
    if limits is None:
        return []
    note = _gost_note(drive.series)
    return [
        RatingFinding(rating.name, drive.speed, limit, "rpm", "GOST practice", note)
        for rating, limit in zip(_SPEEDS, limits, strict=True)
    ]


def _tensile_findings(drive: RatedDrive, shocks: float) -> list[RatingFinding]:
    if not drive.tensile:
        return []
    # The handbook's table is for chains of one and two strands.
    tabled = drive.series == _GOST and drive.strands <= 2
    asked = least_safety(drive.pitch, drive.speed) if tabled else None
    if asked is None:
        safety = drive.tensile / (drive.pull + drive.own_tension)
        rule = "iwis, fatigue limit 15 to 20 % of the tensile strength"
        return [RatingFinding(_SAFETY.name, safety, LEAST_SAFETY, "", rule, at_least=True)]
    safety = drive.tensile / (shocks * drive.pull + drive.own_tension)
    rule = "GOST practice (Chernavsky), by pitch and speed"
    return [RatingFinding(_SAFETY.name, safety, asked, "", rule, at_least=True)]


def _galling_findings(drive: RatedDrive) -> list[RatingFinding]:
    if drive.pitch > LARGEST_PITCH:
        return []
    tension = (drive.pull + drive.own_tension) / strand_factor(drive.strands)
    limit = galling_speed(drive.pitch, drive.teeth, tension)
    rule = "American Chain Association; Shigley, chapter 17"
    return [RatingFinding(_GALLING.name, drive.speed, limit, "rpm", rule, rating_note(drive.series))]


def rating_warnings(findings: Sequence[RatingFinding]) -> list[str]:
    """Return a warning for every rating that a drive is outside of.

    A pull above a seventh of the tensile strength is warned of where the load is read.
    """
    return [
        warning(finding)
        for finding in findings
        if not finding.ok and (finding.name, finding.limit) != (_SAFETY.name, LEAST_SAFETY)
    ]


def warning(finding: RatingFinding) -> str:
    """Return a finding outside its limit in words.

    Examples
    --------
    >>> warning(RatingFinding("plate fatigue", 30.0, 29.33, "kW", "ANSI B29.1, H1"))
    'outside a rating: plate fatigue 30 kW, allowed at most 29.33 kW (ANSI B29.1, H1)'
    """
    return f"outside a rating: {_compared(finding)}"


def _compared(finding: RatingFinding) -> str:
    side = "least" if finding.at_least else "most"
    unit = f" {finding.unit}" if finding.unit else ""
    kind = "for information" if finding.informs else "indicative"
    source = f"{finding.source}; {kind} here" if finding.note else finding.source
    of = f" with {finding.load}" if finding.load else ""
    return (
        f"{finding.name} {grouped(finding.value)}{unit}{of}, allowed at {side} "
        f"{grouped(finding.limit)}{unit} ({source})"
    )


def overload_fault(findings: Sequence[RatingFinding]) -> str:
    """Return in words that a load is outside the ratings that decide, all of them; empty where it is not.

    Examples
    --------
    >>> overload_fault([RatingFinding("plate fatigue", 30.0, 24.0, "kW", "ANSI B29.1, H1")])[:81]
    'the load must stay within its ratings: plate fatigue 30 kW, allowed at most 24 kW'
    """
    outside = overloading(findings)
    if not outside:
        return ""
    found = "; ".join(f"{_compared(one)}: {grouped(100.0 * one.used)} % of it" for one in outside)
    return f"the load must stay within its ratings: {found}: use a larger chain, more strands or less power"
