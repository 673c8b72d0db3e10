"""Tables whose keys are the dotted names of a case's keys."""

from typing import Annotated, Any

from pydantic import Discriminator, Tag


def dotted(value: Any, leaf: str | None = None) -> Any:
    """Return nested tables as one with dotted keys, so that both ways to write them are one.

    Parameters
    ----------
    value : object
        What was given; anything but a table comes back as it is.
    leaf : str, optional
        Key by which a table is a value, not a level of names; so is then one that holds neither
        tables nor lists, whose keys may be misspelt. Where it is left out no table is a value.

    Returns
    -------
    object
        A table of one level.

    Raises
    ------
    ValueError
        A key is given in both ways.

    Examples
    --------
    >>> dotted({"wear": {"coefficient": {"from": 1, "to": 2}}}, "from")
    {'wear.coefficient': {'from': 1, 'to': 2}}
    """
    if not isinstance(value, dict):
        return value
    flat: dict[str, Any] = {}
    for key, below in value.items():
        nested = isinstance(below, dict) and not (leaf is not None and _is_value(below, leaf))
        inner = dotted(below, leaf) if nested else {"": below}
        for name, entry in inner.items():
            whole = f"{key}.{name}" if name else key
            if whole in flat:
                raise ValueError(f"{whole} is given twice, with and without quotes: remove one")
            flat[whole] = entry
    return flat


def _is_value(table: dict[str, Any], leaf: str) -> bool:
    return leaf in table or not any(isinstance(entry, dict | list) for entry in table.values())


def list_or(table: Any, values: Any) -> Any:
    """Return the type of a key that takes a table or a list, faulted as what was meant.

    Parameters
    ----------
    table, values : type
        Of the table and of the list.

    Returns
    -------
    type
        For pydantic, which else tells the faults of both.
    """
    return Annotated[
        Annotated[table, Tag(_TABLE)] | Annotated[values, Tag(_LIST)],
        Discriminator(lambda value: _LIST if isinstance(value, list) else _TABLE),
    ]


_TABLE, _LIST = "(table)", "(list)"
CHOSEN = (_TABLE, _LIST)
"""What pydantic adds to the place of a fault by `list_or`."""
