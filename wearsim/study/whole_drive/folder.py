"""The folder of a whole drive: written all of it or nothing."""

import copy
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import tomlkit

from wearsim.files import new_folder
from wearsim.study.whole_drive.model import DriveLife
from wearsim.study.whole_drive.sheet import drive_json

if TYPE_CHECKING:
    import pandas as pd

_INPUTS = "inputs"
_FILES = ("points_file", "dxf_file")


def write_drive(found: DriveLife, folder: Path, force: bool) -> None:
    """Write the lives of a drive, its input, and the history and the flanks of all sprockets."""
    with new_folder(folder, force) as place:
        text = json.dumps(drive_json(found), indent=2, ensure_ascii=False, allow_nan=False)
        (place / "drive.json").write_text(text + "\n", encoding="utf-8")
        (place / "drive.lock.toml").write_text(_lock(found, place), encoding="utf-8")
        for name in ("history", "flank"):
            _table(found, f"{name}_columns").to_csv(place / f"{name}.csv", index=False)


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


def _table(found: DriveLife, name: str) -> "pd.DataFrame":
    """Return the tables of all sprockets below each other, with their names in the first column."""
    import pandas as pd

    tables = []
    for sprocket, result in found.results.items():
        table = pd.DataFrame(getattr(result, name))
        table.insert(0, "sprocket", sprocket)
        tables.append(table)
    return pd.concat(tables, ignore_index=True)
