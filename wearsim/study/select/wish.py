"""What the options of ``wearsim select`` ask for, with everything that is wrong with them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from wearsim.catalogue.catalogues import wear_conditions
from wearsim.chain.service_conditions import service_conditions
from wearsim.errors import CaseError, Fault, quoted
from wearsim.study.select.model import Price
from wearsim.study.select.price_file import read_prices
from wearsim.study.select.requirements import DriveRequirements, requirement_faults

_REQUIRED = ("power", "rpm", "ratio", "hours")

_FIELDS = {"rpm": "speed"}
"""Fields of the requirements whose options have other names."""

_QUANTITIES = {
    "power": "kW",
    "rpm": "rpm",
    "ratio": "",
    "hours": "h",
    "centre": "mm",
    "centre_min": "mm",
    "centre_max": "mm",
    "max_diameter": "mm",
    "ratio_tolerance": "%",
    "hours_per_day": "",
    "teeth_min": "",
    "teeth_max": "",
}
"""Units of the options that hold a number, which may be written behind it."""

_WHOLE = ("teeth_min", "teeth_max")


@dataclass(frozen=True)
class Wish:
    """What was asked for."""

    need: DriveRequirements
    hours_per_day: float
    use: str  # in words
    prices: dict[str, Price] | None


def read_wish(texts: Mapping[str, str | None], price: Path | None) -> Wish:
    """Return what the options ask for; name everything that is wrong with them."""
    faults: list[Fault] = []
    given = _numbers(texts, faults)
    hours_per_day = given.pop("hours_per_day", 8.0)
    words = {name: str(texts[name]) for name in ("lubrication", "environment", "tooth_hardness", "shock")}
    service, prices = None, None
    try:
        service = service_conditions(hours_per_day=hours_per_day, **words)
    except CaseError as error:
        faults += _by_option(error.faults)
    faults += _by_option(requirement_faults(given))
    if price is not None:
        try:
            prices = read_prices(price)
        except CaseError as error:
            faults += error.faults
    if faults or service is None:
        raise CaseError(faults)
    need = DriveRequirements(
        **given,
        service_factor=service.service_factor,
        joint_application_factor=service.joint_application_factor,
        joints=wear_conditions()[service.wear_condition],
        lubrication=service.lubrication,
        environment=service.environment,
        tooth_hardness=service.tooth_hardness,
    )
    use = f"{service.lubrication}, {service.environment}, {words['shock']} load, {hours_per_day:g} h a day"
    return Wish(need, hours_per_day, use, prices)


def _by_option(faults: Sequence[Fault]) -> list[Fault]:
    """Return faults of fields with the names of their options."""
    names = {field: option for option, field in _FIELDS.items()}
    names |= {"strands_min": "strands", "strands_max": "strands"}
    return [
        Fault(fault.message, "", f"--{names.get(fault.key, fault.key).replace('_', '-')}") for fault in faults
    ]


def _numbers(texts: Mapping[str, str | None], faults: list[Fault]) -> dict[str, Any]:
    """Return the numbers of the options by the names of their fields, those that can be read."""
    found: dict[str, Any] = {}
    for name, unit in _QUANTITIES.items():
        text = texts[name]
        option = f"--{name.replace('_', '-')}"
        if text is None:
            if name in _REQUIRED:
                faults.append(Fault("must be given: the drive is chosen for it", "", option))
            continue
        try:
            value = _number(text, unit)
        except ValueError as error:
            faults.append(Fault(f"{error} (got {quoted(text)})", "", option))
            continue
        if name in _WHOLE and value.is_integer():
            found[name] = int(value)
        else:
            found[_FIELDS.get(name, name)] = value
    found["series"] = tuple(word.strip() for word in str(texts["series"]).split(","))
    found |= _strands(str(texts["strands"]), faults)
    return found


def _number(text: str, unit: str) -> float:
    """Return a number of an option in a unit."""
    if unit == "%":
        return 0.01 * _number(text.strip().removesuffix("%"), "")
    try:
        return float(text)
    except ValueError:
        pass
    if not unit:
        raise ValueError("must be a number: write it with a point")
    from wearsim.input.units import convert

    return convert(text, unit)


def _strands(text: str, faults: list[Fault]) -> dict[str, int]:
    low, dash, high = text.partition("-")
    try:
        return {"strands_min": int(low), "strands_max": int(high if dash else low)}
    except ValueError:
        message = f"must be a whole number or two with a dash between, such as 1-3 (got {quoted(text)})"
        faults.append(Fault(f"{message}: correct it", "", "--strands"))
        return {}
