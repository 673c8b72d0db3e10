"""Texts of an input that stand in answers: one line of characters that can be seen."""

import unicodedata
from typing import Annotated

from pydantic import AfterValidator, Field

_LONGEST = 200
"""Characters of a title."""

_UNSEEN = ("C", "Zl", "Zp")
"""Unicode categories of what steers a text or is no character at all, and of ends of lines."""


def check_characters(text: str) -> str:
    """Return a text; raise for one with characters that steer it and cannot be seen.

    Examples
    --------
    >>> check_characters("Förderer № 5")
    'Förderer № 5'
    """
    unseen = next(filter(_is_unseen, text), "")
    if unseen:
        raise ValueError(f"must be one line without control characters, holds U+{ord(unseen):04X}: remove it")
    return text


def in_line(text: str) -> str:
    r"""Return a text as one that may be a title: without unseen characters, cut where it is long.

    Examples
    --------
    >>> in_line("Hoist\x1b"), len(in_line("a" * 1000))
    ('Hoist', 200)
    """
    seen = "".join(one for one in text if not _is_unseen(one))
    return seen if len(seen) <= _LONGEST else f"{seen[: _LONGEST - 3]}..."


def line_fault(text: str) -> str:
    r"""Return what is wrong with a text that may be as long as a title; empty where nothing is.

    Examples
    --------
    >>> line_fault("Hoist"), line_fault("Hoist\a")
    ('', 'must be one line of at most 200 characters without control characters: correct it')
    """
    if text == in_line(text):
        return ""
    return f"must be one line of at most {_LONGEST} characters without control characters: correct it"


def _is_unseen(character: str) -> bool:
    return unicodedata.category(character).startswith(_UNSEEN)


SEEN = AfterValidator(check_characters)
"""Of a text that stands in answers as it was given."""

Title = Annotated[str, Field(max_length=_LONGEST), SEEN]
"""What an answer is about."""
