"""Names of sheets that Excel accepts."""

import re
from collections.abc import Iterable, Sequence

_LONGEST = 31
_NOT_IN_XML = re.compile("[^\t\n\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_FORBIDDEN = re.compile(r"[\[\]:*?/\\\t\n]")


def without_forbidden(text: str) -> str:
    """Return a text without what no XML file can hold."""
    return _NOT_IN_XML.sub("\ufffd", text)


def worksheet_names(names: Sequence[str], taken: Iterable[str] = ()) -> list[str]:
    r"""Return names of sheets.

    Examples
    --------
    >>> worksheet_names(["16b/20t", "16B/20T"], taken=["Inputs"])
    ['16b-20t', '16B-20T (2)']
    """
    used = {"history", *(name.casefold() for name in taken)}
    found = []
    for name in names:
        base = _FORBIDDEN.sub("-", without_forbidden(name)).strip(" '") or "result"
        chosen, number = _cut(base, ""), 1
        while chosen.casefold() in used:
            number += 1
            chosen = _cut(base, f" ({number})")
        used.add(chosen.casefold())
        found.append(chosen)
    return found


def _cut(base: str, end: str) -> str:
    """Cut a name so that it takes 31 units of UTF-16, as Excel counts, with its end."""
    room = 2 * (_LONGEST - len(end))
    head = base.encode("utf-16-le")[:room].decode("utf-16-le", "ignore")
    return head.strip(" '") + end
