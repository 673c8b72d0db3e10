"""``wearsim report``: pages for a browser, one for each drive."""

from collections.abc import Mapping
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING

import click

from wearsim.command.cases_and_runs import is_drive, loaded_sources, results_of
from wearsim.command.complete import RunPath
from wearsim.command.options import (
    SOME_FAILED,
    common_options,
    keeping_runs,
    overrides,
    show_failed_parts,
    warn,
)

if TYPE_CHECKING:
    from wearsim.case.model import Case
    from wearsim.drive.drive_case import DriveCase
    from wearsim.drive.drive_result import DriveLife
    from wearsim.result import WearResult


@click.command(short_help="HTML report: results, pictures, inputs, sources.")
@click.argument("sources", nargs=-1, required=True, type=RunPath(path_type=Path), metavar="RUN_OR_CASE...")
@click.option(
    "--out",
    required=True,
    type=click.Path(path_type=Path),
    help="New folder; for a whole drive, also a file *.html.",
)
@click.option("--single-file", is_flag=True, help="Self-contained pages with their scripts, about 5 MB each.")
@click.option(
    "--detail",
    type=click.Choice(["brief", "full"]),
    default="full",
    show_default=True,
    help="brief: only answer, tooth, margins, assumptions and warnings.",
)
@click.option("--project", default="", metavar="TEXT", help="Project, printed on the sheet of a whole drive.")
@click.option("--drawing", default="", metavar="TEXT", help="Drawing number, printed on the sheet.")
@click.option("--author", default="", metavar="TEXT", help="Author, printed on the sheet.")
@click.option("--force", is_flag=True, help="Replace an existing folder or file.")
@keeping_runs
@overrides
@common_options
def report(
    sources: tuple[Path, ...],
    out: Path,
    single_file: bool,
    detail: str,
    project: str,
    drawing: str,
    author: str,
    force: bool,
    settings: tuple[str, ...],
) -> int:
    """Write HTML pages about runs (folders of life --out) and cases (.toml, run now).

    Open index.html in the folder: the page of the drive, or, for several, a comparison that links to
    their pages. The pages need no network. Needs wearsim[report].

    A case with [[sprocket]] twice or more is a whole drive: one page, a calculation sheet for A4.
    """
    from wearsim.extras import check_installed
    from wearsim.files import check_folder

    loaded = loaded_sources(sources, settings, False)
    if any(map(is_drive, loaded.values())):
        if len(loaded) > 1:
            raise click.UsageError("a drive has a sheet of its own: run wearsim report for each")
        if single_file or detail != "full":
            raise click.UsageError(
                "a drive with [[sprocket]] takes neither --single-file, as its page is one, nor --detail"
            )
        return _report_drive(loaded, out, force, (project, drawing, author))
    if project or drawing or author:
        raise click.UsageError("--project, --drawing and --author belong to a drive with [[sprocket]]")
    check_installed(("jinja2", "plotly"), "report", "report")
    check_folder(out, force)
    found = results_of(loaded, False)
    from wearsim.report.comparison import differing_limits, distinct
    from wearsim.report.html.page_writer import save_report
    from wearsim.result import WearResult

    singles = [one for one in found.values() if isinstance(one, WearResult)]
    results = distinct(singles, [str(path) for path in found])
    for page in save_report(results, out, force, single_file, detail):
        click.echo(out / page)
    if limits := differing_limits(results):
        warn(f"warning: {limits}")
    return SOME_FAILED if len(found) < len(set(sources)) else 0


def _report_drive(
    loaded: "Mapping[Path, Case | DriveCase | WearResult | DriveLife]",
    out: Path,
    force: bool,
    head: tuple[str, str, str],
) -> int:
    """Write the sheet of a drive, and print where it stands."""
    from wearsim.drive.drive_result import DriveLife
    from wearsim.extras import check_installed
    from wearsim.files import check_folder

    check_installed(("jinja2",), "report", "report")
    from wearsim.report.drive.report_page import SheetHead, check_page, is_page, save_sheet

    (check_page if is_page(out) else check_folder)(out, force)
    found = results_of(loaded, False)
    project, drawing, author = head
    for result in found.values():
        assert isinstance(result, DriveLife)
        click.echo(save_sheet(result, SheetHead(date.today(), project, author, drawing), out, force))
    return SOME_FAILED if show_failed_parts(found) else 0
