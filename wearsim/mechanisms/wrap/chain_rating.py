"""A drive against the ratings of the handbooks: the worst of its loads, and what no rule limits."""

import math
from collections.abc import Sequence
from dataclasses import replace

from wearsim.chain.drive_layout import DriveLayout, ToothMeetings, polygon_effect
from wearsim.chain.loop_layout import LoopLayout
from wearsim.chain.power_rating import hours_over_duty
from wearsim.chain.rating_findings import RATINGS, RatedDrive, RatingFinding, assess

RatedLoad = tuple[str, RatedDrive]
"""A load in words, empty where it is the only one, and what the ratings need to know under it."""


def findings_by_load(
    loads: Sequence[RatedLoad], service: float, application: float
) -> list[list[RatingFinding]]:
    """Return what the handbooks say about each load."""
    return [
        [replace(finding, load=of) for finding in assess(rated, service, application)] for of, rated in loads
    ]


def worst_findings(by_load: Sequence[Sequence[RatingFinding]]) -> tuple[RatingFinding, ...]:
    """Return of every rule the finding that uses most of its limit."""
    worst: dict[str, RatingFinding] = {}
    for findings in by_load:
        for finding in findings:
            before = worst.get(finding.name)
            if before is None or finding.used > before.used:
                worst[finding.name] = finding
    return tuple(worst.values())


def with_hours_over_duty(
    worst: Sequence[RatingFinding], shares: Sequence[float], by_block: Sequence[Sequence[RatingFinding]]
) -> tuple[RatingFinding, ...]:
    """Return findings whose hours are those of the whole duty, of its blocks and their shares of the time."""
    blocks: dict[str, list[tuple[float, float]]] = {}
    for share, findings in zip(shares, by_block, strict=True):
        for finding in findings:
            if finding.hours is not None:
                blocks.setdefault(finding.name, []).append((share, finding.hours))
    return tuple(
        replace(finding, hours=hours_over_duty(blocks[finding.name])) if finding.name in blocks else finding
        for finding in worst
    )


def rules_without_limit(by_load: Sequence[Sequence[RatingFinding]]) -> tuple[str, ...]:
    """Return the rules that say nothing about some load: a number or a row is missing."""
    found = [{finding.name for finding in findings} for findings in by_load]
    return tuple(name for name in RATINGS if not all(name in names for names in found))


def drive_notes(
    layout: DriveLayout | LoopLayout, rated: RatedDrive, silent: Sequence[str], meetings: str
) -> list[str]:
    """Return what a designer asks of a chain drive that no rule limits."""
    small = min(layout.rated_teeth)
    return [
        _laid_out(layout),
        f"{rated.power:.4g} kW at {rated.chain_speed:.4g} m/s: pull {rated.pull:.5g} N; small sprocket "
        f"{rated.teeth:g} teeth at {rated.speed:.5g} rpm, ratio "
        f"{max(layout.rated_teeth) / small:.4g}",
        f"polygon effect: the speed of the chain varies by {100.0 * polygon_effect(small):.2f} % "
        f"over a tooth of the small sprocket{_swing(layout)}",
        meetings,
        *([f"no limit known, so not judged: {', '.join(silent)}"] if silent else []),
    ]


def _swing(layout: DriveLayout | LoopLayout) -> str:
    if isinstance(layout, LoopLayout):
        return ""
    return f", the taut centre distance by +- {layout.polygon_swing:.1g} mm"


def _laid_out(layout: DriveLayout | LoopLayout) -> str:
    if isinstance(layout, LoopLayout):
        wraps = ", ".join(
            f"{math.degrees(angle):.1f} degrees on {wheel.name!r}"
            for wheel, angle in zip(layout.loop.wheels, layout.loop.wrap_angles, strict=True)
        )
        return f"{layout.links} links; wrap angle {wraps}"
    return (
        f"{layout.links} links, centre distance {layout.centre_distance:.2f} mm = "
        f"{layout.centre_distance / layout.pitch:.4f} pitches (taut), wrap angle "
        f"{math.degrees(layout.wrap_angle_1):.1f} degrees on the driver and "
        f"{math.degrees(layout.wrap_angle_2):.1f} on the driven sprocket"
    )


def meetings_note(loaded: int, links: int, alternating: bool) -> str:
    """Return which rollers meet which of the loaded teeth."""
    meetings = ToothMeetings(loaded, links)
    if meetings.hunts:
        return "every tooth meets every roller: teeth and rollers wear evenly"
    text = (
        f"{loaded} teeth and {links} links have the common divisor {meetings.classes}: "
        f"a tooth meets {meetings.rollers_per_tooth} of the rollers"
    )
    if not (meetings.same_link_kind and alternating):
        return text
    return f"{text}, always inner or always outer links: teeth wear unevenly"
