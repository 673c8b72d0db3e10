"""The answer on screen, and the study of three grids that can stand below it."""

import math
import shlex
from collections.abc import Mapping, Sequence
from typing import Any

from wearsim.chain.power_rating import RATED_HOURS
from wearsim.chain.rating_findings import RatingFinding, rated_for_hours
from wearsim.contact.stop_limits import FAR_FROM_JUMPING
from wearsim.contact.stop_limits import LIMITS as STOP_LIMITS
from wearsim.quantities import DAYS_OF_YEAR, grouped
from wearsim.report.text_lines import Finding, answer_text, counted_assumptions, numbered_assumptions, row
from wearsim.result import Life, LimitState, LowerBound, WearResult
from wearsim.result.ends import PartEnd, before_wear, end_rows, first_hours, wear_only
from wearsim.result.events import Event, event_rows
from wearsim.result.lives import hours, service_measures
from wearsim.result.second_opinions import SecondOpinions, practice_text, rule_rows
from wearsim.wear.accuracy import LEAST_ORDER, MAX_ORDER, GridStudy

BAND, LIMITS = "Band", "Limits"
OVERLOADED = "Overloaded:"
"""Labels of findings that have a place of their own on a page."""

JUMPING = "min_slack_tension_N"
"""Limit of which the margin is a factor: what is needed lies far below it on most drives."""

REMOVED = "Removed"
"""Label of a check of the run, which ``--explain`` prints."""

SAFE = "no risk"
"""What is said of a chain that is far from jumping."""

_SAFE = 2.0
"""Margin of jumping from which on a chain is called safe."""

_AT_END = "at the end of the life"

_LEAST_AREA = 1e-10
"""Area that is lost in the digits of the points of a flank [mm2]."""


def headline(result: WearResult) -> str:
    """Return the hours of what ends first, with the word where the drive is overloaded."""
    text = first_hours(result.ends, result.life)
    return f"{text} (overloaded)" if result.overloaded else text


def beyond_ratings(overloaded: Sequence[RatingFinding]) -> str:
    """Return in words which ratings for 15 000 h a drive is beyond; empty where it is within."""
    beyond = [used_text(finding) for finding in rated_for_hours(overloaded)]
    return f"beyond its rating for {grouped(RATED_HOURS)} h: {', '.join(beyond)}" if beyond else ""


def practice_line(result: WearResult) -> str:
    """Return what published rules say of the chain, and whether that is within its band."""
    assert result.practice is not None
    agrees = result.practice.within(result.bands["chain"])
    return f"{'' if agrees else 'outside the band of the chain: '}{practice_text(result.practice)}"


def limit_text(name: str, value: float) -> str:
    """Return a limit in words.

    Examples
    --------
    >>> limit_text("elongation_percent", 3.0)
    'elongation 3 %'
    """
    words, unit = limit_name(name)
    return f"{words} {grouped(value)} {unit}"


def limit_name(name: str) -> tuple[str, str]:
    """Return the key of a limit as words and its unit."""
    words, _, unit = name.rpartition("_")
    row = STOP_LIMITS.get(name)
    return (row and row.words) or words.replace("_", " "), {"percent": "%", "hours": "h"}.get(unit, unit)


def limit_state(state: LimitState, inputs: Mapping[str, Any]) -> str:
    """Return in words how far a limit is used."""
    if state.name == JUMPING:
        whose = "allowed" if JUMPING in inputs["stop"] else "there"
        return jumping(state.value, state.limit, whose)
    return f"{state.name} {grouped(state.value, 3)} of {grouped(state.limit, 3)}"


def jumping(needed: float, limit: float, whose: str = "there") -> str:
    """Return in words how sure it is that a chain does not jump.

    Examples
    --------
    >>> jumping(5.0, 60.0)
    'jumping: no risk (slack tension: 5 N needed, 60 N there)'
    >>> jumping(4e-6, 60.0)
    'jumping: no risk (slack tension: below 0.6 N needed, 60 N there)'
    """
    amount = slack_needed(needed, limit)
    margin = jumping_margin(needed, limit)
    return f"jumping: {margin} (slack tension: {amount} N needed, {grouped(limit, 3)} N {whose})"


def jumping_margin(needed: float, limit: float) -> str:
    """Return the margin against jumping: no risk from twice the needed slack tension on.

    Examples
    --------
    >>> jumping_margin(4e-6, 60.0), jumping_margin(50.0, 56.0), jumping_margin(60.0, 60.0)
    ('no risk', '12 % more than needed', 'no margin')
    """
    if needed >= limit * (1.0 - 1e-9):
        return "no margin"
    if _SAFE * needed <= limit:
        return SAFE
    return f"{grouped(100.0 * (limit / needed - 1.0), 2)} % more than needed"


def slack_needed(needed: float, limit: float) -> str:
    """Return the slack tension below which a chain jumps, without digits where it is next to none."""
    far = limit / FAR_FROM_JUMPING
    return grouped(needed, 3) if needed > far else f"below {grouped(far, 2)}"


def answer(result: WearResult, source: str, explain: bool = False) -> str:
    """Return the answer to one sprocket or gears in words, on request with all that it rests on."""
    found = findings(result)
    if explain:
        found += [Finding("Band from", result.band), *_explained(result)]
        assumes = numbered_assumptions(result.assumptions)
    else:
        short = {LIMITS: _limits_in_short(result)}
        found = [one._replace(text=short.get(one.label, one.text)) for one in found if one.label != REMOVED]
        assumes = counted_assumptions(result.assumptions)
    return answer_text(
        result.title,
        *found,
        Finding("Assumes", assumes),
        Finding("Warnings", "; ".join(result.warnings) or "none"),
        Finding("Next", f"{_compare(result, source)}     (pictures)"),
    )


def _explained(result: WearResult) -> list[Finding]:
    """Return what ends first, each published rule and what happens when, of a chain."""
    if result.practice is None:
        return []
    return chain_findings(result.ends, result.practice, result.events)


def chain_findings(
    ends: Sequence[PartEnd], practice: SecondOpinions, events: Sequence[Event]
) -> list[Finding]:
    """Return a line for everything that may end a part, for every published rule and for every event."""
    rows = {
        "Ends": [", ".join(cell for cell in row if cell != "-") for row in end_rows(ends)],
        "Rules": [
            f"{rule}: {told} ({trust}{f'; {why}' if why != '-' else ''})"
            for rule, told, trust, why in rule_rows(practice)
        ],
        "Events": [
            f"{told}{f' ({day})' if day != '-' else ''}: {part} {what}"
            for told, day, part, what in event_rows(events)
        ],
    }
    return [
        Finding("" if i else label, text) for label, texts in rows.items() for i, text in enumerate(texts)
    ]


def page_findings(result: WearResult) -> list[Finding]:
    """Return the findings that a page lists: band, limits and overload have places of their own there."""
    return [one for one in findings(result) if one.label not in (BAND, LIMITS, OVERLOADED)]


def findings(result: WearResult) -> list[Finding]:
    """Return what a run has found, the life first; before it that the drive is overloaded."""
    service = service_text(result.inputs, result.life)
    return [
        *((Finding(OVERLOADED, overload_text(result)),) if result.overloaded else ()),
        Finding("Life", _life(result)),
        Finding(BAND, _band(result)),
        *((Finding("Practice", practice_line(result)),) if result.practice else ()),
        *((Finding("In service", service),) if service else ()),
        *((Finding("Governs", governing_text(result)),) if result.fatigue else ()),
        *_parts(result),
        Finding("Worn most", _worst(result)),
        Finding(REMOVED, _removed(result)),
    ]


def overload_text(result: WearResult) -> str:
    """Return by how much a drive is outside the ratings of its load."""
    if not result.overloaded:
        return ""
    used = ", ".join(used_text(finding) for finding in result.overloaded if not finding.at_least)
    short = [used_text(finding) for finding in result.overloaded if finding.at_least]
    found = "; ".join([f"{used} of the rating"] * bool(used) + short)
    counts = pressure_that_counts(result)
    found += f"; {counts}, which counts for published rules" if counts else ""
    if wear_only(result.ends):
        return f"{found}; life counts wear only, fatigue may end it sooner"
    return f"{found}; plate fatigue may end it sooner"


def pressure_that_counts(result: WearResult) -> str:
    """Say which joint pressure counts for practice where that with K_e alone is above twice [p]."""
    application = result.inputs.get("drive", {}).get("joint_application_factor", 1.0)
    twice = [one for one in result.overloaded if one.name == "joint pressure" and one.used > 2.0]
    if not twice or result.practice is None or result.practice.outside:
        return ""
    return f"without K_e {grouped(100.0 * twice[0].used / application)} %"


def used_text(finding: RatingFinding) -> str:
    """Return in words how far a rating is used.

    Examples
    --------
    >>> used_text(RatingFinding("joint pressure", 27.0, 22.5, "MPa", "GOST practice", "indicative"))
    'joint pressure (indicative) 120 %'
    >>> used_text(RatingFinding("safety", 6.0, 7.0, "", "iwis", at_least=True))
    'safety 6, at least 7'
    """
    kind = "for information" if finding.informs else "indicative"
    name = f"{finding.name} ({kind})" if finding.note else finding.name
    if finding.at_least:
        return f"{name} {finding.value:.3g}, at least {finding.limit:.3g}"
    return f"{name} {grouped(100.0 * finding.used)} %"


def _removed(result: WearResult) -> str:
    if not result.removed_area > _LEAST_AREA:
        return "below the resolution of the flank coordinates"
    closes = abs(result.worn_area / result.removed_area - 1.0)
    return (
        f"{result.removed_area:.4g} mm2 between new and worn outline, {result.worn_area:.4g} mm2 summed "
        f"over the wear: closes to {max(closes, 1e-15):.1g}"
    )


def governing_text(result: WearResult) -> str:
    """Return which of wear and contact fatigue comes first, and the others."""
    lives = {
        "wear": hours(result.life),
        **{
            f"contact fatigue of the {name.removesuffix('_fatigue')}": _endured(life)
            for name, life in result.fatigue.items()
        },
    }
    names = dict(zip(("wear", *result.fatigue), lives, strict=True))
    if result.governing is None:
        known = ", ".join(f"{name} {life}" for name, life in lives.items())
        return f"nothing within {grouped(result.life.hours_run)} h: {known}"
    first = names[result.governing]
    others = ", ".join(f"{name} {life}" for name, life in lives.items() if name != first)
    return f"{first}, {lives[first]} ({others})"


def _endured(life: Life | LowerBound) -> str:
    if isinstance(life, LowerBound):
        return "never"
    return hours(life) if life.hours > 0.0 else "from the start"


def _parts(result: WearResult) -> list[Finding]:
    """Lives of chain and sprocket, and how far every limit is used when the life ends."""
    if len(result.limits) < 2:
        return []
    used = ", ".join(limit_state(state, result.inputs) for state in result.limits)
    limits = [Finding(LIMITS, f"{_AT_END} {used}")]
    if "chain" not in result.parts:
        return limits
    lives = ", ".join(f"{name} {hours(result.parts[name])}" for name in ("chain", "sprocket"))
    chains = int(result.history_columns["chain"][-1])
    more = f" with {chains} chains, each replaced at its limit" if chains > 1 else ""
    return [Finding("Of which", f"{lives}{more}"), *limits]


def _limits_in_short(result: WearResult) -> str:
    """Say how far every limit is used, of jumping only whether it is safe."""
    used = ", ".join(
        f"jumping: {jumping_margin(state.value, state.limit)}"
        if state.name == JUMPING
        else limit_state(state, result.inputs)
        for state in result.limits
    )
    return f"{_AT_END} {used}"


def service_text(inputs: Mapping[str, Any], life: Life | LowerBound, before: float = 0.0) -> str:
    """Return a life in the measures that a case gives factors for, in words."""
    bound = isinstance(life, LowerBound)
    text = ", ".join(
        f"{'beyond' if bound else 'until'} {value}" if isinstance(value, str) else _measure(name, value)
        for name, value in service_measures(inputs, life.hours_run, before).items()
    )
    return f"more than {text}" if text and bound else text


def _measure(name: str, value: float) -> str:
    if name == "days" and value >= DAYS_OF_YEAR:
        return years_and_months(value)
    return f"{grouped(value)} {name}"


def years_and_months(days: float) -> str:
    """Return days as years and months, months of the twelfth of a year.

    Examples
    --------
    >>> years_and_months(2082.0), years_and_months(366.0), years_and_months(729.0)
    ('5 years 8 months', '1 year', '2 years')
    """
    years, months = divmod(round(12.0 * days / DAYS_OF_YEAR), 12)
    counted = {"year": years, "month": months}
    return " ".join(f"{n} {unit}{'' if n == 1 else 's'}" for unit, n in counted.items() if n)


def ending(result: WearResult) -> str:
    """Return in words what ended a life, or what is worn off where nothing did."""
    if not isinstance(result.life, Life):
        return f"{result.max_depth:.3g} mm is worn off by then"
    row, value = STOP_LIMITS[result.stop], result.stop_value
    words = row.ending if result.stop in result.inputs["stop"] or not row.ending_unset else row.ending_unset
    return words.format(value=value, depth=_depth(value))


def _life(result: WearResult) -> str:
    """Return what ends first, with what stands against its hours in the same line."""
    text, first = _wear_life(result), before_wear(result.ends)
    if first is not None:
        text = f"{hours(first.life)} by {first.mode} of the {first.part}; by wear {text}"
    if result.practice is not None and result.practice.outside:
        text = f"outside any published practice ({result.practice.outside}): {text}"
    beyond = beyond_ratings(result.overloaded)
    return f"{text}; {beyond}, which may end it sooner" if beyond else text


def _wear_life(result: WearResult) -> str:
    speed = f"{result.speed_rpm:g} rpm"
    if isinstance(result.life, Life):
        error = result.numerical_error
        bound = max(error, result.life_tolerance)
        sign = "<" if error <= result.life_tolerance else "about"
        whose = " of the sprocket's life" if result.stop == "elongation_percent" else ""
        return (
            f"{hours(result.life)}   ({result.life.cycles:.3g} cycles at {speed}) {ending(result)}; "
            f"numerical error{whose} {sign} {100 * bound:.2g} %"
        )
    return (
        f"{hours(result.life)} (limit not reached)   ({result.cycles_run:.3g} cycles at {speed}); "
        f"{ending(result)}"
    )


def _depth(value: float) -> str:
    return f"{value:.3f}" if value >= 0.1 else f"{value:.3g}"


def _compare(result: WearResult, source: str) -> str:
    return shlex.join(["wearsim", "compare", source, "--out", f"reports/{result.case}"])


def _band(result: WearResult) -> str:
    low, high = hours(result.life_low), hours(result.life_high)
    return f"{low} to {high}, over the band of the wear rate"


def _worst(result: WearResult) -> str:
    length = float(result.flank_columns["arc_length_mm"][-1])
    place = f"at {result.max_depth_arc_length:.1f} mm of {length:.1f} mm"
    kind = result.inputs["mechanism"]["kind"]
    if kind == "strand":
        side = "entry" if result.max_depth_arc_length > 0.5 * length else "exit"
        place = f"{result.max_depth_arc_length:.1f} mm from the root (flank {length:.1f} mm), {side} side"
    if kind == "gear_pair":
        place = f"pinion, {place} from the start of contact to its tip"
    if kind == "wrap":
        place = f"{_depth(result.max_depth)} mm {place} from the gap's right tip"
        if result.life.hours_run < result.hours_run:
            place += f", after {grouped(result.hours_run)} h"
    pressures = f"{result.initial_peak_pressure:.0f} -> {result.final_peak_pressure:.0f} MPa"
    return f"{place}; peak pressure {pressures}"


def grid_json(grid: "GridStudy") -> dict[str, Any]:
    """Return a study of three grids as ``wearsim life --verify-grid --json`` prints it."""
    return {
        "nodes": list(grid.points),
        "quantity": grid.quantity,
        "values": list(grid.values),
        "order": None if math.isnan(grid.order) else grid.order,
        "error": grid.error if math.isfinite(grid.error) else None,
        "richardson": grid.extrapolates,
    }


def grid_text(grid: "GridStudy", sprocket: str = "") -> str:
    """Return a study of three grids as ``wearsim life --verify-grid`` prints it."""
    nodes = ", ".join(map(str, grid.points))
    values = ", ".join(f"{value:.7g}" for value in grid.values)
    unit = "cycles" if grid.quantity == "cycles" else "mm deep"
    if grid.extrapolates:
        found = f"order {grid.order:.2f}, Richardson error {grid.error:.1g}"
    else:
        order = "no order" if math.isnan(grid.order) else f"order {grid.order:.2g}"
        found = (
            f"{order} instead of {LEAST_ORDER:g} to {MAX_ORDER:g}, so no extrapolation: spread of the "
            f"three {grid.error:.1g}"
        )
    whose = f"{sprocket}, " if sprocket else ""
    return row("Grid", f"{whose}{nodes} nodes: {values} {unit}; {found}")
