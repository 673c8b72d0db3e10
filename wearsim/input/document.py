"""An input file or a mapping with overrides, before anything is checked."""

import copy
import errno
import re
import sys
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path, PurePath
from typing import Any, TypeVar

from pydantic import ValidationError

from wearsim.catalogue.shipped_cases import place_of_case, similar_case
from wearsim.errors import CaseError, Fault
from wearsim.files import given_bytes
from wearsim.input.column_files import with_column_files
from wearsim.input.faults import Faults
from wearsim.input.giving_way import remove_alternatives
from wearsim.input.named_files import file_paths, outside_fault, printable
from wearsim.input.table import CalculationTables, Table
from wearsim.input.texts import in_line
from wearsim.input.units import plain_tables


@dataclass(frozen=True)
class CaseText:
    """What an input file is to hold, before it is written."""

    # place of the file, there or not: it names the case, and paths in it are relative to its folder
    path: Path
    text: str  # all of it


_DEEPEST = 20
"""Tables and lists within one another that any input needs, and some more."""


@dataclass(frozen=True)
class GivenInput:
    """An input as it was given, from which it can be read again."""

    file: str  # what faults call it
    name: str  # stem of the file
    folder: Path  # folder that paths in it are relative to
    text: str  # of the file, empty where there is none
    written: Mapping[str, Any]  # its tables as they were written
    tables: Mapping[str, Any]  # the same with what was changed since


CaseSource = str | Path | CaseText | GivenInput | Mapping[str, Any]


@dataclass(frozen=True)
class Document:
    """What stands in an input file."""

    name: str  # stem of the file
    folder: Path  # folder that paths in it are relative to
    data: dict[str, Any]  # its tables with the overrides
    faults: Faults  # takes what is wrong with it
    given: GivenInput | None = None  # what it was read from; None for a part of another document


def read_document(source: CaseSource, overrides: Sequence[str]) -> Document:
    """Read a file or a shipped case by its name, or take a text, an input given before or a mapping."""
    given = source if isinstance(source, GivenInput) else _given(source)
    keys = [item.partition("=")[0].strip() for item in overrides]
    faults = Faults(given.file, given.text, keys)
    data = copy.deepcopy(dict(given.tables))
    for item in overrides:
        _override(data, item)
    if keys:
        remove_alternatives(data, keys)
    given = replace(given, tables=data)
    if isinstance(source, str | Path | CaseText):
        check_inside(given, faults, keys)
    return Document(given.name, given.folder, retitled(data, given.written), faults, given)


def check_inside(given: GivenInput, faults: Faults, changed: Sequence[str] = ()) -> None:
    """Raise where a file names files that lie out of its folder, before any of them is read."""
    values = dict(leaves(given.tables))
    for key in map(".".join, file_paths(given.tables)):
        name = values.get(key)
        if key not in changed and isinstance(name, str) and (fault := outside_fault(given.folder, name)):
            faults.add(key, fault)
    faults.check()


def _given(source: str | Path | CaseText | Mapping[str, Any]) -> GivenInput:
    if isinstance(source, Mapping):
        tables = plain_tables(with_column_files(source))
        _check_depth(tables, "case")
        data = copy.deepcopy(tables)
        return GivenInput("case", "case", Path(), "", data, data)
    path = source.path if isinstance(source, CaseText) else place_of_case(Path(source))
    text = source.text if isinstance(source, CaseText) else text_of(path)
    data = _parsed(path, text)
    name = "case" if path == STDIN else printable(path.stem)
    return GivenInput(printable(str(path)), name, path.parent, text, data, data)


def retitled(tables: Mapping[str, Any], written: Mapping[str, Any]) -> dict[str, Any]:
    """Return tables whose title tells what is no longer as it was written under that title.

    Examples
    --------
    >>> written = {"title": "Hoist", "sprocket": {"teeth": 20, "profile": "evolute"}}
    >>> retitled({"title": "Hoist", "sprocket": {"teeth": 25, "profile": "evolute"}}, written)["title"]
    'Hoist, with sprocket.teeth = 25'
    """
    title, now, before = tables.get("title"), dict(leaves(tables)), dict(leaves(written))
    if not isinstance(title, str) or not title or title != written.get("title") or title != in_line(title):
        return dict(tables)
    changes = {
        "with": [f"{key} = {_shown(key, now[key])}" for key in now if now[key] != before.get(key)],
        "without": [key for key in before if key not in now],
    }
    told = [f", {word} {', '.join(keys)}" for word, keys in changes.items() if keys]
    return {**tables, "title": in_line("".join([title, *told]))}


def leaves(tables: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Give every key of some tables.

    Examples
    --------
    >>> dict(leaves({"duty": [{"speed_rpm": 1}], "title": "A"}))
    {'duty.1.speed_rpm': 1, 'title': 'A'}
    """
    for name, value in tables.items():
        if isinstance(value, Mapping):
            yield from leaves(value, f"{prefix}{name}.")
        elif isinstance(value, list | tuple) and value and all(isinstance(one, Mapping) for one in value):
            for number, entry in enumerate(value, start=1):
                yield from leaves(entry, f"{prefix}{name}.{number}.")
        else:
            yield f"{prefix}{name}", value


def _shown(key: str, value: Any) -> str:
    if key.endswith("_file"):
        return PurePath(str(value)).name
    return str(value).lower() if isinstance(value, bool) else str(value)


STDIN = Path("-")
"""What stands for the case that is on standard input."""


_MOST_BYTES = 2_000_000
"""Of a case: more than any has, and little enough to be read at once."""

_MOST_SIGNS = {"=": (20_000, "keys"), ",": (100_000, "values in lists")}
"""How often what stands for keys and for values may stand in a file: far more often than by hand."""


@cache
def stdin_bytes() -> bytes:
    """Return standard input, which can be read only once, no further than tells that it is too large."""
    return sys.stdin.buffer.read(_MOST_BYTES + 1)


def _stdin() -> bytes:
    content = stdin_bytes()
    if len(content) > _MOST_BYTES:
        raise OSError(errno.EFBIG, f"it has more than {_MOST_BYTES / 1e6:.3g} MB")
    return content


def text_of(path: Path) -> str:
    """Return the text of a file, or what is on standard input."""
    try:
        return (_stdin() if path == STDIN else given_bytes(path, _MOST_BYTES)).decode("utf-8-sig")
    except OSError as error:
        similar = similar_case(path)
        hint = f"; did you mean the shipped case {similar!r}?" if similar else ""
        text = f"must be a readable file: {error.strerror}{hint}"
        raise CaseError([Fault(text, "", str(path))]) from None
    except UnicodeDecodeError:
        raise CaseError([Fault("must be UTF-8 text: save it as UTF-8", "", str(path))]) from None


_DECIMAL_COMMA = re.compile(r"=\s*([-+]?\d+),(\d+)\s*(?:#.*)?$")
"""End of a line whose value is a number with a decimal comma."""


_LONG_KEY = re.compile(rf"(?<![\w\"'-])(?:[\w\"'-]+[ \t]*\.[ \t]*){{{_DEEPEST},}}[\w\"'-]")
"""A dotted key of more parts than tables may be deep, which take long to make."""


def _check_size(path: Path, text: str) -> None:
    """Raise where a text has so many keys or values that it would take long and much memory to read."""
    for sign, (most, what) in _MOST_SIGNS.items():
        if (count := text.count(sign)) > most:
            message = f"must hold at most {most} {what}, holds about {count}: put long tables into CSV files"
            raise CaseError([Fault(message, "", str(path))])
    if found := _LONG_KEY.search(text):
        message = f"tables and lists may be nested at most {_DEEPEST} deep, a key is deeper: shorten it"
        raise CaseError([Fault(message, "", str(path), text.count("\n", 0, found.start()) + 1)])


def _parsed(path: Path, text: str) -> dict[str, Any]:
    _check_size(path, text)
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        place = re.search(r"\(at line (\d+), column \d+\)", str(error))
        line = int(place.group(1)) if place else text.count("\n") + 1
        lines = text.splitlines()
        found = _DECIMAL_COMMA.search(lines[line - 1]) if line <= len(lines) else None
        hint = f": write decimals with a point, {found[1]}.{found[2]}" if found else ""
        raise CaseError([Fault(f"not valid TOML: {error}{hint}", "", str(path), line)]) from None
    except (ValueError, RecursionError) as error:
        raise CaseError([Fault(f"not readable TOML: {error}", "", str(path))]) from None
    _check_depth(data, str(path), text)
    return data


def _check_depth(data: dict[str, Any], file: str, text: str = "") -> None:
    """Raise where tables or lists lie deeper within one another than any input needs."""
    depth, level = 0, list[Any]([data])
    while level:
        depth += 1
        level = [
            entry
            for place in level
            for entry in (place.values() if isinstance(place, Mapping) else place)
            if isinstance(entry, Mapping | list)
        ]
    if depth <= _DEEPEST:
        return
    lines = [line.partition("#")[0] for line in text.splitlines()]
    deep = (number for number, line in enumerate(lines, 1) if _opened(line) >= _DEEPEST)
    message = f"tables and lists may be nested at most {_DEEPEST} deep, are {depth} deep: remove some"
    raise CaseError([Fault(message, "", file, next(deep, 0))])


def _opened(line: str) -> int:
    """Tables and lists that a line opens."""
    return sum(line.count(sign) for sign in ".[{")


def _bare(raw: str) -> float | str:
    """Return what is not TOML: a number such as .5, else the text itself."""
    try:
        return float(raw)
    except ValueError:
        return raw


def _inner(place: Any, table: str, typed: str) -> Any:
    """Return a table of a table, made where it is missing, or one of several by its number from 1."""
    if isinstance(place, dict):
        return place.setdefault(table, {})
    if not table.isdecimal() or not 1 <= int(table) <= len(place):
        raise CaseError(
            [Fault(f"must name one of {len(place)} tables by its number from 1", "", f"--set {typed}")]
        )
    return place[int(table) - 1]


def _override(data: dict[str, Any], item: str) -> None:
    key, equals, raw = item.partition("=")
    key, raw = key.strip(), raw.strip()
    if not equals or not all(key.split(".")):
        raise CaseError([Fault("must have the form table.key=VALUE", "", f"--set {item}")])
    try:
        value = tomllib.loads(f"value = {raw}")["value"]
    except (ValueError, RecursionError):
        value = _bare(raw)
    *tables, last = key.split(".")
    place: Any = data
    for table in tables:
        place = _inner(place, table, key)
        if not isinstance(place, dict | list):
            raise CaseError([Fault(f"{table!r} is a key, not a table", "", f"--set {key}")])
    if isinstance(place, list):
        raise CaseError(
            [Fault(f"{tables[-1]!r} holds several tables: give a number and a key", "", f"--set {key}")]
        )
    place[last] = value
    _check_depth(data, f"--set {tables[0] if tables else last}")


NEEDED = {
    "handbook strength": {"drive", "pinion", "wheel"},
    "handbook stiffness-spectrum": {"gear_pair", "pinion", "wheel"},
    "handbook wave-drive": {"wave_drive"},
    "handbook face-load": {"pair", "load", "misalignment", "running_in"},
    "handbook convex-concave": {"convex_concave"},
    "handbook synthesise": {"gears", "load", "stress", "phase"},
    "handbook hertz-check": {"contact"},
    "sweep": {"case"},
}
"""Commands with an input file of their own, and what it must hold beside its version."""


def command_of(tables: Mapping[str, Any]) -> str:
    """Return the command that an input is for; empty where its tables do not tell.

    Examples
    --------
    >>> command_of({"format_version": 1, "wave_drive": {}}), command_of({"chain": {}}), command_of({})
    ('handbook wave-drive', 'life', '')
    """
    if {"chain", "sprocket", "gear"} & tables.keys():
        return "life"
    return next((command for command, needed in NEEDED.items() if needed <= tables.keys()), "")


def check_command(tables: Mapping[str, Any], file: str, own: str = "") -> None:
    """Raise where an input is plainly that of another command."""
    command = command_of(tables)
    if command not in ("", own):
        text = f"must be an input of this command, but is one of wearsim {command}: run that"
        raise CaseError([Fault(text, "", file)])


Tables = TypeVar("Tables", bound=CalculationTables)


def load_calculation(source: CaseSource, model: type[Tables], overrides: Sequence[str] = ()) -> Tables:
    """Return the tables of a calculation."""
    return calculation_tables(read_document(source, overrides), model)


def calculation_tables(document: Document, model: type[Tables]) -> Tables:
    """Return the tables of a calculation, or raise where the input is that of another command."""
    needed = {name for name, field in model.model_fields.items() if field.is_required()}
    if not needed - {"format_version"} <= document.data.keys():
        check_command(document.data, document.faults.file)
    document.data.setdefault("title", document.name)
    return checked(document, model)


def checked(document: Document, model: type[Tables]) -> Tables:
    """Return the tables of a document."""
    try:
        tables = model.model_validate(document.data)
    except ValidationError as error:
        document.faults.add_validation(error, model)
        document.faults.check()
        raise
    document.faults.check()
    return tables


def defaults_taken(tables: Table, prefix: str = "") -> tuple[str, ...]:
    """Return what a file left to its defaults, as an answer lists it under its assumptions."""
    taken: list[str] = []
    for key, value in tables:
        if isinstance(value, Table):
            taken += defaults_taken(value, f"{prefix}{key}.")
        elif prefix and key not in tables.model_fields_set and value is not None:
            shown = f"{value:g}" if isinstance(value, float) else value
            taken.append(f"{prefix}{key} = {shown} (default)")
    return tuple(taken)
