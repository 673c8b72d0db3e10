"""Names of a package that are imported when they are first used."""

import warnings
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any


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
