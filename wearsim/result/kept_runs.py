"""Runs that are kept by their content, so that the next command need not run the same case again.

A command says `keep_runs`; without that, and from Python, every case is run. A run is found by a hash of all
that it depends on: the case number by number, the files of wearsim, and the versions of its libraries.
"""

import contextlib
import hashlib
import io
import json
import os
import time
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import wearsim
from wearsim.case.model import Case
from wearsim.files import write_file
from wearsim.jit.compiled import user_cache
from wearsim.jit.machine_code import file_ending, sealed, unsealed
from wearsim.result.folder import fields_of_result, stored_result, with_files
from wearsim.result.wear_result import WearResult, environment

FOLDER = "WEARSIM_RUNS"
"""Variable that names the folder of kept runs in place of the user's cache folder; empty, none are kept."""

_MOST_BYTES = 200_000_000
"""Size of all runs that are kept; those that were used longest ago go first."""

_LEFT_FOR = 3600.0
"""Seconds after which a file that is not renamed yet has no writer any more."""

_NOT_ITS_CONTENT = ("name", "title", "given")
"""Attributes of a case that no number of its run depends on."""

_ROOT = Path(wearsim.__file__).parent

_TABLES = ("history", "flank")

_ENDING = ".run"

_folder: Path | None = None
_since = 0.0  # when runs began to be kept


def keep_runs(folder: Path | None) -> None:
    """Have runs kept in a folder from now on, by all threads of this process; with None no more."""
    global _folder, _since
    _folder, _since = folder, time.time()


def runs_folder() -> Path | None:
    """Return the folder of kept runs, that of ``WEARSIM_RUNS`` or the user's; None where none are kept."""
    chosen = os.environ.get(FOLDER)
    if chosen is not None:
        return Path(chosen) if chosen else None
    parent = user_cache()
    return parent / "runs" if parent else None


def kept_or_run(case: Case, run: Callable[[], WearResult]) -> WearResult:
    """Return the run of a case that is kept; else run it, and keep it."""
    folder = _folder
    ours = type(case.drive).__module__.startswith(f"{wearsim.__name__}.")
    if folder is None or not ours or not _is_as_begun():
        return run()
    try:
        key = content_hash(case)
    except TypeError:
        return run()
    file = folder / f"{key}{_ENDING}"
    found = _read(file, key, case)
    if found is not None:
        return found
    found = run()
    # A cache that cannot be written costs time and nothing else, and what is no number is not kept.
    with contextlib.suppress(OSError, ValueError):
        if _is_as_begun():
            write_file(file, _written(found, key), force=True)
            _limit_size(folder)
    return found


def content_hash(case: Case) -> str:
    """Return the hash of a case and of what else its run depends on.

    Raises `TypeError` where a case holds what has no hash.
    """
    return hashlib.sha256(_program() + case_content(case)).hexdigest()[:32]


def case_content(case: Case) -> bytes:
    """Return the hash of a case number by number: alike for all that wear alike.

    Raises `TypeError` where a case holds what has no hash.
    """
    digest, stands = hashlib.sha256(), case.drive.alike(case)
    for field in fields(stands):
        if field.name not in _NOT_ITS_CONTENT:
            _add(digest.update, (field.name, getattr(stands, field.name)))
    return digest.digest()


def of_case(result: WearResult, case: Case) -> WearResult:
    """Return the result of a case that wears alike as that of this one."""
    return replace(
        result,
        case=case.name,
        title=case.title,
        inputs=with_files(case.inputs, ""),
        input_files=case.input_files,
    )


@cache
def _program() -> bytes:
    """Return the hash of wearsim and its libraries, and of the processor that machine code is made for."""
    digest = hashlib.sha256(json.dumps([environment(), file_ending()]).encode())
    for path in sorted(_sources()):
        digest.update(path.relative_to(_ROOT).as_posix().encode())
        digest.update(path.read_bytes())
    return digest.digest()


@cache
def _sources() -> list[Path]:
    """Return the files of wearsim that a run depends on."""
    kinds = (".py", ".csv", ".toml")
    return [path for path in _ROOT.rglob("*") if path.suffix in kinds and path.is_file()]


def _is_as_begun() -> bool:
    """Whether no file of wearsim has been edited since runs are kept: what runs is what the files say."""
    try:
        return max(path.stat().st_mtime for path in _sources()) <= _since
    except OSError:  # one is gone
        return False


def _add(update: Callable[[bytes], None], value: Any) -> None:
    """Add a value to a hash, with its kind and its length, so that no two contents are alike."""
    update(f"{type(value).__name__}:".encode())
    if is_dataclass(value):
        for field in fields(value):
            _add(update, (field.name, getattr(value, field.name)))
    elif isinstance(value, Mapping):
        _add(update, tuple(value.items()))
    elif isinstance(value, list | tuple):
        update(f"{len(value)};".encode())
        for part in value:
            _add(update, part)
    elif isinstance(value, np.ndarray):
        _add(update, (value.dtype.str, value.shape, value.tobytes()))
    elif value is None or isinstance(value, str | bytes | int | float | Path):
        content = value if isinstance(value, bytes) else repr(value).encode()
        update(f"{len(content)};".encode() + content)
    else:
        raise TypeError(f"a case holds a {type(value).__name__}, of which there is no hash")


def _written(result: WearResult, key: str) -> bytes:
    """Return a result as the content of a file; its inputs are those of the case."""
    stored = {**stored_result(vars(result), result.summary()), "environment": result.environment}
    columns = {
        f"{table}.{name}": values
        for table in _TABLES
        for name, values in getattr(result, f"{table}_columns").items()
    }
    file = io.BytesIO()
    np.savez_compressed(
        file, result=np.array(json.dumps(stored, allow_nan=False)), allow_pickle=False, **columns
    )
    return sealed(file.getvalue(), key)


def _read(file: Path, key: str, case: Case) -> WearResult | None:
    """Return the result in a file; None where there is none, or the file is not whole or of another run."""
    content = unsealed(file, key)
    if content is None:
        return None
    tables: dict[str, dict[str, Any]] = {table: {} for table in _TABLES}
    with np.load(io.BytesIO(content), allow_pickle=False) as entries:
        stored = json.loads(str(entries["result"]))
        for entry in entries.files:
            table, _, name = entry.partition(".")
            if name:
                tables[table][name] = entries[entry]
    with contextlib.suppress(OSError):
        os.utime(file)
    inputs = with_files(case.inputs, "")
    known = fields_of_result(stored, inputs, case.input_files, tables["history"], tables["flank"])
    return of_case(WearResult(**known, environment=stored["environment"]), case)


def _limit_size(folder: Path) -> None:
    """Remove what killed writers left, and the runs used longest ago until the others are small enough."""
    for path in folder.glob(f".*{_ENDING}.*"):
        with contextlib.suppress(OSError):
            # One from later than now was there before the clock was set back.
            if abs(time.time() - path.stat().st_mtime) > _LEFT_FOR:
                path.unlink()
    files = [(status.st_mtime_ns, status.st_size, path) for path, status in kept_files(folder)]
    size = sum(bytes_ for _, bytes_, _ in files)
    for _, bytes_, path in sorted(files):
        if size <= _MOST_BYTES:
            return
        path.unlink(missing_ok=True)
        size -= bytes_


def kept_files(folder: Path) -> list[tuple[Path, os.stat_result]]:
    """Return the kept runs of a folder with what is known of their files; another writer may remove some."""
    found = []
    for path in folder.glob(f"*{_ENDING}"):
        with contextlib.suppress(OSError):
            found.append((path, path.stat()))
    return found
