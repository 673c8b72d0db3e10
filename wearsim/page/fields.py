"""The fields of the form: every key that the schema allows, with its unit and meaning."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, get_origin

from pydantic.fields import FieldInfo

from wearsim.case.keys import Table
from wearsim.catalogue.catalogues import catalogue_rows, chains, environments, lubricants, wear_conditions
from wearsim.input.keys import is_dict, parts, schema_fields, schema_of, tables_in, words
from wearsim.page.field_words import table_label
from wearsim.quantities import input_quantities


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
    ['duty.1', 'duty.2', 'duty[]']
    >>> tables["load"][1].key, tables["load"][1].unit
    ('load.power_kW', 'kW')
    """
    found: dict[str, list[Field]] = {}
    for key, info in schema_fields(schema_of(data)):
        if key == "wear.constants":  # of laws that only a program has
            continue
        field = _field(key, info)
        for place in _places(key, data):
            if place.endswith("[]"):  # where one more is added: behind those that there are
                found[place] = found.pop(place, [])
            else:
                found.setdefault(place.rpartition(".")[0], []).append(replace(field, key=place))
    return found


def owner(table: str) -> str:
    """Return the table of a list that another table stands in, empty for none.

    Examples
    --------
    >>> owner("sprocket.2.cog.1"), owner("sprocket.2.cog[]"), owner("sprocket.2"), owner("material.chain")
    ('sprocket.2', 'sprocket.2', '', '')
    """
    head, *inner = table.split(".")
    return f"{head}.{inner[0]}" if len(inner) > 1 and inner[0].isdigit() else ""


def table_title(data: Mapping[str, Any], name: str) -> str:
    """Return a table in plain words, one of a list with its number and what it is called.

    Examples
    --------
    >>> wheels = {"sprocket": [{"name": "motor"}, {"cog": [{"teeth": 11}]}]}
    >>> table_title(wheels, "sprocket.1"), table_title(wheels, "sprocket.2.cog.1")
    ('Sprocket 1: motor', 'Cog 1: 11 teeth')
    >>> table_title(wheels, "sprocket.2.take_up"), table_title(wheels, "duty[]")
    ('Take-up', 'Load block: add one')
    """
    words = table_label(".".join(_named_parts(name)))
    number = name.rpartition(".")[2]
    if name.endswith("[]"):
        return f"{words}: add one"
    if not number.isdigit():
        return words
    table = value_at(data, name)
    teeth, called = (table.get(key) if isinstance(table, Mapping) else None for key in ("teeth", "name"))
    about = called or (f"{teeth} teeth" if teeth else "")
    return f"{words} {number}" + (f": {about}" if about else "")


def table_header(name: str) -> str:
    """Return the header of a table as it stands in the file.

    Examples
    --------
    >>> table_header("sprocket.2.cog.1"), table_header("duty[]"), table_header("material.chain")
    ('[[sprocket.cog]]', '[[duty]]', '[material.chain]')
    """
    header = ".".join(_named_parts(name))
    return f"[[{header}]]" if name.endswith("[]") or name.rpartition(".")[2].isdigit() else f"[{header}]"


def value_at(data: Mapping[str, Any], key: str) -> Any:
    """Return what stands at a key, None for nothing.

    Examples
    --------
    >>> value_at({"duty": [{"speed_rpm": 2}]}, "duty.1.speed_rpm"), value_at({}, "load.power_kW")
    (2, None)
    """
    place: Any = data
    for part in key.split("."):
        if isinstance(place, list | tuple) and part.isdigit() and int(part) <= len(place):
            place = place[int(part) - 1]
        else:
            place = place.get(part) if isinstance(place, Mapping) else None
    return place


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


def _named_parts(name: str) -> list[str]:
    return [part for part in name.removesuffix("[]").split(".") if not part.isdigit()]


def _field(key: str, info: FieldInfo) -> Field:
    name = key.rpartition(".")[2]
    quantity = input_quantities()[name]
    kinds = list(parts(info.annotation))
    one_word = () if any(get_origin(kind) is list for kind in kinds) else words(info)
    default = None if info.is_required() else info.get_default(call_default_factory=True)
    return Field(
        key=key,
        unit=quantity.unit,
        meaning=quantity.meaning,
        choices=one_word,
        proposals=catalogue_words(key),
        is_text=(str in kinds and not is_dict(info.annotation)) or (bool(one_word) and bool not in kinds),
        required=info.is_required(),
        default="" if default in (None, "") else _word(default),
    )


def _word(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:g}" if isinstance(value, float) else str(value)


def _places(key: str, data: Mapping[str, Any]) -> Iterator[str]:
    """Give a key in every table of its list, then the list itself, ``name[]``."""
    head, brackets, tail = key.partition("[]")
    if not brackets:
        yield key
        return
    tables = value_at(data, head)
    for number in range(1, len(tables) + 1 if isinstance(tables, list) else 1):
        yield from _places(f"{head}.{number}{tail}", data)
    yield f"{head}[]"


def catalogue_words(key: str) -> tuple[str, ...]:
    """Return the words of a catalogue that a key may hold."""
    if key == "chain.designation":
        return tuple(dict.fromkeys(chain.designation for chain in chains().values()))
    if key.endswith(("wear.condition", "joint.condition")):
        return tuple(wear_conditions())
    if key.endswith(".lubricant"):
        return tuple(lubricants())
    if key.endswith(".environment"):
        return tuple(environments())
    if "material." in key and key.endswith(".name"):
        return tuple(row["name"] for row in catalogue_rows("materials"))
    return ()
