"""What commands do with a whole drive: with all of its sprockets, or with one of them."""

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING

import click

from wearsim.command.colours import show
from wearsim.command.options import (
    NOT_MET,
    SOME_FAILED,
    error_json,
    exit_code,
    load_cases,
    print_json,
    show_error,
    warn,
    working,
)
from wearsim.command.single_file import write_workbook
from wearsim.errors import CaseError, Fault, WearsimError
from wearsim.files import check_folder
from wearsim.input.document import is_whole_drive, read_document
from wearsim.result import Life

if TYPE_CHECKING:
    from wearsim.case.model import Case
    from wearsim.drive.drive_case import DriveCase
    from wearsim.drive.drive_result import DriveLife
    from wearsim.geometry.wheel_outline import State
    from wearsim.result import WearResult


def is_drive(path: Path) -> bool:
    """Tell whether an input names the sprockets of a whole drive; one that cannot be read does not."""
    try:
        return is_whole_drive(read_document(path, ()).data)
    except CaseError:
        return False


def are_drives(cases: Sequence[Path]) -> bool:
    """Tell whether inputs are whole drives; a mixture is refused."""
    drives = [path for path in cases if is_drive(path)]
    if drives and len(drives) < len(cases):
        other = next(path for path in cases if path not in drives)
        raise click.UsageError(f"{drives[0]} is a whole drive, {other} is none: run them one after the other")
    return bool(drives)


def load_one(
    path: Path, settings: Sequence[str], sprocket: str | None, as_json: bool = False, or_else: str = ""
) -> "Case":
    """Return the case of an input, or of one sprocket where the input is a whole drive.

    What may be given in place of a sprocket is told where none is.
    """
    if not is_drive(path):
        if sprocket is not None:
            raise click.UsageError(f"--sprocket belongs to a whole drive, but {path} is none: leave it out")
        (case,) = load_cases([path], settings, as_json)
        return case
    cases = _titled_cases(loaded_drive(path, settings, as_json))
    if sprocket not in cases:
        got = or_else if sprocket is None else f" (got {sprocket!r})"
        names = ", ".join(map(repr, cases))
        raise click.UsageError(f"{path} is a whole drive: give --sprocket, one of {names}{got}")
    return cases[sprocket]


def _titled_cases(drive: "DriveCase") -> "dict[str, Case]":
    """Return the cases of all sprockets under titles that say which one of what drive it is."""
    return {one.name: replace(one.case, title=f"{drive.title}: {one.name}") for one in drive.sprockets}


def export_wheels(
    path: Path, settings: Sequence[str], out: Path, form: str, states: "Sequence[State]", force: bool
) -> None:
    """Write the wheels of all sprockets of a drive into a folder, each cog of a cassette for itself."""
    from wearsim.cad.wheel_formats import export
    from wearsim.files import file_names, new_folder

    check_folder(out, force)
    cases = _titled_cases(loaded_drive(path, settings, False))
    results = lived([path], settings, False)[path].complete().results if "worn" in states else {}
    with new_folder(out, force) as place:
        for file, (name, case) in zip(file_names(list(cases)), cases.items(), strict=True):
            (place / f"{file}.{form}").write_bytes(export(case, results.get(name), states, form))
    warn(f"written to {out}: {len(cases)} wheels")


def loaded_teeth(
    path: Path, settings: Sequence[str], as_json: bool, elongation: float, phase: float | None
) -> None:
    """Print what spans, shafts and all teeth of a drive carry."""
    from wearsim.mechanisms.wrap.tooth_loads import tooth_loads
    from wearsim.report.drive.layout import drive_loads_json, layout_text
    from wearsim.report.loads_table import loads_table

    drive = loaded_drive(path, settings, as_json)
    teeth = {one.name: tooth_loads(one.case, elongation, phase) for one in drive.sprockets}
    if as_json:
        print_json(drive_loads_json(drive, teeth), path)
        return
    click.echo(f"{drive.title}\n{layout_text(drive)}")
    for name, found in teeth.items():
        show(loads_table(replace(found, title=name)))


def live(
    paths: Sequence[Path],
    settings: Sequence[str],
    folders: Sequence[Path | None],
    xlsx: Path | None,
    force: bool,
    as_json: bool,
    hours: float | None,
    strict: bool,
    explain: bool,
) -> int:
    """Print how long every part of some drives lives, and write their files; return the exit code."""
    from wearsim.report.drive.drive_folder import write_drive
    from wearsim.report.drive.drive_text import drive_text
    from wearsim.report.drive.sheet import drive_json, found_rows

    found = lived(paths, settings, as_json, hours)
    for path, folder in zip(paths, folders, strict=True):
        if folder is not None and path in found:
            write_drive(found[path], folder, force)
    if xlsx is not None:
        said = {one.drive.title: found_rows(one) for one in found.values()}
        write_workbook(_by_sprocket(found.values()), xlsx, force, said)
    missed = False
    for path, one in found.items():
        if as_json:
            print_json(drive_json(one), path, one.warnings)
        else:
            show(drive_text(one, str(path), explain))
        missed = _missed(one, hours, strict) or missed
    if _show_failed(found) or len(found) < len(set(paths)):
        return SOME_FAILED
    return NOT_MET if missed else 0


def lived(
    paths: Sequence[Path], settings: Sequence[str], as_json: bool, hours: float | None = None
) -> "dict[Path, DriveLife]":
    """Wear drives, all of which are checked before; one that fails is shown and left out of several."""
    from wearsim.drive.life import drive_life

    drives = dict(zip(paths, _all_loaded(paths, settings, as_json), strict=True))
    found: dict[Path, DriveLife] = {}
    failures: list[WearsimError] = []
    for path, drive in drives.items():
        try:
            with working(f"wearing {drive.title}") as report_progress:
                found[path] = drive_life(drive, hours, report_progress)
        except WearsimError as error:
            failures.append(error)
            if as_json:
                click.echo(error_json(path.stem, error))
            show_error(error, path)
    if not found:
        raise click.exceptions.Exit(max(map(exit_code, failures)))
    return found


def _show_failed(found: "Mapping[Path, DriveLife]") -> bool:
    """Show what the runs of single sprockets have failed with; whether there are any."""
    errors = [
        (path, f"{name!r}: {error}") for path, one in found.items() for name, error in one.failed.items()
    ]
    for path, text in errors:
        show_error(WearsimError(text), path)
    return bool(errors)


def _by_sprocket(drives: "Iterable[DriveLife]") -> "dict[str, WearResult]":
    return {
        f"{one.drive.name} {name}": replace(result, case=name, title=f"{one.drive.title}: {name}")
        for one in drives
        for name, result in one.results.items()
    }


def _missed(found: "DriveLife", hours: float | None, strict: bool) -> bool:
    """Tell what is missed of the hours that are required of every part, or that there are warnings."""
    drive, missed = found.drive, False
    for name, life in found.parts.items():
        if hours is not None and isinstance(life, Life) and life.hours < hours:
            warn(f"{drive.name}: life of the {name} {life.hours:.6g} h is below {hours:g} h")
            missed = True
    if strict and found.warnings:
        warn(f"{drive.name}: {len(found.warnings)} warning(s) and --strict")
        missed = True
    return missed


def compared(
    paths: Sequence[Path], settings: Sequence[str], as_json: bool, out: Path | None, force: bool
) -> int:
    """Print several drives side by side, and write them into a folder; return the exit code."""
    from wearsim.report.drive.comparison import drives_text, save_drives
    from wearsim.report.drive.sheet import drive_json

    if out is not None:
        check_folder(out, force)
    found = lived(paths, settings, as_json)
    drives = list(found.values())
    if as_json:
        for path, one in found.items():
            print_json(drive_json(one), path)
    else:
        show(drives_text(drives))
    if out is not None:
        save_drives(drives, out, force)
        warn(f"written to {out}")
    return SOME_FAILED if _show_failed(found) or len(found) < len(set(paths)) else 0


def planned(path: Path, settings: tuple[str, ...], as_json: bool, out: Path | None, force: bool) -> None:
    """Print when to replace the parts of a drive and what that costs; with ``out`` write it too."""
    from wearsim.drive.maintenance import drive_plan
    from wearsim.report.drive.plan_sheet import plan_json, plan_text, save_plan

    if out is not None:
        check_folder(out, force)
    plan = drive_plan(lived([path], settings, as_json)[path].complete())
    if out is not None:
        save_plan(plan, out, force)
    if as_json:
        print_json(plan_json(plan), path, plan.found.warnings)
    else:
        show(plan_text(plan, str(path)))
    if out is not None:
        warn(f"written to {out}")


def checked(paths: Sequence[Path], settings: Sequence[str], as_json: bool) -> None:
    """Print that drives are complete, where their chains run, their ratings, and what they assume."""
    from wearsim.report.drive.layout import drive_check_json

    for path, drive in zip(paths, _all_loaded(paths, settings, as_json), strict=True):
        if as_json:
            click.echo(json.dumps(drive_check_json(drive), ensure_ascii=False))
        else:
            show(_check_text(drive, path))


def _check_text(drive: "DriveCase", path: Path) -> str:
    from wearsim.report.drive.layout import drive_check_warnings, layout_text
    from wearsim.report.rating import notes_text, rating_table

    case = drive.driver.case
    lines = [
        f"{path}: ok, sprockets {', '.join(one.name for one in drive.sprockets)}",
        layout_text(drive),
        *(f"  assumes  {text}" for text in drive.assumptions),
        rating_table(case),
        notes_text(case),
        *(f"  warning  {text}" for text in drive_check_warnings(drive)),
    ]
    return "\n".join(line for line in lines if line)


def report_sheet(
    path: Path, settings: Sequence[str], out: Path, force: bool, project: str, drawing: str, author: str
) -> None:
    """Write the sheet of a drive, and print where it stands."""
    from wearsim.extras import check_installed

    check_installed(("jinja2",), "report", "report")
    from wearsim.report.drive.report_page import SheetHead, check_page, is_page, save_sheet

    (check_page if is_page(out) else check_folder)(out, force)
    found = lived([path], settings, False)
    head = SheetHead(date.today(), project, author, drawing)
    click.echo(save_sheet(found[path], head, out, force))
    if _show_failed(found):
        raise click.exceptions.Exit(SOME_FAILED)


def loaded_drive(path: Path, settings: Sequence[str], as_json: bool) -> "DriveCase":
    """Return the drive of an input; as JSON its faults too."""
    (drive,) = _all_loaded([path], settings, as_json)
    return drive


def _all_loaded(paths: Sequence[Path], settings: Sequence[str], as_json: bool) -> "list[DriveCase]":
    """Load all drives before the first one runs; report all faults of all of them."""
    from wearsim.drive.load_case import load_drive

    drives: list[DriveCase] = []
    faults: list[Fault] = []
    for path in paths:
        try:
            drives.append(load_drive(path, settings))
        except CaseError as error:
            faults += error.faults
            if as_json:
                click.echo(error_json(path.stem, error))
    if faults:
        raise CaseError(faults)
    return drives
