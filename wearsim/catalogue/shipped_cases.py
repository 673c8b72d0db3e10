"""The cases that come with wearsim, each known by its name."""

import difflib
from functools import cache
from pathlib import Path


@cache
def shipped_cases() -> dict[str, Path]:
    """Return the place of every shipped case by its name: single ones, drives, calculations, studies."""
    package = Path(__file__).parent.parent
    # Beside the package in its repository, within it where it is installed.
    for folder in (package / "cases", package.parent / "cases"):
        kinds = (folder.glob(f"{part}*.toml") for part in ("", "drives/", "sizing/", "studies/"))
        found = {path.stem: path for kind in kinds for path in sorted(kind)}
        if found:
            return found
    return {}


@cache
def shipped_readings() -> dict[str, Path]:
    """Return the place of every shipped table of readings by its name."""
    folders = {path.parent for path in shipped_cases().values() if path.parent.name == "studies"}
    return {path.stem: path for folder in folders for path in sorted(folder.glob("*.csv"))}


def place_of_readings(path: Path) -> Path:
    """Return where readings are: the path itself, or the shipped ones of that name where no file has it.

    Examples
    --------
    >>> place_of_readings(Path("metal-wear")).name, place_of_readings(Path("my.csv")).name
    ('metal-wear.csv', 'my.csv')
    """
    if path.name != str(path) or path.is_file():
        return path
    return shipped_readings().get(str(path), path)


def place_of_case(path: Path) -> Path:
    """Return where a case is: the path itself, or the shipped case of that name where no file has it.

    Examples
    --------
    >>> place_of_case(Path("packaging-conveyor")).parts[-3:]
    ('cases', 'drives', 'packaging-conveyor.toml')
    >>> place_of_case(Path("my/packaging-conveyor")).parts
    ('my', 'packaging-conveyor')
    """
    if path.name != str(path) or path.is_file():
        return path
    return shipped_cases().get(str(path), path)


def similar_case(path: Path) -> str:
    """Return the name of the shipped case that a path is most like; empty where none is.

    Examples
    --------
    >>> similar_case(Path("packing-conveyor")), similar_case(Path("my/packing-conveyor"))
    ('packaging-conveyor', '')
    """
    if path.name != str(path):
        return ""
    return next(iter(difflib.get_close_matches(path.stem, shipped_cases(), n=1, cutoff=0.7)), "")
