"""What can go wrong, by kind; every class is also the matching builtin."""

import math
from dataclasses import dataclass


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


def check_positive(calculation: str, **values: float) -> None:
    """Raise for the first of some numbers, named as the arguments of a calculation, that is not above 0."""
    for name, value in values.items():
        if not 0.0 < value < math.inf:
            raise GeometryError(f"{calculation}: {name} must be a number above 0, is {value:g}: correct it")


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
