"""What can go wrong, by kind; every class is also the matching builtin."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
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


Range = tuple[float, float] | tuple[str, ...]
"""Least and greatest value of a number, both allowed; or the words that are."""

ABOVE_0: tuple[float, float] = (math.ulp(0.0), 1e300)
AT_LEAST_0: tuple[float, float] = (0.0, 1e300)


def check_ranges(place: str, values: Mapping[str, Any], ranges: Mapping[str, Range]) -> None:
    """Raise for the first value that is outside its range; what is None or not there is not looked at.

    Examples
    --------
    >>> check_ranges("pair", {"ratio": 0.5}, {"ratio": (1.0, 100.0)})
    Traceback (most recent call last):
    wearsim.errors.GeometryError: pair: ratio must be at least 1 and at most 100, is 0.5: correct it
    """
    for name, allowed in ranges.items():
        value = values.get(name)
        if value is None:
            continue
        low, high = allowed[0], allowed[-1]
        if isinstance(low, str) or isinstance(high, str):
            inside, must = value in allowed, f"one of {', '.join(map(str, allowed))}"
        else:
            inside = low <= value <= high
            least = "above 0" if 0.0 < low < 1e-300 else f"at least {low:g}"
            must = least if high == 1e300 else f"{least} and at most {high:g}"
        if not inside:
            shown = repr(value) if isinstance(value, str) else f"{value:g}"
            raise GeometryError(f"{place}: {name} must be {must}, is {shown}: correct it")


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
