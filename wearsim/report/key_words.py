"""Keys and columns as people write them: `load.tension_N` is a tension in N, `sprocket.teeth` are teeth."""

import re
from collections.abc import Sequence
from typing import Any

from wearsim.quantities import grouped, quantities

_SPELLED = {"h": "hours", "%": "percent"}
_RAISED = str.maketrans("0123456789-", "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079\u207b")
_EXPONENT = re.compile(r"\^(-?\d+)")
_WRITTEN = str.maketrans({"^": "", "(": "", ")": "", "*": "_", "/": "|"})


def key_words(key: str, among: Sequence[str] = ()) -> str:
    """Return a key without its unit; with its table where another key among some has the same words.

    Examples
    --------
    >>> key_words("load.slack_tension_N")
    'slack tension'
    >>> key_words("sprocket.2.teeth", ["sprocket.1.teeth", "sprocket.2.teeth"])
    'sprocket 2: teeth'
    """
    words = _without_unit(key)
    if any(other != key and _without_unit(other) == words for other in among):
        return f"{key.rpartition('.')[0].replace('.', ' ').replace('_', ' ')}: {words}"
    return words


def unit_words(unit: str) -> str:
    """Return a unit with raised exponents, as it is printed.

    Examples
    --------
    >>> unit_words("mm^2/N"), unit_words("N*m")
    ('mm\u00b2/N', 'N\u00b7m')
    """
    return _EXPONENT.sub(lambda found: found[1].translate(_RAISED), unit).replace("*", "\u00b7")


def number_words(value: float) -> str:
    """Return a number with few digits, very large and small ones by a power of ten.

    Examples
    --------
    >>> number_words(1500.0), number_words(1e-9), number_words(2.5e-10)
    ('1 500', '10\u207b\u2079', '2.5\u00b710\u207b\u00b9\u2070')
    """
    mantissa, _, exponent = grouped(value).partition("e")
    if not exponent:
        return mantissa
    power = f"10{str(int(exponent)).translate(_RAISED)}"
    return power if mantissa == "1" else f"{mantissa}\u00b7{power}"


def axis_label(key: str, among: Sequence[str] = ()) -> str:
    """Return what stands at the axis of a key.

    Examples
    --------
    >>> axis_label("load.tension_N"), axis_label("sprocket.teeth")
    ('tension, N', 'teeth')
    """
    unit = unit_words(_unit(key))
    return f"{key_words(key, among)}, {unit}" if unit else key_words(key, among)


def with_value(key: str, value: Any, among: Sequence[str] = ()) -> str:
    """Return a key with its value.

    Examples
    --------
    >>> with_value("load.tension_N", 2000.0), with_value("sprocket.teeth", 20)
    ('tension 2 000 N', '20 teeth')
    >>> with_value("wear.condition", "hardened, oiled")
    'condition hardened, oiled'
    """
    words, unit = key_words(key, among), _unit(key)
    if isinstance(value, int) and not isinstance(value, bool) and not unit and ":" not in words:
        return f"{value} {words}"
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return f"{words} {number_words(value) if is_number else value} {unit_words(unit)}".rstrip()


def _unit(key: str) -> str:
    found = quantities().get(key.rpartition(".")[2])
    return (found.unit if found else "") or ("%" if key.endswith("_percent") else "")


def _without_unit(key: str) -> str:
    name, unit = key.rpartition(".")[2], _unit(key)
    spelled = _SPELLED.get(unit, unit.translate(_WRITTEN).replace("|", "_per_").removeprefix("1_"))
    return name.removesuffix(f"_{spelled}").replace("_", " ")
