"""What ``wearsim life`` prints of a whole drive: twelve lines, on request all that they rest on."""

import shlex

from wearsim.drive.drive_result import DriveLife
from wearsim.drive.maintenance import DrivePlan, drive_plan
from wearsim.drive.replacement_rules import Stop
from wearsim.report.answer import pressure_that_counts, used_text
from wearsim.report.drive.drive_words import (
    Lives,
    against_hours,
    band_source,
    band_text,
    drive_findings,
    explained_findings,
    failed_findings,
    first_stop_text,
    first_text,
    grouped_parts,
    jumping_text,
    lives_text,
    nearest_to_jumping,
    own_lives,
    part_words,
    parts_in_words,
    practice_agrees,
    stop_text,
    taken_for_granted,
    within_text,
    worn_most_text,
    worn_text,
)
from wearsim.report.text_lines import Finding, answer_text, counted, listed, numbered, row
from wearsim.result import Life
from wearsim.result.ends import CHAIN, wear_only
from wearsim.result.lives import hours
from wearsim.result.second_opinions import span_text

_MAX_LINES, _TITLE_ASSUMES_NEXT = 12, 3
_MAX_ROWS = 2
"""Rows for sprockets: with them, and one line each for all else, the answer is full."""

_MAX_NAMED = 3
"""Sprockets that are named where many share a row."""


def drive_text(found: DriveLife, source: str, explain: bool = False) -> str:
    """Return what ``wearsim life`` prints of a whole drive, on request with all that it rests on."""
    command = shlex.join(["wearsim", "report", source, "--out", "sheet.html"])
    rows = _all_findings(found) if explain else _short_rows(found)
    return answer_text(found.drive.title, *rows, Finding("Next", command.replace(" ", "\u00a0")))


def _all_findings(found: DriveLife) -> list[Finding]:
    places = "; ".join(f"{name} {worn_text(result)}" for name, result in found.results.items())
    return [
        *drive_findings(found),
        Finding("Worn most", f"{places} from the right tip"),
        Finding("Band from", band_source(found)),
        *explained_findings(found),
        Finding("Warnings", "; ".join(found.warnings) or "none"),
        Finding("Assumes", numbered(*taken_for_granted(found))),
    ]


def _short_rows(found: DriveLife) -> list[str]:
    """Return a line for each finding; a warning takes the lines that are left."""
    before = [
        *_part_rows(found),
        *_stop_rows(drive_plan(found)),
        _line("Band", *_band(found)),
        _line("Ratings", *_ratings(found)),
        _line("Worn most", *_worn_most(found)),
    ]
    assumes = row("Assumes", counted(*taken_for_granted(found)))
    left = _MAX_LINES - _TITLE_ASSUMES_NEXT - len(before)
    return [*before, row("Warnings", _first_warning(found.warnings), max(left, 1)), assumes]


def _band(found: DriveLife) -> list[str]:
    """Return the band, with what published rules say where that is outside of it; then less of it."""
    whole = band_text(found)
    short, practice = whole.partition(",")[0], found.practice
    if practice is None or practice.span is None or practice_agrees(found):
        return [whole, short]
    shocks = f" with f1 = {practice.shock_factor:g}" if practice.shock_factor != 1.0 else ""
    whose = "" if found.first_worn == CHAIN else "chain "
    rules = f"{short}; {whose}by published rules{shocks} {span_text(practice.span)}"
    return [rules, f"{short}; published rules{shocks} differ"]


def _line(label: str, *forms: str) -> str:
    """Return the first of some texts that fits on a line; where none does, the last one is cut."""
    lines = (row(label, form) for form in forms)
    return next((line for line in lines if "\n" not in line), row(label, forms[-1], 1))


def _part_rows(found: DriveLife) -> list[str]:
    rows = [_line(CHAIN.capitalize(), *_chain(found))]
    for label, names in grouped_parts(found, _MAX_ROWS):
        alone = names == (label,)
        rows.append(_line(label, *(_part(found, label) if alone else _lives(own_lives(found, label, names)))))
    return [*rows, *(row(label, text, 1) for label, text in failed_findings(found))]


def _chain(found: DriveLife) -> list[str]:
    """Return the life of the chain with what stands against its hours in the same line; then less of it."""
    against, worst = against_hours(found), against_hours(found, only_worst=True)
    if not against:
        return _part(found, CHAIN)
    forms = _part(found, CHAIN)
    first = forms[-1].partition("; by wear")[0]
    lines = [f"{form}; {why}" for why in (against, worst) for form in (*forms, first)]
    return [*lines, f"{first}; beyond its rating"]


def _part(found: DriveLife, name: str) -> list[str]:
    """Return the life of a part, in service, and what ends it; then less and less of that."""
    life, *service, ending = part_words(found, name)
    short = ending.partition(", ")[2] or ending
    forms = [life, *service, ending], [life, *service, short], [life, ending], [life]
    return ["   ".join(words) for words in forms]


def _lives(lives: Lives) -> list[str]:
    """Return several lives, then fewer and fewer of those that end first, with the range of the others."""
    ordered = sorted(lives, key=lambda name: lives[name].hours_run)
    ended = [name for name in ordered if isinstance(lives[name], Life)][:_MAX_NAMED]
    if not ended:
        return [lives_text(lives), f"all {len(lives)} {hours(lives[ordered[0]])}"]
    forms = [lives_text(lives)]
    for count in range(len(ended), 0, -1):
        first, *after = ended[:count]
        then = "".join(f", then {name} at {hours(lives[name])}" for name in after)
        rest = [hours(lives[name]) for name in ordered if name not in ended[:count]]
        others = f"; {len(rest)} more, {' to '.join(dict.fromkeys((rest[0], rest[-1])))}" if rest else ""
        forms.append(f"{first} fails first, at {hours(lives[first])}{then}{others}")
    return forms


def _stop_rows(plan: DrivePlan) -> list[str]:
    """Return what is replaced first, and what then."""
    stops = plan.first_stops
    if not stops:
        return [_line("First", first_text(plan))]
    first, *after = stops
    rows = [_line("First", *(first_stop_text(plan, first, parts) for parts in _called(first)))]
    texts = [stop_text(plan, stop, listed(stop.parts)) for stop in after]
    if texts:
        fewer = [f"{', '.join(texts[:-n])}, and {n} more" for n in range(1, len(texts))]
        rows.append(_line("Then", ", ".join(texts), *fewer, f"{len(texts)} more stops"))
    return rows


def _called(stop: Stop) -> list[str]:
    """Return the parts of a stop in words, by their names alone, and as a number."""
    return [parts_in_words(stop), listed(stop.parts), f"{len(stop.parts)} parts"]


def _ratings(found: DriveLife) -> list[str]:
    """Return whether the drive is within its ratings, and the worst of those that it is outside of."""
    driver = found.reference
    if not driver.overloaded:
        return [within_text(driver), within_text(driver).partition(";")[0]]
    worst = used_text(max(driver.overloaded, key=lambda finding: finding.used))
    others = len(driver.overloaded) - 1
    over = f"OVERLOADED: {worst}" + (f" and {others} more" if others else "")
    counts = pressure_that_counts(driver)
    whole = f"{over}; {counts}" if counts else over
    more = "life counts wear only" if wear_only(found.ends) else "plates may fail sooner"
    return [f"{whole}; {more}", whole, over]


def _worn_most(found: DriveLife) -> list[str]:
    """Return where the teeth are worn most, and whether the chain may jump on them."""
    worn, (name, margin) = worn_most_text(found), nearest_to_jumping(found)
    place = worn.removesuffix(" from the right tip")
    return [
        f"{worn}; {jumping_text(found)}",
        f"{place}; jumping: {margin} on {name}",
        f"{place}; jumping: {margin}",
        f"jumping: {margin}",
    ]


def _first_warning(warnings: tuple[str, ...]) -> str:
    """Return the first of some warnings, and how many there are."""
    if not warnings:
        return "none"
    return warnings[0] if len(warnings) == 1 else f"{len(warnings)} (--explain), the first: {warnings[0]}"
