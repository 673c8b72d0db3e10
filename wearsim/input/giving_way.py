"""Keys that give way to others: where they stand, and an input without them."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from wearsim.errors import CaseError, Fault
from wearsim.input.keys import schema_of, tables_in
from wearsim.input.table import Table, is_number, others_of

Rule = Callable[[type[Table], str], Iterable[str]]
"""Which keys of a table, or of those in it, give way to a key of it."""


def giving_way(tables: Mapping[str, Any], key: str, rule: Rule) -> Iterator[str]:
    """Give the keys that give way to another, as each table on the way to it tells."""
    model: type[Table] | None = schema_of(tables)
    parts, place = key.split("."), ""
    while model is not None and parts:
        yield from (f"{place}{other}" for other in rule(model, ".".join(parts)))
        name, *parts = parts
        numbered = bool(parts) and is_number(parts[0])
        place += f"{name}.{parts.pop(0)}." if numbered else f"{name}."
        field = model.model_fields.get(name)
        model = None if field is None else next(tables_in(field.annotation), None)


def alternatives(tables: Mapping[str, Any], keys: Iterable[str]) -> list[str]:
    """Return the keys that cannot stand beside others, as they give the same quantity.

    Examples
    --------
    >>> alternatives({"chain": {}, "load": {"tension_N": 900}}, ["load.power_kW"])
    ['load.tension_N', 'load.torque_N_m']
    """
    keys = list(keys)
    found = (giving_way(tables, key, lambda model, rest: others_of(rest, *model.one_of())) for key in keys)
    return [other for others in found for other in others if other not in keys]


def remove_alternatives(tables: dict[str, Any], keys: Iterable[str]) -> None:
    """Remove what cannot stand beside keys that are set."""
    for other in alternatives(tables, keys):
        remove(tables, other)


def remove(tables: dict[str, Any], key: str) -> None:
    """Remove a key, and the table that then holds nothing."""
    head, _, rest = key.partition(".")
    below = tables.get(head)
    if not rest:
        tables.pop(head, None)
    elif isinstance(below, dict):
        remove(below, rest)
        if not below:
            del tables[head]
    elif isinstance(below, list):
        number, _, rest = rest.partition(".")
        remove(entry_of(below, number, key), rest)


def entry_of(place: Any, number: str, key: str) -> Any:
    """Return one of several tables by its number from 1."""
    if not isinstance(place, list):
        raise CaseError([Fault("must be a key of a table, but what holds it is a value: correct it", key)])
    if not is_number(number) or not 1 <= int(number) <= len(place):
        text = f"must name one of {len(place)} tables by its number from 1, such as 1 (got {number!r})"
        raise CaseError([Fault(text, key)])
    return place[int(number) - 1]
