"""The folder of a result: written all of it or nothing, read back number by number."""

import copy
import json
from collections.abc import Mapping
from dataclasses import asdict, fields
from pathlib import Path, PurePosixPath
from typing import Any

from wearsim.chain.rating_findings import RatingFinding
from wearsim.errors import OutputError
from wearsim.extras import library
from wearsim.files import new_folder
from wearsim.geometry.profile_points import Vector
from wearsim.input.mechanism_registry import mechanism_of
from wearsim.input.named_files import FILE_KEYS, file_paths
from wearsim.quantities import quantities
from wearsim.result.lives import Life, LimitState, LowerBound
from wearsim.result.run_files import RunFiles, with_digests
from wearsim.result.second_opinions import read_opinions
from wearsim.result.stored_tables import table_columns
from wearsim.result.stored_values import check_flank, check_history, check_inputs, check_parts, check_values

SCHEMA_VERSION = 1

_INPUTS = "inputs"
_FILES = "case.lock.toml", "environment.json", "history.csv", "flank.csv"


def write_result(
    result: Mapping[str, Any], summary: Mapping[str, Any], folder: Path, force: bool, parquet: bool
) -> None:
    """Write the fields of a result into a folder, with what is shown of them."""
    import pandas as pd

    with new_folder(folder, force) as place:
        write_json(place / "environment.json", result["environment"])
        (place / "case.lock.toml").write_text(_lock(result["case"], result["inputs"]), encoding="utf-8")
        for name, text in result["input_files"].items():
            (place / _INPUTS).mkdir(exist_ok=True)
            (place / _INPUTS / name).write_text(text, encoding="utf-8", errors="surrogateescape")
        for name in ("history", "flank"):
            columns = result[f"{name}_columns"]
            pd.DataFrame(columns).to_csv(place / f"{name}.csv", index=False)
            if parquet:
                write_parquet(place / f"{name}.parquet", columns)
        read = (*_FILES, *(f"{_INPUTS}/{name}" for name in result["input_files"]))
        stored = with_digests(stored_result(result, summary), place, "result.json", read)
        write_json(place / "result.json", stored)


def stored_result(result: Mapping[str, Any], summary: Mapping[str, Any]) -> dict[str, Any]:
    """Return the fields of a result, but for its tables and inputs, as plain values."""
    return {
        **summary,
        "lives": {name: asdict(result[name]) for name in ("life", "life_low", "life_high")},
        "parts": {name: asdict(life) for name, life in result["parts"].items()},
        "bands": {name: [asdict(life) for life in band] for name, band in result["bands"].items()},
    }


def pyarrow() -> Any:
    """Return the library that writes Parquet."""
    return library("pyarrow", "parquet", "--parquet")


def write_parquet(path: Path, columns: Mapping[str, Vector]) -> None:
    """Write a table; the unit of each column stands in the metadata of its field."""
    arrow = pyarrow()
    from pyarrow import parquet

    arrays = [arrow.array(values) for values in columns.values()]
    fields = [
        arrow.field(name, array.type, metadata={"unit": quantities()[name].unit})
        for name, array in zip(columns, arrays, strict=True)
    ]
    table = arrow.Table.from_arrays(arrays, schema=arrow.schema(fields))
    parquet.write_table(table, path, compression="zstd")


def _lock(case: str, inputs: Mapping[str, Any]) -> str:
    import tomlkit

    document = tomlkit.document()
    document.add(tomlkit.comment(f"{case} with every default taken by wearsim"))
    for key, value in with_files(inputs, _INPUTS).items():
        if value != {}:
            document.add(key, value)
    return tomlkit.dumps(document)


def read_result(folder: Path) -> dict[str, Any]:
    """Return the fields of a result that was written."""
    if (folder / "drive.json").is_file():
        raise OutputError(
            f"{folder}: must be the run of one case, but is that of a whole drive: use DriveLife"
        )
    try:
        return _stored(folder)
    except OutputError:
        raise
    except OSError as error:
        raise _no_result(
            folder, f"{Path(error.filename or folder).name}: {error.strerror or error}"
        ) from None
    except ValueError as error:
        raise _no_result(folder, str(error)) from None
    except (TypeError, AttributeError, LookupError):
        raise _no_result(folder, "a value in them is missing or of another kind") from None


def _no_result(folder: Path, why: str) -> OutputError:
    return OutputError(
        f"{folder}: must be the folder of a result (result.json, {', '.join(_FILES)}): {why}: run its case "
        "again"
    )


def _stored(folder: Path) -> dict[str, Any]:
    """Return the fields of a result in a folder."""
    files = RunFiles(folder)
    stored = files.json("result.json")
    version = stored.get("schema_version")
    if version != SCHEMA_VERSION:
        raise OutputError(
            f"{folder}: result.json must have schema_version {SCHEMA_VERSION}, has "
            f"{version!r}: read it with the wearsim that wrote it"
        )
    lock = files.toml("case.lock.toml")
    check_values("result.json", stored)
    mechanism = mechanism_of(lock)
    check_inputs("case.lock.toml", of_one_sprocket(lock), mechanism)
    check_parts("result.json", stored, mechanism)
    inputs = with_files(lock, "")
    input_files = {name: files.text(f"{_INPUTS}/{name}", "surrogateescape") for name in _named(inputs)}
    history = table_columns("history.csv", files.text("history.csv"), mechanism.history, check_history)
    flank = table_columns("flank.csv", files.text("flank.csv"), mechanism.flank, check_flank)
    found = fields_of_result(stored, inputs, input_files, history, flank)
    environment = files.json("environment.json")
    if not all(isinstance(version, str) for version in environment.values()):
        raise ValueError("environment.json: must hold texts")
    files.check("result.json", stored)
    return {**found, "environment": environment}


def fields_of_result(
    stored: Mapping[str, Any],
    inputs: Mapping[str, Any],
    input_files: Mapping[str, str],
    history: Mapping[str, Vector],
    flank: Mapping[str, Vector],
) -> dict[str, Any]:
    """Return the fields of a result from its plain values, but for its environment."""
    same = (
        "case",
        "title",
        "band",
        "stop",
        "stop_value",
        "cycles_run",
        "hours_run",
        "speed_rpm",
        "method",
        "updates",
        "numerical_error",
        "life_tolerance",
    )
    return {
        **{name: stored[name] for name in same},
        **{name: _life(life) for name, life in stored["lives"].items()},
        "parts": {name: _life(life) for name, life in stored["parts"].items()},
        "bands": {name: tuple(map(_life, band)) for name, band in stored["bands"].items()},
        "practice": read_opinions(stored["practice"]) if "practice" in stored else None,
        "limits": tuple(LimitState(**state) for state in stored["limits"]),
        "ratings": tuple(map(_rating, stored.get("ratings", ()))),
        "max_depth": stored["max_depth_mm"],
        "max_depth_arc_length": stored["max_depth_arc_length_mm"],
        "removed_area": stored["removed_area_mm2"],
        "worn_area": stored["worn_area_mm2"],
        "initial_peak_pressure": stored["initial_peak_pressure_MPa"],
        "final_peak_pressure": stored["final_peak_pressure_MPa"],
        "assumptions": tuple(stored["assumptions"]),
        "warnings": tuple(stored["warnings"]),
        "inputs": inputs,
        "input_files": input_files,
        "history_columns": history,
        "flank_columns": flank,
    }


def _life(stored: dict[str, float]) -> Life | LowerBound:
    return Life(**stored) if "hours" in stored else LowerBound(**stored)


def _rating(stored: dict[str, Any]) -> RatingFinding:
    return RatingFinding(**{field.name: stored[field.name] for field in fields(RatingFinding)})


def _named(inputs: Mapping[str, Any]) -> list[str]:
    """Names of the CSV files in a case's tables."""
    return [inputs[table][key] for table, key in FILE_KEYS if key in inputs.get(table, {})]


def with_files(inputs: Mapping[str, Any], folder: str) -> dict[str, Any]:
    """Return the tables of a case with the CSV files that they name in another folder."""
    moved = copy.deepcopy(dict(inputs))
    for *tables, key in file_paths(inputs):
        place: Any = moved
        for table in tables:
            place = place[int(table) - 1] if isinstance(place, list) else place[table]
        place[key] = str(PurePosixPath(folder, PurePosixPath(place[key]).name))
    return moved


def of_one_sprocket(inputs: Mapping[str, Any]) -> dict[str, Any]:
    """Return tables without what a block of the duty says of other sprockets of the drive."""
    own = dict(inputs)
    if isinstance(own.get("duty"), list):
        own["duty"] = [{k: v for k, v in block.items() if k != "power_share"} for block in own["duty"]]
    return own


def write_json(path: Path, value: Mapping[str, Any]) -> None:
    """Write an object into a file, a key a line."""
    text = json.dumps(value, indent=2, ensure_ascii=False, allow_nan=False)
    path.write_text(text + "\n", encoding="utf-8")
