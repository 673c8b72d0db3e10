"""The folder of a study: finished shards as Parquet files, from which the same command goes on."""

import contextlib
import json
import os
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.errors import OutputError
from wearsim.extras import library
from wearsim.files import (
    MARKER,
    MOST_BYTES,
    check_free,
    check_given,
    given_bytes,
    left_beside,
    mark,
    new_file,
    write_file,
    written,
)
from wearsim.runner.design import Design, content_hash
from wearsim.runner.shard import TEXTS, Rows, Shard

MANIFEST = "study.json"
_SHARDS = "shards"

DESIGNS, DESIGN_MARK = "designs", " of wearsim optimise "
"""Folder of the best designs, and what stands in the first line of each."""

_DESIGN_NAME = re.compile(r"[0-9]{2,}\.toml")
_DESIGN_LINE = re.compile(rf"# design [0-9]+{DESIGN_MARK}")

_HASH = b"rows_sha256"


@dataclass(frozen=True)
class Store:
    """The folder of a study."""

    folder: Path  # its place

    def path(self, shard: Shard) -> Path:
        """Return the place of a shard."""
        return self.folder / _SHARDS / f"{shard.address}.parquet"

    def finished(self, shard: Shard) -> Rows | None:
        """Return the rows of a shard that was run before."""
        parquet = library("pyarrow.parquet", "parquet", "--out")
        path = self.path(shard)
        if not path.exists():
            return None
        arrow = library("pyarrow", "parquet", "--out")
        try:
            check_given(path)
            if _is_large(parquet.read_metadata(path), shard):
                raise ValueError
            table = parquet.read_table(path)
            rows: Rows = table.to_pydict()
            written = (table.schema.metadata or {}).get(_HASH)
            sound = written == content_hash(rows).encode()
        except (OSError, ValueError, TypeError, arrow.ArrowException):
            rows, sound = {}, False
        indices = list(range(shard.first, shard.first + shard.count))
        if sound and tuple(rows) == shard.columns and rows["case_index"] == indices:
            return rows
        with contextlib.suppress(OSError):
            path.unlink()
        return None

    def save(self, shard: Shard, rows: Rows) -> None:
        """Write the rows of a shard beside its place, flush them to the disk, and rename."""
        arrow = library("pyarrow", "parquet", "--out")
        from pyarrow import parquet

        kinds = {name: arrow.string() for name in TEXTS} | {"case_index": arrow.int64()}
        columns = {
            name: arrow.array(values, kinds.get(name, arrow.float64())) for name, values in rows.items()
        }
        table = arrow.table(columns).replace_schema_metadata({_HASH: content_hash(rows)})
        path = self.path(shard)
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            with new_file(path) as file:
                parquet.write_table(table, file, compression="zstd")
                file.flush()
                os.fsync(file.fileno())
        except OSError as error:
            reason = error.strerror or error
            raise OutputError(
                f"{path}: must be writable: {reason}; what is finished is kept, run the same "
                "command again to go on"
            ) from None


def _is_large(metadata: Any, shard: Shard) -> bool:
    """Tell whether a file of Parquet holds more than the rows of a shard, before it is read."""
    groups = [metadata.row_group(number) for number in range(metadata.num_row_groups)]
    size: int = sum(group.total_byte_size for group in groups)
    return size > MOST_BYTES or bool(metadata.num_rows != shard.count)


def open_store(folder: Path, design: Design, identity: Mapping[str, Any], force: bool) -> Store:
    """Make the folder of a study, or open it to go on."""
    text = _manifest(design, identity)
    old = _own_manifest(folder, text, force)
    if old == text:
        return Store(folder)
    if old is not None:
        _clear(folder)
    mark(folder, (MANIFEST,))
    write_file(folder / MANIFEST, text, force=True)
    return Store(folder)


def check_store(folder: Path, design: Design, identity: Mapping[str, Any], force: bool) -> None:
    """Raise where a study cannot go into a folder, as `open_store` does."""
    _own_manifest(folder, _manifest(design, identity), force)


def own_designs(folder: Path) -> list[Path]:
    """Return the designs in a folder that wearsim wrote."""
    return [path for path in folder.glob("*.toml") if _is_own_design(path)]


def _is_own_design(path: Path) -> bool:
    if not _DESIGN_NAME.fullmatch(path.name) or not path.is_file():
        return False
    with path.open(encoding="utf-8", errors="replace") as file:
        return _DESIGN_LINE.match(file.readline(200)) is not None


def _own_manifest(folder: Path, text: str, force: bool) -> str | None:
    """Manifest of the study that is there, which must be the same one unless it may be replaced."""
    check_free(folder, force=True)
    place = folder / MANIFEST
    try:
        own = written(folder)
        ours = MANIFEST in own and place.exists()
        old = given_bytes(place).decode("utf-8", "replace") if ours else None
        own |= {path.name for name in (MARKER, MANIFEST) for path in left_beside(folder / name)}
        foreign = folder.exists() and (not folder.is_dir() or {path.name for path in folder.iterdir()} - own)
    except OSError as error:
        raise OutputError(f"{folder}: must be readable: {error.strerror or error}") from None
    if old is None and foreign:
        raise OutputError(f"{folder}: must be new or hold a study of wearsim, but does not: choose another")
    if old not in (None, text) and not force:
        raise OutputError(
            f"{folder}: must hold this study to go on, but holds another one (other input, seed, "
            "number or version): choose another place or --force"
        )
    return old


def _manifest(design: Design, identity: Mapping[str, Any]) -> str:
    content = {**ANSWER_HEAD, **identity, "cases": len(design.rows), "sha256": design.address()}
    return json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def _clear(folder: Path) -> None:
    """Remove what another study wrote about all of its cases, before this one has run."""
    try:
        own = written(folder) - {MARKER, MANIFEST}
        for path in [path for path in folder.iterdir() if path.name in own]:
            path.unlink()
        for path in own_designs(folder / DESIGNS):
            path.unlink()
    except OSError as error:
        raise OutputError(f"{folder}: must be writable: {error.strerror or error}") from None
