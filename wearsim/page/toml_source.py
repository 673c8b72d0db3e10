"""The text of an input file, key by key: comments and order stay as they are."""

import tomllib
from collections.abc import Iterator, Mapping
from typing import Any

import tomlkit
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import AoT, InlineTable, Item, String, Table


def parsed_tables(text: str) -> dict[str, Any] | None:
    """Return the tables of an input file."""
    try:
        tomlkit.parse(text)
        return tomllib.loads(text)
    except (ValueError, RecursionError):
        return None


def shown_values(text: str) -> dict[str, str]:
    r"""Return what stands at each key, as the form shows it.

    Examples
    --------
    >>> shown_values('title = "A"  # of the drive\n[load]\npower_kW = 3.0\n[[duty]]\nspeed_rpm = 1')
    {'title': 'A', 'load.power_kW': '3.0', 'duty.1.speed_rpm': '1'}
    """
    return dict(_leaves(tomlkit.parse(text), ""))


def with_value(text: str, key: str, typed: str, is_text: bool = False) -> str:
    r"""Return an input file with another value at a key.

    Examples
    --------
    >>> print(with_value("[load]\npower_kW = 3  # shaft\n", "load.power_kW", "4 kW"), end="")
    [load]
    power_kW = "4 kW"  # shaft
    >>> with_value("[load]\npower_kW = 3\n", "load.power_kW", "")
    ''
    """
    document = tomlkit.parse(text)
    if not typed.strip():
        _remove(document, key.split("."))
        return tomlkit.dumps(document)
    _holder(document, key)
    # Read again, a new table takes its keys before the empty line that it ends in.
    document = tomlkit.parse(tomlkit.dumps(document))
    place, last = _holder(document, key)
    place[last] = typed if is_text else _value(typed.strip())
    return tomlkit.dumps(document)


def with_table(text: str, name: str) -> str:
    r"""Return an input file with one more table in a list of tables.

    Examples
    --------
    >>> with_table("title = 'A'\n", "duty")
    "title = 'A'\n\n[[duty]]\n"
    >>> print(with_table("[[sprocket]]\nteeth = 21\n", "sprocket.1.cog"), end="")
    [[sprocket]]
    teeth = 21
    [[sprocket.cog]]
    """
    document = tomlkit.parse(text)
    place, last = _holder(document, name)
    if last not in place:
        (_spaced(place) if place is document else place).add(last, tomlkit.aot())
    tables = place[last]
    if isinstance(tables, AoT):
        tables.append(_table_like(tables[-1] if len(tables) else place))
    else:
        tables.append(tomlkit.inline_table())
    return tomlkit.dumps(document)


def without_table(text: str, name: str, number: int) -> str:
    r"""Return an input file without one of the tables of a list.

    Examples
    --------
    >>> without_table("cog = [{teeth = 11}, {teeth = 12}]\n", "cog", 1)
    'cog = [{teeth = 12}]\n'
    """
    document = tomlkit.parse(text)
    place, last = _holder(document, name)
    if len(place[last]) == 1:
        place.remove(last)
    else:
        del place[last][number - 1]
    return tomlkit.dumps(document)


def _holder(document: Any, key: str) -> tuple[Any, str]:
    """Return the table that holds a key, a new one where it is missing, and the key's own name."""
    *tables, last = key.split(".")
    place = document
    for depth, part in enumerate(tables):
        place = _below(place, part, deeper=depth + 1 < len(tables))
    return place, last


def _leaves(table: Any, prefix: str) -> Iterator[tuple[str, str]]:
    for name, value in table.items():
        if isinstance(value, Mapping):
            if isinstance(value, InlineTable):
                yield f"{prefix}{name}", value.as_string()
            yield from _leaves(value, f"{prefix}{name}.")
        elif isinstance(value, list) and value and isinstance(value[0], Mapping):
            for number, entry in enumerate(value, start=1):
                if isinstance(entry, Mapping):
                    yield from _leaves(entry, f"{prefix}{name}.{number}.")
        elif isinstance(value, String):
            yield f"{prefix}{name}", str(value)
        else:
            yield f"{prefix}{name}", value.as_string() if isinstance(value, Item) else str(value)


def _value(typed: str) -> Any:
    try:
        return tomlkit.value(typed)
    except (TOMLKitError, ValueError, RecursionError):
        pass
    try:
        return float(typed)
    except ValueError:
        return typed


def _below(place: Any, part: str, deeper: bool) -> Any:
    """Return a table of a table, a new one where it is missing."""
    if isinstance(place, list):
        return place[int(part) - 1]
    if part not in place or not isinstance(place[part], Mapping | list):
        new = tomlkit.table(is_super_table=True) if deeper else _table_like(place)
        if part in place:
            place[part] = new
        elif isinstance(place, tomlkit.TOMLDocument):
            _spaced(place).add(part, new)
        else:
            place.add(part, new)
    return place[part]


def _table_like(place: Any) -> Table:
    """Return a new table that ends in an empty line where the one before it does."""
    new = tomlkit.table()
    if isinstance(place, Table) and place.as_string().endswith("\n\n"):
        new.add(tomlkit.nl())
    return new


def _spaced(document: Any) -> Any:
    """Return a document that ends in an empty line, for a header to come."""
    text = tomlkit.dumps(document)
    if text and not text.endswith("\n\n"):
        document.add(tomlkit.nl())
    return document


def _remove(document: Any, parts: list[str]) -> None:
    """Remove a key, and the tables above it that then hold neither keys nor comments."""
    places = [document]
    for part in parts[:-1]:
        place = places[-1]
        known = int(part) <= len(place) if isinstance(place, list) else part in place
        if not known:
            return
        places.append(place[int(part) - 1] if isinstance(place, list) else place[part])
    for place, part in zip(reversed(places), reversed(parts), strict=True):
        if isinstance(place, list) or part not in place:
            return
        del place[part]
        if len(place) or not isinstance(place, InlineTable | Table):
            return
        if isinstance(place, Table) and place.as_string().strip():
            return
