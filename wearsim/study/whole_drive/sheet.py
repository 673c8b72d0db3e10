"""The answer for a whole drive, as text of a dozen lines and as JSON."""

from typing import Any

from wearsim.quantities import grouped
from wearsim.report.answer import ending, hours, overload_text, service_text
from wearsim.report.service import service_keys
from wearsim.report.text_lines import row, stated_and_defaults
from wearsim.result import Life, WearResult, life_keys
from wearsim.study.whole_drive.layout import layout_json
from wearsim.study.whole_drive.model import CHAIN, DriveLife

_MAX_WARNINGS = 1


def drive_text(found: DriveLife, source: str) -> str:
    """Return what ``wearsim life`` prints of a whole drive."""
    driver = found.results[found.drive.driver.name]
    rows = [
        (CHAIN.capitalize(), _part(found, CHAIN)),
        *((name, _part(found, name)) for name in found.results),
        ("First", first_text(found)),
        ("Band", _band(found)),
        ("Ratings", f"OVERLOADED: {overload_text(driver)}" if driver.overloaded else within_text(driver)),
        ("Worn most", _worn_most(found)),
        ("Warnings", _warnings(found)),
        ("Assumes", _assumes(found, source)),
    ]
    return "\n".join([found.drive.title, *(row(label, text) for label, text in rows)])


def _part(found: DriveLife, name: str) -> str:
    life = found.parts[name]
    text = hours(life)
    service = service_text(found.drive.inputs, life)
    if service:
        text += f"   ({service})"
    if name == CHAIN:
        return f"{text}   grown by {_elongation_limit(found):.3g} %"
    chains = found.chains_with(name)
    result = found.results[name]
    teeth = result.inputs["sprocket"]["teeth"]
    worn = sprocket_ending(result) if isinstance(life, Life) else f"{result.max_depth:.3g} mm worn by then"
    return f"{text}   {teeth} teeth, {worn}" + (f", chain {chains}" if chains > 1 else "")


def _elongation_limit(found: DriveLife) -> float:
    limits = found.results[found.drive.driver.name].limits
    return next(state.limit for state in limits if state.name == "elongation_percent")


def sprocket_ending(result: WearResult) -> str:
    """Return in words what ends the life of a sprocket."""
    state = next((one for one in result.limits if one.name == "critical_depth_mm"), None)
    if result.stop == "elongation_percent" and state is not None:
        return f"worn by {state.limit:.3g} mm"
    return ending(result)


def first_text(found: DriveLife) -> str:
    """Return in words what is replaced first, and what then."""
    if not found.first:
        return f"nothing is to be replaced within {hours(found.life).lstrip('> ')}"
    after = sorted(
        (life.hours, name)
        for name, life in found.parts.items()
        if isinstance(life, Life) and name != found.first
    )
    text = f"replace the {part_name(found.first)} at {hours(found.life)}"
    if found.first == CHAIN:
        text += " and again after each such time"
    then = ", ".join(f"the {part_name(name)} at {grouped(life)} h" for life, name in after)
    return f"{text}; then {then}" if then else text


def part_name(name: str) -> str:
    """Return what a part is called in a sentence."""
    return name if name == CHAIN else f"sprocket {name!r}"


def _band(found: DriveLife) -> str:
    whose = found.first or next(iter(found.results))
    low, high = (hours(life) for life in found.band(whose))
    return f"{low} to {high} for the {part_name(whose)}, over the band of its wear coefficient"


def within_text(result: WearResult) -> str:
    """Return in words which rating of those that a drive keeps to is used most."""
    used = [one for one in result.ratings if not one.at_least and not one.name.startswith("elongation")]
    if not used:
        return "no rating applies"
    most = max(used, key=lambda finding: finding.used)
    return f"within all of them; most used is {most.name}, {grouped(100.0 * most.used)} %"


def _worn_most(found: DriveLife) -> str:
    places = "; ".join(f"{name} {_worn(result)}" for name, result in found.results.items())
    return f"{places} from the gap's right tip"


def _worn(result: WearResult) -> str:
    length = float(result.flank_columns["arc_length_mm"][-1])
    return f"{result.max_depth:.3g} mm at {result.max_depth_arc_length:.1f} of {length:.1f} mm"


def _warnings(found: DriveLife) -> str:
    # What is outside of a rating stands beside the ratings.
    warnings = [text for text in found.warnings if not text.startswith("outside a rating")]
    if not warnings:
        return "none"
    shown = warnings[:_MAX_WARNINGS]
    more = len(warnings) - len(shown)
    return "; ".join(shown) + (f"; and {more} more (--json)" if more else "")


def _assumes(found: DriveLife, source: str) -> str:
    each = tuple(dict.fromkeys(text for result in found.results.values() for text in result.assumptions))
    stated, defaults = stated_and_defaults(each)
    return f"{len(stated)} assumptions and {len(defaults)} defaults: wearsim check {source}"


def drive_json(found: DriveLife) -> dict[str, Any]:
    """Return what ``wearsim life --json`` prints of a whole drive."""
    drive = found.drive
    return {
        "schema_version": 1,
        "case": drive.name,
        "title": drive.title,
        **life_keys("life_hours", found.life),
        "first": found.first or None,
        **life_keys("chain_life_hours", found.chain),
        **service_keys(drive.inputs, found.life),
        "overloaded": bool(found.overloaded),
        "sprockets": [
            {"name": name, **result.summary(), "chains": found.chains_with(name)}
            for name, result in found.results.items()
        ],
        "layout": layout_json(drive),
        "warnings": list(found.warnings),
    }
