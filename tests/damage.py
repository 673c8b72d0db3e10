"""Damage to the folder of a run: what a disk, an editor, a copy or a joker leaves of its files."""

import json
import os
import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class Damage:
    """One change of one file."""

    name: str
    file: str
    do: Callable[[Path], None]


def _written(content: bytes) -> Callable[[Path], None]:
    return lambda path: _replace(path, lambda: path.write_bytes(content))


def _dumped(content: Any, place: tuple[Any, ...], value: Any) -> Callable[[Path], None]:
    """Write JSON with one value changed, when it is asked for."""

    def do(path: Path) -> None:
        text = json.dumps(_changed(content, place, value)).replace('"LONG"', _LONG)
        path.write_text(text, "utf-8")

    return do


def _table(rows: list[list[str]]) -> Callable[[Path], None]:
    return lambda path: path.write_text("".join(",".join(row) + "\n" for row in rows), "utf-8")


def _replace(path: Path, make: Callable[[], Any]) -> None:
    path.unlink()
    make()


def of_file(path: Path) -> dict[str, Callable[[Path], None]]:
    """Damage that any file may take."""
    whole = path.read_bytes()
    half = len(whole) // 2
    return {
        "missing": lambda path: path.unlink(),
        "empty": _written(b""),
        "truncated": _written(whole[:half]),
        "one byte short": _written(whole.rstrip()[:-1]),
        "NUL": _written(bytes(len(whole))),
        "a NUL within": _written(whole[:half] + b"\0" + whole[half:]),
        "no UTF-8": _written(b"\xff\xfe\xfd" + whole),
        "UTF-16": _written(whole.decode().encode("utf-16")),
        "BOM": _written(b"\xef\xbb\xbf" + whole),
        "CRLF": _written(whole.replace(b"\n", b"\r\n")),
        "twice": _written(whole + whole),
        "folder": lambda path: _replace(path, path.mkdir),
        "pipe": lambda path: _replace(path, lambda: os.mkfifo(path)),
        "link to itself": lambda path: _replace(path, lambda: path.symlink_to(path.name)),
        "link to nothing": lambda path: _replace(path, lambda: path.symlink_to("nothing")),
        "link to a device": lambda path: _replace(path, lambda: path.symlink_to("/dev/zero")),
        "deep nesting": _written(b"[" * 100_000),
        "large": lambda path: os.truncate(path, 3_000_000_000),
    }


GONE = "gone"
_VALUES: tuple[Any, ...] = (
    GONE,
    None,
    True,
    -1,
    0,
    1e300,
    float("nan"),
    float("inf"),
    "text",
    "LONG",
    [],
    {},
    [1, "a"],
)
_LONG = "1" * 5000


def _places(value: Any, here: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Places of all values of JSON, of a list those of its first member."""
    if here:
        yield here
    if isinstance(value, dict):
        for key in value:
            yield from _places(value[key], (*here, key))
    elif isinstance(value, list) and value:
        yield from _places(value[0], (*here, 0))


def _changed(content: Any, place: tuple[Any, ...], value: Any) -> Any:
    found = json.loads(json.dumps(content))
    table = found
    for key in place[:-1]:
        table = table[key]
    if value is GONE:
        del table[place[-1]]
    else:
        table[place[-1]] = value
    return found


def of_json(path: Path) -> dict[str, Callable[[Path], None]]:
    """Values of another kind in a file of JSON."""
    content = json.loads(path.read_text("utf-8"))
    found = {"a list": _written(b"[]"), "an empty object": _written(b"{}")}
    for place in _places(content):
        for value in _VALUES:
            found[f"{'.'.join(map(str, place))} = {value!r}"] = _dumped(content, place, value)
    return found


def of_csv(path: Path) -> dict[str, Callable[[Path], None]]:
    """Rows, columns and cells that do not fit."""
    head, *rows = [line.split(",") for line in path.read_text("utf-8").splitlines()]
    found = {"head alone": [head], "no head": rows, "one row": [head, rows[0]], "last row": [head, rows[-1]]}
    found["rows backwards"] = [head, *reversed(rows)]
    found["rows twice"] = [head, *rows, *rows]
    found["row too short"] = [head, *rows, rows[-1][:-1]]
    found["row too long"] = [head, *rows, [*rows[-1], "1"]]
    found["unknown column"] = [[*head, "colour"], *([*row, "1"] for row in rows)]
    for at, name in enumerate(head):
        found[f"without {name}"] = [row[:at] + row[at + 1 :] for row in (head, *rows)]
        found[f"{name} twice"] = [[*row, row[at]] for row in (head, *rows)]
        found[f"{name} first"] = [[row[at], *row[:at], *row[at + 1 :]] for row in (head, *rows)]
        for cell in ("", "nan", "inf", "-1", "1e300", "text", "=1+1", "1;2", "0", _LONG):
            for number in (0, len(rows) // 2, len(rows) - 1):
                changed = [*rows]
                changed[number] = [*rows[number][:at], cell, *rows[number][at + 1 :]]
                found[f"{name} of row {number} = {cell[:9]!r}"] = [head, *changed]
    return {name: _table(rows) for name, rows in found.items()}


def of_toml(path: Path) -> dict[str, Callable[[Path], None]]:
    """Lines of a file of TOML that are gone or have another value."""
    lines = path.read_text("utf-8").splitlines()
    found = {}
    for number, line in enumerate(lines):
        key, _, value = line.partition(" = ")
        if line.startswith("#") or not line:
            continue
        others = [None, line + "\n" + line]
        if value:
            others += [
                f"{key} = {other}"
                for other in ("nan", "inf", "-1", "0", "1e300", '"text"', "[]", "true", "{}")
            ]
        for other in others:
            changed = [*lines[:number], *([] if other is None else [other]), *lines[number + 1 :]]
            found[f"line {number + 1}: {line} -> {other}"] = _written("\n".join(changed).encode())
    return found


_OF_KIND = {".json": of_json, ".csv": of_csv, ".toml": of_toml}


def damages(run: Path) -> list[Damage]:
    """Every damage to every file of a folder."""
    found = []
    for path in sorted(path for path in run.rglob("*") if path.is_file() and path.name != ".wearsim"):
        file = path.relative_to(run).as_posix()
        kinds = {**of_file(path), **_OF_KIND[path.suffix](path)}
        found += [Damage(f"{file}: {name}", file, do) for name, do in kinds.items()]
    return found


def sample(of: list[Any], most: int, seed: int = 1) -> list[Any]:
    """So many of them, the same ones each time."""
    return of if len(of) <= most else random.Random(seed).sample(of, most)  # noqa: S311


def without_digests(run: Path) -> None:
    """Have a folder as earlier versions of wearsim wrote it: what it holds is all that can be checked."""
    for path in (*run.rglob("result.json"), *run.glob("drive.json")):
        stored = json.loads(path.read_text("utf-8"))
        del stored["sha256"]
        path.write_text(json.dumps(stored, indent=2, ensure_ascii=False), "utf-8")
