"""``wearsim report``: pages for a browser, one for each drive."""

from pathlib import Path

import click

from wearsim.command.cases_and_runs import results_of
from wearsim.command.complete import RunPath
from wearsim.command.options import SOME_FAILED, common_options, overrides, warn


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
    from wearsim.study.whole_drive.command import are_drives, report_sheet

    if are_drives(sources):
        if len(sources) > 1:
            raise click.UsageError("a drive has a sheet of its own: run wearsim report for each")
        if single_file or detail != "full":
            raise click.UsageError(
                "a drive with [[sprocket]] takes neither --single-file, as its page is one, nor --detail"
            )
        report_sheet(sources[0], settings, out, force, project, drawing, author)
        return 0
    if project or drawing or author:
        raise click.UsageError("--project, --drawing and --author belong to a drive with [[sprocket]]")
    check_installed(("jinja2", "plotly"), "report", "report")
    check_folder(out, force)
    found = results_of(sources, settings, False)
    from wearsim.report.comparison import differing_limits, distinct
    from wearsim.report.html.page_writer import save_report

    results = distinct(list(found.values()), [str(path) for path in found])
    for page in save_report(results, out, force, single_file, detail):
        click.echo(out / page)
    if limits := differing_limits(results):
        warn(f"warning: {limits}")
    return SOME_FAILED if len(found) < len(set(sources)) else 0
