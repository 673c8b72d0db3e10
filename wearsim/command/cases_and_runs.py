"""Cases to run and folders of runs, as several commands take them side by side."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from wearsim.catalogue.shipped_cases import place_of_case
from wearsim.command.options import error_json, exit_code, load_cases, show_error, worn
from wearsim.errors import OutputError, WearsimError

if TYPE_CHECKING:
    from wearsim.result import WearResult


def results_of(
    sources: tuple[Path, ...], settings: tuple[str, ...], as_json: bool
) -> "dict[Path, WearResult]":
    """Load the runs and run the cases; a failed case is shown and left out of the rest."""
    from wearsim.result import WearResult

    for path in sources:
        if not path.is_dir() and place_of_case(path).suffix != ".toml" and str(path) != "-":
            raise OutputError(
                f"{path}: must be a case (.toml, or the name of a shipped one) or the folder of a run"
            )
    check_settings(sources, settings)
    paths = [path for path in dict.fromkeys(sources) if not path.is_dir()]
    cases = dict(zip(paths, load_cases(paths, settings, as_json), strict=True))
    runs = {path: WearResult.load(path) for path in dict.fromkeys(sources) if path.is_dir()}
    found: dict[Path, WearResult] = {}
    failures: list[WearsimError] = []
    for path in dict.fromkeys(sources):
        try:
            found[path] = runs[path] if path in runs else worn(cases[path])
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
