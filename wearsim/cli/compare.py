"""``wearsim compare``: several lives side by side, with pictures."""

import json
from pathlib import Path

import click

from wearsim.command.cases_and_runs import results_of
from wearsim.command.colours import show
from wearsim.command.complete import RunPath
from wearsim.command.options import SOME_FAILED, common_options, overrides, warn
from wearsim.command.single_file import check_workbook, workbook_option, write_workbook


@click.command(short_help="Compare cases: tables and pictures.")
@click.argument("sources", nargs=-1, required=True, type=RunPath(path_type=Path), metavar="CASE_OR_RUN...")
@click.option("--out", type=click.Path(path_type=Path), help="New folder for tables and pictures.")
@workbook_option
@click.option("--force", is_flag=True, help="Replace an existing folder or workbook.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object per case.")
@overrides
@common_options
def compare(
    sources: tuple[Path, ...],
    out: Path | None,
    xlsx: Path | None,
    force: bool,
    as_json: bool,
    settings: tuple[str, ...],
) -> int:
    """Compare cases (.toml, run now) and runs (folders of life --out).

    Prints a table. --out writes it as summary.csv and summary.md, with pictures of the flanks, of
    depth, pressure and sliding along them, and of depth over running time. The workbook has a sheet
    for each case.

    Whole drives ([[sprocket]] twice or more) are compared part by part: lives, first replacement,
    ratings, cost.
    """
    from wearsim.study.whole_drive.command import are_drives, compared

    if are_drives(sources):
        if xlsx is not None:
            raise click.UsageError("whole drives take no --xlsx here: wearsim life writes their workbook")
        return compared(sources, settings, as_json, out, force)
    check_workbook(out, xlsx, force)
    if out is not None:
        from wearsim.files import check_folder

        check_folder(out, force)
    found = results_of(sources, settings, as_json)
    from wearsim.report.comparison import comparison_text, differing_limits, distinct

    results = distinct(list(found.values()), [str(path) for path in found])
    if out is not None:
        from wearsim.report.comparison import save_comparison

        save_comparison(results, out, force)
        warn(f"written to {out}")
    if as_json:
        from wearsim.report.service import life_json

        for result in results:
            click.echo(json.dumps(life_json(result), ensure_ascii=False, allow_nan=False))
    else:
        show(comparison_text(results))
    if limits := differing_limits(results):
        warn(f"warning: {limits}")
    if xlsx is not None:
        write_workbook(found, xlsx, force)
    return SOME_FAILED if len(found) < len(set(sources)) else 0
