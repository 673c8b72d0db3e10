"""Wear laws that a program gives as functions, beside those of the catalogue, for as long as it runs."""

import inspect
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from numbers import Real
from typing import Any

from wearsim.catalogue.catalogues import WearLawEntry, wear_laws
from wearsim.errors import CaseError, Fault

_FITTED = 5.0
"""Factor to either side of a constant without a range within which `calibrate` looks for it."""


@dataclass(frozen=True)
class Constant:
    """A constant of a law."""

    value: float  # where a case gives none
    # low, high: ends of its range; infinite where it has none
    low: float = -math.inf
    high: float = math.inf

    @property
    def fitted(self) -> tuple[float, float] | None:
        """Range within which it may be fitted, by its logarithm; None where it may be 0 or less."""
        if self.value <= 0.0:
            return None
        if math.isinf(self.low):
            return self.value / _FITTED, self.value * _FITTED
        return (self.low, self.high) if self.low > 0.0 else None


@dataclass(frozen=True)
class OwnWearLaw:
    """A wear law that a program gave."""

    name: str
    function: Callable[..., Any]  # of pressure, load, speed and slip, with the constants by their names
    constants: Mapping[str, Constant]
    source: str  # where it comes from


_LAWS: dict[str, OwnWearLaw] = {}


def own_wear_laws() -> Mapping[str, OwnWearLaw]:
    """Return the laws that the program has given so far, by their names."""
    return _LAWS


def wear_law(
    name: str,
    function: Callable[..., Any],
    constants: Mapping[str, float | tuple[float, float, float]] | None = None,
    *,
    source: str,
) -> str:
    """Add a wear law of your own, for as long as the program runs.

    A case names it as ``wear.law``. ``wear.coefficient`` multiplies it, 1 where it is left out, and its
    constants are keys too, such as ``wear.constants.m``: `Case.with_`, `sweep`, `uncertainty` and `optimise`
    take them, and `calibrate` fits the coefficient and those constants that ``fit`` names.

    It is for one constant load on a straight strand, under a table of loads or on a pair of gears, where it
    must not depend on the slip. Chains that wrap a sprocket, whole drives among them, a duty of several
    blocks and ``run.method = "per_cycle"`` refuse it. To add it again replaces it, also for cases that were
    loaded before.

    Parameters
    ----------
    name : str
        What cases call it; not a law of ``wearsim list wear-laws``.
    function : callable
        ``function(pressure, load, speed, slip, **constants)``, the depth worn off per sliding distance
        [mm/mm], in plain Python or compiled by numba. It takes arrays of numpy and returns one of their
        shape, smooth and not negative. ``pressure`` is the pressure at a point of the contact [MPa],
        ``load`` the load of the whole contact per width [N/mm], ``speed`` the sliding speed [mm/s] (nan where
        a table of loads does not give it), ``slip`` sliding over rolling (nan under a table of sliding
        distances).
    constants : mapping, optional
        Its further arguments by name: the value where a case gives none, or low, value and high, the range in
        which it holds.
    source : str
        Where it comes from; it stands among the assumptions of every life.

    Returns
    -------
    str
        Its name, for the case.

    Raises
    ------
    CaseError
        What is wrong with it.

    Examples
    --------
    Archard's law, whose constant is the specific wear rate [mm2/N]:

    >>> import wearsim
    >>> def mine(pressure, load, speed, slip, k):
    ...     return k * pressure
    >>> wearsim.wear_law("my archard", mine, {"k": 1.8e-10}, source="own rig")
    'my archard'
    """
    faults = [*_name_faults(name, source), *_constant_faults(constants or {})]
    if not faults:
        faults = list(_call_faults(function, constants or {}))
    if faults:
        raise CaseError([Fault(text, key, f"wear law {name!r}") for key, text in faults])
    ranges = {
        key: given if isinstance(given, tuple) else (given,) for key, given in (constants or {}).items()
    }
    taken = {
        key: Constant(float(one[0]))
        if len(one) == 1
        else Constant(float(one[1]), float(one[0]), float(one[2]))
        for key, one in ranges.items()
    }
    _LAWS[name] = OwnWearLaw(name, function, taken, source)
    wear_laws()[name] = WearLawEntry(
        name,
        "law",
        "a user-defined function",
        ("coefficient",),
        "one constant load on a strand, under a table of loads or on a pair of gears",
        source,
        "wraps, whole drives, a duty of several blocks, run.method = 'per_cycle'",
    )
    return name


def own_constant_faults(law: OwnWearLaw | None, given: Mapping[str, float]) -> list[tuple[str, str]]:
    """Return what is wrong with the constants of a case; its law is None where it is of the catalogue."""
    if law is None:
        return [("constants", "belongs to a user-defined wear law: remove it")] if given else []
    known = ", ".join(law.constants) or "none"
    return [
        (f"constants.{name}", f"wear law {law.name!r} has no such constant (it has: {known})")
        for name in given
        if name not in law.constants
    ]


def _name_faults(name: str, source: str) -> list[tuple[str, str]]:
    found = []
    if not name.strip() or (name in wear_laws() and name not in _LAWS):
        found.append(("name", f"must be a name that no other wear law has (got {name!r})"))
    if not source.strip():
        found.append(("source", "must say where the law comes from"))
    return found


def _constant_faults(constants: Mapping[str, Any]) -> list[tuple[str, str]]:
    found = []
    for key, given in constants.items():
        numbers = given if isinstance(given, tuple) else (given,)
        plain = all(isinstance(one, Real) and math.isfinite(one) for one in numbers)
        if not str(key).isidentifier():
            found.append((f"constants.{key}", "must be the name of an argument of the function"))
        if not plain or len(numbers) not in (1, 3) or list(numbers) != sorted(numbers):
            text = f"must be a number, or low, value and high in this order (got {given!r})"
            found.append((f"constants.{key}", text))
    return found


def _call_faults(function: Callable[..., Any], constants: Mapping[str, Any]) -> list[tuple[str, str]]:
    if not callable(function):
        return [("function", f"must be a function (got {function!r})")]
    try:
        inspect.signature(function).bind(1.0, 1.0, 1.0, 1.0, **constants)
    except TypeError as error:
        names = ", ".join(["pressure", "load", "speed", "slip", *constants])
        return [("function", f"must take {names}: {error}")]
    except ValueError:  # one without a signature, such as one of numpy
        pass
    return []
