"""Texts of an input: one line of characters that can be seen."""

import unicodedata

_UNSEEN = ("C", "Zl", "Zp")
"""Unicode categories of what steers a text or is no character at all, and of ends of lines."""


def check_characters(text: str) -> str:
    """Return a text; raise for one with characters that steer it and cannot be seen.

    Examples
    --------
    >>> check_characters("Förderer № 5")
    'Förderer № 5'
    """
    unseen = next((one for one in text if unicodedata.category(one).startswith(_UNSEEN)), "")
    if unseen:
        raise ValueError(f"must be one line without control characters, holds U+{ord(unseen):04X}: remove it")
    return text
