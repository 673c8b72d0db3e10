"""A whole drive to start from, by what an engineer knows of it."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from wearsim.catalogue.catalogues import chains, environments
from wearsim.chain.service_conditions import LUBRICATIONS, SHOCKS, shifts_in_words, shifts_of
from wearsim.drive.known_drive import Values, is_plain, read_known, use_of
from wearsim.errors import CaseError, Fault
from wearsim.quantities import DAYS_OF_YEAR

if TYPE_CHECKING:
    from wearsim.case.model import Case
    from wearsim.drive.drive_case import DriveCase

_UNITS = {"power": "kW", "rpm": "rpm", "centre": "mm"}
"""Units of the case."""

_MOST_JOINT_FACTOR = 3.0
_TOO_HARD = "\n# It is above 3; handbooks advise another drive."
_COLUMN = 32
"""Width of a line of the case before its comment."""

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


def start_text(typed: Mapping[str, str | None]) -> str:
    """Return a drive as text, or raise everything that is wrong with what is known of it."""
    values, faults = read_known(typed)
    if faults:
        raise CaseError(faults)
    amounts = {
        name: _as_typed(values[name], typed.get(name), unit)
        for name, unit in _UNITS.items()
        if values[name] is not None
    }
    template = Path(__file__).with_name("drive_start.toml")
    shown = _shown(values, amounts, _loaded(values))
    return _aligned(template.read_text(encoding="utf-8").format(**shown))


def _loaded(values: Values) -> "DriveCase":
    """Return the drive, or raise its faults at the options that they come from."""
    from wearsim.chain.standard_teeth import standard_form
    from wearsim.drive.load_case import load_drive

    use, form = use_of(values), standard_form(chains()[values["chain"]])
    lengths = {"centre_distance_mm": values["centre"], "links": values["links"]}
    tables = {
        "format_version": 1,
        "chain": {"designation": values["chain"]},
        "sprocket": [{"teeth": values[role], "profile": form} for role in ("driver", "driven")],
        "drive": {
            **{key: value for key, value in lengths.items() if value is not None},
            "service_factor": use.service_factor,
            "joint_application_factor": use.joint_application_factor,
        },
        "load": {"power_kW": values["power"], "speed_rpm": values["rpm"]},
        **use.tables,
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
        return Fault(f"{fault.message}: choose another chain", fault.key, "--chain")
    return fault


def _as_typed(value: float, text: str | None, unit: str) -> str:
    """Return a number as it was typed, in the unit of the case where that is as short."""
    number = f"{value:.15g}"
    if text is None or is_plain(text):
        return number
    typed = text.strip()
    return number if len(f"{number} {unit}") <= len(typed) else json.dumps(typed, ensure_ascii=False)


def _shown(values: Values, amounts: Mapping[str, str], drive: "DriveCase") -> dict[str, Any]:
    """Return what the template shows."""
    from wearsim.drive.part_tables import LONGEST, SERVICE_YEARS

    use = use_of(values)
    case = drive.driver.case
    chain, driver, driven = (values[name] for name in ("chain", "driver", "driven"))
    iso, load = SHOCKS[values["shock"]]
    return {
        "chain": chain,
        "driver": driver,
        "driven": driven,
        "driven_rpm": values["rpm"] * driver / driven,
        "profile": case.inputs["sprocket"]["profile"],
        "length": _length(values, amounts, case),
        "iso_load": iso,
        "gost_load": load,
        "gost_lubrication": LUBRICATIONS[use.lubrication],
        "lubrication_note": " (there is none for dry)" if values["lubrication"] == "dry" else "",
        "shifts": shifts_in_words(shifts_of(values["hours_per_day"])),
        "use": use,
        "limit": _TOO_HARD if use.joint_application_factor > _MOST_JOINT_FACTOR else "",
        "power": amounts["power"],
        "rpm": amounts["rpm"],
        "lubricants": ", ".join(LUBRICATIONS),
        "environments": ", ".join(environments()),
        "hours": values["hours_per_day"],
        "horizon": min(LONGEST, SERVICE_YEARS * DAYS_OF_YEAR * values["hours_per_day"]),
        "years": SERVICE_YEARS,
        "longest": LONGEST,
        "elongation": case.inputs["stop"]["elongation_percent"],
    }


def _length(values: Values, amounts: Mapping[str, str], case: "Case") -> str:
    """Return the line of the case that says how long the drive is."""
    from wearsim.chain.drive_layout import DriveLayout
    from wearsim.mechanisms.wrap.drive import WrapDrive

    assert isinstance(case.drive, WrapDrive)
    layout = case.drive.layout
    assert isinstance(layout, DriveLayout)
    distance = f"{layout.centre_distance:.6g} mm centre distance"
    if values["centre"] is not None:
        even = f"{layout.links} links (even) give {layout.centre_distance:.6g} mm"
        return f"centre_distance_mm = {amounts['centre']}  # of the axes; {even}"
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
