"""Whole drives as the cases of studies."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from wearsim.case.model import Case
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.drive_result import CHAIN
from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_drive
from wearsim.drive.maintenance import part_lives
from wearsim.drive.wheels import wheel_name
from wearsim.errors import CaseError, Fault, WearsimError
from wearsim.input.document import CaseSource
from wearsim.result import Life
from wearsim.runner.case_kind import ONE_SPROCKET, CaseKind
from wearsim.simulation.batch_lives import CaseLife


def kind_of(tables: Mapping[str, Any]) -> CaseKind:
    """Return what kind of cases a study of these tables has."""
    sprockets = tables.get("sprocket")
    if not isinstance(sprockets, list):
        return ONE_SPROCKET
    named = [table if isinstance(table, Mapping) else {} for table in sprockets]
    names = [wheel_name(table, number, len(named)) for number, table in enumerate(named, start=1)]
    return CaseKind(driver_case, load_drive, drive_lives, (CHAIN, *names))


def driver_case(source: CaseSource, overrides: Sequence[str] = ()) -> Case:
    """Return the case of the driver under the title of its drive, whose [wear] is that of all sprockets."""
    drive = load_drive(source, overrides)
    faults = [
        Fault("must be left out here, where [wear] is that of all: move it there", f"sprocket.{i}.wear")
        for i, wheel in enumerate(drive.wheels, start=1)
        if "wear" in wheel.own
    ]
    if faults:
        raise CaseError([replace(fault, file=drive.name) for fault in faults])
    return replace(drive.driver.case, name=drive.name, title=drive.title, assumptions=drive.assumptions)


def drive_lives(drives: Iterable[DriveCase]) -> Iterator[CaseLife | WearsimError]:
    """Give the lives of drives: of the part that ends first, and of each part; a cassette is one."""
    for drive in drives:
        try:
            found = drive_life(drive, threads=1).complete()
        except WearsimError as error:
            yield error
            continue
        lives = part_lives(found)
        ended = {name: life.hours for name, life in lives.items() if isinstance(life, Life)}
        yield CaseLife(
            drive.name,
            found.life,
            min(ended, key=ended.__getitem__, default="horizon_hours"),
            max(result.numerical_error for result in found.results.values()),
            found.warnings,
            lives,
        )
