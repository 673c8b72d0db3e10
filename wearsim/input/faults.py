"""Faults of an input file: where each key stands and what is wrong with it, in plain words."""

import difflib
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, get_args, get_origin

from pydantic import BaseModel, ValidationError

from wearsim.errors import CaseError, Fault, quoted
from wearsim.input.table import CHOSEN, Table, is_number, without_numbers

_MARK = "\x00wearsim\x00"
_MAX_SHOWN = 20
_MAX_SIMILAR = 3


class Faults:
    """What is wrong with one input, collected in one pass."""

    def __init__(self, file: str, text: str, overrides: Iterable[str]) -> None:
        self.file = file
        self.text = text
        self._overrides = tuple(overrides)
        self._found: list[Fault] = []
        self._lines: dict[str, int] = {}
        self._distrusted: set[str] = set()
        self._said: set[tuple[str, str]] = set()

    @property
    def count(self) -> int:
        """Number of faults found so far."""
        return len(self._found)

    def add(self, key: str, message: str) -> None:
        """Add a fault of a key."""
        if self.distrusts(key):
            return
        if self._is_set(key):
            self._found.append(Fault(message, "", f"--set {key}"))
            return
        if key not in self._lines:
            self._lines[key] = line_of(self.text, key)
        self._found.append(Fault(message, key, self.file, self._lines[key]))

    def add_once(self, key: str, kind: str, message: str) -> None:
        """Add a fault of a key unless one of its kind was added so before."""
        if (key, kind) not in self._said:
            self._said.add((key, kind))
            self.add(key, message)

    def _is_set(self, key: str) -> bool:
        """Whether an override holds a key, or made the table of this name."""
        if any(key == typed or key.startswith(f"{typed}.") for typed in self._overrides):
            return True
        made = self.text and any(typed.startswith(f"{key}.") for typed in self._overrides)
        return bool(made) and not _line_of_value(self.text, key.split("."))

    def add_validation(self, error: ValidationError, model: type[BaseModel]) -> None:
        """Add everything that pydantic found."""
        for key, message, _ in validation_faults(error, model):
            self.add(key, message)

    def distrust(self, tables: Iterable[str]) -> None:
        """Take no more faults of some tables: they may only follow from those already found."""
        self._distrusted = set(tables)

    def distrusts(self, key: str) -> bool:
        """Tell whether no faults of a key are taken."""
        table, *rest = key.split(".")
        return table in self._distrusted or (len(rest) > 1 and f"{table}.{rest[0]}" in self._distrusted)

    def check(self) -> None:
        """Raise if anything was found."""
        if not self._found:
            return
        ordered = sorted(self._found, key=lambda fault: (fault.line == 0, fault.line))
        shown = ordered[:_MAX_SHOWN]
        if len(ordered) > len(shown):
            shown.append(Fault(f"and {len(ordered) - len(shown)} more", "", self.file))
        raise CaseError(shown)


class PartFaults(Faults):
    """What is wrong with one part of an input, found in the whole of it under the keys where it stands there.

    Parts share tables: what is wrong with these all of them find, in other numbers in those of a load.
    """

    def __init__(self, whole: Faults, places: Mapping[str, str], in_numbers: Iterable[str] = ()) -> None:
        super().__init__(whole.file, "", ())
        self._whole = whole
        self._places = places
        self._in_numbers = tuple(in_numbers)

    def add(self, key: str, message: str) -> None:
        """Add a fault of a key."""
        place = next(
            (
                self._places[table] + key.removeprefix(table)
                for table in self._places
                if f"{key}.".startswith(f"{table}.")
            ),
            key,
        )
        if self._whole.distrusts(place):
            return
        self._found.append(Fault(message, place, self.file))
        self._whole.add_once(place, "" if key.partition(".")[0] in self._in_numbers else message, message)


def validation_faults(error: ValidationError, model: type[BaseModel]) -> Iterator[tuple[str, str, bool]]:
    """Give key and message of all that pydantic found, and whether the value is wrong beside any others."""
    names = known_keys(model)
    for entry in error.errors(include_url=False):
        key = ".".join(
            str(part + 1 if isinstance(part, int) else part) for part in entry["loc"] if part not in CHOSEN
        )
        if entry["type"] == "conflicts":
            for name, message in entry["ctx"]["faults"]:
                yield f"{key}.{name}" if key else name, message, False
            continue
        yield key, _message(dict(entry), key, names), True


def known_keys(model: type[BaseModel]) -> list[str]:
    """Return the dotted names of all tables and keys of a model."""
    names = []
    for name, field in model.model_fields.items():
        names.append(name)
        inner = field.annotation
        for candidate in dict.fromkeys(map(_entry, (inner, *get_args(inner)))):
            if isinstance(candidate, type) and issubclass(candidate, BaseModel):
                names += [f"{name}.{below}" for below in known_keys(candidate)]
    return names


def _entry(annotation: Any) -> Any:
    """Return the type of the entries of a list or of a table of tables, or of what is neither."""
    while get_origin(annotation) in (Annotated, list, dict):
        annotation = get_args(annotation)[-1 if get_origin(annotation) is dict else 0]
    return annotation


def _message(entry: dict[str, Any], key: str, names: list[str]) -> str:
    kind, got, table = entry["type"], entry["input"], without_numbers(key)
    if kind == "extra_forbidden":
        what = "table" if isinstance(got, Mapping) else "key"
        return f"unknown {what}{_similar(key, names)}"
    if kind == "missing":
        what = "table" if any(name.startswith(f"{table}.") for name in names) else "key"
        return f"this {what} is required and missing"
    if kind in ("too_short", "too_long"):
        return _length_message(entry["ctx"], kind)
    text = str(entry["msg"]).removeprefix("Value error, ")
    text = text.replace("Input should be", "must be").replace("String should have", "must have")
    if kind in ("model_type", "dict_type"):
        text = "must be a table"
    if kind == "list_type":
        tables = "." not in key or any(name.startswith(f"{table}.") for name in names)
        text = f"must be tables under headers [[{table}]]" if tables else "must be a list of values"
    if isinstance(got, Mapping):
        return f"{text} (got a table)"
    hint = ""
    if kind == "literal_error" and isinstance(got, str):
        allowed = [part.strip("' ") for part in str(entry["ctx"]["expected"]).split(" or ")]
        allowed = [word.strip("' ") for part in allowed for word in part.split(",")]
        hint = _meant(got, allowed)
    return f"{text} (got {quoted(got)}){hint}"


_INVOLUTE = re.compile(r"involut|evolvent", re.IGNORECASE)
"""Begins the name of the involute in English, German and French."""


def _meant(given: str, allowed: list[str]) -> str:
    """Name the word that is most like another one; the evolute form is no involute."""
    if "evolute" in allowed and _INVOLUTE.match(given):
        return "; involutes are teeth of gears ([gear]), not of sprockets"
    close = difflib.get_close_matches(given, allowed, n=1, cutoff=0.5)
    return f"; did you mean {close[0]!r}?" if close else ""


def _length_message(found: Mapping[str, Any], kind: str) -> str:
    word, count = ("least", found["min_length"]) if kind == "too_short" else ("most", found["max_length"])
    one, many = ("key", "keys") if found["field_type"] == "Dictionary" else ("value", "values")
    return f"must hold at {word} {count} {one if count == 1 else many} (holds {found['actual_length']})"


def _similar(key: str, names: list[str]) -> str:
    """Name the keys like an unknown one: of its own table first, then the same word elsewhere.

    A table by the dotted name of another key is not of the schema, and has its keys alone: those that
    stand below the table of the schema that holds it.
    """
    own, _, last = without_numbers(key).rpartition(".")
    table = own
    while table and table not in names:
        table = table.rpartition(".")[0]
    siblings = [name.rpartition(".")[2] for name in names if name.rpartition(".")[0] == table]
    if close := _closest(last, siblings):
        return f"; did you mean '{close}'?"
    if table != own:
        return ""
    close = _closest(last, [name.rpartition(".")[2] for name in names])
    found = [f"'{name}'" for name in names if name.rpartition(".")[2] == close]
    return f"; did you mean {' or '.join(found[:_MAX_SIMILAR])}?" if found else ""


def _closest(word: str, names: list[str]) -> str:
    """Return the first name that begins with a word, else the one most like it; empty where none is."""
    begun = [name for name in names if name.startswith(f"{word}_")]
    return next(iter([*begun, *difflib.get_close_matches(word, names, n=1, cutoff=0.6)]), "")


_MOST_SEARCHED = 20_000
"""Characters of a text in which lines are looked for: that takes the square of its tables."""


def line_of(text: str, key: str) -> int:
    """Return the line of a key in a TOML text; 0 where it is not there, or the text is long."""
    if not text or len(text) > _MOST_SEARCHED:
        return 0
    parts = key.split(".")
    line = _line_of_value(text, parts)
    while not line and len(parts) > 1:
        parts = parts[:-1]
        line = _line_of_value(text, parts)
    return line


def _line_of_value(text: str, parts: list[str]) -> int:
    import tomlkit
    from tomlkit.items import AoT

    document: Any = tomlkit.parse(text)
    place = document
    for part in parts[:-1]:
        if isinstance(place, list) and is_number(part) and 0 < int(part) <= len(place):
            place = place[int(part) - 1]
        else:
            place = place.get(part) if isinstance(place, Mapping) else None
    if isinstance(place, AoT) and is_number(parts[-1]):
        return _line_of_header(text, ".".join(parts[:-1]), int(parts[-1]))
    if not isinstance(place, Mapping) or parts[-1] not in place:
        return 0
    value = place[parts[-1]]
    if isinstance(value, AoT):
        return _line_of_header(text, ".".join(parts))
    if isinstance(value, Mapping) and value:
        lines = [_line_of_value(text, [*parts, name]) for name in value]
        return min((line for line in lines if line), default=0)
    place[parts[-1]] = _MARK  # type: ignore[index]
    dumped = tomlkit.dumps(document)
    marked = tomlkit.item(_MARK).as_string()
    before, found, _ = dumped.partition(marked)
    return before.count("\n") + 1 if found else 0


def _line_of_header(text: str, name: str, which: int = 1) -> int:
    """Return the line of one of the headers of an array of tables, counted from 1."""
    lines = enumerate(text.splitlines(), start=1)
    found = [number for number, line in lines if line.strip().startswith(f"[[{name}]]")]
    return found[which - 1] if which <= len(found) else 0


class CaseRecord:
    """What is given, found, taken and doubted while a case is being completed."""

    def __init__(self, tables: Table, folder: Path, faults: Faults) -> None:
        self.folder = folder
        self.faults = faults
        self.inputs: dict[str, Any] = tables.model_dump(exclude_none=True)
        self.files: list[Path] = []
        self.assumptions: list[str] = []
        self.warnings: list[str] = []

    def take(self, key: str, value: float | int | str | list[int], why: str) -> None:
        """Record a default that the case takes."""
        place = self.inputs
        *tables, last = key.split(".")
        for table in tables:
            place = place.setdefault(table, {})
        place[last] = value
        shown = f"{value:.6g}" if isinstance(value, float) else value
        self.assumptions.append(f"{key} = {shown} ({why})")

    def path(self, name: str) -> Path:
        """Return the place of a file that the case names."""
        path = self.folder / name
        self.files.append(path)
        return path

    def texts(self) -> dict[str, str]:
        """Return the text of the files by their names; the cases of a study share it."""
        found = {}
        for path in self.files:
            text = path.read_text(encoding="utf-8-sig", errors="surrogateescape")
            found[path.name] = sys.intern(text)
        return found
