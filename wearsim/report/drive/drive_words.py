"""What is found of a whole drive, in words."""

from collections.abc import Mapping, Sequence

from wearsim.chain.rating_findings import deciding, rated_for_hours
from wearsim.drive.drive_case import said_of_sprockets
from wearsim.drive.drive_result import DriveLife
from wearsim.drive.maintenance import DrivePlan, drive_plan, planned_events
from wearsim.drive.replacement_rules import Stop
from wearsim.quantities import grouped
from wearsim.report.answer import (
    JUMPING,
    SAFE,
    beyond_ratings,
    chain_findings,
    ending,
    jumping_margin,
    overload_text,
    service_text,
    used_text,
)
from wearsim.report.drive.plan_words import ordinal
from wearsim.report.text_lines import Finding, listed, stated_and_defaults
from wearsim.result import Life, LowerBound, WearResult
from wearsim.result.ends import CHAIN, before_wear, first_hours
from wearsim.result.lives import hours, service_measures
from wearsim.result.second_opinions import practice_text

Lives = Mapping[str, Life | LowerBound]

_TOGETHER = "Sprockets"
"""Label of several sprockets in one row."""

_MAX_ROWS = 3
"""Sprockets with a row of their own; the cogs of a cassette share one where there are more."""

_MAX_THEN = 2
"""Stops that are named after the first one."""


def drive_findings(found: DriveLife) -> list[Finding]:
    """Return the life of every part, what is replaced first, the band and the ratings."""
    return [
        Finding(CHAIN.capitalize(), "; ".join(filter(None, (part_text(found, CHAIN), against_hours(found))))),
        *(Finding(name, part_text(found, name)) for name in found.results),
        *failed_findings(found),
        Finding("First", first_text(drive_plan(found))),
        Finding("Band", band_text(found)),
        *([Finding("Practice", practice_text(found.practice))] if found.practice else []),
        Finding("Ratings", ratings_text(found)),
    ]


def practice_agrees(found: DriveLife) -> bool:
    """Return whether the published rules lie within the band of the chain."""
    return found.practice is None or found.practice.within(found.band(CHAIN))


def against_hours(found: DriveLife, only_worst: bool = False) -> str:
    """Return in words which ratings may end the chain before its hours; empty where it is within them."""
    overloaded = list(found.overloaded)
    if only_worst:
        rated = rated_for_hours(overloaded)
        overloaded = [max(rated, key=lambda finding: finding.used)] if rated else []
    return beyond_ratings(overloaded)


def outside_practice(found: DriveLife) -> str:
    """Return what stands before the hours of the chain where no published rule has been in use."""
    return "outside any published practice: " if found.practice is not None and found.practice.outside else ""


def explained_findings(found: DriveLife) -> list[Finding]:
    """Return a line for everything that may end a part, for every published rule and for every event."""
    if found.practice is None:
        return []
    return chain_findings(found.ends, found.practice, planned_events(drive_plan(found)))


def failed_findings(found: DriveLife) -> list[Finding]:
    """Return the sprockets whose runs have failed, and why."""
    return [Finding(name, f"failed: {error}") for name, error in found.failed.items()]


def grouped_parts(found: DriveLife, most_rows: int) -> list[tuple[str, tuple[str, ...]]]:
    """Return labels of the sprockets, each with the names that share it.

    Where there are more than given, the cogs of a cassette share one; then all others; at last all do.
    """
    if len(found.results) <= most_rows:
        return [(name, (name,)) for name in found.results]
    cassettes = [
        (wheel.name, tuple(name for name in wheel.parts if name in found.results))
        for wheel in found.drive.wheels
        if wheel.cogs
    ]
    cassettes = [(name, cogs) for name, cogs in cassettes if cogs]
    in_cassette = {name for _, names in cassettes for name in names}
    single = tuple(name for name in found.results if name not in in_cassette)
    if len(single) + len(cassettes) <= most_rows:
        return [*((name, (name,)) for name in single), *cassettes]
    if 1 + len(cassettes) <= most_rows:
        return [(_TOGETHER, single), *cassettes]
    return [(_TOGETHER, tuple(found.results))]


def part_findings(found: DriveLife) -> list[Finding]:
    """Return the lives of chain and sprockets by their names, of many sprockets together."""
    rows = [Finding(CHAIN.capitalize(), part_text(found, CHAIN))]
    for label, names in grouped_parts(found, _MAX_ROWS):
        alone = names == (label,)
        text = part_text(found, label) if alone else lives_text(own_lives(found, label, names))
        rows.append(Finding(label, text))
    return [*rows, *failed_findings(found)]


def ratings_text(found: DriveLife) -> str:
    """Return in words whether a drive is within its ratings, and whether its chain may jump."""
    driver = found.reference
    rated = f"OVERLOADED: {overload_text(driver)}" if driver.overloaded else within_text(driver)
    return f"{rated}; {jumping_text(found)}"


def jumping_text(found: DriveLife) -> str:
    """Return in words whether the chain may jump, with the sprocket on which it is nearest to that."""
    name, margin = nearest_to_jumping(found)
    return f"jumping: {margin}" if margin == SAFE else f"jumping: {margin} on the {part_name(name)}"


def nearest_to_jumping(found: DriveLife) -> tuple[str, str]:
    """Return the sprocket on which the chain is nearest to jumping, and its margin in words."""
    states = {
        name: next(state for state in result.limits if state.name == JUMPING)
        for name, result in found.results.items()
    }
    nearest = max(states, key=lambda name: states[name].value / states[name].limit)
    return nearest, jumping_margin(states[nearest].value, states[nearest].limit)


def own_lives(found: DriveLife, label: str, names: Sequence[str]) -> Lives:
    """Return lives of sprockets under one label, of the cogs of a cassette without its name."""
    return {name.removeprefix(f"{label} "): found.parts[name] for name in names}


def lives_text(lives: Lives) -> str:
    """Return lives in words, those that are alike once, and which of them ends first.

    Examples
    --------
    >>> lives_text({"13T": Life(1e6, 1500.0), "15T": LowerBound(2e6, 4000.0), "17T": LowerBound(2e6, 4000.0)})
    '13T 1 500 h; 15T and 17T > 4 000 h: 13T fails first'
    """
    alike: dict[str, list[str]] = {}
    for name, life in lives.items():
        alike.setdefault(hours(life), []).append(name)
    text = "; ".join(f"{listed(names)} {life}" for life, names in alike.items())
    ended = {name: life.hours for name, life in lives.items() if isinstance(life, Life)}
    return f"{text}: {min(ended, key=ended.__getitem__)} fails first" if ended else text


def part_text(found: DriveLife, name: str) -> str:
    """Return the life of chain or sprocket in words, and what ends it."""
    return "   ".join(part_words(found, name))


def part_words(found: DriveLife, name: str) -> list[str]:
    """Return the life of chain or sprocket, in service if that is known, and what ends it."""
    life = found.parts[name]
    service = service_text(found.drive.driver.case.inputs, life)
    about = part_ending(found, name)
    if name != CHAIN:
        about = f"{found.results[name].inputs['sprocket']['teeth']} teeth, {about}"
    first = before_wear(found.ends, name)
    text = f"{hours(first.life)} by {first.mode}; by wear {hours(life)}" if first else hours(life)
    before = outside_practice(found) if name == CHAIN else ""
    return [f"{before}{text}", *([f"({service})"] if service else []), about]


def part_ending(found: DriveLife, name: str) -> str:
    """Return in words what ends the life of chain or sprocket, or that nothing does within the run."""
    reached = isinstance(found.parts[name], Life)
    if name == CHAIN:
        limit = 100.0 * found.drive.driver.drive.joint.elongation_limit
        return f"elongation {'' if reached else 'below '}{limit:.3g} %"
    result, chains = found.results[name], found.chains_with(name)
    text = _sprocket_ending(result) if reached else f"{result.max_depth:.3g} mm worn"
    return f"{text}, chain {chains}" if chains > 1 else text


def _sprocket_ending(result: WearResult) -> str:
    """Say by how much a sprocket is worn, or what else ended the run if the chain did not do so before."""
    if result.stop in ("critical_depth_mm", "elongation_percent"):
        return f"worn by {result.max_depth:.3g} mm"
    return ending(result)


def drive_headline(found: DriveLife) -> str:
    """Return when something is replaced first and what, with the word where the drive is overloaded."""
    text = first_hours(found.ends, found.life) + (f", {found.first} first" if found.first else "")
    if found.failed:
        text += f", no life known of {listed(list(found.failed))}"
    return f"{text} (overloaded)" if found.overloaded else text


def first_text(plan: DrivePlan) -> str:
    """Return in words what is replaced first, and what then, by the best rule of a plan."""
    stops = plan.first_stops
    unknown = f"; no life is known of {listed(list(plan.found.failed))}" if plan.found.failed else ""
    if not stops:
        return f"no replacement is due within {grouped(plan.until)} h{unknown}"
    first, *after = stops
    text = first_stop_text(plan, first, parts_in_words(first))
    then = ", ".join(stop_text(plan, stop, parts_in_words(stop)) for stop in after[:_MAX_THEN])
    more = f", and {len(after) - _MAX_THEN} more" if len(after) > _MAX_THEN else ""
    return f"{text}; then {then}{more}{unknown}" if then else f"{text}{unknown}"


def first_stop_text(plan: DrivePlan, first: Stop, parts: str) -> str:
    """Return in words when parts are replaced first, and on which day where that is known."""
    when = _in_service(plan, first.hours)
    text = f"replace {stop_text(plan, first, parts)}" + (f" ({when})" if when else "")
    every = {plan.best.every[name] for name in first.parts}
    return f"{text}, then every {grouped(first.hours)} h" if every == {first.hours} else text


def parts_in_words(stop: Stop) -> str:
    """Return the parts of a stop as a sentence names them."""
    return listed([f"the {part_name(name)}" for name in stop.parts])


def stop_text(plan: DrivePlan, stop: Stop, parts: str) -> str:
    """Return in words when parts are replaced, and with which chain where they go with one."""
    chain = plan.best.chain_at(stop.hours)
    with_chain = f" with the {ordinal(chain)} chain" if chain and CHAIN not in stop.parts else ""
    return f"{parts}{with_chain} at {grouped(stop.hours)} h"


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
    low, high = (hours(life) for life in found.band(banded_part(found)))
    return f"{low} to {high} for the {part_name(banded_part(found))}, over the band of its wear rate"


def banded_part(found: DriveLife) -> str:
    """Return whose band is shown: that of the part worn out first, of the first sprocket if none is."""
    return found.first_worn or next(iter(found.results))


def within_text(result: WearResult) -> str:
    """Return in words which rating of those that a drive keeps to is used most."""
    used = [one for one in result.ratings if not one.at_least and not one.name.startswith("elongation")]
    if not used:
        return "no rating applies"
    outside = [used_text(one) for one in used if not one.ok]
    decide = deciding(used) if outside else used
    most = max(decide, key=lambda finding: finding.used, default=None)
    which = "all of them" if not outside else f"those that decide, outside {', '.join(outside)}"
    return f"within {which}" + (f"; most used is {most.name}, {grouped(100.0 * most.used)} %" if most else "")


def band_source(found: DriveLife) -> str:
    """Return where the bands of the wear coefficients come from."""
    sources: dict[str, list[str]] = {}
    for name, result in found.results.items():
        sources.setdefault(result.band, []).append(name)
    if len(sources) == 1:
        return next(iter(sources))
    return "; ".join(f"{', '.join(names)}: {band}" for band, names in sources.items())


def worn_most_text(found: DriveLife) -> str:
    """Return in words on which sprocket, and where, the teeth are worn most."""
    deepest = max(found.results, key=lambda name: found.results[name].max_depth)
    return f"{deepest} {worn_text(found.results[deepest])} from the right tip"


def worn_text(result: WearResult) -> str:
    """Return in words how deep and where the teeth of a sprocket are worn."""
    length = float(result.flank_columns["arc_length_mm"][-1])
    return f"{result.max_depth:.3g} mm at {result.max_depth_arc_length:.1f} of {length:.1f} mm"


def taken_for_granted(found: DriveLife) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return what is taken for granted, and the defaults, each once with the sprockets it is about."""
    split = {name: stated_and_defaults(result.assumptions) for name, result in found.results.items()}
    stated, defaults = ({name: texts[kind] for name, texts in split.items()} for kind in (0, 1))
    wheels = found.drive.wheels
    return said_of_sprockets(stated, wheels), said_of_sprockets(defaults, wheels)
