"""The folder of a whole drive: written all of it or nothing."""

import copy
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import tomlkit

from wearsim.drive.drive_result import DriveLife
from wearsim.files import new_folder
from wearsim.report.drive.sheet import drive_json
from wearsim.result.folder import write_parquet

if TYPE_CHECKING:
    pass

_INPUTS = "inputs"
_FILES = ("points_file", "dxf_file")


def write_drive(found: DriveLife, folder: Path, force: bool, parquet: bool = False) -> None:
    """Write the lives of a drive, its input, and the history and the flanks of all sprockets."""
    with new_folder(folder, force) as place:
        text = json.dumps(drive_json(found), indent=2, ensure_ascii=False, allow_nan=False)
        (place / "drive.json").write_text(text + "\n", encoding="utf-8")
        (place / "drive.lock.toml").write_text(_lock(found, place), encoding="utf-8")
        for name in ("history", "flank"):
            table = getattr(found, name)
            table.to_csv(place / f"{name}.csv", index=False)
            if parquet:
                columns = {column: table[column].to_numpy() for column in table}
                write_parquet(place / f"{name}.parquet", columns)


def _lock(found: DriveLife, place: Path) -> str:
    """Return the input of a drive as TOML, its files beside it."""
    inputs: dict[str, Any] = copy.deepcopy(dict(found.drive.inputs))
    files = {one.name: one.case.input_files for one in found.drive.sprockets}
    for number, (wheel, table) in enumerate(zip(found.drive.wheels, inputs["sprocket"], strict=True), 1):
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
