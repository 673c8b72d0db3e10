"""What an engineer knows of a drive: read from words, with defaults for what is not known."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from wearsim.catalogue.catalogues import HARDNESSES, chains, environments, nearest
from wearsim.catalogue.chain_names import known_chain_name
from wearsim.chain.service_conditions import (
    LUBRICATIONS,
    SHOCKS,
    ServiceConditions,
    plain_word,
    service_conditions,
)
from wearsim.errors import Fault, quoted
from wearsim.quantities import either

_SAFETY = 20.0
"""Breaking load over the pull, before the factors of its use, where nobody knows the power."""


def _whole(least: int, most: int) -> Callable[[str], int]:
    def _read(text: str) -> int:
        digits = text.strip()
        if not (digits.isascii() and digits.isdecimal() and least <= float(digits) <= most):
            raise ValueError(f"must be a whole number from {least} to {most} (got {quoted(text)})")
        return int(digits)

    return _read


def _quantity(unit: str, most: float = math.inf) -> Callable[[str], float]:
    def _read(text: str) -> float:
        number = _number(text, unit)
        if not (0.0 < number <= most and math.isfinite(number)):
            end = f" and at most {most:g}" if math.isfinite(most) else ""
            raise ValueError(f"must be a number above 0{end} (got {quoted(text)})")
        return number

    return _read


def _number(text: str, unit: str) -> float:
    """Return a plain number, or one with a unit in another one."""
    from wearsim.input.units import convert

    if is_plain(text):
        return float(text)
    try:
        return convert(text, unit)
    except ValueError as error:
        raise ValueError(f"{error} (got {quoted(text)})") from None


def is_plain(text: str) -> bool:
    """Tell whether a text is a number without a unit."""
    try:
        float(text)
    except ValueError:
        return False
    return True


def _word(words: tuple[str, ...]) -> Callable[[str], str]:
    def _read(text: str) -> str:
        found = plain_word(text)
        if found not in words:
            raise ValueError(
                f"must be one of {', '.join(words)} (got {quoted(text)}){nearest(text, list(words))}"
            )
        return found

    return _read


def _or_nothing(read: Callable[[str], Any]) -> Callable[[str], Any]:
    return lambda text: read(text) if text.strip() else None


Values = Mapping[str, Any]


@dataclass(frozen=True)
class Known:
    """Something that an engineer knows of a drive."""

    option: str
    what: str  # the help of the option, and the question
    metavar: str
    read: Callable[[str], Any]  # the value of a text; raises ValueError
    default: Callable[[Values], str]  # by the values of those before; empty for nothing
    default_in_words: str = ""
    words: tuple[str, ...] = ()  # that it may be
    asked: bool = True

    @property
    def name(self) -> str:
        """Name of the value."""
        return self.option.removeprefix("--").replace("-", "_")

    @property
    def help(self) -> str:
        """What the option is said to be."""
        return f"{self.what}." + (f"  [default: {self.default_in_words}]" if self.default_in_words else "")


def _fixed(option: str, what: str, metavar: str, read: Callable[[str], Any], default: str) -> Known:
    return Known(option, what, metavar, read, lambda values: default, default)


def _one_of(option: str, what: str, words: tuple[str, ...]) -> Known:
    every = f"{what}: {either(words)}"
    return Known(option, every, "WORD", _word(words), lambda values: words[0], words[0], words)


def _rounded(number: float) -> str:
    return f"{float(f'{number:.2g}'):g}"


def _default_rpm(values: Values) -> str:
    return _rounded(60_000.0 / (chains()[values["chain"]].pitch * values["driver"]))


def _default_power(values: Values) -> str:
    chain, use = chains()[values["chain"]], use_of(values)
    pull = chain.tensile / _SAFETY / max(use.service_factor, use.joint_application_factor)
    return _rounded(pull * chain.pitch * values["driver"] * values["rpm"] / 6e7)


KNOWN = (
    _fixed(
        "--chain", "Chain designation (see wearsim list chains)", "DESIGNATION", known_chain_name, "16B-1"
    ),
    _fixed("--driver", "Number of teeth of the driver", "TEETH", _whole(5, 1000), "19"),
    _fixed("--driven", "Number of teeth of the driven sprocket", "TEETH", _whole(5, 1000), "25"),
    Known("--rpm", "Speed of the driver in rpm", "SPEED", _quantity("rpm"), _default_rpm, "chain at 1 m/s"),
    _fixed(
        "--centre",
        "Centre distance in mm; about 40 pitches if empty",
        "LENGTH",
        _or_nothing(_quantity("mm")),
        "",
    ),
    Known(
        "--links",
        "Number of links, instead of --centre",
        "N",
        _or_nothing(_whole(10, 100_000)),
        lambda values: "",
        asked=False,
    ),
    _one_of("--lubrication", "Lubrication", tuple(LUBRICATIONS)),
    _one_of("--environment", "Environment of the chain", tuple(environments())),
    _one_of("--tooth-hardness", "Teeth", HARDNESSES),
    _fixed("--hours-per-day", "Running hours per day", "HOURS", _quantity("h", 24.0), "8"),
    _one_of("--shock", "Shocks from the driven machine", tuple(SHOCKS)),
    Known(
        "--power",
        "Power in kW",
        "POWER",
        _quantity("kW"),
        _default_power,
        "5 % of the breaking load, or less",
    ),
)
"""What is known of a drive, in the order of the questions."""


def read_known(typed: Mapping[str, str | None]) -> tuple[dict[str, Any], list[Fault]]:
    """Return all values, and what is wrong with the texts; the default stands in for such a one."""
    values: dict[str, Any] = {}
    faults = []
    for known in KNOWN:
        text = typed.get(known.name)
        try:
            values[known.name] = known.read(known.default(values) if text is None else text)
        except ValueError as error:
            faults.append(Fault(str(error), "", known.option))
            values[known.name] = known.read(known.default(values))
    return values, faults


def use_of(values: Values) -> ServiceConditions:
    """Return what follows from lubrication, shocks and hours of a day."""
    names = ("lubrication", "shock", "hours_per_day", "environment", "tooth_hardness")
    return service_conditions(**{name: values[name] for name in names})
