"""The fields of the form: every key that the schema allows, with its unit and meaning."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, get_origin

from pydantic.fields import FieldInfo

from wearsim.catalogue.catalogues import catalogue_rows, chains, wear_conditions
from wearsim.input.keys import parts, schema_fields, schema_of, tables_in, words
from wearsim.input.schema import Table
from wearsim.quantities import quantities


@dataclass(frozen=True)
class Field:
    """A key of an input file as the form shows it."""

    key: str  # dotted; tables of a list by their numbers from 1
    unit: str  # of the quantity
    meaning: str  # of the quantity
    choices: tuple[str, ...]  # all words that it may hold; empty where it holds more than words
    proposals: tuple[str, ...]  # words of the catalogue that it may hold
    is_text: bool  # whether what is typed is a text whatever it looks like
    required: bool  # whether its table must hold it
    default: str  # what the schema takes where it is left out

    @property
    def table(self) -> str:
        """Dotted name of its table, empty for what stands above all tables."""
        return self.key.rpartition(".")[0]

    @property
    def name(self) -> str:
        """Its name in the table."""
        return self.key.rpartition(".")[2]


def form_fields(data: Mapping[str, Any]) -> dict[str, list[Field]]:
    """Return the fields of an input file by their tables.

    Examples
    --------
    >>> tables = form_fields({"duty": [{}, {}]})
    >>> [name for name in tables if name.startswith("duty")]
    ['duty[]', 'duty.1', 'duty.2']
    >>> tables["load"][1].key, tables["load"][1].unit
    ('load.power_kW', 'kW')
    """
    found: dict[str, list[Field]] = {}
    for key, info in schema_fields(schema_of(data)):
        head, brackets, _ = key.partition("[]")
        if brackets:
            found.setdefault(f"{head}[]", [])
        for field in _numbered(_field(key, info), data):
            found.setdefault(field.table, []).append(field)
    return found


def table_meaning(data: Mapping[str, Any], name: str) -> str:
    """Return what a table is about.

    Examples
    --------
    >>> table_meaning({}, "stop")
    'Limits; the first one met ends the life.'
    """
    model: type[Table] | None = schema_of(data)
    if not name:
        return ""
    for part in name.removesuffix("[]").split("."):
        if not part.isdigit():
            model = next(tables_in(model.model_fields[part].annotation), None) if model else None
    return (model.__doc__ or "").partition("\n")[0] if model else ""


def _field(key: str, info: FieldInfo) -> Field:
    name = key.rpartition(".")[2]
    quantity = quantities()[name]
    kinds = list(parts(info.annotation))
    one_word = () if any(get_origin(kind) is list for kind in kinds) else words(info)
    default = None if info.is_required() else info.get_default(call_default_factory=True)
    return Field(
        key=key,
        unit=quantity.unit,
        meaning=quantity.meaning,
        choices=one_word,
        proposals=_proposals(key),
        is_text=str in kinds or (bool(one_word) and bool not in kinds),
        required=info.is_required(),
        default="" if default in (None, "") else _word(default),
    )


def _word(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:g}" if isinstance(value, float) else str(value)


def _numbered(field: Field, data: Mapping[str, Any]) -> Iterator[Field]:
    head, brackets, tail = field.key.partition("[]")
    if not brackets:
        yield field
        return
    tables = data.get(head)
    for number in range(1, len(tables) + 1 if isinstance(tables, list) else 1):
        yield replace(field, key=f"{head}.{number}{tail}")


def _proposals(key: str) -> tuple[str, ...]:
    if key == "chain.designation":
        return tuple(chains())
    if key == "wear.condition":
        return tuple(wear_conditions())
    if key.startswith("material.") and key.endswith(".name"):
        return tuple(row["name"] for row in catalogue_rows("materials"))
    return ()
