"""What the public functions take for a case: one that is loaded, a file, or a mapping of tables."""

from collections.abc import Mapping
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any

from wearsim.case.model import Case
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.load_case import load_case
from wearsim.errors import CaseError, Fault
from wearsim.input.changes import changed
from wearsim.input.document import GivenInput

CaseInput = Case | DriveCase | str | PathLike[str] | Mapping[str, Any]
"""A loaded case or drive, the path of its file, or its tables."""


def loaded(source: CaseInput | GivenInput) -> Case | DriveCase:
    """Return a case, or a whole drive where the input names all of its sprockets."""
    if isinstance(source, Case | DriveCase):
        return source
    return load_case(source if isinstance(source, Mapping | GivenInput) else Path(source))


def given_input(source: CaseInput) -> GivenInput:
    """Return what a study reads its cases from."""
    case = loaded(source)
    if case.given is None:
        text = "must be studied as a whole: this is one sprocket of a drive, give the drive"
        raise CaseError([Fault(text, "", case.name)])
    return case.given


def with_table(source: CaseInput, name: str, table: Mapping[str, Any] | None) -> GivenInput:
    """Return the input of a study whose table takes the place of that of the case, if one is given."""
    given = given_input(source)
    if table is None:
        return given
    without = changed(given, {name: None})
    # In what was written too: the title is not to tell of what only the study takes.
    return replace(
        without, written={**without.written, name: dict(table)}, tables={**without.tables, name: dict(table)}
    )
