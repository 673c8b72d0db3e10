"""A plan of replacements in words."""

from wearsim.drive.renewal import Cycle, cycles_in_life
from wearsim.drive.replacement_rules import ReplacementRule
from wearsim.quantities import grouped
from wearsim.report.text_lines import listed
from wearsim.result.ends import CHAIN

_MAX_STOPS = 6
"""Stops of a part that are named; of more only their number is said."""


def ordinal(number: int) -> str:
    """Return a number as one counts.

    Examples
    --------
    >>> [ordinal(number) for number in (1, 2, 3, 4, 11, 22, 113)]
    ['1st', '2nd', '3rd', '4th', '11th', '22nd', '113th']
    """
    teens = number % 100 in (11, 12, 13)
    return f"{number}{'th' if teens else {1: 'st', 2: 'nd', 3: 'rd'}.get(number % 10, 'th')}"


def rule_text(rule: ReplacementRule) -> str:
    """Return in words when each part is replaced by a rule.

    Examples
    --------
    >>> from wearsim.drive.replacement_rules import replacement_rules
    >>> for rule in replacement_rules(1000.0, {"driver": 900.0, "roll": 9950.0})[:2]:
    ...     rule_text(rule)
    'chain every 1 000 h, driver every 900 h, roll every 9 950 h'
    'chain and driver every 900 h, roll at every 11th chain change'
    """
    if rule.cycle is None:
        return ", ".join(
            f"{name} {'not before' if name in rule.at_most else 'every'} {grouped(hours)} h"
            for name, hours in rule.every.items()
        )
    texts = [_cycle_text(rule.cycle), *_later(rule, rule.cycle)]
    return ", ".join(texts)


def _cycle_text(cycle: Cycle) -> str:
    """Return in words what is replaced in a cycle, and what in some of them only."""
    seldom: dict[int, list[str]] = {}
    for name, every in cycle.every.items():
        seldom.setdefault(every, []).append(name)
    each, hours = seldom.pop(1), f"{grouped(cycle.hours)} h"
    if cycle.within:
        stops: dict[str, list[str]] = {}
        for name in each:
            stops.setdefault(_in_stops(cycle, name), []).append(name)
        parts = ", ".join(f"{listed(names)} {which}" for which, names in stops.items())
        head = f"{len(cycle.within) + 1} stops every {hours}: {parts}"
    else:
        head = f"{listed(each)} every {hours}"
    return ", ".join(
        [head, *(f"{listed(names)} at every {ordinal(n)} {_end(cycle)}" for n, names in seldom.items())]
    )


def _end(cycle: Cycle) -> str:
    """Return what the stop at the end of a cycle is called."""
    if cycle.within:
        return "last of these stops"
    return "chain change" if cycle.every.get(CHAIN) == 1 else "stop"


def _in_stops(cycle: Cycle, name: str) -> str:
    """Return in words in which stops of a cycle a part is replaced."""
    stops = [number for number, (_, parts) in enumerate(cycle.within, start=1) if name in parts]
    last = len(cycle.within) + 1
    if len(stops) + 1 == last:
        return "at each"
    if len(stops) >= _MAX_STOPS:
        return f"at {len(stops) + 1} of them"
    return f"at the {listed([ordinal(number) for number in (*stops, last)])}"


def _later(rule: ReplacementRule, cycle: Cycle) -> list[str]:
    """Return in words from when on parts that outlived their run may be due."""
    texts = []
    for name in rule.every:
        if name in rule.at_most:
            cycles = cycles_in_life(rule.every[name], cycle.hours)
            at = f"at the {ordinal(cycles)} {_end(cycle)}" if cycles and not cycle.within else ""
            texts.append(
                f"{name} {at} or later" if at else f"{name} not before {grouped(rule.every[name])} h"
            )
    return texts
