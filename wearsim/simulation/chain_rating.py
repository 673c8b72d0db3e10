"""The drive of a case against the ratings of the handbooks."""

from dataclasses import replace

from wearsim.case.model import Block, Case, WrapDrive
from wearsim.chain.selection import RULES, Finding, RatedDrive, assess, elongation_limit

_LIGHT = "085-1"
"""Designation of no. 41, the light chain of 12.7 mm pitch."""

_SAFETY = "safety against breaking"


def rated_drive(case: Case, drive: WrapDrive, load: Block) -> RatedDrive:
    """Return what the ratings need to know of a case.

    The ratings are those of the smaller sprocket, so its teeth and speed follow from the chain's
    speed where the case is about the larger one.

    Examples
    --------
    >>> import wearsim
    >>> case = wearsim.load_case({
    ...     "format_version": 1,
    ...     "chain": {"designation": "ANSI 80"},
    ...     "sprocket": {"teeth": 60, "profile": "ansi_b29", "role": "driven"},
    ...     "drive": {"mate_teeth": 20, "links": 122},
    ...     "load": {"power_kW": 30, "speed_rpm": 250},
    ...     "wear": {"condition": "hardened, oiled"},
    ... })
    >>> found = rated_drive(case, case.drive, case.drive.heaviest)
    >>> found.teeth, found.speed, round(found.power, 9)
    (20.0, 750.0, 30.0)
    """
    layout, chain = drive.layout, drive.chain
    mate = layout.teeth_2 if drive.driver else layout.teeth_1
    own = drive.gaps / case.engaged_every
    # 27 gaps of which every second carries a roller are 13.5 teeth, and no more than 13.
    teeth = own if int(own) <= mate else float(mate)
    pitches = own * load.speed_rpm
    return RatedDrive(
        pitch=chain.pitch,
        teeth=teeth,
        speed=pitches / teeth,
        power=1e-6 * (load.tension - drive.slack) * chain.pitch * pitches / 60.0,
        strands=chain.strands,
        bearing_area=chain.bearing_area,
        tensile=chain.tensile,
        own_tension=drive.slack + load.centrifugal,
        series=chain.series,
        light=chain.designation == _LIGHT,
    )


def rating(case: Case) -> tuple[Finding, ...]:
    """Return what the handbooks say about the drive of a case."""
    drive = case.drive
    if not isinstance(drive, WrapDrive):
        return ()
    worst: dict[str, Finding] = {}
    for findings in _by_load(case, drive):
        for finding in findings:
            before = worst.get(finding.name)
            if before is None or finding.used > before.used:
                worst[finding.name] = finding
    return (*worst.values(), _elongation(drive))


def _by_load(case: Case, drive: WrapDrive) -> list[list[Finding]]:
    """Findings of every rated load that pulls, each named where there are several."""
    found = []
    for load in drive.rated:
        if load.tension <= drive.slack:
            continue
        of = f"{load.tension:.4g} N at {load.speed_rpm:.4g} rpm" if len(drive.rated) > 1 else ""
        rated = rated_drive(case, drive, load)
        findings = assess(rated, drive.service_factor, drive.exploitation_factor)
        found.append([replace(finding, load=of) for finding in findings])
    return found


def rules_without_limit(case: Case) -> tuple[str, ...]:
    """Return the rules that say nothing about the drive of a case: a number or a row is missing."""
    drive = case.drive
    if not isinstance(drive, WrapDrive):
        return ()
    found = [{finding.name for finding in findings} for findings in _by_load(case, drive)]
    return tuple(name for name in RULES if not all(name in names for names in found))


def rating_warnings(case: Case) -> list[str]:
    """Return a warning for every rating that the drive of a case is outside of."""
    return [warning(finding) for finding in rating(case) if not finding.ok and finding.name != _SAFETY]


def warning(finding: Finding) -> str:
    """Return a finding outside its limit in words.

    Examples
    --------
    >>> warning(Finding("plate fatigue", 30.0, 29.33, "kW", "ANSI B29.1, H1"))
    'outside a rating: plate fatigue 30 kW, allowed at most 29.33 kW (ANSI B29.1, H1)'
    """
    side = "least" if finding.at_least else "most"
    unit = f" {finding.unit}" if finding.unit else ""
    source = f"{finding.source}; indicative here" if finding.note else finding.source
    of = f" of {finding.load}" if finding.load else ""
    return (
        f"outside a rating: {finding.name}{of} {finding.value:.4g}{unit}, allowed at {side} "
        f"{finding.limit:.4g}{unit} ({source})"
    )


def _elongation(drive: WrapDrive) -> Finding:
    layout = drive.layout
    limit = elongation_limit(max(layout.teeth_1, layout.teeth_2))
    # Both to the four digits of the limit that a case takes by default.
    value, limit = (float(f"{100.0 * part:.4g}") for part in (drive.joint.elongation_limit, limit))
    return Finding(
        "elongation at the end", value, limit, "%", "3 %, 200 % over the teeth of the larger sprocket"
    )
