"""The answer for a whole drive, as text of a dozen lines and as JSON."""

import shlex
from collections.abc import Sequence
from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped
from wearsim.report.answer import JUMPING, SAFE, ending, hours, jumping_margin, overload_text, service_text
from wearsim.report.service import service_keys, service_measures
from wearsim.report.text_lines import counted, numbered, row, stated_and_defaults
from wearsim.result import Life, WearResult, life_keys
from wearsim.study.whole_drive.layout import layout_json
from wearsim.study.whole_drive.maintenance import DrivePlan, drive_plan
from wearsim.study.whole_drive.model import CHAIN, DriveLife
from wearsim.study.whole_drive.plan import Stop
from wearsim.study.whole_drive.said_of_sprockets import said_of_sprockets

_MAX_WARNINGS = 1
_MAX_ROWS = 3
"""Sprockets with a row of their own; the cogs of a cassette share one where there are more."""
_MAX_THEN = 2
"""Stops that are named after the first one."""


def drive_text(found: DriveLife, source: str, explain: bool = False) -> str:
    """Return what ``wearsim life`` prints of a whole drive, on request with all that it rests on."""
    rows = [
        *found_rows(found, explain),
        ("Worn most", worn_most_text(found, explain)),
        *((("Band from", _band_source(found)),) if explain else ()),
        ("Warnings", _warnings(found, explain)),
        ("Assumes", (numbered if explain else counted)(*taken_for_granted(found))),
        ("Next", shlex.join(["wearsim", "report", source, "--out", "sheet.html"])),
    ]
    return "\n".join([found.drive.title, *(row(label, text) for label, text in rows)])


def found_rows(found: DriveLife, explain: bool = False) -> list[tuple[str, str]]:
    """Return lives, what is replaced first, the band and the ratings, on request of every cog for itself."""
    return [
        *part_rows(found, explain),
        ("First", first_text(drive_plan(found))),
        ("Band", band_text(found)),
        ("Ratings", ratings_text(found)),
    ]


def part_rows(found: DriveLife, explain: bool = False) -> list[tuple[str, str]]:
    """Return the lives of chain and sprockets by their names, on request of every cog for itself."""
    return [
        (CHAIN.capitalize(), _part(found, CHAIN)),
        *(_all_sprockets(found) if explain else _sprockets(found)),
    ]


def ratings_text(found: DriveLife) -> str:
    """Return in words whether a drive is within its ratings, and whether its chain may jump."""
    driver = found.results[found.drive.driver.name]
    rated = f"OVERLOADED: {overload_text(driver)}" if driver.overloaded else within_text(driver)
    return f"{rated}; {jumping_text(found)}"


def jumping_text(found: DriveLife) -> str:
    """Return in words whether the chain may jump, with the sprocket on which it is nearest to that."""
    states = {
        name: next(state for state in result.limits if state.name == JUMPING)
        for name, result in found.results.items()
    }
    nearest = max(states, key=lambda name: states[name].value / states[name].limit)
    margin = jumping_margin(states[nearest].value, states[nearest].limit)
    return f"jumping: {margin}" if margin == SAFE else f"jumping: {margin} on the {part_name(nearest)}"


def _all_sprockets(found: DriveLife) -> list[tuple[str, str]]:
    return [(name, _part(found, name)) for name in found.results]


def _sprockets(found: DriveLife) -> list[tuple[str, str]]:
    """Return a row for each of few sprockets; of more, the cogs of a cassette share one, then all others."""
    if len(found.results) <= _MAX_ROWS:
        return _all_sprockets(found)
    cogs = {wheel.name: wheel.parts for wheel in found.drive.wheels if wheel.cogs}
    in_cassette = {name for names in cogs.values() for name in names}
    single = [name for name in found.results if name not in in_cassette]
    together = [
        (name, _lives(found, names, [one.removeprefix(f"{name} ") for one in names]))
        for name, names in cogs.items()
    ]
    if len(single) + len(together) <= _MAX_ROWS:
        return [*((name, _part(found, name)) for name in single), *together]
    return [("Sprockets", _lives(found, single, single)), *together]


def _lives(found: DriveLife, names: Sequence[str], shown: Sequence[str]) -> str:
    """Return the lives of several sprockets, and which of them dies first."""
    parts = found.parts
    text = ", ".join(f"{label} {hours(parts[name])}" for name, label in zip(names, shown, strict=True))
    ended = {
        label: life.hours
        for name, label in zip(names, shown, strict=True)
        if isinstance(life := parts[name], Life)
    }
    return f"{text}: {min(ended, key=ended.__getitem__)} dies first" if ended else text


def _part(found: DriveLife, name: str) -> str:
    life = found.parts[name]
    text = hours(life)
    service = service_text(found.drive.driver.case.inputs, life)
    if service:
        text += f"   ({service})"
    if name == CHAIN:
        return f"{text}   {part_ending(found, name)}"
    return f"{text}   {found.results[name].inputs['sprocket']['teeth']} teeth, {part_ending(found, name)}"


def part_ending(found: DriveLife, name: str) -> str:
    """Return in words what ends the life of chain or sprocket, or that nothing does within the run."""
    reached = isinstance(found.parts[name], Life)
    if name == CHAIN:
        limit = 100.0 * found.drive.driver.drive.joint.elongation_limit
        return f"{'' if reached else 'not yet '}grown by {limit:.3g} %"
    result, chains = found.results[name], found.chains_with(name)
    text = _sprocket_ending(result) if reached else f"{result.max_depth:.3g} mm worn"
    return f"{text}, chain {chains}" if chains > 1 else text


def _sprocket_ending(result: WearResult) -> str:
    """Say by how much a sprocket is worn, or what else ended the run if the chain did not do so before."""
    if result.stop in ("critical_depth_mm", "elongation_percent"):
        return f"worn by {result.max_depth:.3g} mm"
    return ending(result)


def first_text(plan: DrivePlan) -> str:
    """Return in words what is replaced first, and what then, by the best rule of a plan."""
    stops = plan.first_stops
    if not stops:
        return f"nothing is to be replaced within {grouped(plan.until)} h"
    first, *after = stops
    when = _in_service(plan, first.hours)
    text = f"replace {_parts_at(plan, first)}" + (f" ({when})" if when else "")
    if first.parts == (CHAIN,):
        text += " and again after each such time"
    then = ", ".join(_parts_at(plan, stop) for stop in after[:_MAX_THEN])
    more = f", and {len(after) - _MAX_THEN} more" if len(after) > _MAX_THEN else ""
    return f"{text}; then {then}{more}" if then else text


def _parts_at(plan: DrivePlan, stop: Stop) -> str:
    names = " and ".join(f"the {part_name(name)}" for name in stop.parts)
    chain = plan.chain_at(stop.hours)
    with_chain = f" with chain {chain}" if chain and CHAIN not in stop.parts else ""
    return f"{names}{with_chain} at {grouped(stop.hours)} h"


def _in_service(plan: DrivePlan, at: float) -> str:
    """Return on which day hours of running are over; how long that is where no day is known to begin."""
    inputs = plan.drive.driver.case.inputs
    day = service_measures(inputs, at).get("date")
    return str(day) if day else service_text(inputs, Life(0.0, at))


def part_name(name: str) -> str:
    """Return what a part is called in a sentence."""
    return name if name == CHAIN else f"sprocket {name!r}"


def band_text(found: DriveLife) -> str:
    """Return in words how sure the first life is."""
    low, high = (hours(life) for life in found.band(_banded(found)))
    return f"{low} to {high} for the {part_name(_banded(found))}, over the band of its wear coefficient"


def _banded(found: DriveLife) -> str:
    """Return whose band is shown: that of the part that ends first, of the first sprocket if none does."""
    return found.first or next(iter(found.results))


def within_text(result: WearResult) -> str:
    """Return in words which rating of those that a drive keeps to is used most."""
    used = [one for one in result.ratings if not one.at_least and not one.name.startswith("elongation")]
    if not used:
        return "no rating applies"
    most = max(used, key=lambda finding: finding.used)
    return f"within all of them; most used is {most.name}, {grouped(100.0 * most.used)} %"


def _band_source(found: DriveLife) -> str:
    sources: dict[str, list[str]] = {}
    for name, result in found.results.items():
        sources.setdefault(result.band, []).append(name)
    if len(sources) == 1:
        return next(iter(sources))
    return "; ".join(f"{', '.join(names)}: {band}" for band, names in sources.items())


def worn_most_text(found: DriveLife, explain: bool = False) -> str:
    """Return in words where the teeth are worn most, on request of every sprocket."""
    results = found.results
    if not explain:
        deepest = max(results, key=lambda name: results[name].max_depth)
        return f"{deepest} {_worn(results[deepest])} from the right tip"
    places = "; ".join(f"{name} {_worn(result)}" for name, result in results.items())
    return f"{places} from the right tip"


def _worn(result: WearResult) -> str:
    length = float(result.flank_columns["arc_length_mm"][-1])
    return f"{result.max_depth:.3g} mm at {result.max_depth_arc_length:.1f} of {length:.1f} mm"


def _warnings(found: DriveLife, explain: bool) -> str:
    warnings = found.doubts
    if explain or not warnings:
        return "; ".join(warnings) or "none"
    shown = warnings[:_MAX_WARNINGS]
    more = len(warnings) - len(shown)
    return "; ".join(shown) + (f"; and {more} more (--explain)" if more else "")


def taken_for_granted(found: DriveLife) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return what is taken for granted, and the defaults, each once with the sprockets it is about."""
    split = {name: stated_and_defaults(result.assumptions) for name, result in found.results.items()}
    stated, defaults = ({name: texts[kind] for name, texts in split.items()} for kind in (0, 1))
    wheels = found.drive.wheels
    return said_of_sprockets(stated, wheels), said_of_sprockets(defaults, wheels)


def drive_json(found: DriveLife) -> dict[str, Any]:
    """Return what ``wearsim life --json`` prints of a whole drive."""
    drive, (low, high) = found.drive, found.band(_banded(found))
    return {
        **ANSWER_HEAD,
        "case": drive.name,
        "title": drive.title,
        **life_keys("life_hours", found.life),
        **life_keys("life_hours_low", low),
        **life_keys("life_hours_high", high),
        "first": found.first or None,
        **life_keys("chain_life_hours", found.chain),
        **service_keys(drive.driver.case.inputs, found.life),
        "overloaded": bool(found.overloaded),
        "sprockets": [
            {"name": name, **result.summary(), "chains": found.chains_with(name)}
            for name, result in found.results.items()
        ],
        "layout": layout_json(drive),
        "warnings": list(found.warnings),
    }
