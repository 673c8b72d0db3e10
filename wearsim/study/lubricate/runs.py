"""The runs behind a study of lubrication: one for each lubricant."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from wearsim.case.model import Case
from wearsim.catalogue.catalogues import lubricants
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_case
from wearsim.drive.maintenance import part_lives
from wearsim.drive.part_life import case_clock, simulate
from wearsim.drive.wrap_life import chain_clock
from wearsim.errors import CaseError, Fault
from wearsim.input.changes import changed
from wearsim.input.document import GivenInput
from wearsim.lubrication.keys import APPLICATION, FADES, LASTS, RATES, SCHEDULES, SUPPLY
from wearsim.result.ends import CHAIN, SPROCKET
from wearsim.study.lubricate.model import LubricatedDrive, LubricationStudy, check_ages, lubrication_study
from wearsim.wear.running_in import WearClock

_OF_A_LUBRICANT = (
    *LASTS,
    *FADES,
    "dry_factor",
    "lasts_band_factor",
    "dry_band_factor",
    "completeness",
    "contamination_removed",
    *SUPPLY,
)
"""Keys that do not hold for another lubricant."""

_OF_APPLICATIONS = (*SCHEDULES, *APPLICATION)
"""Keys that do not hold for a lubricant that is supplied continuously."""

_SCHEDULED = (*SCHEDULES, "lasts_hours")
"""Keys in which a case lacks something that suits its schedule."""


def compare_intervals(
    case: Case | DriveCase, progress: Callable[[float], None] = lambda part: None
) -> LubricationStudy:
    """Return life and cost against the interval, for the lubricant of a case and for its options."""
    given = case.given
    if given is None:
        text = "must be studied as a whole: this is one sprocket of a drive, give the drive"
        raise CaseError([Fault(text, "", case.name)])
    cases = [case, *_options(given)]
    for number, one in enumerate(cases):
        key = f"lubrication.option.{number}" if number else "lubrication"
        check_ages(one.chain_case, key, alone=len(cases) == 1)
    drives = []
    for number, one in enumerate(cases):

        def report(part: float, number: int = number) -> None:
            progress((number + part) / len(cases))

        drives.append(_run(one, report))
    service = case.chain_case.inputs.get("service", {})
    return lubrication_study(drives, service.get("km_per_hour"), case.title)


def _options(given: GivenInput) -> Iterator[Case | DriveCase]:
    """Give the same case with each of its other lubricants; faults name the option."""
    table = given.tables.get("lubrication", {})
    options = table.get("option", []) if isinstance(table, Mapping) else []
    _check_rates(given, options)
    for number, option in enumerate(options, start=1):
        changes: dict[str, Any] = {f"lubrication.{key}": value for key, value in option.items()}
        if "lubricant" in option:
            row = lubricants().get(option["lubricant"])
            supplied = row is not None and row.supply == "continuous"
            dropped = (*_OF_A_LUBRICANT, *(_OF_APPLICATIONS if supplied else ()))
            changes = {f"lubrication.{key}": None for key in dropped if key in table} | changes
        other = replace(changed(given, {**changes, "lubrication.option": None}), file=given.file)
        try:
            yield load_case(other)
        except CaseError as error:
            place = f"lubrication.option.{number}"
            raise CaseError([_of_option(fault, place, option) for fault in error.faults]) from None


def _of_option(fault: Fault, place: str, option: Mapping[str, Any]) -> Fault:
    """Return a fault of a case with an option as one of the option."""
    name = fault.key.removeprefix("lubrication.")
    if name in option or name not in _SCHEDULED:
        return replace(fault, key=f"{place}.{name}", line=0)
    text = "must be one that is applied now and then, or supplied continuously: remove this option"
    return Fault(text, f"{place}.lubricant", fault.file)


def _check_rates(given: GivenInput, options: Sequence[Mapping[str, Any]]) -> None:
    """Raise where lubricants are to be compared that all have the wear rates of one."""
    wear, joint = (given.tables.get(name) or {} for name in ("wear", "joint"))
    own = [f"wear.{key}" for key in RATES if key in wear]
    own += [f"joint.{key}" for key in RATES if key in joint]
    if own and any("lubricant" in option for option in options):
        text = "holds for one lubricant: remove it to compare lubricants, each has its own wear rates"
        raise CaseError([Fault(text, own[0], given.file)])


def _run(case: Case | DriveCase, progress: Callable[[float], None]) -> LubricatedDrive:
    if isinstance(case, DriveCase):
        return _run_drive(case, progress)
    result = simulate(case, progress)
    worn = {name: life for name, life in result.parts.items() if name in (CHAIN, SPROCKET)}
    lives = worn or {SPROCKET: result.life}
    prices = case.inputs.get("maintenance", {})
    return LubricatedDrive(
        case,
        {name: _clock(case, name) for name in lives},
        lives,
        {name: case.drive.wear_band(name, case.wear) for name in lives},
        {name: prices.get(f"{name}_price") for name in lives},
        result.assumptions,
        result.warnings,
    )


def _run_drive(drive: DriveCase, progress: Callable[[float], None]) -> LubricatedDrive:
    found = drive_life(drive, progress).complete()
    lives = part_lives(found)
    first = drive.driver.case
    cases = drive.single_cases
    prices = {name: case.inputs.get("maintenance", {}).get("sprocket_price") for name, case in cases.items()}
    return LubricatedDrive(
        first,
        {name: _clock(cases.get(name, first), name) for name in lives},
        lives,
        {name: of.drive.wear_band(name, of.wear) for name in lives for of in [cases.get(name, first)]},
        {
            **{name: prices.get(name) for name in lives},
            CHAIN: first.inputs.get("maintenance", {}).get("chain_price"),
        },
        drive.assumptions,
        found.warnings,
    )


def _clock(case: Case, part: str) -> tuple[WearClock, float]:
    """Return how a part runs in, and the cycles of an hour."""
    return (chain_clock(case) if part == CHAIN else case_clock(case)).part, case.cycles_per_hour
