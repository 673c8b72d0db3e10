"""Libraries that not every user has: installed by ``pip install 'wearsim[EXTRA]'``."""

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib import import_module, util
from pathlib import Path
from typing import Any

from wearsim.errors import CaseError, Fault

_DISTRIBUTIONS = {"skfem": "scikit-fem"}
"""Names that modules are installed by, where they differ."""


@dataclass(frozen=True)
class Library:
    """A library that wearsim uses."""

    name: str  # as it is installed
    extra: str  # extra of wearsim that brings it, empty where it always comes
    lowest: str  # versions between which the tests have passed
    newest: str  # versions between which the tests have passed


@cache
def libraries() -> tuple[Library, ...]:
    """Return the libraries that wearsim uses, those of extras last."""
    path = Path(__file__).with_name("libraries.csv")
    with path.open(encoding="utf-8", newline="") as file:
        return tuple(
            Library(row["library"], row["extra"], row["lowest"], row["newest"])
            for row in csv.DictReader(file)
        )


def library(module: str, extra: str, option: str) -> Any:
    """Return a library of an extra.

    Examples
    --------
    >>> library("math", "report", "--xlsx").sqrt(9.0)
    3.0
    """
    try:
        return import_module(module)
    except ImportError:
        raise _missing(module, extra, option) from None


def check_installed(modules: Sequence[str], extra: str, option: str) -> None:
    """Find out whether libraries of an extra are there, without the time to load them.

    Examples
    --------
    >>> check_installed(["math", "json"], "report", "report")
    """
    for module in modules:
        if util.find_spec(module) is None:
            raise _missing(module, extra, option)


def _missing(module: str, extra: str, option: str) -> CaseError:
    name = _DISTRIBUTIONS.get(module, module)
    text = f"needs {name}, which is not installed: pip install 'wearsim[{extra}]'"
    return CaseError([Fault(text, file=option)])
