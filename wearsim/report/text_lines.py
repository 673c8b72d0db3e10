"""Lines of text as the screen and figures show them."""

import re
import textwrap
from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import NamedTuple

from wearsim.quantities import kind_of_text

_WIDTH = 100
_LABEL = 13

_GROUP = re.compile(r"(?<=\d) (?=\d{3}\b)")

_JOINS = re.compile(
    r"(?<=\d) (?=\d{3}\b|(?:h|m|mm|mm2|km|kg|N|kN|N/mm2?|MPa|%|W|kW|rpm|m/s|deg|degrees|°C)(?:[^\w/]|$))"
    r"|(?<=[<>≤≥=]) (?=\d)|(?<=\w) (?=[=≤≥] \d)"
)
"""Spaces within a number, before its unit and after its relation."""
"""What sets thousands apart."""

_DEFAULT = re.compile(r"[a-z_]+\.[a-zA-Z_.]+ = ")


class Finding(NamedTuple):
    """What an answer says under a label: on the screen, on pages, in a workbook and in a notebook."""

    label: str
    text: str

    def __str__(self) -> str:
        return row(self.label, self.text)


def answer_text(*parts: object) -> str:
    """Return what an answer prints: its title, its findings, and tables and lines as they are."""
    return "\n".join(map(str, parts))


def fenced(text: str) -> str:
    """Return lines of text as a page of Markdown that shows them as they are."""
    return f"```\n{text}\n```\n"


def closing_lists(assumptions: Sequence[str], warnings: Sequence[str], explain: bool) -> list[str]:
    """Return the end of a long answer, a warning and, on request, an assumption on each line."""
    if explain:
        stated = [
            "assumptions:",
            *(f"  {number}. {text}" for number, text in enumerate(assumptions, start=1)),
        ]
    else:
        stated = [f"assumptions: {counted_assumptions(assumptions)}"]
    return ["", *stated, *(f"warning: {text}" for text in warnings)]


def closing(assumptions: Sequence[str], warnings: Sequence[str], explain: bool) -> Iterator[Finding]:
    """Give the end of an answer: its assumptions, on request each of them, and its warnings."""
    yield assumed(assumptions, explain)
    yield Finding("Warnings", "; ".join(warnings) or "none")


def assumed(assumptions: Sequence[str], explain: bool) -> Finding:
    """Return the assumptions and defaults of an answer: how many there are, on request each of them."""
    return Finding("Assumes", (numbered_assumptions if explain else counted_assumptions)(assumptions))


def row(label: str, text: str, most_lines: int | None = None) -> str:
    """Return one line of an answer, folded under its label, but not within a number, and cut on request.

    Examples
    --------
    >>> row("Stops", "x" * 84 + " 1 803 h").splitlines()[1].strip()
    '1 803 h'
    >>> row("Stops", "x" * 70 + " 1 803 h and so on", 1).removeprefix("  Stops" + " " * 6 + "x" * 70)
    ' 1 803 h and ...'
    """
    lead = f"  {label:<{_LABEL - 2}}" + ("" if len(label) < _LABEL - 2 else "  ")
    return textwrap.fill(
        unbroken(text),
        _WIDTH,
        initial_indent=lead,
        subsequent_indent=" " * _LABEL,
        break_on_hyphens=False,
        break_long_words=False,
        max_lines=most_lines,
        placeholder=" ...",
    ).replace("\u00a0", " ")


def unbroken(text: str) -> str:
    """Return a text that is not folded within a number.

    Examples
    --------
    >>> [word.split() for word in unbroken("at 1 803 h").split(" ")]
    [['at'], ['1', '803'], ['h']]
    """
    return _GROUP.sub("\u00a0", text)


def pages_kept(text: str) -> str:
    """Return a text whose numbers do not break off their groups, units and relations.

    Examples
    --------
    >>> pages_kept("until 21 090 h, by > 3 %").encode("ascii", "replace")
    b'until 21?090?h, by >?3?%'
    """
    return _JOINS.sub("\u00a0", text)


def listed(names: Sequence[str]) -> str:
    """Return names as a sentence lists them.

    Examples
    --------
    >>> listed(["idler"]), listed(["idler", "pump"]), listed(["idler", "pump", "fan"])
    ('idler', 'idler and pump', 'idler, pump and fan')
    """
    *others, last = names
    return f"{', '.join(others)} and {last}" if others else last


def numbered_assumptions(assumptions: Sequence[str]) -> str:
    """Return assumptions with their numbers; the defaults taken share the last one.

    Examples
    --------
    >>> numbered_assumptions(("alike", "run.method = advance (default)", "wear.law = power (default)"))
    '1 alike; 2 defaults: run.method = advance, wear.law = power'
    """
    return numbered(*stated_and_defaults(assumptions))


def numbered(stated: Sequence[str], defaults: Sequence[str]) -> str:
    """Return what is taken for granted with its numbers; the defaults taken share the last one."""
    shown = list(stated)
    if defaults:
        shown.append("defaults: " + ", ".join(text.removesuffix(" (default)") for text in defaults))
    return "; ".join(f"{i} {text}" for i, text in enumerate(shown, start=1))


def counted_assumptions(assumptions: Sequence[str]) -> str:
    """Return how many assumptions and defaults there are.

    Examples
    --------
    >>> counted_assumptions(("alike", "run.method = advance (default)", "wear.law = power (default)"))
    '1 assumption and 2 defaults: --explain shows them'
    """
    return counted(*stated_and_defaults(assumptions))


def counted(stated: Sequence[str], defaults: Sequence[str]) -> str:
    """Return how many assumptions and defaults there are."""
    kinds = [_counted(stated, "assumption")] if stated or not defaults else []
    kinds += [_counted(defaults, "default")] if defaults else []
    return f"{' and '.join(kinds)}: --explain shows them" if stated or defaults else "nothing"


def _counted(texts: Collection[str], name: str) -> str:
    return f"{len(texts)} {name}" if len(texts) == 1 else f"{len(texts)} {name}s"


def stated_and_defaults(assumptions: Sequence[str]) -> tuple[list[str], list[str]]:
    """Return what a result takes for granted, and the defaults it takes.

    Examples
    --------
    >>> stated_and_defaults(("all teeth alike", "wear.law = archard (default)"))
    (['all teeth alike'], ['wear.law = archard (default)'])
    """
    defaults = [text for text in assumptions if _DEFAULT.match(text)]
    return [text for text in assumptions if text not in defaults], defaults


def counts_by_kind(texts: Iterable[str]) -> list[tuple[str, int]]:
    """Return the first text of each kind, and how many there are of it.

    Examples
    --------
    >>> counts_by_kind(["below 1 from 3 h on", "too wide", "below 1 from -4.5e3 h on"])
    [('below 1 from 3 h on', 2), ('too wide', 1)]
    """
    found: dict[str, tuple[str, int]] = {}
    for text in texts:
        kind = kind_of_text(text)
        first, count = found.get(kind, (text, 0))
        found[kind] = first, count + 1
    return sorted(found.values(), key=lambda entry: -entry[1])


def literal(text: str) -> str:
    r"""Return a text that a figure shows as it is.

    Examples
    --------
    >>> print(literal("3 $ an hour"))
    3 \$ an hour
    """
    return text.replace("$", r"\$")
