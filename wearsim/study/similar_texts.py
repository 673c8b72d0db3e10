"""Texts that differ in their numbers only, told as one."""

import re
from collections.abc import Iterable


def kinds(texts: Iterable[str]) -> list[tuple[str, int]]:
    """Return the first text of each kind, and how many there are of it.

    Examples
    --------
    >>> kinds(["below 1 from 3 h on", "too wide", "below 1 from -4.5e3 h on"])
    [('below 1 from 3 h on', 2), ('too wide', 1)]
    """
    found: dict[str, tuple[str, int]] = {}
    for text in texts:
        kind = re.sub(r"[-+]?\d[\d.]*(e[-+]?\d+)?", "#", text)
        first, count = found.get(kind, (text, 0))
        found[kind] = first, count + 1
    return sorted(found.values(), key=lambda entry: -entry[1])
