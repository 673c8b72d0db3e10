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

    Examples
    --------
    >>> dotted({"wear": {"coefficient": {"from": 1, "to": 2}}}, "from")
    {'wear.coefficient': {'from': 1, 'to': 2}}
    """
    if not isinstance(value, dict):
        return value
    flat: dict[str, Any] = {}
    for key, below in value.items():
        if isinstance(below, dict) and leaf not in below:
            flat |= {f"{key}.{name}": entry for name, entry in dotted(below, leaf).items()}
        else:
            flat[key] = below
    return flat
