"""The drive of a case against the ratings of the handbooks."""

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from wearsim.case.model import Block, Case
from wearsim.chain.drive_layout import Meetings, polygon_effect
from wearsim.chain.selection import RULES, Finding, RatedDrive, assess, elongation_limit

if TYPE_CHECKING:
    from wearsim.mechanisms.wrap.drive import WrapDrive

_LIGHT = "085-1"
"""Designation of no. 41, the light chain of 12.7 mm pitch."""


def rated_drive(case: Case, drive: "WrapDrive", load: Block) -> RatedDrive:
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


def rating(case: Case, drive: "WrapDrive") -> tuple[Finding, ...]:
    """Return what the handbooks say about the drive of a case."""
    worst: dict[str, Finding] = {}
    for findings in _by_load(case, drive):
        for finding in findings:
            before = worst.get(finding.name)
            if before is None or finding.used > before.used:
                worst[finding.name] = finding
    return (*worst.values(), _elongation(drive))


def _by_load(case: Case, drive: "WrapDrive") -> list[list[Finding]]:
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


def rules_without_limit(case: Case, drive: "WrapDrive") -> tuple[str, ...]:
    """Return the rules that say nothing about the drive of a case: a number or a row is missing."""
    found = [{finding.name for finding in findings} for findings in _by_load(case, drive)]
    return tuple(name for name in RULES if not all(name in names for names in found))


def _elongation(drive: "WrapDrive") -> Finding:
    layout = drive.layout
    limit = elongation_limit(max(layout.teeth_1, layout.teeth_2))
    # Both to the four digits of the limit that a case takes by default.
    value, limit = (float(f"{100.0 * part:.4g}") for part in (drive.joint.elongation_limit, limit))
    return Finding(
        "elongation at the end", value, limit, "%", "3 %, 200 % over the teeth of the larger sprocket"
    )


def drive_notes(case: Case, drive: "WrapDrive") -> list[str]:
    """Return what a designer asks of a chain drive that no rule limits."""
    layout, rated = drive.layout, rated_drive(case, drive, drive.heaviest)
    silent = rules_without_limit(case, drive)
    small = min(layout.teeth_1, layout.teeth_2)
    speed = rated.teeth * rated.pitch * rated.speed / 6e4
    return [
        f"{layout.links} links, centre distance {layout.centre_distance:.2f} mm = "
        f"{layout.centre_distance / layout.pitch:.4f} pitches (taut), wrap "
        f"{math.degrees(layout.wrap_1):.1f} degrees on the driver and "
        f"{math.degrees(layout.wrap_2):.1f} on the driven sprocket",
        f"{rated.power:.4g} kW at {speed:.4g} m/s: pull {rated.pull:.5g} N; small sprocket "
        f"{rated.teeth:g} teeth at {rated.speed:.5g} rpm, ratio "
        f"{max(layout.teeth_1, layout.teeth_2) / small:.4g}",
        f"polygon effect: the speed of the chain varies by {100.0 * polygon_effect(small):.2f} % "
        f"over a tooth of the small sprocket",
        _meetings(case, drive),
        *([f"no limit known, so not judged: {', '.join(silent)}"] if silent else []),
    ]


def _meetings(case: Case, drive: "WrapDrive") -> str:
    loaded = drive.gaps // math.gcd(drive.gaps, case.engaged_every)
    meetings = Meetings(loaded, drive.layout.links)
    if meetings.hunts:
        return "every tooth meets every roller: teeth and rollers wear evenly"
    text = (
        f"{loaded} teeth and {drive.layout.links} links have the common divisor {meetings.classes}: "
        f"a tooth meets {meetings.rollers_per_tooth} of the rollers"
    )
    if not (meetings.same_link_kind and drive.joint.alternating):
        return text
    return f"{text}, only inner or only outer links for life: teeth wear unevenly"
