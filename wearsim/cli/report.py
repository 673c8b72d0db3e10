"""``wearsim report``: pages for a browser, one for each drive."""

from collections.abc import Callable, Mapping
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING, Any

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
    from wearsim.report.html.paper import SheetHead
    from wearsim.result import WearResult

_HEAD = {
    "project": "Project, printed at the head of the sheet.",
    "drawing": "Drawing number, printed on the sheet.",
    "revision": "Revision of the sheet, printed on every page.",
    "author": "Author, printed on the sheet.",
    "checked-by": "Who checked it, printed on the sheet.",
}
"""Options for the head of a sheet, with their help."""


def _head_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options for the head of a sheet, in the order of its rows."""
    for name, text in reversed(_HEAD.items()):
        function = click.option(f"--{name}", default="", metavar="TEXT", help=text)(function)
    return function


@click.command(short_help="Report as HTML or PDF: inputs, verdict, service lives, pictures.")
@click.argument("sources", nargs=-1, required=True, type=RunPath(path_type=Path), metavar="RUN_OR_CASE...")
@click.option(
    "--out",
    required=True,
    type=click.Path(path_type=Path),
    help="New folder, or of one drive a file: *.html or *.pdf.",
)
@click.option("--single-file", is_flag=True, help="Self-contained pages with their scripts, about 5 MB each.")
@click.option(
    "--detail",
    type=click.Choice(["brief", "full"]),
    default="full",
    show_default=True,
    help="Amount of detail; brief keeps answer, tooth, margins, assumptions and warnings.",
)
@_head_options
@click.option("--force", is_flag=True, help="Replace an existing folder or file.")
@keeping_runs
@overrides
@common_options
def report(
    sources: tuple[Path, ...],
    out: Path,
    single_file: bool,
    detail: str,
    force: bool,
    settings: tuple[str, ...],
    **head: str,
) -> int:
    """Write pages about runs (folders of life --out) and cases (.toml, run now).

    Open index.html in the folder: the page of the drive, or, for several, a comparison that links to
    their pages. The pages need no network. Needs jinja2 and plotly (pip install 'wearsim[report]').

    --out sheet.html writes the page of one drive as a single file.

    A case with [[sprocket]] twice or more is a whole drive: one page, a calculation sheet for A4,
    which needs jinja2 only.

    --out sheet.pdf writes the page of one drive as PDF, with page numbers. Chromium, Chrome or Edge must be
    installed to print it.
    """
    from wearsim.extras import check_installed

    loaded = loaded_sources(sources, settings, False)
    if any(map(is_drive, loaded.values())):
        if len(loaded) > 1:
            raise click.UsageError("a drive has a sheet of its own: run wearsim report for each")
        if single_file or detail != "full":
            raise click.UsageError(
                "a drive with [[sprocket]] takes neither --single-file, as its page is one, nor --detail"
            )
        check_installed(("jinja2",), "report", "report")
        return _report_drive(loaded, out, force, _sheet_head(head))
    check_installed(("jinja2", "plotly"), "report", "report")
    _check_place(out, force, single_file, len(loaded))
    found = results_of(loaded, False)
    from wearsim.report.comparison import differing_limits, distinct
    from wearsim.report.html.page_writer import save_report
    from wearsim.result import WearResult

    singles = [one for one in found.values() if isinstance(one, WearResult)]
    results = distinct(singles, [str(path) for path in found])
    for page in save_report(results, out, force, single_file, detail, _sheet_head(head)):
        click.echo(page)
    if limits := differing_limits(results):
        warn(f"warning: {limits}")
    return SOME_FAILED if len(found) < len(set(sources)) else 0


def _sheet_head(head: Mapping[str, str]) -> "SheetHead":
    from wearsim.report.html.paper import SheetHead

    return SheetHead(date.today(), **head)


def _check_place(out: Path, force: bool, single_file: bool, count: int) -> None:
    """Raise where pages cannot be written or replaced."""
    from wearsim.report.drive.report_page import check_sheet
    from wearsim.report.html.pdf import is_page, is_pdf

    if count > 1 and (is_page(out) or is_pdf(out)):
        raise click.UsageError(f"{out} is a file, which holds one drive: give a folder for several")
    if single_file and is_pdf(out):
        raise click.UsageError("a PDF holds no scripts: leave --single-file out")
    check_sheet(out, force)


def _report_drive(
    loaded: "Mapping[Path, Case | DriveCase | WearResult | DriveLife]",
    out: Path,
    force: bool,
    head: "SheetHead",
) -> int:
    """Write the sheet of a drive, and print where it stands."""
    from wearsim.drive.drive_result import DriveLife
    from wearsim.report.drive.report_page import check_sheet, save_sheet

    check_sheet(out, force)
    found = results_of(loaded, False)
    for result in found.values():
        assert isinstance(result, DriveLife)
        click.echo(save_sheet(result, head, out, force))
    return SOME_FAILED if show_failed_parts(found) else 0
