"""The folder of a whole drive: written all of it or nothing, read back with the results of its sprockets."""

import copy
import json
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import tomlkit

from wearsim.drive.drive_case import DriveCase
from wearsim.drive.drive_result import DriveLife
from wearsim.drive.load_case import load_drive
from wearsim.errors import OutputError, WearsimError
from wearsim.files import file_names, new_folder
from wearsim.input.document import GivenInput, check_inside, leaves
from wearsim.input.faults import Faults
from wearsim.input.named_files import FILE_KEYS, file_paths
from wearsim.report.drive.drive_json import drive_json
from wearsim.result import WearResult
from wearsim.result.folder import SCHEMA_VERSION, write_json, write_parquet
from wearsim.result.run_files import RunFiles, with_digests

_INPUTS, _PARTS = "inputs", "parts"
_STORED, _LOCK = "drive.json", "drive.lock.toml"
_FILES = ("points_file", "dxf_file")


def write_drive(found: DriveLife, folder: Path, force: bool, parquet: bool = False) -> None:
    """Write the lives of a drive, its input, and the history and the flanks of all sprockets."""
    with new_folder(folder, force) as place:
        lock = _lock(found, place)
        (place / _LOCK).write_text(lock, encoding="utf-8")
        for name in ("history", "flank"):
            table = getattr(found, name)
            table.to_csv(place / f"{name}.csv", index=False)
            if parquet:
                columns = {column: table[column].to_numpy() for column in table}
                write_parquet(place / f"{name}.parquet", columns)
        parts = {name: part for name, part in _parts(found.drive, place).items() if name in found.results}
        for sprocket, part in parts.items():
            found.results[sprocket].save(part)
        others = _others(tomllib.loads(lock), parts.values(), place)
        write_json(place / _STORED, with_digests(drive_json(found), place, _STORED, [_LOCK, *others]))


def read_drive(folder: Path) -> DriveLife:
    """Return the lives of a drive that were written."""
    try:
        return _stored(folder)
    except WearsimError:
        raise
    except OSError as error:
        raise _no_drive(folder, f"{Path(error.filename or folder).name}: {error.strerror or error}") from None
    except ValueError as error:
        raise _no_drive(folder, str(error)) from None
    except (TypeError, AttributeError, LookupError):
        raise _no_drive(folder, f"a value in {_STORED} is missing or of another kind") from None


def _no_drive(folder: Path, why: str) -> OutputError:
    return OutputError(
        f"{folder}: must be the folder of a drive ({_STORED}, {_LOCK} and a folder for each sprocket in "
        f"{_PARTS}): {why}: run its case again"
    )


def _stored(folder: Path) -> DriveLife:
    files = RunFiles(folder)
    stored = files.json(_STORED)
    if stored["schema_version"] != SCHEMA_VERSION:
        raise OutputError(
            f"{folder}: {_STORED} must have schema_version {SCHEMA_VERSION}, has "
            f"{stored['schema_version']!r}: read it with the wearsim that wrote it"
        )
    text, tables = files.text(_LOCK), files.toml(_LOCK)
    given = GivenInput(str(folder / _LOCK), stored["case"], folder, text, tables, tables)
    check_inside(given, Faults(given.file, text, ()))
    drive = load_drive(given)
    errors = {one["name"]: one["error"] for one in stored["sprockets"] if "error" in one}
    parts = {name: part for name, part in _parts(drive, folder).items() if name not in errors}
    for name in _others(tables, parts.values(), folder):
        files.text(name, "surrogateescape")
    results = {name: WearResult.load(part) for name, part in parts.items()}
    for one in drive.sprockets:
        if one.name in results:
            _check_same(folder, one.name, one.case.inputs, results[one.name].inputs)
    files.check(_STORED, stored)
    return DriveLife(drive, results, {name: WearsimError(error) for name, error in errors.items()})


def _check_same(folder: Path, name: str, now: Mapping[str, Any], then: Mapping[str, Any]) -> None:
    """Raise where a sprocket is read otherwise than when it was worn, as by other defaults."""
    files = {".".join(place) for place in FILE_KEYS}
    # As both stand in a file: lists, no tuples.
    plain = (json.loads(json.dumps(of)) for of in (then, now))
    before, after = ({key: at for key, at in leaves(of) if key not in files} for of in plain)
    for key in dict.fromkeys([*before, *after]):
        if before.get(key) != after.get(key):
            change = f"{key} of {name!r} was {before.get(key)!r} and is {after.get(key)!r} by this wearsim"
            lock = folder / _LOCK
            raise OutputError(f"{folder}: must be read as it was worn, but {change}: run {lock} again")


def _others(tables: Mapping[str, Any], parts: Iterable[Path], folder: Path) -> list[str]:
    """Return the names of the files of an input, and of the results of parts, in the folder of a drive."""
    values = dict(leaves(tables))
    inputs = [values[".".join(place)] for place in file_paths(tables)]
    return [*inputs, *((part / "result.json").relative_to(folder).as_posix() for part in parts)]


def _parts(drive: DriveCase, folder: Path) -> dict[str, Path]:
    """Return the folders of the results of all sprockets by their names."""
    names = [one.name for one in drive.sprockets]
    return {name: folder / _PARTS / file for name, file in zip(names, file_names(names), strict=True)}


def _lock(found: DriveLife, place: Path) -> str:
    """Return the input of a drive as TOML, its files beside it."""
    inputs: dict[str, Any] = copy.deepcopy(dict(found.drive.inputs))
    files = {one.name: one.case.input_files for one in found.drive.sprockets}
    for number, (wheel, table) in enumerate(zip(found.drive.wheels, inputs["sprocket"], strict=True), 1):
        if wheel.is_smooth:
            continue
        own = files[wheel.parts[0]]
        for key in _FILES:
            if key in table:
                file = Path(table[key]).name
                table[key] = _kept(place, f"{number}-{file}", own[file])
    load = inputs.get("load", {})
    if "duty_file" in load:
        file = Path(load["duty_file"]).name
        log = found.results[found.drive.driver.name].input_files[file]
        load["duty_file"] = _kept(place, file, log)
    document = tomlkit.document()
    document.add(tomlkit.comment(f"{found.drive.name} as it was read, with what --set changed"))
    for key, value in inputs.items():
        document.add(key, value)
    return tomlkit.dumps(document)


def _kept(place: Path, name: str, text: str) -> str:
    """Write a file of the input into the folder and return the name that its key takes."""
    (place / _INPUTS).mkdir(exist_ok=True)
    (place / _INPUTS / name).write_text(text, encoding="utf-8", errors="surrogateescape")
    return f"{_INPUTS}/{name}"
