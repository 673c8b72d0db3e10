"""Cases to run and folders of runs, as several commands take them side by side."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from wearsim.catalogue.shipped_cases import place_of_case
from wearsim.command.options import error_json, exit_code, load_cases, show_error, worn
from wearsim.errors import OutputError, WearsimError

if TYPE_CHECKING:
    from wearsim.case.model import Case
    from wearsim.drive.drive_case import DriveCase
    from wearsim.drive.drive_result import DriveLife
    from wearsim.result import WearResult


def loaded_sources(
    sources: Sequence[Path], settings: tuple[str, ...], as_json: bool
) -> "dict[Path, Case | DriveCase | WearResult]":
    """Load cases, and the runs in folders, each once."""
    from wearsim.result import WearResult

    for path in sources:
        if not path.is_dir() and place_of_case(path).suffix != ".toml" and str(path) != "-":
            raise OutputError(
                f"{path}: must be a case (.toml, or the name of a shipped one) or the folder of a run"
            )
    check_settings(sources, settings)
    paths = [path for path in dict.fromkeys(sources) if not path.is_dir()]
    cases = dict(zip(paths, load_cases(paths, settings, as_json), strict=True))
    return {path: cases[path] if path in cases else WearResult.load(path) for path in dict.fromkeys(sources)}


def results_of(
    loaded: "Mapping[Path, Case | DriveCase | WearResult]", as_json: bool
) -> "dict[Path, WearResult | DriveLife]":
    """Run the cases among cases and runs; one that fails is shown and left out of the rest."""
    from wearsim.result import WearResult

    found: dict[Path, WearResult | DriveLife] = {}
    failures: list[WearsimError] = []
    for path, source in loaded.items():
        try:
            found[path] = source if isinstance(source, WearResult) else worn(source)
        except WearsimError as error:
            failures.append(error)
            if as_json:
                click.echo(error_json(path.stem, error))
            show_error(error, path)
    if not found:
        raise click.exceptions.Exit(max(exit_code(error) for error in failures))
    return found


def check_settings(sources: Sequence[Path], settings: tuple[str, ...]) -> None:
    """Raise where values are to be set in a run, which has been."""
    if settings and any(path.is_dir() for path in sources):
        raise click.UsageError("--set changes cases, it cannot change the folder of a run")


def one_sprocket(case: "Case | DriveCase", path: Path, sprocket: str | None, or_else: str = "") -> "Case":
    """Return the case of one sprocket, of a whole drive that which is named, under a title that says so.

    What may be given in place of a sprocket is told where none is.
    """
    from wearsim.case.model import Case

    if isinstance(case, Case):
        if sprocket is not None:
            raise click.UsageError(f"--sprocket belongs to a whole drive, but {path} is none: leave it out")
        return case
    cases = case.titled_cases()
    if sprocket not in cases:
        got = or_else if sprocket is None else f" (got {sprocket!r})"
        names = ", ".join(map(repr, cases))
        raise click.UsageError(f"{path} is a whole drive: give --sprocket, one of {names}{got}")
    return cases[sprocket]
