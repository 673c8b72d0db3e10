"""What can go wrong, by kind; every class is also the matching builtin."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from numbers import Integral, Real
from typing import Any


class WearsimError(Exception):
    """Base of every error that a user of wearsim can cause or meet."""


class GeometryError(WearsimError, ValueError):
    """A shape that cannot exist or cannot run: infeasible flank, self-crossing profile."""


class ContactError(WearsimError, ArithmeticError):
    """A contact outside the theory that describes it: conforming or vanished."""


class JumpError(ContactError):
    """The chain jumps over the teeth of its sprocket."""


class ConvergenceError(WearsimError, RuntimeError):
    """A calculation that would report a wrong life if it went on."""


class StudyError(WearsimError, RuntimeError):
    """A study that cannot go on: no workers, or workers of another engine."""


class OutputError(WearsimError, OSError):
    """A place that results cannot be written to or read from."""


class LimitNotReachedError(WearsimError, ValueError):
    """A life was asked for, but the run ended before any limit was met."""


_LONGEST = 60
"""Characters of a value in a message."""


def quoted(value: object) -> str:
    """Return a value as a message quotes it, cut where it is long.

    Examples
    --------
    >>> quoted("3 kW"), quoted(True), len(quoted("k" * 1000))
    ("'3 kW'", 'true', 60)
    """
    if isinstance(value, bool):
        return str(value).lower()
    text = repr(value)
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 3]}..."


@dataclass(frozen=True)
class Fault:
    """One thing wrong with an input."""

    message: str  # what must hold, what was found and what to do
    key: str = ""  # dotted key, empty where the fault is of a whole file
    file: str = ""  # file the key stands in, or `--set` for an override
    line: int = 0  # line of the key, 0 where there is none

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}" if self.line else self.file
        return ": ".join(part for part in (place, self.key, self.message) if part)


@dataclass(frozen=True)
class Range:
    """What a number may be; it is finite in any case."""

    least: float = -math.inf
    most: float = math.inf
    # above, below: ends that are no part of the range
    above: float = -math.inf
    below: float = math.inf
    whole: bool = False  # an int, or numpy's
    optional: bool = False  # None is allowed too

    def must(self, value: Any) -> str:
        """Return what a value must be and is not; empty where it is all that."""
        fits = isinstance(value, Integral if self.whole else Real) and not isinstance(value, bool)
        if not fits:
            return "a whole number" if self.whole else "a number"
        if not -1e300 <= value <= 1e300:
            return "a finite number"
        if self.least <= value <= self.most and self.above < value < self.below:
            return ""
        ends = {"above": self.above, "at least": self.least, "below": self.below, "at most": self.most}
        return " and ".join(f"{word} {end:g}" for word, end in ends.items() if math.isfinite(end))


Allowed = Range | tuple[str | int | None, ...]
"""A range of numbers, or the values that there are; with None where it may be left out."""

ABOVE_0 = Range(above=0.0)
AT_LEAST_0 = Range(least=0.0)
POISSONS_RATIO = Range(above=-1.0, below=0.5)


def check_ranges(place: str, values: Mapping[str, Any], ranges: Mapping[str, Allowed]) -> None:
    """Raise for the first value that is outside its range, or missing though it may not be left out.

    Examples
    --------
    >>> check_ranges("pair", {"ratio": 0.5}, {"ratio": Range(1.0, 100.0)})
    Traceback (most recent call last):
    wearsim.errors.GeometryError: pair: ratio must be at least 1 and at most 100, is 0.5: correct it
    """
    for name, allowed in ranges.items():
        value = values.get(name)
        if value is None:
            if None in allowed if isinstance(allowed, tuple) else allowed.optional:
                continue
            raise GeometryError(f"{place}: {name} must be given, but is not: give it")
        if isinstance(allowed, Range):
            must = allowed.must(value)
        else:
            words = ", ".join(str(word) for word in allowed if word is not None)
            must = "" if value in allowed else f"one of {words}"
        if must:
            shown = repr(value) if isinstance(value, str) else value
            raise GeometryError(f"{place}: {name} must be {must}, is {shown}: correct it")


def check_series(
    place: str, name: str, values: Any, allowed: Range = Range(), count: int | None = None
) -> None:
    """Raise for a sequence that is empty or not of the count, or for its first entry outside a range.

    Examples
    --------
    >>> check_series("pair", "moduli", (2e5, -1.0), ABOVE_0, 2)
    Traceback (most recent call last):
    wearsim.errors.GeometryError: pair: moduli[1] must be above 0, is -1.0: correct it
    """
    try:
        entries = list(values)
    except TypeError:
        entries = []
    if len(entries) != (count or max(1, len(entries))):
        must = count or "1 or more"
        raise GeometryError(f"{place}: {name} must be a sequence of length {must}, is {values!r}: correct it")
    numbers = {f"{name}[{i}]": entry for i, entry in enumerate(entries)}
    check_ranges(place, numbers, dict.fromkeys(numbers, allowed))


class CaseError(WearsimError, ValueError):
    """Everything wrong with an input, found in one pass.

    Parameters
    ----------
    faults : sequence of Fault
        At least one; kept in the order in which they are shown.
    """

    def __init__(self, faults: "list[Fault] | tuple[Fault, ...]") -> None:
        self.faults = tuple(faults)
        super().__init__("\n".join(str(fault) for fault in self.faults))
