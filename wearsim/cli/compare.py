"""``wearsim compare``: several lives side by side, with pictures."""

from collections.abc import Iterable
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
    print_json,
    show,
    show_failed_parts,
    warn,
)
from wearsim.command.single_file import check_workbook, workbook_option, write_workbook

if TYPE_CHECKING:
    from wearsim.case.model import Case
    from wearsim.drive.drive_case import DriveCase
    from wearsim.drive.drive_result import DriveLife
    from wearsim.result import WearResult


@click.command(short_help="Compare cases in tables and pictures.")
@click.argument("sources", nargs=-1, required=True, type=RunPath(path_type=Path), metavar="CASE_OR_RUN...")
@click.option("--out", type=click.Path(path_type=Path), help="New folder for tables and pictures.")
@workbook_option
@click.option("--force", is_flag=True, help="Replace an existing folder or workbook.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object per case.")
@keeping_runs
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
    check_workbook(out, xlsx, force)
    if out is not None:
        from wearsim.files import check_folder

        check_folder(out, force)
    loaded = loaded_sources(sources, settings, as_json)
    _check_alike(loaded.values())
    found = results_of(loaded, as_json)
    from wearsim.drive.drive_result import DriveLife
    from wearsim.report.chain_first import chain_first_of
    from wearsim.report.comparison import comparison_table, differing_limits, distinct_rows, save_comparison
    from wearsim.report.drive.drives_table import drives_table, save_drives

    drives = [one for one in found.values() if isinstance(one, DriveLife)]
    runs = {str(path): one for path, one in found.items() if not isinstance(one, DriveLife)}
    singles = distinct_rows(list(runs.values()), list(runs))
    if out is not None:
        if drives:
            save_drives(drives, out, force)
        else:
            save_comparison(singles, out, force)
        warn(f"written to {out}")
    if as_json:
        for path, result in found.items():
            print_json(result.summary(), path)
    else:
        show((drives_table(drives) if drives else comparison_table(singles)).markdown())
    if limits := differing_limits(singles):
        warn(f"warning: {limits}")
    if chain := chain_first_of(singles):
        warn(f"warning: {chain}")
    if xlsx is not None:
        write_workbook(found, xlsx, force)
    failed = show_failed_parts(found)
    return SOME_FAILED if failed or len(found) < len(set(sources)) else 0


def _check_alike(loaded: "Iterable[Case | DriveCase | WearResult | DriveLife]") -> None:
    """Raise where whole drives and flanks are to stand in one table."""
    if len(set(map(is_drive, loaded))) > 1:
        raise click.UsageError(
            "whole drives are compared by their parts, single sprockets and gears by their flanks: compare "
            "them separately"
        )
