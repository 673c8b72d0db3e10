"""A whole drive to start from, by what an engineer knows of it."""

import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from wearsim.catalogue.catalogues import chains, known_chain_name, nearest
from wearsim.chain.service_conditions import LUBRICATIONS, SHIFTS, SHOCKS, plain_word, service_conditions
from wearsim.command.complete import complete_chain
from wearsim.errors import CaseError, Fault
from wearsim.quantities import DAYS_OF_YEAR

if TYPE_CHECKING:
    from wearsim.case.model import Case
    from wearsim.study.whole_drive.keys import DriveCase

_SAFETY = 20.0
"""Breaking load over the pull, before the factors of its use, where nobody knows the power."""

_UNITS = {"power": "kW", "rpm": "rpm", "centre": "mm"}
"""Units of the case."""

_MOST_JOINT_FACTOR = 3.0
_TOO_HARD = "\n# It is above 3, where handbooks ask for another drive."
_COLUMN = 32
"""Width of a line of the case before its comment."""

_WHY = {
    "hardened, oiled": "hardened teeth, and oil on teeth and joints at all times.",
    "normalised, greased": "the row of the table for little lubricant, with softer teeth.",
    "hardened, dry": "hardened teeth, no lubricant at all.",
}
"""What the conditions of wear mean that go with the ways to lubricate."""


def _whole(least: int, most: int) -> Callable[[str], int]:
    def _read(text: str) -> int:
        digits = text.strip()
        if not (digits.isascii() and digits.isdecimal() and least <= float(digits) <= most):
            raise ValueError(f"must be a whole number from {least} to {most} (got {text!r})")
        return int(digits)

    return _read


def _quantity(unit: str, most: float = math.inf) -> Callable[[str], float]:
    def _read(text: str) -> float:
        number = _number(text, unit)
        if not (0.0 < number <= most and math.isfinite(number)):
            end = f" and at most {most:g}" if math.isfinite(most) else ""
            raise ValueError(f"must be a number above 0{end} (got {text!r})")
        return number

    return _read


def _number(text: str, unit: str) -> float:
    """Return a plain number, or one with a unit in another one."""
    from wearsim.input.units import convert

    if _is_plain(text):
        return float(text)
    try:
        return convert(text, unit)
    except ValueError as error:
        raise ValueError(f"{error} (got {text!r})") from None


def _is_plain(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _word(words: tuple[str, ...]) -> Callable[[str], str]:
    def _read(text: str) -> str:
        found = plain_word(text)
        if found not in words:
            raise ValueError(f"must be one of {', '.join(words)} (got {text!r}){nearest(text, list(words))}")
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
    every = f"{what}: {', '.join(words[:-1])} or {words[-1]}"
    return Known(option, every, "WORD", _word(words), lambda values: words[0], words[0], words)


def _rounded(number: float) -> str:
    return f"{float(f'{number:.2g}'):g}"


def _default_rpm(values: Values) -> str:
    return _rounded(60_000.0 / (chains()[values["chain"]].pitch * values["driver"]))


def _default_power(values: Values) -> str:
    chain, factors = chains()[values["chain"]], _factors(values)
    pull = chain.tensile / _SAFETY / max(factors.service, factors.joint)
    return _rounded(pull * chain.pitch * values["driver"] * values["rpm"] / 6e7)


KNOWN = (
    _fixed("--chain", "Chain, as wearsim list chains has it", "DESIGNATION", known_chain_name, "16B-1"),
    _fixed("--driver", "Teeth of the driver", "TEETH", _whole(5, 1000), "19"),
    _fixed("--driven", "Teeth of the driven sprocket", "TEETH", _whole(5, 1000), "25"),
    Known("--rpm", "Speed of the driver in rpm", "SPEED", _quantity("rpm"), _default_rpm, "chain at 1 m/s"),
    _fixed(
        "--centre",
        "Distance of the axes in mm; with none about 40 pitches",
        "LENGTH",
        _or_nothing(_quantity("mm")),
        "",
    ),
    Known(
        "--links",
        "Links of the chain, in place of --centre",
        "N",
        _or_nothing(_whole(10, 100_000)),
        lambda values: "",
        asked=False,
    ),
    _one_of("--lubrication", "Lubrication", tuple(LUBRICATIONS)),
    _fixed("--hours-per-day", "Running hours a day", "HOURS", _quantity("h", 24.0), "8"),
    _one_of("--shock", "Load of the driven machine", tuple(SHOCKS)),
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

_OPTIONS = {
    "chain.designation": "--chain",
    "sprocket.1.teeth": "--driver",
    "sprocket.2.teeth": "--driven",
    "load.power_kW": "--power",
    "load.speed_rpm": "--rpm",
    "drive.centre_distance_mm": "--centre",
    "drive.links": "--links",
}
"""Where keys of a case come from."""


def drive_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add an option for everything that may be known of a drive."""
    for known in reversed(KNOWN):
        add = click.option(
            known.option,
            metavar=known.metavar,
            help=known.help,
            shell_complete=complete_chain if known.option == "--chain" else _completing(known.words),
        )
        function = add(function)
    return function


def _completing(words: tuple[str, ...]) -> Callable[..., list[str]]:
    return lambda context, parameter, incomplete: [word for word in words if word.startswith(incomplete)]


def ask_for_drive() -> str:
    """Ask for everything one by one, and again for what does not fit; return the text of the drive."""
    typed: dict[str, str | None] = {}
    questions = [known for known in KNOWN if known.asked]
    while True:
        for known in questions:
            typed[known.name] = _answer(known, _read(typed)[0])
        try:
            return drive_text(typed)
        except CaseError as error:
            wrong = {fault.file for fault in error.faults}
            questions = [known for known in KNOWN if known.asked and known.option in wrong]
            if not questions:
                raise
            click.echo(str(error), err=True)


def _answer(known: Known, values: Values) -> str:
    def _checked(text: str) -> str:
        try:
            known.read(text)
        except ValueError as error:
            raise click.UsageError(str(error)) from None
        return text

    default = known.default(values)
    return str(click.prompt(known.what, default=default, value_proc=_checked, show_default=bool(default)))


def drive_text(typed: Mapping[str, str | None]) -> str:
    """Return a drive as text, or raise everything that is wrong with what is known of it."""
    values, faults = _read(typed)
    if faults:
        raise CaseError(faults)
    amounts = {
        name: _as_typed(values[name], typed.get(name), unit)
        for name, unit in _UNITS.items()
        if values[name] is not None
    }
    template = Path(__file__).with_name("templates") / "drive.toml"
    shown = _shown(values, amounts, _loaded(values))
    return _aligned(template.read_text(encoding="utf-8").format(**shown))


def _read(typed: Mapping[str, str | None]) -> tuple[dict[str, Any], list[Fault]]:
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


@dataclass(frozen=True)
class _Factors:
    """Factors of the ratings for how a drive is used."""

    service: float  # f1
    load: float
    lubrication: float
    shifts: float
    joint: float  # K_e, the product of the three


def _factors(values: Values) -> _Factors:
    from wearsim.chain.joint_pressure import joint_application_factor

    _, load = SHOCKS[values["shock"]]
    used = service_conditions(values["lubrication"], values["shock"], values["hours_per_day"])
    return _Factors(
        service=used.service_factor,
        load=joint_application_factor(load=load),
        lubrication=joint_application_factor(lubrication=LUBRICATIONS[values["lubrication"]][1]),
        shifts=joint_application_factor(shifts=_shifts(values)),
        joint=used.joint_application_factor,
    )


def _shifts(values: Values) -> str:
    return next(shifts for most, shifts in SHIFTS if values["hours_per_day"] <= most)


def _loaded(values: Values) -> "DriveCase":
    """Return the drive, or raise its faults at the options that they come from."""
    from wearsim.chain.standard_teeth import standard_form
    from wearsim.study.whole_drive.keys import load_drive

    factors, form = _factors(values), standard_form(chains()[values["chain"]])
    lengths = {"centre_distance_mm": values["centre"], "links": values["links"]}
    tables = {
        "format_version": 1,
        "chain": {"designation": values["chain"]},
        "sprocket": [{"teeth": values[role], "profile": form} for role in ("driver", "driven")],
        "drive": {
            **{key: value for key, value in lengths.items() if value is not None},
            "service_factor": factors.service,
            "joint_application_factor": factors.joint,
        },
        "load": {"power_kW": values["power"], "speed_rpm": values["rpm"]},
        "wear": {"condition": LUBRICATIONS[values["lubrication"]][0]},
    }
    try:
        return load_drive(tables)
    except CaseError as error:
        # Both sprockets may tell the same, each with its own numbers.
        found: dict[str, Fault] = {}
        for fault in error.faults:
            found.setdefault(fault.key, _at_option(fault))
        raise CaseError(list(found.values())) from None


def _at_option(fault: Fault) -> Fault:
    if fault.key in _OPTIONS:
        return Fault(fault.message, "", _OPTIONS[fault.key])
    if fault.key.startswith("chain."):
        return Fault(f"{fault.message}: take another chain", fault.key, "--chain")
    return fault


@dataclass(frozen=True)
class _Amount:
    """A number as it is written in the case, and in words."""

    toml: str
    words: str


def _as_typed(value: float, text: str | None, unit: str) -> _Amount:
    """Return a number as it was typed, in the unit of the case where that is as short."""
    number = f"{value:.15g}"
    words = f"{number} {unit}"
    if text is None or _is_plain(text):
        return _Amount(number, words)
    typed = text.strip()
    return _Amount(number if len(words) <= len(typed) else json.dumps(typed, ensure_ascii=False), typed)


def _shown(values: Values, amounts: Mapping[str, _Amount], drive: "DriveCase") -> dict[str, Any]:
    """Return what the template shows."""
    from wearsim.study.whole_drive.keys import SERVICE_YEARS

    factors, (condition, oil) = _factors(values), LUBRICATIONS[values["lubrication"]]
    case = drive.driver.case
    chain, driver, driven = (values[name] for name in ("chain", "driver", "driven"))
    power, rpm = amounts["power"], amounts["rpm"]
    title = f"{chain}, {driver} to {driven} teeth, {power.words} at {rpm.words}"
    iso, load = SHOCKS[values["shock"]]
    shifts = _shifts(values)
    return {
        "title": json.dumps(title, ensure_ascii=False),
        "chain": chain,
        "driver": driver,
        "driven": driven,
        "driven_rpm": values["rpm"] * driver / driven,
        "profile": case.inputs["sprocket"]["profile"],
        "length": _length(values, amounts, case),
        "iso_load": iso,
        "gost_load": load,
        "gost_lubrication": oil,
        "lubrication_note": " (there is none for dry)" if values["lubrication"] == "dry" else "",
        "shifts": f"{shifts} {'shift' if shifts == 'one' else 'shifts'}",
        "factors": factors,
        "limit": _TOO_HARD if factors.joint > _MOST_JOINT_FACTOR else "",
        "power": power.toml,
        "rpm": rpm.toml,
        "lubrication": values["lubrication"],
        "why": _WHY[condition],
        "condition": condition,
        "hours": values["hours_per_day"],
        "horizon": SERVICE_YEARS * DAYS_OF_YEAR * values["hours_per_day"],
        "years": SERVICE_YEARS,
        "elongation": case.inputs["stop"]["elongation_percent"],
    }


def _length(values: Values, amounts: Mapping[str, _Amount], case: "Case") -> str:
    """Return the line of the case that says how long the drive is."""
    from wearsim.chain.drive_layout import DriveLayout
    from wearsim.mechanisms.wrap.drive import WrapDrive

    assert isinstance(case.drive, WrapDrive)
    layout = case.drive.layout
    assert isinstance(layout, DriveLayout)
    distance = f"{layout.centre_distance:.6g} mm between the axes"
    if values["centre"] is not None:
        even = f"{layout.links} links, the next even number, take {layout.centre_distance:.6g} mm"
        return f"centre_distance_mm = {amounts['centre'].toml}  # of the axes; {even}"
    if values["links"] is not None:
        return f"links = {layout.links}  # {distance}; or centre_distance_mm"
    return f"links = {layout.links}  # about 40 pitches, {distance}; or centre_distance_mm"


def _aligned(text: str) -> str:
    """Return a case with the comments behind its lines below one another."""
    lines = []
    for line in text.splitlines():
        code, mark, comment = line.partition("  # ")
        lines.append(f"{code.ljust(_COLUMN)}{mark}{comment}" if mark else line)
    return "\n".join([*lines, ""])
