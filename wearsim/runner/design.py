"""The cases of a study: one input file, and values for some of its keys."""

import copy
import hashlib
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from pathlib import PurePath
from typing import Any, TypeVar

from wearsim._version import __version__
from wearsim.case.model import Case
from wearsim.catalogue.catalogues import nearest
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.wheels import part_names
from wearsim.errors import CaseError, Fault
from wearsim.files import given_text
from wearsim.input.document import Document
from wearsim.input.giving_way import remove_alternatives
from wearsim.input.keys import is_dict, schema_fields, schema_of
from wearsim.input.mechanism_registry import MECHANISMS, WHOLE_DRIVE, MechanismEntry, mechanism_of
from wearsim.input.named_files import FILE_KEYS, file_paths
from wearsim.input.table import is_number, without_numbers
from wearsim.jit.compiled import source_hash
from wearsim.result.ends import CHAIN, SPROCKET

_OF_A_MECHANISM = ("mechanism.kind", "sprocket.profile")
"""Keys that say which mechanism a case is about."""

FEW, SOME, MANY = 2, 25, 250
"""Cases of a shard: of wraps, which take seconds each, with contact fatigue, which run one by one,
and of all others."""


NAMES_FILE = tuple(f"{table}.{key}" for table, key in FILE_KEYS)
"""Dotted keys whose values name a file."""


@dataclass(frozen=True)
class Engine:
    """What the numbers depend on beside the input."""

    version: str  # of wearsim
    kernels: str  # hash of the compiled functions' sources, of numba and of Python


@cache
def engine() -> Engine:
    """Return the engine of this process."""
    return Engine(__version__, source_hash())


@dataclass(frozen=True)
class Design:
    """The cases of a study."""

    name: str  # of the case that they come from
    tables: Mapping[str, Any]  # its tables as they were given
    files: Mapping[str, str]  # texts of the files that the tables and values name
    # dotted keys that differ; entries of a list of tables by their numbers from 1
    keys: tuple[str, ...]
    rows: Sequence[Sequence[Any]]  # values of the keys, a row for each case
    lives: tuple[str, ...] = ()  # parts whose lives have columns of their own, of all cases

    @property
    def parts(self) -> tuple[str, ...]:
        """Parts of a whole drive."""
        return part_names(self.tables)

    def tables_of(self, index: int) -> dict[str, Any]:
        """Return the tables of one case."""
        tables = dict(self.tables)
        for key, value in zip(self.keys, self.rows[index], strict=True):
            tables = replaced(tables, key.split("."), value)
        return tables

    def part(self, first: int, count: int) -> "Design":
        """Return some of the cases."""
        return replace(self, rows=self.rows[first : first + count])

    def address(self) -> str:
        """Return the hash of all that the lives depend on."""
        content = {
            "tables": self.tables,
            "files": self.files,
            "keys": self.keys,
            "rows": [content_hash({"rows": rows}) for rows in batched(self.rows)],
            "engine": vars(engine()),
        }
        return content_hash(content)

    @property
    def cases_per_shard(self) -> int:
        """Cases that are run and stored together."""
        if self._mechanisms & {WHOLE_DRIVE, MECHANISMS["wrap"]}:
            return FEW
        tables = {*self.tables, *(key.partition(".")[0] for key in self.keys)}
        return SOME if "fatigue" in tables else MANY

    def with_lives(self) -> "Design":
        """Return the same with the parts whose lives are told apart: of whole drives and of wraps."""
        wrap = (CHAIN, SPROCKET) if MECHANISMS["wrap"] in self._mechanisms else ()
        return replace(self, lives=self.parts or wrap)

    @cached_property
    def _mechanisms(self) -> set[MechanismEntry]:
        """Mechanisms of the cases; those of the same kind and profile have the same one."""
        differs = [place for place, key in enumerate(self.keys) if key in _OF_A_MECHANISM]
        cases = {tuple(str(row[place]) for place in differs): index for index, row in enumerate(self.rows)}
        return {mechanism_of(self.tables_of(index)) for index in cases.values()}


Item = TypeVar("Item")


def batched(rows: Sequence[Item]) -> Iterator[Sequence[Item]]:
    """Give a sequence in pieces, as a million rows at once take a gigabyte as text."""
    for first in range(0, len(rows), _BATCH):
        yield rows[first : first + _BATCH]


_BATCH = 10_000


def content_hash(content: Mapping[str, Any]) -> str:
    """Return the hash of plain values that does not depend on the order of keys.

    Examples
    --------
    >>> content_hash({"a": 1, "b": 2.0}) == content_hash({"b": 2.0, "a": 1})
    True
    """
    # Dates of TOML are the only values that JSON does not know.
    text = json.dumps(content, sort_keys=True, separators=(",", ":"), default=str)
    return hashlib.sha256(text.encode()).hexdigest()


def replaced(tables: Mapping[str, Any], path: Sequence[str], value: Any) -> dict[str, Any]:
    """Return tables with one value set, what it does not touch shared.

    Examples
    --------
    >>> replaced({"duty": [{"speed_rpm": 1}]}, ["duty", "1", "speed_rpm"], 2)
    {'duty': [{'speed_rpm': 2}]}
    """
    head, *rest = path
    if not rest:
        return {**tables, head: value}
    below = tables.get(head, {})
    if isinstance(below, Mapping):
        return {**tables, head: replaced(below, rest, value)}
    number, *rest = rest
    if not isinstance(below, list) or not is_number(number) or not 0 < int(number) <= len(below):
        counted = f"holds {len(below)} tables" if isinstance(below, list) else "is a key, no table"
        raise CaseError([Fault(f"must be a key of the case, but {head} {counted}", ".".join(path))])
    entry = replaced(below[int(number) - 1], rest, value) if rest else value
    return {**tables, head: [*below[: int(number) - 1], entry, *below[int(number) :]]}


def value_at(tables: Mapping[str, Any], key: str) -> Any:
    """Return the value of a key.

    Examples
    --------
    >>> value_at({"duty": [{"speed_rpm": 1}]}, "duty.1.speed_rpm")
    1
    """
    found: Any = tables
    for part in key.split("."):
        if isinstance(found, list):
            is_there = is_number(part) and 0 < int(part) <= len(found)
            found = found[int(part) - 1] if is_there else None
        else:
            found = found.get(part) if isinstance(found, Mapping) else None
    return found


def value_in(case: Case | DriveCase, key: str) -> Any:
    """Return the value of a key in a case with every default taken; None where there is none.

    Of a drive ``sprocket.2.teeth`` is a key of the second sprocket, all else is of the driver.
    """
    table, _, rest = key.partition(".")
    number, _, name = rest.partition(".")
    if isinstance(case, Case) or table != "sprocket":
        return value_at(case.chain_case.inputs, key)
    if not is_number(number) or not 0 < int(number) <= len(case.wheels):
        return None
    wheel = case.wheels[int(number) - 1]
    if wheel.is_smooth:
        return value_at(case.inputs["sprocket"][int(number) - 1], name)
    return value_at(case.single_cases[wheel.parts[0]].inputs, f"sprocket.{name}")


def design(document: Document, keys: Sequence[str], rows: Sequence[Sequence[Any]], file: str) -> Design:
    """Return the cases of a study with the texts of all their files."""
    _check_keys(document, keys, file)
    files: dict[str, str] = {}
    tables = copy.deepcopy(dict(document.data))
    remove_alternatives(tables, keys)
    for path in file_paths(document.data):
        given = value_at(tables, ".".join(path))
        if isinstance(given, str):
            tables = replaced(tables, path, _taken(document, files, given))
    if any(without_numbers(key) in NAMES_FILE for key in keys):
        rows = [
            tuple(
                _taken(document, files, value)
                if without_numbers(key) in NAMES_FILE and isinstance(value, str)
                else value
                for key, value in zip(keys, row, strict=True)
            )
            for row in rows
        ]
    return Design(document.name, tables, files, tuple(keys), rows).with_lives()


def _check_keys(document: Document, keys: Sequence[str], file: str) -> None:
    found = ((key, unknown_key(document.data, key)) for key in keys)
    faults = [Fault(text, f'"{key}"', file) for key, text in found if text]
    if faults:
        raise CaseError(faults)


def unknown_key(tables: Mapping[str, Any], key: str) -> str:
    """Say that a case has no such key, and which may be meant; empty where it may have it.

    Examples
    --------
    >>> unknown_key({"chain": {}}, "load.powr_kW")
    "must be a key of a case; did you mean 'load.power_kW' or 'duty.power_kW'?"
    """
    fields = {key.replace("[]", ""): field for key, field in schema_fields(schema_of(tables))}
    known, plain = set(fields), without_numbers(key)
    holder = fields.get(plain.rpartition(".")[0])
    if holder is not None and is_dict(holder.annotation):
        return ""
    return "" if plain in known else f"must be a key of a case{nearest(plain, dict.fromkeys(known))}"


def _taken(document: Document, files: dict[str, str], path: str) -> str:
    """Read a file that a case names, if it is there, and return its name without folder."""
    name = PurePath(path).name
    try:
        text = given_text(document.folder / path, "surrogateescape")
    except OSError:
        return name
    if files.setdefault(name, text) != text:
        raise CaseError([Fault(f"two files of a study must not share the name {name}: rename one")])
    return name
