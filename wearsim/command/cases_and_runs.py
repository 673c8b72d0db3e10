"""Cases to run and folders of runs, as several commands take them side by side."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, overload

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
) -> "dict[Path, Case | DriveCase | WearResult | DriveLife]":
    """Load cases, and the runs in folders, each once."""
    for path in sources:
        if not path.is_dir() and place_of_case(path).suffix != ".toml" and str(path) != "-":
            raise OutputError(
                f"{path}: must be a case (.toml, or the name of a shipped one) or the folder of a run"
            )
    check_settings(sources, settings)
    paths = [path for path in dict.fromkeys(sources) if not path.is_dir()]
    cases = dict(zip(paths, load_cases(paths, settings, as_json), strict=True))
    return {path: cases[path] if path in cases else _run(path) for path in dict.fromkeys(sources)}


def _run(folder: Path) -> "WearResult | DriveLife":
    """Read the run of one sprocket, of a pair of gears or of a whole drive."""
    # One sprocket starts without what only whole drives take.
    if (folder / "drive.json").is_file():
        from wearsim.drive.drive_result import DriveLife

        return DriveLife.load(folder)
    from wearsim.result import WearResult

    return WearResult.load(folder)


def results_of(
    loaded: "Mapping[Path, Case | DriveCase | WearResult | DriveLife]", as_json: bool
) -> "dict[Path, WearResult | DriveLife]":
    """Run the cases among cases and runs; one that fails is shown and left out of the rest."""
    from wearsim.case.model import Case
    from wearsim.drive.drive_case import DriveCase

    found: dict[Path, WearResult | DriveLife] = {}
    failures: list[WearsimError] = []
    for path, source in loaded.items():
        try:
            found[path] = worn(source) if isinstance(source, Case | DriveCase) else source
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


def is_drive(source: "Case | DriveCase | WearResult | DriveLife") -> bool:
    """Tell whether a case or a run is that of a whole drive."""
    from wearsim.case.model import Case
    from wearsim.result import WearResult

    return not isinstance(source, Case | WearResult)


@overload
def one_sprocket(
    source: "Case | DriveCase", path: Path, sprocket: str | None, or_else: str = ""
) -> "Case": ...


@overload
def one_sprocket(
    source: "Case | DriveCase | WearResult | DriveLife", path: Path, sprocket: str | None, or_else: str = ""
) -> "Case | WearResult": ...


def one_sprocket(
    source: "Case | DriveCase | WearResult | DriveLife", path: Path, sprocket: str | None, or_else: str = ""
) -> "Case | WearResult":
    """Return case or run of one sprocket, of a whole drive that which is named, under a title that says so.

    What may be given in place of a sprocket is told where none is.
    """
    from wearsim.case.model import Case
    from wearsim.drive.drive_case import DriveCase
    from wearsim.result import WearResult

    if isinstance(source, Case | WearResult):
        if sprocket is not None:
            raise click.UsageError(f"--sprocket belongs to a whole drive, but {path} is none: leave it out")
        return source
    found: Mapping[str, Case | WearResult] = (
        source.titled_cases()
        if isinstance(source, DriveCase)
        else {result.case: result for result in source.titled()}
    )
    if sprocket is None or sprocket not in found:
        got = or_else if sprocket is None else f" (got {sprocket!r})"
        names = ", ".join(map(repr, found))
        raise click.UsageError(f"{path} is a whole drive: give --sprocket, one of {names}{got}")
    return found[sprocket]
