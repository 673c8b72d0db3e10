"""What is imported when it is first used: names of a package, and what a row of a list names."""

import warnings
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any


def named(place: str) -> Any:
    """Return the object of a place `module:name`.

    Examples
    --------
    >>> named("math:sqrt")(9.0)
    3.0
    """
    module, _, name = place.partition(":")
    return getattr(import_module(module), name)


def lazy_names(
    package: str, places: Mapping[str, str], former: Mapping[str, tuple[str, str]] | None = None
) -> tuple[Callable[[str], Any], Callable[[], list[str]]]:
    """Return ``__getattr__`` and ``__dir__`` of a package whose names stand in other modules.

    Former names lead to the name of today and the version that will be without them: they still work,
    with a warning.

    Examples
    --------
    >>> getter, _ = lazy_names("shapes", {"tau": "math"}, {"turn": ("tau", "2.0")})
    >>> round(getter("tau"), 4)
    6.2832
    """

    def getter(name: str) -> Any:
        if former is not None and name in former:
            present, last = former[name]
            text = f"{package}.{name} is called {package}.{present} now and goes with version {last}"
            warnings.warn(text, DeprecationWarning, stacklevel=2)
            return getter(present)
        if name not in places:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        return getattr(import_module(places[name]), name)

    return getter, lambda: sorted(places)
