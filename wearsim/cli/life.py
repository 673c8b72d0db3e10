"""``wearsim life``: the life of one or several cases."""

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import click

from wearsim.command.complete import CasePath, complete_key
from wearsim.command.options import (
    NOT_MET,
    SOME_FAILED,
    answer_text,
    common_options,
    error_json,
    exit_code,
    finite,
    keeping_runs,
    load_cases,
    overrides,
    print_json,
    show,
    show_error,
    show_failed_parts,
    warn,
    working,
    worn,
)
from wearsim.command.single_file import check_workbook, workbook_option, write_workbook
from wearsim.errors import WearsimError

if TYPE_CHECKING:
    from wearsim.case.model import Case
    from wearsim.drive.drive_case import DriveCase
    from wearsim.drive.drive_result import DriveLife
    from wearsim.result import WearResult
    from wearsim.wear.accuracy import GridStudy


@click.command(short_help="Compute the service life in hours.")
@click.argument("cases", nargs=-1, required=True, type=CasePath(path_type=Path), metavar="CASE...")
@click.option(
    "--out", type=click.Path(path_type=Path), help="New folder for the result, its history and the flank."
)
@click.option(
    "--parquet",
    is_flag=True,
    help="Also write both tables as Parquet files (pip install 'wearsim[parquet]').",
)
@workbook_option
@click.option("--force", is_flag=True, help="Replace an existing folder or workbook.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object per case.")
@click.option(
    "--require-hours",
    type=click.FloatRange(min=0.0, min_open=True),
    metavar="H",
    callback=finite,
    help="Exit with code 4 if any life is shorter; raises the horizon to at least H.",
)
@click.option(
    "--solve-for",
    "key",
    metavar="TABLE.KEY",
    shell_complete=complete_key,
    help="Find the value of this key for which the life is --require-hours.",
)
@click.option(
    "--method",
    type=click.Choice(["advance", "per_cycle"]),
    help="Solution method: long controlled steps, or cycle by cycle (equations 10 to 13 of the source).",
)
@click.option("--verify-grid", is_flag=True, help="Repeat the run with a half and a quarter of the nodes.")
@click.option(
    "--explain", is_flag=True, help="Print every assumption and default, and the source of the band."
)
@click.option("--strict", is_flag=True, help="Exit with code 4 if a case has a warning.")
@keeping_runs
@overrides
@common_options
def life(
    cases: tuple[Path, ...],
    out: Path | None,
    parquet: bool,
    xlsx: Path | None,
    force: bool,
    as_json: bool,
    require_hours: float | None,
    key: str | None,
    method: str | None,
    verify_grid: bool,
    explain: bool,
    strict: bool,
    settings: tuple[str, ...],
) -> int:
    """Print the service life of each CASE (.toml), and how sure it is.

    A CASE is one sprocket, a pair of gears, or with [[sprocket]] twice or more a whole drive: chain
    and sprockets wear together.

    --out writes result.json, case.lock.toml, environment.json, history.csv and flank.csv; several
    cases get a folder each, named after their files. For a whole drive it writes drive.json,
    drive.lock.toml, and both tables for all sprockets. A workbook holds all cases.
    """
    if method is not None:
        settings = (*settings, f"run.method={method}")
    if key is not None:
        if verify_grid or explain or strict or parquet or xlsx:
            raise click.UsageError(
                "--solve-for takes neither --verify-grid, --explain, --strict, --parquet nor --xlsx"
            )
        return _solve(cases, key, require_hours, settings, out, force, as_json)
    _check_parquet(out, parquet)
    check_workbook(out, xlsx, force)
    loaded = load_cases(cases, settings, as_json)
    if require_hours is not None:
        loaded = [case.with_horizon(require_hours) for case in loaded]
    folders = _folders(cases, out, force)
    results: dict[Path, WearResult | DriveLife] = {}
    failures: list[WearsimError] = []
    missed = False
    for path, case, folder in zip(cases, loaded, folders, strict=True):
        try:
            result = _run(case, folder, force, parquet)
            grids = _verified(case) if verify_grid else {}
        except WearsimError as error:
            if len(loaded) == 1 and not as_json:
                raise
            failures.append(error)
            if as_json:
                click.echo(error_json(path.stem, error))
            show_error(error, path)
            continue
        _show(result, grids, path, as_json, explain)
        results[path] = result
        missed = _missed(result, path, require_hours, strict) or missed
    if xlsx is not None and results:
        write_workbook(results, xlsx, force)
    if failures:
        return SOME_FAILED if len(failures) < len(loaded) else max(map(exit_code, failures))
    if show_failed_parts(results):
        return SOME_FAILED
    return NOT_MET if missed else 0


def _solve(
    cases: tuple[Path, ...],
    key: str,
    hours: float | None,
    settings: tuple[str, ...],
    out: Path | None,
    force: bool,
    as_json: bool,
) -> int:
    from wearsim.study.solve_for.command import solve

    if len(cases) != 1 or hours is None:
        raise click.UsageError("--solve-for needs one CASE and --require-hours")
    (folder,) = _folders(cases, out, force)
    return solve(cases[0], key, hours, settings, folder, force, as_json)


def _folders(cases: tuple[Path, ...], out: Path | None, force: bool) -> list[Path | None]:
    from wearsim.files import check_folder

    if out is None:
        return [None] * len(cases)
    if len(cases) == 1:
        check_folder(out, force)
        return [out]
    twice = [stem for stem, count in Counter(path.stem for path in cases).items() if count > 1]
    if twice:
        raise click.UsageError(
            f"--out: several cases need different file names, {', '.join(twice)} comes twice"
        )
    folders: list[Path | None] = []
    for path in cases:
        check_folder(out / path.stem, force)
        folders.append(out / path.stem)
    return folders


def _check_parquet(out: Path | None, parquet: bool) -> None:
    """Find what is in the way of Parquet files before the first case runs."""
    if not parquet:
        return
    if out is None:
        raise click.UsageError("--parquet needs --out, the folder for its files")
    from wearsim.result.folder import pyarrow

    pyarrow()


def _run(
    case: "Case | DriveCase", folder: Path | None, force: bool, parquet: bool
) -> "WearResult | DriveLife":
    result = worn(case)
    if folder is not None:
        result.save(folder, force, parquet)
    return result


def _verified(case: "Case | DriveCase") -> "dict[str, GridStudy]":
    """Return the studies of three grids of all sprockets by their names."""
    from wearsim.drive.part_life import verify_grid

    with working(f"verifying the grid of {case.title}"):
        return {name: verify_grid(one) for name, one in case.single_cases.items()}


def _show(
    result: "WearResult | DriveLife", grids: "dict[str, GridStudy]", path: Path, as_json: bool, explain: bool
) -> None:
    from wearsim.report.answer import grid_json, grid_text
    from wearsim.result.ends import SPROCKET

    if as_json:
        studies = {name: grid_json(grid) for name, grid in grids.items()}
        grid = {"grid": studies.get(SPROCKET, studies)} if studies else {}
        print_json({**result.summary(), **grid}, path, result.warnings)
        return
    show(answer_text(result, str(path), explain))
    for name, grid_study in grids.items():
        show(grid_text(grid_study, "" if name == SPROCKET else name))


def _missed(result: "WearResult | DriveLife", path: Path, require_hours: float | None, strict: bool) -> bool:
    from wearsim.result import Life

    missed = False
    for what, life in result.named_lives.items():
        if require_hours is not None and isinstance(life, Life) and life.hours < require_hours:
            warn(f"{path.stem}: {what} {life.hours:.6g} h is below {require_hours:g} h")
            missed = True
    if strict and result.warnings:
        warn(f"{path.stem}: {len(result.warnings)} warning(s) and --strict")
        missed = True
    return missed
