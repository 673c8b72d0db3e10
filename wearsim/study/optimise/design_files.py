"""Designs of a study as cases of their own, beside what else lies in their folder."""

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from wearsim.errors import OutputError
from wearsim.files import write_file
from wearsim.input.document import retitled
from wearsim.input.named_files import file_paths
from wearsim.runner.design import Design, replaced, value_at
from wearsim.runner.store import own_designs


def save_designs(folder: Path, heads: Mapping[str, str], cases: Design) -> None:
    """Write designs as cases, with the files that they name, in place of those of an earlier run."""
    try:
        own = {path.name: path for path in own_designs(folder)}
        _check_free(folder, heads.keys() - own.keys())
        placed = {name: _write_apart(folder, name, cases.files[name]) for name in _named(cases)}
        for name in own.keys() - heads.keys():
            own[name].unlink()
    except OSError as error:
        if isinstance(error, OutputError):
            raise
        raise OutputError(f"{folder}: must be writable: {error.strerror or error}") from None
    texts = {
        name: _case_text(head, retitled(cases.tables_of(at), cases.tables), placed)
        for at, (name, head) in enumerate(heads.items())
    }
    for name, content in texts.items():
        write_file(folder / name, content, force=True)


def _check_free(folder: Path, names: set[str]) -> None:
    for path in (folder / name for name in sorted(names)):
        if path.exists():
            raise OutputError(
                f"{path}: must be free for a design, but wearsim did not write what is there: move it "
                "away, then the same command goes on"
            )


def _named(cases: Design) -> list[str]:
    """Names of the files that at least one case names."""
    drives = [cases.tables_of(at) for at in range(len(cases.rows))]
    found = {value_at(tables, ".".join(path)) for tables in drives for path in file_paths(tables)}
    return sorted(found & cases.files.keys())


def _write_apart(folder: Path, name: str, text: str) -> str:
    """Write a file, under another name where a different one has its own, and return the name."""
    data = text.encode("utf-8", "surrogateescape")
    place = folder / name
    digest = hashlib.sha256(data).hexdigest()[:12]
    for path in (place, place.with_stem(f"{place.stem}-{digest}")):
        if not path.exists():
            write_file(path, data, force=False)
            return path.name
        if path.is_file() and path.read_bytes() == data:
            return path.name
    raise OutputError(f"{place}: must be free, but something else is there: move it away")


def _case_text(head: str, tables: Mapping[str, Any], placed: Mapping[str, str]) -> str:
    import tomlkit

    for path in file_paths(tables):
        name = value_at(tables, ".".join(path))
        if name in placed:
            tables = replaced(tables, path, placed[name])
    document = tomlkit.document()
    document.add(tomlkit.comment(head))
    for key, value in tables.items():
        document.add(key, value)
    return tomlkit.dumps(document)
