"""``wearsim life``, ``check``, ``maintain`` and ``report`` of a drive with all of its sprockets."""

import json
from collections.abc import Sequence
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING

import click

from wearsim.command.options import NOT_MET, error_json, print_json, warn, working
from wearsim.errors import CaseError, WearsimError
from wearsim.files import check_folder
from wearsim.input.document import is_whole_drive, read_document
from wearsim.result import Life

if TYPE_CHECKING:
    from wearsim.study.whole_drive.keys import DriveCase


def is_drive(path: Path) -> bool:
    """Tell whether an input names the sprockets of a whole drive; one that cannot be read does not."""
    try:
        return is_whole_drive(read_document(path, ()).data)
    except CaseError:
        return False


def alone(cases: Sequence[Path]) -> bool:
    """Tell whether the inputs are one whole drive; one among others is refused."""
    drives = [path for path in cases if is_drive(path)]
    if drives and len(cases) > 1:
        raise click.UsageError(f"{drives[0]} is a whole drive: give it alone")
    return bool(drives)


def live(
    path: Path,
    settings: Sequence[str],
    as_json: bool,
    hours: float | None,
    strict: bool,
    out: Path | None = None,
    force: bool = False,
    explain: bool = False,
) -> int:
    """Print how long every part of a drive lives, and write its folder; return the exit code."""
    from wearsim.study.whole_drive.folder import write_drive
    from wearsim.study.whole_drive.model import drive_life
    from wearsim.study.whole_drive.sheet import drive_json, drive_text

    if out is not None:
        check_folder(out, force)
    drive = _loaded(path, settings, as_json)
    try:
        with working(f"wearing {drive.title}") as report_progress:
            found = drive_life(drive, hours, report_progress)
    except WearsimError as error:
        if as_json:
            click.echo(error_json(path.stem, error))
        raise
    if out is not None:
        write_drive(found, out, force)
    if as_json:
        print_json(drive_json(found), path, found.warnings)
    else:
        click.echo(drive_text(found, str(path), explain))
    missed = False
    for name, life in found.parts.items():
        if hours is not None and isinstance(life, Life) and life.hours < hours:
            warn(f"{drive.name}: life of the {name} {life.hours:.6g} h is below {hours:g} h")
            missed = True
    if strict and found.warnings:
        warn(f"{drive.name}: {len(found.warnings)} warning(s) and --strict")
        missed = True
    return NOT_MET if missed else 0


def planned(path: Path, settings: tuple[str, ...], as_json: bool, out: Path | None, force: bool) -> None:
    """Print when to replace the parts of a drive and what that costs; with ``out`` write it too."""
    from wearsim.files import check_folder
    from wearsim.study.whole_drive.maintenance import check_plan_keys, drive_plan
    from wearsim.study.whole_drive.model import drive_life
    from wearsim.study.whole_drive.plan_sheet import plan_json, plan_text, save_plan

    drive = _loaded(path, settings, as_json)
    try:
        check_plan_keys(path, settings)
        if out is not None:
            check_folder(out, force)
        with working(f"wearing {drive.title}") as report_progress:
            plan = drive_plan(drive_life(drive, progress=report_progress))
    except WearsimError as error:
        if as_json:
            click.echo(error_json(path.stem, error))
        raise
    if out is not None:
        save_plan(plan, out, force)
    if as_json:
        print_json(plan_json(plan), path, plan.found.warnings)
    else:
        click.echo(plan_text(plan, str(path)))
    if out is not None:
        warn(f"written to {out}")


def checked(path: Path, settings: Sequence[str], as_json: bool) -> None:
    """Print that a drive is complete, and what it assumes."""
    from wearsim.study.whole_drive.layout import layout_json, layout_text

    drive = _loaded(path, settings, as_json)
    warnings = tuple(dict.fromkeys(text for one in drive.sprockets for text in one.case.warnings))
    if as_json:
        content = {
            "schema_version": 1,
            "case": drive.name,
            "sprockets": [one.name for one in drive.sprockets],
            "layout": layout_json(drive),
            "assumptions": list(drive.assumptions),
            "warnings": list(warnings),
        }
        click.echo(json.dumps(content, ensure_ascii=False))
        return
    click.echo(f"{path}: ok, sprockets {', '.join(one.name for one in drive.sprockets)}")
    click.echo(layout_text(drive))
    for text in drive.assumptions:
        click.echo(f"  assumes  {text}")
    for text in warnings:
        click.echo(f"  warning  {text}")


def report_sheet(
    path: Path, settings: Sequence[str], out: Path, force: bool, project: str, drawing: str, author: str
) -> None:
    """Write the sheet of a drive, and print where it stands."""
    from wearsim.extras import check_installed

    check_installed(("jinja2",), "report", "report")
    from wearsim.study.whole_drive.keys import load_drive
    from wearsim.study.whole_drive.model import drive_life
    from wearsim.study.whole_drive.report_page import SheetHead, check_page, is_page, save_sheet

    (check_page if is_page(out) else check_folder)(out, force)
    drive = load_drive(path, settings)
    with working(f"wearing {drive.title}") as report_progress:
        found = drive_life(drive, progress=report_progress)
    head = SheetHead(date.today(), project, author, drawing)
    click.echo(save_sheet(found, head, out, force))


def _loaded(path: Path, settings: Sequence[str], as_json: bool) -> "DriveCase":
    from wearsim.study.whole_drive.keys import load_drive

    try:
        return load_drive(path, settings)
    except CaseError as error:
        if as_json:
            click.echo(error_json(path.stem, error))
        raise
