"""Reading a case: from a file or a mapping, with overrides, to a complete one."""

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from wearsim.case.model import Case
from wearsim.input.document import CaseSource, Document, check_command, read_document
from wearsim.input.mechanism_registry import is_whole_drive, read_case

if TYPE_CHECKING:
    from wearsim.drive.drive_case import DriveCase


def load_case(source: CaseSource, overrides: Sequence[str] = ()) -> "Case | DriveCase":
    """Return the case of an input file, of its text or of a mapping with the same tables.

    Parameters
    ----------
    source : path, CaseText or mapping
        A TOML file, its text, or its tables as dictionaries (paths in it are then relative to
        the working directory).
    overrides : sequence of str
        ``table.key=VALUE``, applied before validation; VALUE is TOML, else a string.
        ``sprocket.2.teeth=57`` is a key of the second sprocket of a drive.

    Returns
    -------
    Case or DriveCase
        Complete: every default filled in and named under ``assumptions``. A drive where
        ``[[sprocket]]`` names all that the chain runs on, ``[load]`` and ``[[duty]]`` of its driver; else
        one sprocket, or a pair of gears.

    Raises
    ------
    CaseError
        Everything that is wrong with the input, with file and line.

    Examples
    --------
    >>> case = load_case({
    ...     "format_version": 1,
    ...     "chain": {"designation": "16B-1"},
    ...     "sprocket": {"teeth": 20, "profile": "evolute"},
    ...     "load": {"power_kW": 3, "speed_rpm": 100},
    ...     "wear": {"condition": "hardened, oiled"},
    ... })
    >>> case.cycles_per_hour
    6000.0
    """
    found: Case | DriveCase = read_case(_document(source, overrides, lambda tables: False, ""))
    return found


def load_single(source: CaseSource, overrides: Sequence[str] = ()) -> Case:
    """Return the case of one sprocket or of a pair of gears; a fault on a whole drive."""
    text = "must be one [sprocket] here, with drive.mate_teeth for the other one: this is a whole drive"
    found: Case = read_case(_document(source, overrides, is_whole_drive, text))
    return found


def load_drive(source: CaseSource, overrides: Sequence[str] = ()) -> "DriveCase":
    """Return a whole drive; a fault on one sprocket and on gears."""
    text = "must be [[sprocket]] for each sprocket of a drive here: this is one sprocket or a pair of gears"
    found: DriveCase = read_case(
        _document(source, overrides, lambda tables: not is_whole_drive(tables), text)
    )
    return found


def _document(
    source: CaseSource, overrides: Sequence[str], refused: Callable[[Mapping[str, Any]], bool], why: str
) -> Document:
    document = read_document(source, overrides)
    check_command(document.data, document.faults.file, "life")
    if refused(document.data):
        document.faults.add("sprocket", why)
        document.faults.check()
    return document
