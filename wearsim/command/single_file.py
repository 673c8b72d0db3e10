"""What commands that write one file share: its place, its ending, stdout for ``-``; and ``--xlsx``."""

import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from wearsim.command.options import warn
from wearsim.errors import OutputError

if TYPE_CHECKING:
    from wearsim.drive.drive_result import DriveLife
    from wearsim.result import WearResult

Function = TypeVar("Function", bound=Callable[..., Any])


def check_place(place: Path, source: Path, force: bool) -> None:
    """Raise where a file would be written over another one, or over its own source."""
    from wearsim.files import check_free

    if str(place) == "-":
        return
    check_free(place, force)
    if place.resolve() == source.resolve():
        raise OutputError(f"{place}: must not be the case itself: choose another place")


def format_of(place: Path, given: str | None, known: tuple[str, ...], hint: str) -> str:
    """Return the format of a file by its ending."""
    from wearsim.cad import format_by_ending

    found = given or format_by_ending(place)
    if found not in known:
        endings = ", ".join(f".{name}" for name in known)
        raise OutputError(f"{place}: must end in one of {endings}: choose another name, or {hint}")
    return found


def write_content(place: Path, content: bytes, force: bool) -> None:
    """Write a file, all of it or nothing, and say so; to stdout where the place is ``-``."""
    if str(place) == "-":
        sys.stdout.buffer.write(content)
        return
    from wearsim.files import write_file

    write_file(place, content, force)
    warn(f"written to {place}")


def workbook_option(function: Function) -> Function:
    """Add ``--xlsx``."""
    return click.option(
        "--xlsx",
        type=click.Path(path_type=Path, dir_okay=False),
        metavar="FILE",
        help="New workbook with answers, tables, charts and inputs (pip install 'wearsim[report]').",
    )(function)


def check_workbook(out: Path | None, xlsx: Path | None, force: bool) -> None:
    """Find what is in the way of a workbook before the first case runs."""
    if xlsx is None:
        return
    from wearsim.report import workbook

    if out is not None and out.resolve() == xlsx.resolve():
        raise OutputError(f"{xlsx}: must not be the folder of --out: choose another place")
    workbook.check_workbook(xlsx, force)


def write_workbook(results: "Mapping[Path, WearResult | DriveLife]", file: Path, force: bool) -> None:
    """Write results into a workbook, with titles that tell them apart, and say where it is.

    What is found of a whole drive stands above its sprockets, after what was given of it.
    """
    from wearsim.drive.drive_result import DriveLife
    from wearsim.report.comparison import distinct
    from wearsim.report.workbook import save_workbook

    sheets: dict[str, WearResult] = {}
    said: dict[str, Sequence[tuple[str, str]]] = {}
    for path, result in results.items():
        if isinstance(result, DriveLife):
            sheets |= {f"{result.drive.name} {one.case}": one for one in result.titled()}
            said |= _verified(result)
        else:
            sheets[str(path)] = result
    save_workbook(distinct(list(sheets.values()), list(sheets)), file, force, said)
    warn(f"written to {file}")


def _verified(found: "DriveLife") -> dict[str, Sequence[tuple[str, str]]]:
    """Return what the sheet of a drive begins with: inputs, loads and lubrication, the verdict, the lives."""
    from wearsim.report.drive.drive_words import drive_findings
    from wearsim.report.verification import given_rows, verification_rows

    title, case = found.drive.title, found.drive.driver.case
    *lives, verdict = drive_findings(found)
    return {
        f"{title}: inputs": given_rows(found.drive.inputs, case),
        f"{title}: loads, factors, lubrication": verification_rows(case, found.reference.ratings),
        f"{title}: verdict and service lives": [verdict, *lives],
    }
