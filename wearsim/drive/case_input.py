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
    if isinstance(source, str | PathLike):
        return load_case(Path(source))
    if not isinstance(source, Mapping | GivenInput):
        text = f"must be a case, the path of its file, or its tables (got a {type(source).__name__})"
        raise CaseError([Fault(text, "case")])
    return load_case(source)


def keys_of(name: str, given: Mapping[str, Any] | None) -> dict[str, Any]:
    """Return an argument that maps keys of a case to values, empty where it is left out.

    Raises
    ------
    CaseError
        It is no mapping.

    Examples
    --------
    >>> keys_of("grid", {"load.power_kW": [1, 2]})
    {'load.power_kW': [1, 2]}
    """
    if given is not None and not isinstance(given, Mapping):
        text = (
            "must map keys of the case to values, such as {'load.power_kW': ...} "
            f"(got a {type(given).__name__})"
        )
        raise CaseError([Fault(text, name)])
    return dict(given or {})


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
    added = {name: keys_of(name, table)}
    without = changed(given, {name: None})
    # In what was written too: the title is not to tell of what only the study takes.
    return replace(without, written={**without.written, **added}, tables={**without.tables, **added})
