"""Tables whose keys are the dotted names of a case's keys."""

from typing import Any


def dotted(value: Any, leaf: str) -> Any:
    """Return nested tables as one with dotted keys, so that both ways to write them are one.

    Parameters
    ----------
    value : object
        What was given; anything but a table comes back as it is.
    leaf : str
        Key by which a table is a value, not a level of names.

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
        nested = isinstance(below, dict) and leaf not in below
        inner = dotted(below, leaf) if nested else {"": below}
        for name, entry in inner.items():
            whole = f"{key}.{name}" if name else key
            if whole in flat:
                raise ValueError(f"{whole} is given twice, with and without quotes: remove one")
            flat[whole] = entry
    return flat
